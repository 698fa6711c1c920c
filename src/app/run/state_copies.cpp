#include "app/run/state_copies.hpp"

#include <fmt/format.h>

#include <utility>

namespace courant {

std::size_t saved_bytes(const World& world) {
  std::size_t sum = 0;
  const auto add = [&](const FieldSet& fields) {
    for (const auto& field : fields.all())
      if (field->info().restart)
        sum += static_cast<std::size_t>(fields.size()) * static_cast<std::size_t>(field->info().components) *
               sizeof(Real);
  };
  add(world.particles.fields);
  add(world.nodes.fields);
  add(world.segments.fields);
  return sum;
}

StateCopies::StateCopies(const World& world, bool wanted, std::int64_t first_cycle)
    : wanted_(wanted), last_cycle_(first_cycle) {
  const std::size_t bytes = saved_bytes(world);
  if (!wanted_ || bytes <= most_bytes) return;
  wanted_ = false;
  refusal_ = fmt::format(
      "a stop in error will leave no restart file of its own: a copy of the state would take {:.1f} GB, more "
      "than "
      "{:.1f}; *DATABASE_BINARY_RUNRSF writes restart files during the run",
      1e-9 * static_cast<double>(bytes), 1e-9 * static_cast<double>(most_bytes));
}

bool StateCopies::is_due(const Clock& clock) const {
  return wanted_ && clock.cycle % Guard::interval == 1 && clock.cycle >= last_cycle_ + spacing &&
         Timer::now() >= rest_until_;
}

std::shared_ptr<StateCopy> StateCopies::take(const Clock& clock,
                                             const std::function<void(SavedState&)>& save) {
  const Timer::time_point start = Timer::now();
  older_ = std::exchange(newest_, nullptr);  // first of all, so that there are never three
  newest_ = std::make_shared<StateCopy>();
  save(newest_->state);
  newest_->t = clock.t;
  newest_->cycle = last_cycle_ = clock.cycle;
  const Timer::time_point end = Timer::now();
  rest_until_ = end + least_rest * (end - start);
  return newest_;
}

}  // namespace courant
