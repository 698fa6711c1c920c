#include "time/access_check.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace courant {

namespace {

const StagePlan::Entry* at_work = nullptr;
/// The running entry; none after its destruction, also where its pass throws.
struct AtWork {
  explicit AtWork(const StagePlan::Entry& entry) { at_work = &entry; }
  ~AtWork() { at_work = nullptr; }
};
/// What it has asked for without having declared it, first. Kept until it is done: it may be at work on
/// several threads, which nothing that is thrown may leave.
std::atomic<const Resource*> undeclared = nullptr;
std::pair<std::string, std::string> left_out;

bool declares(const Accesses& accesses, const Resource& resource) {
  return std::any_of(accesses.all().begin(), accesses.all().end(), [&](const Access& a) {
    return a.what == &resource || (resource.field() && a.what->field() == resource.field());
  });
}
bool declares_change(const Accesses& accesses, const FieldBase& field, Access::When when) {
  return std::any_of(accesses.all().begin(), accesses.all().end(), [&](const Access& a) {
    return a.changes() && a.when == when && (a.what == &field || a.what->field() == &field);
  });
}

[[noreturn]] void stop_for(const StagePlan::Entry& entry, const std::string& what, const Resource& resource) {
  throw std::logic_error(
      fmt::format("pass '{}' {} {} of {}", entry.pass->name(), what, resource.name(), resource.set()));
}

template <class T>
bool add_values(const FieldBase& field, Index n, std::string& bytes) {
  const auto* values = dynamic_cast<const Field<T>*>(&field);
  if (!values) return false;
  for (int k = 0; k < field.info().components; ++k)
    bytes.append(reinterpret_cast<const char*>(values->data(k)), sizeof(T) * static_cast<std::size_t>(n));
  return true;
}

std::size_t hash_of(const FieldBase& field, Index n) {
  std::string bytes;
  add_values<Real>(field, n, bytes) || add_values<Id>(field, n, bytes) || add_values<Index>(field, n, bytes);
  return std::hash<std::string>()(bytes);
}

std::map<const FieldBase*, std::size_t> hashes(const World& world) {
  std::map<const FieldBase*, std::size_t> out;
  for (const FieldSet* set : world.sets())
    for (const auto& field : set->all()) out[field.get()] = hash_of(*field, set->size());
  return out;
}

}  // namespace

void run_checked(const StagePlan::Entry& entry, Access::When when, const World& world,
                 const std::function<void()>& work) {
  const auto before = hashes(world);
  undeclared = nullptr;
  try {
    const AtWork now(entry);
    work();
  } catch (const std::exception&) {  // perhaps because of it
    if (!undeclared) throw;
  }
  if (undeclared) stop_for(entry, "asks, without having declared it, for", *undeclared);
  const auto after = hashes(world);
  for (const auto& [field, hash] : after) {
    const auto old = before.find(field);
    if (old == before.end() || old->second == hash) continue;
    // two turns of one resource: which of them it was is known before or after the work only
    if (!declares_change(entry.accesses, *field, when))
      stop_for(entry, "changes, without having declared it,", *field);
  }
}

void run_block_checked(const StagePlan::Entry& entry, World&, Index begin, Index end,
                       const std::function<void()>& work) {
  struct Hidden {
    Real* values;
    std::vector<Real> kept;
  };
  const StagePlan::Entry* const now = at_work;
  at_work = nullptr;
  const Index n = entry.over->size();
  constexpr Index most_blocks = 32;  // others are not hidden from: that would take the square of their number
  const Index stride = block_count(n) / most_blocks + 1;
  if (begin / block_size % stride != 0) return at_work = now, work();
  std::vector<Hidden> hidden;
  for (const auto& field : entry.over->all()) {
    auto* reals = dynamic_cast<Field<Real>*>(field.get());
    if (!reals || !declares(entry.accesses, *field)) continue;
    const bool others =
        std::any_of(entry.accesses.all().begin(), entry.accesses.all().end(), [&](const Access& a) {
          return (a.what == field.get() || a.what->field() == field.get()) && a.reach == Reach::others;
        });
    if (others) continue;
    for (int k = 0; k < field->info().components; ++k) {
      Real* values = reals->data(k);
      hidden.push_back({values, {values, values + n}});
      std::fill(values, values + begin, std::numeric_limits<Real>::quiet_NaN());
      std::fill(values + end, values + n, std::numeric_limits<Real>::quiet_NaN());
    }
  }
  at_work = now;
  work();
  for (const Hidden& h : hidden) {
    std::copy(h.kept.begin(), h.kept.begin() + begin, h.values);
    std::copy(h.kept.begin() + end, h.kept.end(), h.values + end);
  }
}

void leave_out_declaration(const std::string& pass, const std::string& resource) {
  left_out = {pass, resource};
}
const std::pair<std::string, std::string>& left_out_declaration() {
  return left_out;
}

#ifdef COURANT_CHECK_ACCESSES
void note_access(const Resource& resource) {
  const Resource* none = nullptr;
  if (at_work && !declares(at_work->accesses, resource)) undeclared.compare_exchange_strong(none, &resource);
}
ReadsForMessage::ReadsForMessage() : at_work_(std::exchange(at_work, nullptr)) {}
ReadsForMessage::~ReadsForMessage() {
  at_work = static_cast<const StagePlan::Entry*>(at_work_);
}
#endif

}  // namespace courant
