#include "output/binout/binout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "output/glstat.hpp"

namespace courant {
namespace {

/// Arrays of a folder under construction.
class BinoutFolder {
 public:
  BinoutFolder(std::vector<LsdaArray>& to, std::string name) : to_(to), name_(std::move(name)) {}
  void real(const char* name, Real value) { to_.push_back(lsda_reals(name_, name, {value})); }
  void integer(const char* name, std::int64_t value) { to_.push_back(lsda_integers(name_, name, {value})); }
  template <class List, class Value>
  void reals(const std::string& name, const List& list, const Value& value) {
    std::vector<Real> out;
    for (const auto& one : list) out.push_back(value(one));
    to_.push_back(lsda_reals(name_, name, out));
  }
  /// x_NAME, y_NAME, z_NAME
  template <class List, class Value>
  void vectors(const char* form, const List& list, const Value& value) {
    for (int k = 0; k < 3; ++k)
      reals(fmt::format(fmt::runtime(form), "xyz"[k]), list, [&](const auto& one) { return value(one)[k]; });
  }
  template <class List, class Value>
  void ids(const char* name, const List& list, const Value& value) {
    std::vector<std::int64_t> out;
    for (const auto& one : list) out.push_back(value(one));
    to_.push_back(lsda_integers(name_, name, out));
  }

 private:
  std::vector<LsdaArray>& to_;
  std::string name_;
};

struct BinoutKind {
  std::function<void(const Sample&, Real first_potential, BinoutFolder&)> state;
  std::function<void(const Sample&, BinoutFolder&)> head = [](const Sample&, BinoutFolder&) {};
  const char* folder = "";  ///< of its states in the folder of the history
};

void glstat(const Sample& s, Real first_potential, BinoutFolder& to) {
  const GlstatNumbers g = glstat_numbers(s, first_potential);
  to.real("time_step", s.dt);
  to.real("kinetic_energy", g.kinetic), to.real("internal_energy", g.internal);
  to.real("hourglass_energy", g.hourglass), to.real("stonewall_energy", g.stonewall);
  to.real("rigid_body_stopper_energy", 0), to.real("spring_and_damper_energy", g.discrete);
  to.real("system_damping_energy", 0), to.real("sliding_interface_energy", g.sliding);
  to.real("external_work", g.external_work), to.real("eroded_kinetic_energy", 0);
  to.real("eroded_internal_energy", g.eroded_internal);
  to.real("eroded_hourglass_energy", g.eroded_hourglass);
  to.real("total_energy", g.total), to.real("energy_ratio", g.ratio);
  to.real("energy_ratio_wo_eroded", g.ratio_without_eroded);
  to.real("global_x_velocity", s.velocity.x()), to.real("global_y_velocity", s.velocity.y());
  to.real("global_z_velocity", s.velocity.z());
  to.real("added_mass", g.added_mass);
}

void matsum(const Sample& s, Real, BinoutFolder& to) {
  using P = PartSample;
  to.reals("internal_energy", s.parts, [](const P& p) { return p.internal; });
  to.reals("kinetic_energy", s.parts, [](const P& p) { return p.kinetic; });
  to.reals("eroded_internal_energy", s.parts, [](const P& p) { return p.eroded_internal; });
  to.reals("eroded_kinetic_energy", s.parts, [](const P&) { return 0.0; });
  to.reals("eroded_hourglass_energy", s.parts, [](const P& p) { return p.eroded_hourglass; });
  to.reals("hourglass_energy", s.parts, [](const P& p) { return p.hourglass; });
  to.vectors("{}_momentum", s.parts, [](const P& p) { return p.momentum; });
  to.vectors("{}_rbvelocity", s.parts, [](const P& p) { return p.rigid_velocity; });
  to.reals("mass", s.parts, [](const P& p) { return p.mass; });
  to.reals("added_mass", s.parts, [](const P& p) { return p.added_mass; });
}

void nodout(const Sample& s, Real, BinoutFolder& to) {
  using N = NodeSample;
  to.vectors("{}_displacement", s.nodes, [](const N& n) { return n.displacement; });
  to.vectors("{}_velocity", s.nodes, [](const N& n) { return n.v; });
  to.vectors("{}_acceleration", s.nodes, [](const N& n) { return n.a; });
  to.vectors("{}_coordinate", s.nodes, [](const N& n) { return n.x; });
  if (std::none_of(s.nodes.begin(), s.nodes.end(), [](const N& n) { return n.turns; })) return;
  to.vectors("r{}_displacement", s.nodes, [](const N& n) { return n.rotation; });
  to.vectors("r{}_velocity", s.nodes, [](const N& n) { return n.omega; });
  to.vectors("r{}_acceleration", s.nodes, [](const N& n) { return n.angular_a; });
}

/// Both sides of each interface, SURFA first.
std::vector<std::pair<Id, Vec>> sides_of(const Sample& s) {
  std::vector<std::pair<Id, Vec>> out;
  for (const InterfaceForce& i : s.interfaces) {
    out.emplace_back(i.id, i.on_surfa);
    out.emplace_back(i.id, Vec::Zero() - i.on_surfa);  // not the sign alone: 0 must not become -0
  }
  return out;
}

void rcforc(const Sample& s, Real, BinoutFolder& to) {
  const auto sides = sides_of(s);
  to.vectors("{}_force", sides, [](const auto& one) { return one.second; });
  to.reals("mass", sides, [](const auto&) { return 0.0; });
}

void rcforc_head(const Sample& s, BinoutFolder& to) {
  const auto sides = sides_of(s);
  to.ids("ids", sides, [](const auto& one) { return one.first; });
  std::int64_t side = 1;
  to.ids("side", sides, [&](const auto&) { return side = 1 - side; });  // 0 SURFA, 1 SURFB
}

void sleout(const Sample& s, Real, BinoutFolder& to) {
  const auto energy = [](const InterfaceForce& i) {
    return i.energy_stored + i.energy_damping + i.energy_friction;
  };
  Real total = 0, friction = 0;
  for (const InterfaceForce& i : s.interfaces) total += energy(i), friction += i.energy_friction;
  to.reals("slave", s.interfaces, energy);
  to.reals("master", s.interfaces, [](const auto&) { return 0.0; });
  to.reals("frictional_energy", s.interfaces, [](const InterfaceForce& i) { return i.energy_friction; });
  to.real("total_slave", total), to.real("total_master", 0), to.real("total_energy", total);
  to.real("total_friction", friction);
}

void rwforc(const Sample& s, Real, BinoutFolder& to) {
  to.reals("normal_force", s.rigid_walls, [](const RigidWallForce& w) { return w.normal; });
  to.vectors("{}_force", s.rigid_walls, [](const RigidWallForce& w) { return w.force; });
}

std::vector<BoundaryForce> of_kind(const Sample& s, BoundaryForce::Kind kind) {
  std::vector<BoundaryForce> out;
  for (const BoundaryForce& one : s.boundary_forces)
    if (one.kind == kind) out.push_back(one);
  return out;
}

void spcforc(const Sample& s, Real, BinoutFolder& to) {
  const auto forces = of_kind(s, BoundaryForce::Kind::held_point),
             moments = of_kind(s, BoundaryForce::Kind::held_rotation);
  to.ids("ids", forces, [](const auto& one) { return one.id; });
  to.vectors("{}_force", forces, [](const auto& one) { return one.force; });
  to.ids("moment_ids", moments, [](const auto& one) { return one.id; });
  to.vectors("{}_moment", moments, [](const auto& one) { return one.moment; });
  Vec sum = Vec::Zero();
  for (const BoundaryForce& one : forces) sum += one.force;
  to.real("x_resultant", sum.x()), to.real("y_resultant", sum.y()), to.real("z_resultant", sum.z());
}

void bndout(const Sample& s, Real, BinoutFolder& to) {
  using K = BoundaryForce::Kind;
  const auto nodes = of_kind(s, K::driven_point), bodies = of_kind(s, K::driven_body);
  const auto put = [&](const std::string& of, const auto& list) {
    to.ids((of + "ids").c_str(), list, [](const auto& one) { return one.id; });
    to.vectors((of + "{}_force").c_str(), list, [](const auto& one) { return one.force; });
    to.reals(of + "energy", list, [](const auto& one) { return one.work; });
  };
  put("", nodes);
  put("body_", bodies);
  to.vectors("body_{}_moment", bodies, [](const auto& one) { return one.moment; });
}

void rbdout(const Sample& s, Real, BinoutFolder& to) {
  using M = RigidBodyMotion;
  to.vectors("global_{}", s.body_motions, [](const M& b) { return b.x; });
  to.vectors("global_d{}", s.body_motions, [](const M& b) { return b.displacement; });
  to.vectors("global_rd{}", s.body_motions, [](const M& b) { return b.rotation; });
  to.vectors("global_v{}", s.body_motions, [](const M& b) { return b.v; });
  to.vectors("global_rv{}", s.body_motions, [](const M& b) { return b.omega; });
  to.vectors("global_a{}", s.body_motions, [](const M& b) { return b.a; });
  to.vectors("global_ra{}", s.body_motions, [](const M& b) { return b.angular_a; });
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      to.reals(fmt::format("dircos_{}{}", i + 1, j + 1), s.body_motions,
               [&](const M& b) { return b.axes(i, j); });
}

void sphout(const Sample& s, Real, BinoutFolder& to) {
  using P = ParticleSample;
  constexpr const char* axes[] = {"xx", "yy", "zz", "xy", "yz", "zx"};
  for (std::size_t k = 0; k < 6; ++k)
    to.reals(fmt::format("sig_{}", axes[k]), s.particles,
             [&](const P& p) { return p.tau[k] - (k < 3 ? p.p : 0); });
  to.reals("density", s.particles, [](const P& p) { return p.rho; });
  to.reals("smooth", s.particles, [](const P& p) { return p.h; });
  to.reals("neigh", s.particles, [](const P& p) { return static_cast<Real>(p.neighbours); });
  to.reals("act", s.particles, [](const P& p) { return p.active ? 1.0 : 0.0; });
}

template <class T>
auto head_of(std::vector<T> Sample::*list, Id T::*id) {
  return [list, id](const Sample& s, BinoutFolder& to) {
    to.ids("ids", s.*list, [id](const T& one) { return one.*id; });
  };
}

const std::map<std::string, BinoutKind>& binout_kinds() {
  static const std::map<std::string, BinoutKind> all{
      {"glstat", {glstat}},
      {"matsum", {matsum, head_of(&Sample::parts, &PartSample::id)}},
      {"nodout", {nodout, head_of(&Sample::nodes, &NodeSample::id)}},
      {"rcforc", {rcforc, rcforc_head}},
      {"sleout", {sleout, head_of(&Sample::interfaces, &InterfaceForce::id)}},
      {"rwforc", {rwforc, head_of(&Sample::rigid_walls, &RigidWallForce::id), "/forces"}},
      {"spcforc", {spcforc}},
      {"bndout", {bndout}},
      {"rbdout", {rbdout, head_of(&Sample::body_motions, &RigidBodyMotion::part)}},
      {"sphout", {sphout, head_of(&Sample::particles, &ParticleSample::id)}},
  };
  return all;
}

}  // namespace

bool has_binout(const std::string& history) {
  return binout_kinds().contains(history);
}

std::vector<LsdaArray> binout_state(const std::string& history, const Sample& sample, Real first_potential,
                                    std::int64_t number) {
  const BinoutKind& kind = binout_kinds().at(history);
  std::vector<LsdaArray> out;
  BinoutFolder to(out, fmt::format("/{}{}/d{:06d}", history, kind.folder, number));
  to.real("time", sample.t);
  to.integer("cycle", sample.cycle);
  kind.state(sample, first_potential, to);
  return out;
}

std::vector<LsdaArray> binout_head(const std::string& history, const Sample& sample,
                                   const std::string& title) {
  const BinoutKind& kind = binout_kinds().at(history);
  std::vector<LsdaArray> out;
  const std::string name = fmt::format("/{}{}/metadata", history, kind.folder);
  std::string padded = title;
  padded.resize(80, ' ');
  out.push_back(lsda_text(name, "title", padded));
  BinoutFolder to(out, name);
  kind.head(sample, to);
  return out;
}

void Binout::write(const std::string& history, const Sample& sample, Real first_potential) {
  std::int64_t& number = states_[history];
  std::vector<LsdaArray> all;
  if (number == 0) all = binout_head(history, sample, title_);
  const std::vector<LsdaArray> state = binout_state(history, sample, first_potential, ++number);
  all.insert(all.end(), state.begin(), state.end());
  file_.write(all);
}

}  // namespace courant
