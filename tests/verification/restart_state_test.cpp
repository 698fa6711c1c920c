// Every number that a restart keeps matters: changed, it changes what comes after.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "base/restart_error.hpp"
#include "base/run_error.hpp"
#include "same_bits.hpp"

using namespace courant;
using test::SolidDeck;

namespace restart_state_test {
namespace {

/// Other numbers of the same kind: indices and flags become 0 or one more, reals grow by a tenth and a bit.
void change(SavedArray& array) {
  std::byte* const bytes = array.bytes.data();
  const auto each = [&](auto zero, const auto& other) {
    for (std::size_t k = 0; k < array.count(); ++k) {
      decltype(zero) value;
      std::memcpy(&value, bytes + k * sizeof value, sizeof value);
      value = other(value);
      std::memcpy(bytes + k * sizeof value, &value, sizeof value);
    }
  };
  switch (array.type) {
    case SavedType::real:
      return each(Real(0), [](Real x) { return 1.1 * x + 1e-6; });
    case SavedType::integer64:
      return each(std::int64_t(0), [](std::int64_t n) { return n == 0 ? 1 : n - 1; });
    case SavedType::integer32:
      return each(std::int32_t(0), [](std::int32_t n) { return n == 0 ? 1 : n - 1; });
    case SavedType::byte:
      return each(char(0), [](char c) { return static_cast<char>(c == 0 ? 1 : 0); });
  }
}

/// Names whose change, in the state at any of these times, nothing notices: neither the reader, nor the run,
/// nor fields, what histories print and the state at the end.
std::vector<std::string> unnoticed(const std::string& deck, const std::vector<int>& saved_at, int steps) {
  std::set<std::string> all, noticed;
  for (const int at : saved_at) {
    auto s = test::simulation_of(deck);
    for (int k = 0; k < at; ++k) s->step(test::do_nothing);
    const SavedState saved = test::saved_state(*s);
    const test::WholeState reference = test::state_after(*s, steps);
    for (const auto& [name, array] : saved) {
      if (array.bytes.empty() || noticed.contains(name)) continue;
      all.insert(name);
      SavedState other = saved;
      change(other.at(name));
      try {
        if (!test::differences(reference, test::state_after_restart(deck, std::move(other), steps)).empty())
          noticed.insert(name);
      } catch (const RestartError&) {
        noticed.insert(name);
      } catch (const RunError&) {
        noticed.insert(name);
      }
    }
  }
  std::vector<std::string> out;
  std::set_difference(all.begin(), all.end(), noticed.begin(), noticed.end(), std::back_inserter(out));
  return out;
}

/// A block that slides and rubs on a rigid plate, which is driven, and meets a moving rigid wall with
/// friction.
std::string rubbing_block() {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 2, 2, 2, 1);
  deck.block(Vec(0.6, 0.6, 0.1), 2, 2, 1, 2, [](const Vec& x) { return Vec(x - Vec(0.2, 0.2, 0.1005)); });
  deck.cards =
      "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1e7,0.3\n*PART\nplate\n2,1,2\n"
      "*MAT_RIGID\n2,1000.0,1e7,0.3\n1,5,7\n*CONTROL_HOURGLASS\n4,0.05\n"
      "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID\n7,rubs\n1,2,3,3\n0.3,0.2,5.0,,20.0\n\n1\n"
      "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n2,1,0,3\n*DEFINE_CURVE\n3\n0,0.5\n9,5.0\n"
      "*LOAD_BODY_Z\n4,10.0\n*DEFINE_CURVE\n4\n0,1\n9,1\n"
      "*RIGIDWALL_PLANAR_MOVING\n0\n0.21,0.0,0.0,-0.79,0.0,0.0,0.3\n20.0,0.5\n"
      "*INITIAL_VELOCITY\n1\n1.0,0.2,-1.0\n*DAMPING_PART_STIFFNESS\n1,0.1\n";
  deck.node_set(1, [](const Vec& x) { return x[2] > -1e-9; });
  return deck.text(1);
}

}  // namespace

TEST(RestartState, EveryNumberOfARubbingBlockMatters) {
  // Made anew in each step, kept for what reads the state between steps; or of no effect in this scene: the
  // driven plate does not give way to springs, lives on from the start, and no node comes to an edge.
  const std::set<std::string> made_anew{"clock/dt",
                                        "energy/below",
                                        "energy/bulk_viscosity",
                                        "energy/contact",
                                        "energy/half_step",
                                        "energy/hourglass",
                                        "energy/internal",
                                        "energy/kinetic",
                                        "energy/potential",
                                        "passes/contact 7 of nodes/asleep",
                                        "passes/contact 7 of nodes/body_push",
                                        "passes/contact 7 of nodes/body_springs",
                                        "passes/contact 7 of nodes/body_turn",
                                        "passes/contact 7 of nodes/deepest",
                                        "passes/contact 7 of nodes/fresh",
                                        "passes/rigid bodies/part 2/force",
                                        "passes/rigid bodies/part 2/moment",
                                        "passes/rigid bodies/part 2/omega",
                                        "passes/rigid wall 1/force",
                                        "solids of part 1/damped_stress"};
  for (const std::string& name : unnoticed(rubbing_block(), {10, 60, 110}, 130))
    EXPECT_TRUE(made_anew.contains(name.substr(std::string("state/").size()))) << name;
  test::expect_same_bits(rubbing_block(), 130, 60);
}

}  // namespace restart_state_test
