// What of a sample goes into history.h5, and under which name.
#include <fmt/format.h>

#include <limits>

#include "output/history.hpp"

namespace courant {

namespace {
constexpr const char* energy = "ML2/T2";
}

History::Column& History::column(const std::string& path, const std::string& dimension, int components) {
  Column& c = columns_[path];
  c.dimension = dimension;
  c.components = components;
  c.values.resize(rows_ * static_cast<std::size_t>(components), std::numeric_limits<double>::quiet_NaN());
  return c;
}

void History::put(const std::string& path, const char* dimension, double value) {
  column(path, dimension, 1).values.push_back(value);
}

void History::put(const std::string& path, const char* dimension, const Vec& value) {
  auto& values = column(path, dimension, 3).values;
  values.insert(values.end(), value.data(), value.data() + 3);
}

void History::put(const std::string& path, const char* dimension, const std::array<Real, 6>& value) {
  auto& values = column(path, dimension, 6).values;
  values.insert(values.end(), value.begin(), value.end());
}

void History::put_global(const Sample& s) {
  put("/global/time", "T", s.t);
  put("/global/dt", "T", s.dt);
  put("/global/cycle", "-", static_cast<double>(s.cycle));
  put("/global/mass", "M", s.mass);
  put("/global/velocity", "L/T", s.velocity);
  put("/global/kinetic", energy, s.energy.kinetic);
  put("/global/internal", energy, s.energy.internal);
  put("/global/potential", energy, s.energy.potential);
  put("/global/contact", energy, s.energy.contact);
  put("/global/hourglass", energy, s.energy.hourglass);
  put("/global/bulk_viscosity", energy, s.energy.bulk_viscosity);
  put("/global/dissipated", energy, s.energy.dissipated);
  put("/global/external_work", energy, s.energy.external_work);
  put("/global/total", energy, s.energy.total());
  put("/global/residual", energy, s.energy.residual());
  put("/global/throughput", energy, s.energy.throughput);
}

void History::put_bodies(const Sample& s) {
  for (const RigidBodyReport& body : s.bodies) {
    const std::string group = fmt::format("/rigid_bodies/{}", body.part);
    put(group + "/x", "L", body.x);
    put(group + "/v", "L/T", body.v);
    put(group + "/omega", "1/T", body.omega);
    put(group + "/force", "ML/T2", body.force);
    put(group + "/moment", "ML2/T2", body.moment);
    put(group + "/kinetic", energy, body.kinetic_energy);
  }
  for (const RigidBodyMotion& body : s.body_motions) {
    const std::string group = fmt::format("/rigid_bodies/{}", body.part);
    put(group + "/displacement", "L", body.displacement);
    put(group + "/rotation", "-", body.rotation);
    put(group + "/a", "L/T2", body.a);
    put(group + "/angular_a", "1/T2", body.angular_a);
  }
  constexpr const char* groups[] = {"/driven_particles/{}", "/driven_bodies/{}", "/held_particles/{}",
                                    "/driven_rotations/{}", "/held_rotations/{}"};
  for (const BoundaryForce& b : s.boundary_forces) {
    const std::string group = fmt::format(fmt::runtime(groups[static_cast<int>(b.kind)]), b.id);
    using Kind = BoundaryForce::Kind;
    const bool turns = b.kind == Kind::driven_rotation || b.kind == Kind::held_rotation;
    if (!turns) put(group + "/force", "ML/T2", b.force);
    if (turns || b.kind == Kind::driven_body) put(group + "/moment", "ML2/T2", b.moment);
    if (b.kind != Kind::held_point && b.kind != Kind::held_rotation) put(group + "/work", energy, b.work);
  }
}

void History::put_points(const Sample& s) {
  for (const ParticleSample& particle : s.particles) {
    const std::string group = fmt::format("/particles/{}", particle.id);
    put(group + "/x", "L", particle.x);
    put(group + "/v", "L/T", particle.v);
    put(group + "/p", "M/LT2", particle.p);
    put(group + "/rho", "M/L3", particle.rho);
    put(group + "/E", "M/LT2", particle.E);
    put(group + "/h", "L", particle.h);
    put(group + "/tau", "M/LT2", particle.tau);
    put(group + "/neighbours", "-", static_cast<double>(particle.neighbours));
    put(group + "/active", "-", particle.active ? 1.0 : 0.0);
  }
  for (const NodeSample& node : s.nodes) {
    const std::string group = fmt::format("/nodes/{}", node.id);
    put(group + "/displacement", "L", node.displacement);
    put(group + "/x", "L", node.x);
    put(group + "/v", "L/T", node.v);
    put(group + "/a", "L/T2", node.a);
    if (!node.turns) continue;
    put(group + "/rotation", "-", node.rotation);
    put(group + "/omega", "1/T", node.omega);
    put(group + "/angular_a", "1/T2", node.angular_a);
  }
}

void History::put_added(const Sample& s) {
  for (const AddedSample& added : s.added) {
    for (const auto& [group, title] : added.numbers.titles)
      if (!title.empty()) titles_[group] = title;
    for (const HistoryValue& one : added.numbers.values) {
      auto& values = column(one.path, one.dimension, static_cast<int>(one.components.size())).values;
      values.insert(values.end(), one.components.begin(), one.components.end());
    }
  }
}

void History::put_entities(const Sample& s) {
  for (const PartSample& part : s.parts) {
    const std::string group = fmt::format("/parts/{}", part.id);
    titles_[group] = part.title;
    put(group + "/mass", "M", part.mass);
    put(group + "/kinetic", energy, part.kinetic);
    put(group + "/internal", energy, part.internal);
    put(group + "/momentum", "ML/T", part.momentum);
    put(group + "/hourglass", energy, part.hourglass);
  }
  for (std::size_t k = 0; k < s.interfaces.size(); ++k) {
    const InterfaceForce& contact = s.interfaces[k];
    const std::string group = fmt::format("/contacts/{}", contact.id);
    titles_[group] = contact.title;
    put(group + "/force", "ML/T2", contact.on_surfa);
    if (!s.impulses.empty()) put(group + "/impulse", "ML/T", s.impulses[k]);
    put(group + "/energy_stored", energy, contact.energy_stored);
    put(group + "/energy_damping", energy, contact.energy_damping);
    put(group + "/energy_friction", energy, contact.energy_friction);
  }
  for (const RigidWallForce& wall : s.rigid_walls) {
    const std::string group = fmt::format("/rigid_walls/{}", wall.id);
    titles_[group] = wall.title;
    put(group + "/force", "ML/T2", wall.force);
    put(group + "/impulse", "ML/T", wall.impulse);
    put(group + "/v", "L/T", wall.v);
    put(group + "/displacement", "L", wall.displacement);
    put(group + "/dissipated", energy, wall.dissipated);
  }
  put_bodies(s);
  put_points(s);
  put_added(s);
}

}  // namespace courant
