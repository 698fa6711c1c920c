// The words of a state.
#include <algorithm>
#include <unordered_map>

#include "d3plot/d3plot_model.hpp"
#include "rigid/bodies/rigid.hpp"
#include "state/force_of_now.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

namespace courant {
namespace {

constexpr const char* plastic_strain = "plastic_strain";
const SharedField<Real> bending_moment{{.name = "bending_moment", .dimension = "ML/T2", .components = 3}};
const SharedField<Real> membrane_force{{.name = "membrane_force", .dimension = "M/T2", .components = 3}};
const SharedField<Real> internal_energy{{.name = "internal_energy", .dimension = "ML2/T2"}};

Real value_of(const Field<Real>* field, Index e, int component = 0) {
  return field ? field->data(component)[e] : 0;
}

bool is_deleted(const FieldSet& fields, Index e) {
  const Field<Index>* eroded = shared_fields::eroded.find(fields);
  return eroded && (*eroded)[e] != 0;
}

/// Points of a layered element that are written: of three the middle, the lowest, the highest; else the first
/// ones, and the last one where the element has fewer.
std::vector<PointReport> shown_points(const std::vector<PointReport>& points, int most) {
  std::vector<PointReport> out;
  if (points.empty()) return out;
  const std::size_t count = points.size();
  if (most == 3)
    return {mean_of({points[(count - 1) / 2], points[count / 2]}), points.front(), points.back()};
  for (std::size_t k = 0; k < static_cast<std::size_t>(most); ++k)
    out.push_back(points[std::min(k, count - 1)]);
  return out;
}

void put_history(const PointReport& point, int count, Words& out) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
    out.real(k < point.history.size() ? point.history[k] : 0);
}

}  // namespace

void D3plotModel::find_sources(const World& world) {
  if (has_sources_) return;
  has_sources_ = true;
  const auto find = [&](ElementKind kind, std::vector<Source>& to) {
    const std::vector<D3plotElement>& elements = mesh_.of(kind);
    std::unordered_map<Id, std::size_t> place;
    for (std::size_t k = 0; k < elements.size(); ++k)
      if (!elements[k].spring) place.emplace(elements[k].id, k);
    to.assign(elements.size(), {});
    for (const auto* reporter : world.passes.all<const ElementReporter>()) {
      if (reporter->kind() != kind) continue;
      const ElementGroup& group = reporter->reported();
      for (Index e = 0; e < group.size(); ++e)
        if (const auto at = place.find(group.id[e]); at != place.end()) to[at->second] = {reporter, e};
    }
    if (kind != ElementKind::shell) return;
    for (Index s = 0; s < world.segments.size(); ++s)
      if (const auto at = place.find(world.segments.id[s]);
          at != place.end() && !(world.segments.volume[s] > 0))
        to[at->second].segment = s;
  };
  find(ElementKind::solid, solids_);
  find(ElementKind::beam, beams_);
  find_springs(world);
  find(ElementKind::shell, shells_);
  std::unordered_map<Id, Index> node;
  for (Index n = 0; n < world.nodes.size(); ++n) node.emplace(world.nodes.id[n], n);
  node_of_.clear();
  for (const Id id : mesh_.node_ids) {
    const auto at = node.find(id);
    node_of_.push_back(at == node.end() ? -1 : at->second);
  }
}

void D3plotModel::find_springs(const World& world) {
  std::unordered_map<Id, std::size_t> row_of;
  for (std::size_t k = 0; k < mesh_.beams.size(); ++k)
    if (mesh_.beams[k].spring) row_of.emplace(mesh_.beams[k].id, k);
  for (const auto* reporter : world.passes.all<const SpringReporter>()) {
    const ElementGroup& group = reporter->spring_group();
    for (Index e = 0; e < group.size(); ++e)
      if (const auto at = row_of.find(group.id[e]); at != row_of.end())
        beams_[at->second] = {nullptr, e, reporter};
  }
}

// Ids of a deck are mostly numbered without large gaps: then a table finds them, faster.
std::vector<Index> D3plotModel::find_particles(const World& world) const {
  const Particles& p = world.particles;
  std::vector<Index> out(mesh_.particles.size(), -1);
  if (out.empty()) return out;
  const Id low = mesh_.particles.front().id, high = mesh_.particles.back().id;
  std::vector<Index> table;
  std::unordered_map<Id, Index> sparse;
  const bool dense = static_cast<std::size_t>(high - low) < 8 * out.size() + 1024;
  if (dense) table.assign(static_cast<std::size_t>(high - low) + 1, -1);
  for (Index i = 0; i < p.size(); ++i)
    if (!dense)
      sparse.emplace(p.id[i], i);
    else if (p.id[i] >= low && p.id[i] <= high)
      table[static_cast<std::size_t>(p.id[i] - low)] = i;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Id id = mesh_.particles[k].id;
    if (dense)
      out[k] = table[static_cast<std::size_t>(id - low)];
    else if (const auto at = sparse.find(id); at != sparse.end())
      out[k] = at->second;
  }
  return out;
}

std::size_t D3plotModel::global_words(const World& world) const {
  return 6 + 7 * mesh_.parts.size() + 4 * world.passes.all<const RigidWallReporter>().size();
}

void D3plotModel::put_globals(const World& world, Words& out) const {
  std::vector<PartSums> sums(world.part_ids.size());
  const Particles& p = world.particles;
  const Field<Real>* volume = shared_fields::reference_volume.find(p.fields);
  for (Index i = 0; i < p.active; ++i) {
    PartSums& part = sums.at(static_cast<std::size_t>(p.part[i]));
    const Vec v = p.v.vec(i);
    part.mass += p.m[i], part.momentum += p.m[i] * v;
    part.kinetic += 0.5 * p.m[i] * v.squaredNorm();
    part.internal += p.E[i] * value_of(volume, i);
  }
  for (const auto* reporter : world.passes.all<const PartReporter>()) reporter->report_part(world, sums);
  for (const auto* bodies : world.passes.all<const RigidBodies>())
    for (const RigidBodyReport& body : bodies->reports())
      for (std::size_t k = 0; k < sums.size(); ++k)
        if (world.part_ids[k] == body.part) {
          sums[k].mass = body.mass, sums[k].momentum = body.mass * body.v;
          sums[k].kinetic = body.kinetic_energy;
        }
  PartSums all;
  for (const PartSums& one : sums) {
    all.kinetic += one.kinetic, all.internal += one.internal, all.hourglass += one.hourglass;
    all.mass += one.mass, all.momentum += one.momentum;
  }
  const auto velocity = [](const PartSums& of) {
    return of.mass > 0 ? Vec(of.momentum / of.mass) : Vec::Zero();
  };
  out.real(all.kinetic);
  out.real(all.internal);
  out.real(all.kinetic + all.internal + all.hourglass);
  out.vec(velocity(all));
  const auto each = [&](const auto& put) {
    for (const D3plotPart& part : mesh_.parts) put(sums[static_cast<std::size_t>(part.index)]);
  };
  each([&](const PartSums& part) { out.real(part.internal); });
  each([&](const PartSums& part) { out.real(part.kinetic); });
  each([&](const PartSums& part) { out.vec(velocity(part)); });
  each([&](const PartSums& part) { out.real(part.mass); });
  each([&](const PartSums& part) { out.real(part.hourglass); });
  const auto walls = world.passes.all<const RigidWallReporter>();
  for (const auto* wall : walls) out.real(wall->report_wall().normal);
  for (const auto* wall : walls) out.vec(wall->report_wall().displacement);
}

// Nodes of bodies move with them: v + omega x r, a + alpha x r + omega x (omega x r).
void D3plotModel::put_nodes(const World& world, const Clock& clock, const std::vector<Index>& particles,
                            Words& out) const {
  const Nodes& nodes = world.nodes;
  const Particles& p = world.particles;
  std::vector<Vec> a(static_cast<std::size_t>(nodes.size()), Vec::Zero());
  for (Index n = 0; n < nodes.size(); ++n)
    if (nodes.follow[n] == 0 && nodes.m[n] > 0) a[static_cast<std::size_t>(n)] = nodes.f.vec(n) / nodes.m[n];
  for (const auto* bodies : world.passes.all<const RigidBodies>()) {
    const std::vector<RigidBodyMotion> motions = bodies->motions(clock);
    for (std::size_t b = 0; b < motions.size(); ++b)
      for (const Index n : bodies->bodies()[b].nodes) {
        const RigidBodyMotion& body = motions[b];
        const Vec r = nodes.x.vec(n) - body.x;
        a[static_cast<std::size_t>(n)] =
            body.a + body.angular_a.cross(r) + body.omega.cross(body.omega.cross(r));
      }
  }
  const std::size_t count = mesh_.node_ids.size();
  std::vector<Index> of(count, -1);
  for (std::size_t k = 0; k < particles.size(); ++k)
    of[static_cast<std::size_t>(mesh_.particles[k].node[0])] = particles[k];
  const auto each = [&](const auto& of_node, const auto& of_particle, const auto& of_none) {
    for (std::size_t k = 0; k < count; ++k)
      out.vec(node_of_[k] >= 0 ? of_node(node_of_[k]) : of[k] >= 0 ? of_particle(of[k]) : of_none(k));
  };
  const auto none = [](std::size_t) { return Vec(Vec::Zero()); };
  const Field<Real>& force = force_of_now(p);
  each([&](Index n) { return nodes.x.vec(n); }, [&](Index i) { return p.place(i, clock.t); },
       [&](std::size_t k) { return mesh_.places[k]; });
  each([&](Index n) { return nodes.v.vec(n); }, [&](Index i) { return p.v.vec(i); }, none);
  each([&](Index n) { return a[static_cast<std::size_t>(n)]; },
       [&](Index i) { return i < p.active ? Vec(force.vec(i) / p.m[i]) : Vec(Vec::Zero()); }, none);
}

// Of eight points that are asked for, elements with fewer repeat their last one.
void D3plotModel::put_solid(const World& world, const Source& source, Words& out) const {
  if (!source.reporter) return out.zeros(static_cast<std::size_t>(extent_.words_of_solid()));
  const auto count = static_cast<std::size_t>(extent_.points_of_solids);
  const ElementReport report = source.reporter->report_element(world, source.e, {.all_points = count > 1});
  for (std::size_t p = 0; p < count; ++p) {
    const PointReport& point = report.points[std::min(p, report.points.size() - 1)];
    for (const Real s : point.stress) out.real(s);
    out.real(point.plastic);
    put_history(point, extent_.history_of_solids, out);
    for (std::size_t k = 0; extent_.strains && k < 6; ++k) out.real(point.strain[k]);
  }
}

void D3plotModel::put_beam(const World& world, const Source& source, Words& out) const {
  if (source.spring) {
    const SpringForce spring = source.spring->spring(source.e);
    out.real(spring.turns ? 0 : spring.resultant);
    out.zeros(4);
    out.real(spring.turns ? spring.resultant : 0);
    return out.zeros(static_cast<std::size_t>(extent_.words_of_beam()) - 6);
  }
  if (!source.reporter) return out.zeros(static_cast<std::size_t>(extent_.words_of_beam()));
  const ElementReport report = source.reporter->report_element(world, source.e, {});
  for (const Real r : report.resultants) out.real(r);
  for (std::size_t k = 0; k < static_cast<std::size_t>(extent_.points_of_beams); ++k) {
    const PointReport point = k < report.points.size() ? report.points[k] : PointReport{};
    for (const std::size_t c : {0, 3, 5}) out.real(point.stress[c]);
    out.real(point.plastic);
    out.real(0);  // axial strain
  }
}

void D3plotModel::put_shell(const World& world, const Source& source, Words& out) const {
  const D3plotExtent& x = extent_;
  std::vector<PointReport> points(static_cast<std::size_t>(x.points_of_shells));
  std::array<std::array<Real, 6>, 2> strain{};
  if (source.reporter) {
    const std::vector<PointReport> all = source.reporter->report_element(world, source.e, {}).points;
    points = shown_points(all, x.points_of_shells);
    strain = {all.front().strain, all.back().strain};
  }
  for (const PointReport& point : points) {
    for (std::size_t k = 0; x.stress && k < 6; ++k) out.real(point.stress[k]);
    if (x.plastic) out.real(point.plastic);
    put_history(point, x.history_of_shells, out);
  }
  const ElementGroup* group = source.reporter ? &source.reporter->reported() : nullptr;
  const auto three = [&](const SharedField<Real>& kind) {
    const Field<Real>* field = group ? kind.find(group->fields) : nullptr;
    for (int k = 0; k < 3; ++k) out.real(value_of(field, source.e, k));
  };
  if (x.resultants) {
    three(bending_moment);
    out.zeros(2);  // shear forces are not kept
    three(membrane_force);
  }
  const auto put_strain = [&] {
    for (const auto& tensor : strain)
      for (std::size_t k = 0; x.strains && k < 6; ++k) out.real(tensor[k]);
  };
  if (!x.extra) return put_strain();
  const Real rigid = source.segment ? world.segments.thickness[*source.segment] : 0;
  out.real(group ? source.reporter->cut_measure(source.e) : rigid);
  out.zeros(2);
  put_strain();
  const Field<Real>* energy = group ? internal_energy.find(group->fields) : nullptr;
  out.real(energy && group->V0[source.e] > 0 ? (*energy)[source.e] / group->V0[source.e] : 0);
}

void D3plotModel::put_elements(const World& world, Words& out) const {
  for (const Source& one : solids_) put_solid(world, one, out);
  for (const Source& one : beams_) put_beam(world, one, out);
  for (const Source& one : shells_) put_shell(world, one, out);
  if (!may_delete()) return;
  const auto alive = [&](const std::vector<Source>& sources, const std::vector<D3plotElement>& elements) {
    for (std::size_t k = 0; k < sources.size(); ++k) {
      const Source& one = sources[k];
      const bool deleted = (one.reporter && is_deleted(one.reporter->reported().fields, one.e)) ||
                           (one.segment && is_deleted(world.segments.fields, *one.segment));
      out.real(deleted ? 0 : elements[k].part + 1);
    }
  };
  alive(solids_, mesh_.solids);
  alive(shells_, mesh_.shells);
  alive(beams_, mesh_.beams);
}

// Twenty words each: part, < 0 of those that are not active, h, pressure, stress, plastic strain, density,
// internal energy, number of neighbours, strain, mass. The number of neighbours and the strain are 0.
void D3plotModel::put_particles(const World& world, const std::vector<Index>& particles, Words& out) const {
  const Particles& p = world.particles;
  const Field<Real>* tau = shared_fields::stress.find(p.fields);
  const Field<Real>* volume = shared_fields::reference_volume.find(p.fields);
  const auto* plastic = dynamic_cast<const Field<Real>*>(p.fields.find(plastic_strain));
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const D3plotElement& one = mesh_.particles[k];
    const Index i = particles[k];
    if (i < 0) {
      out.real(-one.part - 1);
      out.zeros(19);
      continue;
    }
    const bool active = p.state[i] == particle_active;
    out.real(active ? one.part + 1 : -one.part - 1);
    out.real(p.h[i]);
    out.real(p.p[i]);
    for (int c = 0; c < 6; ++c) out.real(value_of(tau, i, c) - (c < 3 ? p.p[i] : 0));
    out.real(value_of(plastic, i));
    out.real(p.rho[i]);
    out.real(p.E[i] * value_of(volume, i));
    out.zeros(7);
    out.real(p.m[i]);
  }
}

std::string D3plotModel::state(World& world, const Clock& clock) {
  find_sources(world);
  if (!beside_vtk)  // else all are filled
    for (auto* filler : world.passes.all<FieldFiller>())
      if (dynamic_cast<ElementReporter*>(filler)) filler->fill_fields(world);
  const std::vector<Index> particles = find_particles(world);
  Words out(extent_.bits);
  out.reserve(state_bytes(world) / out.width());
  out.real(clock.t);
  put_globals(world, out);
  put_nodes(world, clock, particles, out);
  put_elements(world, out);
  put_particles(world, particles, out);
  return out.take();
}

}  // namespace courant
