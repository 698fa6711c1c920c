// Each number of a sample is found in its column of the text histories and of history.h5.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <regex>

#include "full_sample.hpp"
#include "output/ascii/ascii.hpp"
#include "output/history.hpp"
#include "output_test.hpp"

namespace courant {
namespace {

/// Numbers with an exponent, in their order.
std::vector<double> numbers_in(const std::string& text) {
  static const std::regex number(R"([-+]?\d+\.\d+E[-+]\d+)");
  std::vector<double> out;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), number); it != std::sregex_iterator(); ++it)
    out.push_back(std::stod(it->str()));
  return out;
}
/// Numbers and vectors one after the other.
struct Row {
  std::vector<double> all;
  template <class... Values>
  explicit Row(const Values&... values) {
    (add(values), ...);
  }
  void add(Real value) { all.push_back(value); }
  void add(const Vec& value) { all.insert(all.end(), value.data(), value.data() + 3); }
  void add(const Row& row) { all.insert(all.end(), row.all.begin(), row.all.end()); }
};
void expect_numbers(const std::string& text, const Row& expected) {
  const std::vector<double> found = numbers_in(text);
  ASSERT_EQ(found.size(), expected.all.size()) << text;
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k], expected.all[k], 1e-4 * 9) << k << text;
}

using test::sample_of_all;

const BoundaryForce& of_kind(const Sample& s, BoundaryForce::Kind kind) {
  return s.boundary_forces[static_cast<std::size_t>(kind)];
}

}  // namespace

TEST(NumbersOfHistories, OfPartsContactsAndWallsStandInTheirPlaces) {
  const Sample s = sample_of_all();
  Row matsum(s.t), rcforc, rwforc, sleout(s.t), energies;
  Real total = 0, friction = 0;
  for (const PartSample& p : s.parts)
    matsum.add(Row(p.internal, p.kinetic, p.eroded_internal, 0.0, p.momentum, p.rigid_velocity, p.hourglass,
                   p.added_mass, p.eroded_hourglass));
  for (const InterfaceForce& c : s.interfaces) {
    rcforc.add(Row(s.t, c.on_surfa, 0.0, s.t, Vec(-c.on_surfa), 0.0));
    const Real all = c.energy_stored + c.energy_damping + c.energy_friction;
    sleout.add(Row(all, 0.0, c.energy_friction));
    total += all, friction += c.energy_friction;
  }
  sleout.add(Row(total, 0.0, total, friction));
  for (const RigidWallForce& w : s.rigid_walls) rwforc.add(Row(s.t, w.normal, w.force));
  expect_numbers(history_text("matsum", s), matsum);
  expect_numbers(history_text("rcforc", s), rcforc);
  expect_numbers(history_text("sleout", s), sleout);
  expect_numbers(history_text("rwforc", s), rwforc);
}

TEST(NumbersOfHistories, OfNodesBodiesAndBoundariesStandInTheirPlaces) {
  using Kind = BoundaryForce::Kind;
  const Sample s = sample_of_all();
  const NodeSample& n = s.nodes[0];
  expect_numbers(history_text("nodout", s),
                 Row(s.t, n.displacement, n.v, n.a, n.x, s.t, n.rotation, n.omega, n.angular_a));
  const RigidBodyMotion& b = s.body_motions[0];
  const auto rows = [&](const Matrix& L) {
    return Row(Vec(L * b.displacement), Vec(L * b.rotation), Vec(L * b.v), Vec(L * b.omega), Vec(L * b.a),
               Vec(L * b.angular_a));
  };
  expect_numbers(history_text("rbdout", s),
                 Row(s.t, b.x, rows(Matrix::Identity()), Vec(b.axes.row(0)), Vec(b.axes.row(1)),
                     Vec(b.axes.row(2)), rows(b.axes.transpose())));
  const BoundaryForce &point = of_kind(s, Kind::driven_point), &body = of_kind(s, Kind::driven_body),
                      &held = of_kind(s, Kind::held_point), &turn = of_kind(s, Kind::held_rotation);
  expect_numbers(history_text("bndout", s),
                 Row(s.t, point.force, point.work, body.force, body.work, body.moment,
                     Vec(point.force + body.force), point.work + body.work));
  expect_numbers(history_text("spcforc", s), Row(s.t, held.force, turn.moment, Vec(held.force + turn.force)));
}

TEST(NumbersOfHistories, OfParticlesStandInTheirPlaces) {
  const Sample s = sample_of_all();
  const ParticleSample& p = s.particles[0];
  const auto& t = p.tau;
  const Real mises = std::sqrt(1.5 * (t[0] * t[0] + t[1] * t[1] + t[2] * t[2]) +
                               3 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]));
  expect_numbers(history_text("sphout", s), Row(s.t, t[0] - p.p, t[1] - p.p, t[2] - p.p, t[3], t[4], t[5],
                                                Vec(0, 0, 0), Vec(0, 0, 0), p.rho, p.h, 0.0, mises));
}

// The balance as LS-DYNA has it: potential energy as external work, what contact and walls took apart, energy
// of deleted elements not in the internal energy.
TEST(NumbersOfHistories, OfTheWholeModelAddUp) {
  const Sample s = sample_of_all();
  const EnergyLedger& e = s.energy;
  Real contact = 0, walls = 0, added = 0, eroded_internal = 0, eroded_hourglass = 0;
  for (const InterfaceForce& c : s.interfaces) contact += c.energy_damping + c.energy_friction;
  for (const RigidWallForce& w : s.rigid_walls) walls += w.dissipated;
  for (const PartSample& p : s.parts)
    added += p.added_mass, eroded_internal += p.eroded_internal, eroded_hourglass += p.eroded_hourglass;
  const Real first = 0.5, eroded = eroded_internal + eroded_hourglass,
             work = e.external_work + first - e.potential, total = e.total() - e.potential,
             expected = e.initial - first + work;
  expect_numbers(
      history_text("glstat", s, first),
      Row(s.t, s.dt, e.kinetic, e.internal + e.bulk_viscosity + e.dissipated - contact - walls - eroded,
          e.hourglass, s.rigid_walls[0].dissipated, s.rigid_walls[1].dissipated, 0.0, e.discrete, 0.0,
          e.contact + contact, work, 0.0, eroded_internal, eroded_hourglass, total, total / expected,
          (total - eroded) / expected, s.velocity, added, 100 * added / (s.mass - added)));
}

TEST(NumbersOfHistories, StandUnderTheirNamesInHistoryH5) {
  const Sample s = sample_of_all();
  test::ScratchFolder folder;
  const auto path = folder.path() / "history.h5";
  {
    History history(path);
    history.record(s), history.flush();
  }
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const auto expect = [&](const std::string& name, const Row& expected) {
    const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    ASSERT_GE(dataset, 0) << name;
    std::vector<double> out(expected.all.size());
    H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data());
    H5Dclose(dataset);
    EXPECT_EQ(out, expected.all) << name;
  };
  const EnergyLedger& e = s.energy;
  expect("/global/kinetic", Row(e.kinetic)), expect("/global/internal", Row(e.internal));
  expect("/global/contact", Row(e.contact)), expect("/global/hourglass", Row(e.hourglass));
  expect("/global/potential", Row(e.potential)), expect("/global/dissipated", Row(e.dissipated));
  expect("/global/external_work", Row(e.external_work)), expect("/global/total", Row(e.total()));
  expect("/global/residual", Row(e.residual())), expect("/global/throughput", Row(e.throughput));
  expect("/global/velocity", Row(s.velocity)), expect("/global/mass", Row(s.mass));
  for (const PartSample& p : s.parts) {
    const std::string at = fmt::format("/parts/{}/", p.id);
    expect(at + "mass", Row(p.mass)), expect(at + "kinetic", Row(p.kinetic));
    expect(at + "internal", Row(p.internal)), expect(at + "hourglass", Row(p.hourglass));
    expect(at + "momentum", Row(p.momentum));
  }
  for (const InterfaceForce& c : s.interfaces) {
    const std::string at = fmt::format("/contacts/{}/", c.id);
    expect(at + "force", Row(c.on_surfa)), expect(at + "energy_stored", Row(c.energy_stored));
    expect(at + "energy_damping", Row(c.energy_damping)),
        expect(at + "energy_friction", Row(c.energy_friction));
  }
  for (const RigidWallForce& w : s.rigid_walls) {
    const std::string at = fmt::format("/rigid_walls/{}/", w.id);
    expect(at + "force", Row(w.force)), expect(at + "impulse", Row(w.impulse)), expect(at + "v", Row(w.v));
    expect(at + "displacement", Row(w.displacement)), expect(at + "dissipated", Row(w.dissipated));
  }
  const RigidBodyReport& b = s.bodies[0];
  const RigidBodyMotion& m = s.body_motions[0];
  const std::string of_body = "/rigid_bodies/7/";
  expect(of_body + "x", Row(b.x)), expect(of_body + "v", Row(b.v)), expect(of_body + "omega", Row(b.omega));
  expect(of_body + "force", Row(b.force)), expect(of_body + "moment", Row(b.moment));
  expect(of_body + "kinetic", Row(b.kinetic_energy)), expect(of_body + "a", Row(m.a));
  expect(of_body + "displacement", Row(m.displacement)), expect(of_body + "rotation", Row(m.rotation));
  expect(of_body + "angular_a", Row(m.angular_a));
  const NodeSample& n = s.nodes[0];
  expect("/nodes/3/displacement", Row(n.displacement)), expect("/nodes/3/x", Row(n.x));
  expect("/nodes/3/v", Row(n.v)), expect("/nodes/3/a", Row(n.a)),
      expect("/nodes/3/rotation", Row(n.rotation));
  expect("/nodes/3/omega", Row(n.omega)), expect("/nodes/3/angular_a", Row(n.angular_a));
  const char* const groups[] = {"driven_particles", "driven_bodies", "held_particles", "driven_rotations",
                                "held_rotations"};
  for (std::size_t k = 0; k < 5; ++k) {
    const BoundaryForce& f = s.boundary_forces[k];
    const std::string at = fmt::format("/{}/{}/", groups[k], f.id);
    if (k < 3) expect(at + "force", Row(f.force));
    if (k == 1 || k > 2) expect(at + "moment", Row(f.moment));
    if (k != 2 && k != 4) expect(at + "work", Row(f.work));
  }
  H5Fclose(file);
}

}  // namespace courant
