#include "state/restartable.hpp"

#include <set>
#include <stdexcept>

#include "state/shared_fields.hpp"

namespace courant {
namespace {

template <class T>
bool keep_field(FieldBase& field, Index n, Archive& archive) {
  auto* values = dynamic_cast<Field<T>*>(&field);
  if (!values) return false;
  std::vector<T*> rows;
  for (int k = 0; k < field.info().components; ++k) rows.push_back(values->data(k));
  archive.rows(field.info().name, rows, static_cast<std::size_t>(n));
  return true;
}

/// The first n of each field.
void keep_fields(const std::string& group, FieldSet& fields, Index n, Archive& archive) {
  const Archive::Group inside(archive, group);
  for (const auto& field : fields.all()) {
    const FieldInfo& info = field->info();
    if (!info.restart || (archive.loading() && info.may_begin_later && !archive.has(info.name))) continue;
    if (!keep_field<Real>(*field, n, archive) && !keep_field<Id>(*field, n, archive) &&
        !keep_field<Index>(*field, n, archive))
      throw std::logic_error("field '" + field->info().name + "' has a type that restart files do not know");
  }
}

/// How many of the particles there are in the state. With another ENDTIM a deck with an inlet makes more or
/// fewer particles that wait: those that are missing are not needed yet, and stand behind all others with
/// higher ids; those that are too many wait on.
Index particles_to_load(Particles& p, Archive& archive) {
  const Archive::Group inside(archive, "particles");
  const auto saved = static_cast<Index>(archive.count("id"));
  const bool has_inlets = shared_fields::inlet.find(p.fields) != nullptr;
  if (saved == p.size() || !has_inlets) return p.size();
  if (saved > p.size()) p.fields.resize(saved);
  for (Index i = saved; i < p.size(); ++i)
    if (p.state[i] != particle_waiting) archive.stop("id", "has another length");
  return saved;
}

/// Stops where one of the first n is no index into so many.
void check_indices(const Field<Index>& field, Index n, std::size_t many, const Archive& archive) {
  for (Index i = 0; i < n; ++i)
    if (field[i] < 0 || static_cast<std::size_t>(field[i]) >= many)
      archive.stop(field.info().name, "names what is not there");
}

/// What other arrays are indexed by.
void check_world(const World& world, const Archive& archive) {
  const Particles& p = world.particles;
  const Segments& g = world.segments;
  if (p.active < 0 || p.active > p.moving || p.moving > p.size())
    archive.stop("active", "counts particles that are not there");
  const std::size_t parts = world.part_ids.size(), nodes = static_cast<std::size_t>(world.nodes.size());
  if (parts > 0) check_indices(p.part, p.size(), parts, archive);
  if (parts > 0) check_indices(g.part, g.size(), parts, archive);
  for (const Field<Index>* corner : {&g.node0, &g.node1, &g.node2, &g.node3})
    check_indices(*corner, g.size(), nodes, archive);
  for (const auto& group : world.groups)
    for (int c = 0; c < group->corners(); ++c)
      for (Index e = 0; e < group->size(); ++e)
        if (const Index n = group->node.data(c)[e]; n < 0 || static_cast<std::size_t>(n) >= nodes)
          archive.stop(group->node.info().name, "names what is not there");
}

void keep_ledger(EnergyLedger& e, Archive& archive) {
  const Archive::Group inside(archive, "energy");
  archive("kinetic", e.kinetic);
  archive("internal", e.internal);
  archive("potential", e.potential);
  archive("contact", e.contact);
  archive("hourglass", e.hourglass);
  archive("bulk_viscosity", e.bulk_viscosity);
  archive("dissipated", e.dissipated);
  archive("external_work", e.external_work);
  archive("throughput", e.throughput);
  archive("initial", e.initial);
  archive("half_step", e.half_step);
  archive("below", e.below);
  archive("below_at_start", e.below_at_start);
  archive("peak", e.peak);
  archive("most_internal", e.most_internal);
}

}  // namespace

std::vector<std::pair<std::string, Restartable*>> restartables_of(const World& world) {
  std::vector<std::pair<std::string, Restartable*>> out;
  std::set<std::string> names;
  std::set<Restartable*> known;
  const auto add = [&](Pass& pass) {
    auto* restartable = dynamic_cast<Restartable*>(&pass);
    if (!restartable || !known.insert(restartable).second) return;
    std::string name = pass.name();
    for (int k = 2; !names.insert(name).second; ++k) name = pass.name() + " " + std::to_string(k);
    out.emplace_back(name, restartable);
  };
  for (int k = 0; k <= static_cast<int>(Phase::preparation); ++k)
    for (BlockPass* pass : world.passes.all<BlockPass>())
      if (pass->phase() == static_cast<Phase>(k)) add(*pass);
  for (Pass* pass : world.passes.all<Pass>()) add(*pass);
  return out;
}

void keep_world(World& world, Archive& archive) {
  Particles& p = world.particles;
  const Index known = archive.loading() ? particles_to_load(p, archive) : p.size();
  keep_fields("particles", p.fields, known, archive);
  keep_fields("nodes", world.nodes.fields, world.nodes.size(), archive);
  keep_fields("segments", world.segments.fields, world.segments.size(), archive);
  for (const auto& set : world.other_sets) keep_fields(set->name(), *set, set->size(), archive);
  keep_ledger(world.energy, archive);
  const Archive::Group inside(archive, "world");
  archive("active", p.active);
  archive("moving", p.moving);
  archive("dormant_time", p.dormant_time);
  if (archive.loading()) check_world(world, archive);
  archive("counters", world.counters);
  archive("maxima", world.maxima);
}

void keep_clock(Clock& clock, Archive& archive) {
  const Archive::Group inside(archive, "clock");
  archive("t", clock.t);
  archive("dt", clock.dt);
  archive("dt_old", clock.dt_old);
  archive("cycle", clock.cycle);
}

}  // namespace courant
