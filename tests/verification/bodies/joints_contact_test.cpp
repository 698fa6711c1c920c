// Particles that meet rigid plates which joints hold.
#include <gtest/gtest.h>

#include <cmath>

#include "joint_decks.hpp"
#include "state/world.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;

namespace {

/// Water of 27 particles falls with `speed` on a light plate that a joint of `kind` ties to the ground, or to
/// a free body of 0.1 kg.
std::string water_on_a_plate(const std::string& kind, const std::string& ids, bool grounded, Real speed) {
  std::string nodes, sph;
  int n = 0;
  for (int k = 0; k < 3; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        nodes += fmt::format("{},{},{},{}\n", ++n, 0.01 * i, 0.01 * j, 0.0055 + 0.01 * k);
        sph += fmt::format("{},1,0.001\n", n);
      }
  return "*KEYWORD\n*CONTROL_TERMINATION\n0.02\n*PART\nwater\n1,1,1,1\n*PART\nplate\n2,2,2\n*PART\nbelow\n3,"
         "2,3\n"
         "*SECTION_SPH\n1,1.2,0.,0.\n*SECTION_SHELL\n2,2\n0.001\n*MAT_NULL\n1,1000.,-1e20\n"
         "*EOS_LINEAR_POLYNOMIAL\n1,0.,9.0e5\n*MAT_RIGID\n2,785,2.1e11,0.3\n0.,0,0\n*MAT_RIGID\n3,10000.,2."
         "1e11,0.3\n" +
         std::string(grounded ? "1,7,7\n" : "0.,0,0\n") + "*NODE\n" + nodes +
         "101,-0.05,-0.05,0\n102,0.05,-0.05,0\n103,0.05,0.05,0\n104,-0.05,0.05,0\n"
         "201,-0.05,-0.05,-0.1\n202,0.05,-0.05,-0.1\n203,0.05,0.05,-0.1\n204,-0.05,0.05,-0.1\n"
         "301,0,0,0\n302,0,0,0\n303,0,0.03,0\n304,0,0.03,0\n305,0.03,0,0\n306,0.03,0,0\n*ELEMENT_SPH\n" +
         sph +
         "*ELEMENT_SHELL\n101,2,101,102,103,104\n102,3,201,202,203,204\n"
         "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.\n1.\n*CONSTRAINED_EXTRA_NODES_NODE\n"
         "3,301\n2,302\n3,303\n2,304\n3,305\n2,306\n*CONSTRAINED_JOINT_" +
         kind + "\n" + ids +
         fmt::format("\n*INITIAL_VELOCITY_GENERATION\n1,2,0.,0.,0.,{}\n0\n*END\n", -speed);
}

Vec momentum(const Simulation& s) {
  Vec p = Vec::Zero();
  const auto& particles = const_cast<Simulation&>(s).world().particles;
  for (Index i = 0; i < particles.size(); ++i) p += particles.m[i] * particles.v.vec(i);
  for (const RigidBody& b : s.bodies()->bodies())
    if (!b.fixed()) p += b.m * b.v;
  return p;
}

}  // namespace

// Hinge and slide across the fall do not let the plate yield either.
TEST(JointsInContact, NothingLeaksThroughAPlateThatAJointHolds) {
  const struct {
    const char *kind, *ids;
  } cases[] = {{"LOCKING", "301,302,303,304,305,306"},
               {"REVOLUTE", "301,302,303,304"},
               {"SPHERICAL", "301,302"},
               {"TRANSLATIONAL", "301,302,303,304,305,306"}};
  for (const auto& one : cases) {
    auto s = simulation_of(water_on_a_plate(one.kind, one.ids, true, 4));
    while (s->clock().t < 0.02) s->step(do_nothing);
    EXPECT_EQ(s->world().counters["leaked_particles"], 0) << one.kind;
    const auto& p = s->world().particles;
    for (Index i = 0; i < p.size(); ++i)
      if (std::max(std::abs(p.x.vec(i).x()), std::abs(p.x.vec(i).y())) < 0.04 &&
          std::string(one.kind) != "REVOLUTE" && std::string(one.kind) != "SPHERICAL") {
        EXPECT_GT(p.x.vec(i).z(), 0) << one.kind;
      }
  }
}

TEST(JointsInContact, FreeBodiesKeepMomentumAndHold) {
  for (const char* kind : {"LOCKING", "TRANSLATIONAL"}) {
    auto s = simulation_of(water_on_a_plate(kind, "301,302,303,304,305,306", false, 4));
    const Vec before = momentum(*s);
    while (s->clock().t < 0.02) s->step(do_nothing);
    EXPECT_NEAR((momentum(*s) - before).norm(), 0, 1e-10 * before.norm()) << kind;
    const RigidBody& plate = s->bodies()->bodies()[0];
    EXPECT_LT(plate.v.z(), -0.1) << "it was struck";
    EXPECT_NEAR(plate.v.z(), s->bodies()->bodies()[1].v.z(), 1e-9);
    const auto& p = s->world().particles;
    for (Index i = 0; i < p.size(); ++i)
      if (std::max(std::abs(p.x.vec(i).x()), std::abs(p.x.vec(i).y())) < 0.04) {
        EXPECT_GT(p.x.vec(i).z(), plate.x.z()) << kind;
      }
  }
}
