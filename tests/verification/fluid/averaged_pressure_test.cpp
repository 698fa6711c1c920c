// Equations of state in solids with eight points (ELFORM 2), and in tetrahedra whose pressures are averaged
// over nodes (ELFORM 13).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "elements/element_report.hpp"
#include "pressure_decks.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"

namespace courant::test::averaged_pressure {

namespace {

const char* const copper_law = "*EOS_GRUNEISEN\n1,3940.0,1.489,0.0,0.0,2.02,0.0,0.0\n1.0\n";

struct Kind {
  CellShape cells;
  int elform;
};
const Kind kinds[] = {{CellShape::hexahedron, 2}, {CellShape::tetrahedra, 13}};

/// n x 1 x 1 cells, 1 long, that may move along x alone and are held at x = 0.
SolidDeck column_of(int n, const Kind& kind, const std::string& cards) {
  SolidDeck deck;
  deck.cells = kind.cells;
  deck.block(Vec(1, 1.0 / n, 1.0 / n), n, 1, 1, 1);
  deck.cards = fmt::format("*PART\ncolumn\n1,1,1,1\n*SECTION_SOLID\n1,{}\n", kind.elform) + cards;
  deck.node_set(1, [](const Vec&) { return true; });
  deck.node_set(2, [](const Vec& x) { return x[0] < 1e-9; });
  deck.node_set(3, [](const Vec& x) { return x[0] > 1e-9; });
  deck.cards += "*BOUNDARY_SPC_SET\n1,0,0,1,1\n2,0,1,1,1\n";
  return deck;
}

/// Of the elements: stress, the mean over points.
std::vector<PointReport> reports_of(const Simulation& s) {
  std::vector<PointReport> out;
  for (const auto* pass : s.world().passes.all<const ElementReporter>())
    for (Index e = 0; e < pass->reported().size(); ++e)
      out.push_back(pass->report_element(s.world(), e, {}).points.at(0));
  return out;
}
Real pressure_of(const PointReport& point) {
  return -(point.stress[0] + point.stress[1] + point.stress[2]) / 3;
}
Real middle_of(const Simulation& s, Index e) {
  const ElementGroup& group = *s.world().groups.at(0);
  Real x = 0;
  int corners = 0;
  for (int c = 0; c < 8; ++c)
    if (group.is_first(e, c)) x += s.world().nodes.x.data(0)[group.node.data(c)[e]], ++corners;
  return x / corners;
}
const Field<Real>& energy_of(const Simulation& s) {
  return *dynamic_cast<const Field<Real>*>(s.world().groups.at(0)->fields.find("internal_energy"));
}

/// Means in slices of 1/n of the reference, of pressure and energy per reference volume.
struct Slice {
  Real x = 0, p = 0, E = 0, share = 0;
};
std::vector<Slice> slices_of(const Simulation& s, int n) {
  const ElementGroup& group = *s.world().groups.at(0);
  const auto reports = reports_of(s);
  const Index each = group.size() / n;
  std::vector<Slice> out(static_cast<std::size_t>(n));
  for (Index e = 0; e < group.size(); ++e) {
    Slice& to = out[static_cast<std::size_t>(e / each)];
    const Real w = group.V0[e];
    to.x += w * middle_of(s, e), to.p += w * pressure_of(reports[static_cast<std::size_t>(e)]);
    to.E += energy_of(s)[e], to.share += w;
  }
  for (Slice& slice : out) slice.x /= slice.share, slice.p /= slice.share, slice.E /= slice.share;
  return out;
}

}  // namespace

// us = C + S1 up, p = rho0 us up, E = rho0 up^2/2, as with one point. Means over nodes leave motions of
// tetrahedra free that keep some of the kinetic energy, and behind the front it is noisy.
TEST(AveragedPressure, AShockIsOnItsHugoniot) {
  constexpr Real ro = 8930, up = 500, us = 3940 + 1.489 * up, p = ro * us * up;
  for (const Kind& kind : kinds)
    for (const std::string law :
         {"*MAT_NULL\n1,8930.0,-1e20,0.0\n", "*MAT_ELASTIC_PLASTIC_HYDRO\n1,8930.0,48e9,1e6\n"})
      for (const int n : {50, 100, 200}) {
        if (kind.elform == 13 && n == 200) continue;  // six times as many elements
        SolidDeck deck = column_of(n, kind, law + copper_law);
        deck.cards += fmt::format("*INITIAL_VELOCITY\n3\n{:.6g},0.0,0.0\n", -up);
        auto s = simulation_of(deck.text(1));
        start_ledger(*s);
        const auto [speed, slices] =
            shock_of(*s, us, 0.5 * p, [n](const Simulation& now) { return slices_of(now, n); });
        const bool nodal = kind.elform == 13;
        EXPECT_NEAR((speed + up) / us, 1, nodal ? 0.015 : 0.5 / n) << kind.elform << " " << n;
        Real sum_p = 0, sum_E = 0;
        int count = 0;
        for (const Slice& slice : slices)
          if (slice.x > 0.15 && slice.x < 0.45) sum_p += slice.p, sum_E += slice.E, ++count;
        EXPECT_NEAR(sum_p / count / p, 1, nodal ? 0.01 : 0.003) << kind.elform << " " << n;
        EXPECT_NEAR(sum_E / count / (0.5 * ro * up * up), 1, nodal ? 0.04 : 0.01) << kind.elform << " " << n;
        EXPECT_LT(energy_error_of_a_step(*s), n == 50 ? 0.0012 : 0.001) << kind.elform << " " << n;
      }
}

// Half of the volume, slowly, without bulk viscosity: p V^1.4 stays, and so does p V = 0.4 E V0.
TEST(AveragedPressure, AGasIsCompressedAlongItsIsentrope) {
  for (const Kind& kind : kinds)
    for (const auto& [tssfac, bound] : {std::pair(0.8, 1e-4), std::pair(0.2, 1e-5)}) {
      SolidDeck deck =
          column_of(1, kind,
                    fmt::format("*MAT_NULL\n1,1.0\n*EOS_IDEAL_GAS\n1,2.5,3.5,0.0,0.0,1.0,1.0\n"
                                "*CONTROL_BULK_VISCOSITY\n1e-9,1e-9\n*CONTROL_TIMESTEP\n0.0,{}\n",
                                tssfac));
      deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,1\n*DEFINE_CURVE\n1\n0.0,-0.02\n1e9,-0.02\n";
      auto s = simulation_of(deck.text(100));
      start_ledger(*s);
      EXPECT_NEAR(s->world().energy.initial, 2.5, 1e-12);
      run_until(*s, 25);
      s->step(do_nothing);
      const Real V = 1 - 0.02 * (s->clock().t - s->clock().dt_old);
      const ElementGroup& group = *s->world().groups.at(0);
      const auto reports = reports_of(*s);
      for (Index e = 0; e < group.size(); ++e) {
        const Real p = pressure_of(reports[static_cast<std::size_t>(e)]);
        EXPECT_NEAR(p * std::pow(V, 1.4), 1, bound) << kind.elform;
        EXPECT_NEAR(0.4 * energy_of(*s)[e] / group.V0[e], p * V, 1e-12) << kind.elform;
      }
    }
}

// Sheared at a constant volume, p = mu + E: all work of the deviator is in E, tau gamma - tau^2/(2 G) of it
// plastic.
TEST(AveragedPressure, TheDeviatorsWorkHeats) {
  for (const Kind& kind : kinds) {
    SolidDeck deck;
    deck.cells = kind.cells;
    shear_a_cube(deck, kind.elform, "*MAT_ELASTIC_PLASTIC_HYDRO\n1,1.0,0.3,0.01732051\n");
    auto s = simulation_of(deck.text(100));
    run_until(*s, 50);
    s->step(do_nothing);
    const Real gamma = 0.01 * (s->clock().t - s->clock().dt_old), tau = 0.01;
    const ElementGroup& group = *s->world().groups.at(0);
    const auto reports = reports_of(*s);
    for (Index e = 0; e < group.size(); ++e) {
      const Real E = energy_of(*s)[e] / group.V0[e];
      EXPECT_NEAR(E, tau * gamma - tau * tau / 0.6, 2e-3 * tau * gamma) << kind.elform;
      EXPECT_NEAR(pressure_of(reports[static_cast<std::size_t>(e)]) / E, 1, 1e-9) << kind.elform;
    }
  }
}

// K = 1, G = 0.3, stretched by 0.04: p would be -0.0385; PC = -0.02, and with SPALL 3 nothing is left.
TEST(AveragedPressure, TensionEndsAsSpallHasIt) {
  for (const Kind& kind : kinds)
    for (const int option : {1, 3}) {
      SolidDeck deck = column_of(
          1, kind,
          fmt::format("*MAT_ELASTIC_PLASTIC_HYDRO_SPALL\n1,1.0,0.3,10.0,0.0,-0.02\n0.0,0.0,{}\n"
                      "*EOS_LINEAR_POLYNOMIAL\n1,0.0,1.0\n0.0,1.0\n*CONTROL_BULK_VISCOSITY\n1e-9,1e-9\n"
                      "*CONTROL_TIMESTEP\n0.0,0.02\n",
                      option));
      deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,1\n*DEFINE_CURVE\n1\n0.0,0.01\n1e9,0.01\n";
      auto s = simulation_of(deck.text(100));
      run_until(*s, 4);
      for (const PointReport& point : reports_of(*s)) {
        EXPECT_NEAR(point.stress[0], option == 1 ? 0.02 + 0.4 * std::log1p(0.04) : 0, 1e-3) << kind.elform;
        EXPECT_NEAR(point.stress[1], option == 1 ? 0.02 - 0.2 * std::log1p(0.04) : 0, 1e-3) << kind.elform;
      }
    }
}

// V0 of the equation of state: it starts as dense as RO/V0 says, and nothing works before it moves.
TEST(AveragedPressure, StartsCompressedWhereV0SaysSo) {
  for (const Kind& kind : kinds) {
    auto s = simulation_of(column_of(2, kind,
                                     "*MAT_NULL\n1,2.0\n*EOS_LINEAR_POLYNOMIAL\n1,0.0,0.0,0.0,0.0,0.4,0.4\n"
                                     "2.5,0.8\n")
                               .text(1));
    start_ledger(*s);
    const Real volume = 0.25 / 0.8;
    EXPECT_NEAR(s->world().energy.initial, 2.5 * volume, 1e-12);
    for (const PointReport& point : reports_of(*s)) EXPECT_NEAR(pressure_of(point), 0.4 * 2.5 / 0.8, 1e-12);
    EXPECT_LT(energy_error_of_a_step(*s), 1e-12);
  }
}

// Of a rubber-like fluid that is pressed into a corner: a column with one free side does not lock. What
// crushes remembers its compression at the one pressure of an element.
TEST(AveragedPressure, WhatIsCrushedRemembers) {
  for (const Kind& kind : kinds) {
    SolidDeck deck = column_of(
        1, kind,
        "*MAT_NULL\n1,2.0,-1e20,0.0\n*CONTROL_BULK_VISCOSITY\n1e-9,1e-9\n*CONTROL_TIMESTEP\n0.0,0.1\n"
        "*EOS_TABULATED_COMPACTION\n1,0.0\n0.0,-0.1,-0.5\n\n0.0,1.0,10.0\n\n0.0\n\n20.0,20.0,40.0\n\n");
    deck.cards +=
        "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,1\n*DEFINE_CURVE\n1\n0.0,-0.01\n26.0,-0.01\n26.0001,0.01\n"
        "42.0,0.01\n";
    auto s = simulation_of(deck.text(100));
    run_until(*s, 35);
    s->step(do_nothing);
    const Real V = 0.74 + 0.01 * (s->clock().t - s->clock().dt_old - 26), e1 = -std::log(0.74);
    const Real p = 1 + 22.5 * (e1 - 0.1) + (20 + 50 * (e1 - 0.1)) * (-std::log(V) - e1);
    for (const PointReport& point : reports_of(*s)) EXPECT_NEAR(pressure_of(point), p, 0.01) << kind.elform;
  }
}

// Damage takes all points of an element, or the tetrahedron, away; energies stay accounted for.
TEST(AveragedPressure, DeletedElementsLeaveNothing) {
  for (const Kind& kind : kinds) {
    SolidDeck deck =
        column_of(1, kind,
                  "*MAT_ELASTIC_PLASTIC_HYDRO\n1,1.0,0.3,0.003,0.0,0.0,0.02\n"
                  "*EOS_LINEAR_POLYNOMIAL\n1,0.0,1.0\n0.0,1.0\n*CONTROL_BULK_VISCOSITY\n1e-9,1e-9\n"
                  "*CONTROL_TIMESTEP\n0.0,0.02\n");
    deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,1\n*DEFINE_CURVE\n1\n0.0,0.01\n1e9,0.01\n";
    auto s = simulation_of(deck.text(100));
    start_ledger(*s);
    const Index all = s->world().groups.at(0)->size();
    const auto deleted = [&] {
      const auto found = s->world().counters.find("deleted_elements");
      return found == s->world().counters.end() ? 0 : found->second;
    };
    while (deleted() < all && s->clock().t < 20) s->step(do_nothing);
    EXPECT_NEAR(s->clock().t, 3.56, 0.05) << kind.elform;
    for (int k = 0; k < 5; ++k) s->step(do_nothing);
    for (int k = 0; k < 24; ++k)
      EXPECT_EQ(s->world().groups.at(0)->corner_force->data(k)[0], 0) << kind.elform;
    sample_energy(s->world(), s->clock());
    EXPECT_GT(s->world().energy.dissipated, 0);
    EXPECT_LT(std::abs(s->world().energy.internal), 1e-15);
  }
}

TEST(AveragedPressure, HasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  const std::string jc =
      "*MAT_JOHNSON_COOK\n1,8930.0,46e9\n90e6,292e6,0.31,0.025,1.09,1356.0,295.0,1.0\n383.0,-1e9,3.0,,0.1,0."
      "2,-3.0,0.01\n1.0\n";
  for (const Kind& kind : kinds) {
    SolidDeck deck;
    deck.cells = kind.cells;
    deck.block(Vec(0.4, 0.3, 0.2), 8, 6, 4, 1);
    deck.cards = fmt::format("*PART\nblock\n1,1,1,1\n*SECTION_SOLID\n1,{}\n", kind.elform) + jc + copper_law +
                 "*CONTROL_TIMESTEP\n0.0,0.5\n*INITIAL_VELOCITY\n0\n-300.0,50.0,-200.0\n"
                 "*RIGIDWALL_PLANAR\n0\n-0.001,0.0,0.0,1.0,0.0,0.0\n";
    expect_same_bits(deck.text(1), 60, 25);
  }
}

}  // namespace courant::test::averaged_pressure
