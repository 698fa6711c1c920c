// Solids with eight points (ELFORM 2).
#include <gtest/gtest.h>

#include <random>

#include "base/run_error.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;
using test::CellShape;
using test::do_nothing;
using test::expect_no_force_inside;
using test::expect_same_bits;
using test::simulation_of;
using test::SolidDeck;

namespace {

const std::string no_bulk_viscosity = "*CONTROL_BULK_VISCOSITY\n1e-9,1e-9\n";

std::string full_part(const std::string& material) {
  return "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,2\n*" + material + "\n";
}
Real all_energy(Simulation& s) {
  sample_energy(s.world(), s.clock());
  const EnergyLedger& e = s.world().energy;
  EXPECT_EQ(e.hourglass, 0);
  return e.kinetic + e.internal + e.bulk_viscosity;
}
const Field<Real>& stress_of_points(const Simulation& s) {
  return dynamic_cast<const Field<Real>&>(*s.world().groups.at(0)->fields.find("stress_of_points"));
}

/// A free block of random cells.
SolidDeck random_full_block(std::array<int, 3> n, Real flat, CellShape cells, const std::string& material,
                            std::mt19937& random, Real distortion) {
  std::uniform_real_distribution<Real> number(-1, 1);
  SolidDeck deck;
  deck.cells = cells;
  deck.block(Vec(n[0], n[1], flat * n[2]), n[0], n[1], n[2], 1, [&](const Vec& x) {
    const auto moved = [&] { return distortion * number(random); };
    return Vec(x[0] + 0.3 * x[1] + moved(), x[1] + moved(), x[2] + flat * moved());
  });
  deck.cards = full_part(material) + no_bulk_viscosity;
  return deck;
}

}  // namespace

// An affine motion of a distorted block: one stress at all points, that of Hooke's law, and no force on the
// nodes inside.
TEST(FullSolids, PassThePatchTest) {
  std::mt19937 random(5);
  for (const CellShape shape :
       {CellShape::hexahedron, CellShape::wedges, CellShape::wedges_from_quads, CellShape::tetrahedra}) {
    const SolidDeck deck =
        random_full_block({3, 3, 3}, 1, shape, "MAT_ELASTIC\n1,1.0,2.5,0.25", random, 0.2);  // lambda = G = 1
    auto s = simulation_of(deck.text(1e9));
    Nodes& nodes = s->world().nodes;
    Matrix L;
    L << 1, 2, -1, 0.5, -2, 3, 1, 0, 2;
    L *= 1e-9;
    for (Index i = 0; i < nodes.size(); ++i) nodes.v.set(i, L * nodes.x.vec(i));
    for (int k = 0; k < 2; ++k) s->step(do_nothing);
    const Real dt = s->clock().dt_old;
    const Matrix D = 0.5 * (L + L.transpose()), stress = dt * (D.trace() * Matrix::Identity() + 2 * D);
    const ElementGroup& group = *s->world().groups.at(0);
    const Field<Real>& found = stress_of_points(*s);
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (Index e = 0; e < group.size(); ++e)
      for (int c = 0; c < 48; ++c)
        EXPECT_NEAR(found.data(c)[e], stress(row[c % 6], column[c % 6]), 1e-6 * stress.norm()) << int(shape);
    expect_no_force_inside(group, nodes.size(), 1e-7 * stress.norm());
  }
}

// All twelve modes of hourglassing of a cube are resisted: each swings, and all energy is strain energy.
TEST(FullSolids, HaveNoModeWithoutEnergy) {
  for (int mode = 0; mode < 4; ++mode)
    for (int axis = 0; axis < 3; ++axis) {
      SolidDeck deck;
      deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
      deck.cards =
          full_part("MAT_ELASTIC\n1,1.0,1.0,0.3") + no_bulk_viscosity + "*CONTROL_TIMESTEP\n0.0,0.1\n";
      auto s = simulation_of(deck.text(1e9));
      Nodes& nodes = s->world().nodes;
      for (Index i = 0; i < nodes.size(); ++i) {
        const Vec x = 2 * nodes.x.vec(i) - Vec(1, 1, 1);
        const Real sign[] = {x[1] * x[2], x[2] * x[0], x[0] * x[1], x[0] * x[1] * x[2]};
        Vec v = Vec::Zero();
        v[axis] = 1e-6 * sign[mode];
        nodes.v.set(i, v);
      }
      s->step(do_nothing);
      const Real start = all_energy(*s);
      Real most = 0;
      for (int k = 0; k < 1000; ++k) {
        s->step(do_nothing);
        const Real energy = all_energy(*s);
        most = std::max(most, s->world().energy.internal / start);
        EXPECT_NEAR(energy / start, 1, 0.05);  // kinetic energy is that of the half step
      }
      EXPECT_GT(most, 0.5) << mode << " along " << axis;
    }
}

namespace {

/// EI of a beam of n layers of elements over that of the beam, nu = 0, with elements that are a long, h/n
/// high and w wide. Strains of shear of the bent element stiffen: (a/h)^2/2. Within an element the mean
/// pressure resists no bending: of its share 1/n^2 the deviator of a strain of 1 along and b across remains,
/// where b costs shear as well.
Real bending_stiffness(Real a, Real h, Real w, int n) {
  const Real r = w / (h / n), b = (2.0 / 3) / (4.0 / 3 + r * r);
  const Real own = 2.0 / 3 * (1 - b + b * b) + 0.5 * r * r * b * b;
  return 1 - (1 - own) / (n * n) + 0.5 * a * a / (h * h);
}

}  // namespace

// Half a period of the first mode of a cantilever of length 16 and height 1. Timoshenko's shear and rotary
// inertia take 0.4 % off the frequency here.
TEST(FullSolids, BendingLocksAsTheoryHasIt) {
  constexpr Real length = 16, E = 1e4, beta = 1.875104;
  for (const auto& [nx, nz] : {std::pair(16, 1), {16, 2}, {32, 2}}) {
    SolidDeck deck;
    deck.block(Vec(length, 1, 1), nx, 1, nz, 1);
    deck.cards = full_part(fmt::format("MAT_ELASTIC\n1,1.0,{},0.0", E)) + no_bulk_viscosity;
    deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9; });
    deck.cards += "*BOUNDARY_SPC_SET\n1,0,1,1,1\n";
    auto s = simulation_of(deck.text(1e9));
    Nodes& nodes = s->world().nodes;
    const Real sigma = (std::cosh(beta) + std::cos(beta)) / (std::sinh(beta) + std::sin(beta));
    Index tip = 0;
    for (Index i = 0; i < nodes.size(); ++i) {
      const Real b = beta * nodes.x.data(0)[i] / length;
      nodes.v.data(2)[i] = 1e-4 * (std::cosh(b) - std::cos(b) - sigma * (std::sinh(b) - std::sin(b)));
      const Real slope =
          1e-4 * beta / length * (std::sinh(b) + std::sin(b) - sigma * (std::cosh(b) - std::cos(b)));
      nodes.v.data(0)[i] = -slope * (nodes.x.data(2)[i] - 0.5);
      if (nodes.x.data(0)[i] > length - 1e-9) tip = i;
    }
    const Real omega = beta * beta * std::sqrt(E / 12) / (length * length);
    std::vector<Real> turned;
    Real before = 1, t_before = 0;
    while (turned.size() < 2 && s->clock().t < 4 * pi / omega) {
      s->step(do_nothing);
      const Real v = nodes.v.data(2)[tip], t = s->clock().t - 0.5 * s->clock().dt;
      const bool again = !turned.empty() && t - turned.back() < 0.5 * pi / omega;  // faster modes
      if (v * before < 0 && !again) turned.push_back(t_before + before / (before - v) * (t - t_before));
      before = v, t_before = t;
    }
    ASSERT_EQ(turned.size(), 2u);
    const Real ratio = pi / (turned[1] - turned[0]) / omega;
    const Real expected = 0.996 * std::sqrt(bending_stiffness(length / nx, 1, 1, nz));
    RecordProperty(fmt::format("ratio_{}_{}", nx, nz), fmt::format("{:.4f} of {:.4f}", ratio, expected));
    EXPECT_NEAR(ratio / expected, 1, 0.006) << nx << " " << nz;
  }
}

// As *SolidShapes* has it for one point: 1 000 blocks, TSSFAC 0.9.
TEST(FullSolids, RandomFreeBlocksAreStable) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> number(-1, 1);
  const char* const nu[] = {"0.0", "0.3", "0.495"};
  constexpr std::array<int, 3> sizes[] = {{1, 1, 1}, {1, 1, 2}, {2, 2, 2}};
  constexpr CellShape shapes[] = {CellShape::hexahedron, CellShape::hexahedron, CellShape::wedges,
                                  CellShape::tetrahedra};
  int grown = 0;
  for (int k = 0; k < 1000; ++k) {
    const std::string material = fmt::format("MAT_ELASTIC\n1,1.0,1.0,{}", nu[k % 3]);
    auto s = simulation_of(random_full_block(sizes[k / 3 % 3], k % 7 == 0 ? 0.1 : 1, shapes[k % 4], material,
                                             random, 0.15 + 0.1 * number(random))
                               .text(1e9));
    Nodes& nodes = s->world().nodes;
    for (Index i = 0; i < nodes.size(); ++i)
      nodes.v.set(i, 1e-8 * Vec(number(random), number(random), number(random)));
    Real early = 0, late = 0;
    for (int step = 0; step < 600; ++step) {
      s->step(do_nothing);
      if (step < 200) early = std::max(early, all_energy(*s));
      if (step >= 400) late = std::max(late, all_energy(*s));
    }
    grown += !(late < 1.5 * early);
  }
  EXPECT_EQ(grown, 0);
}

// Pulled and bent at once: each point has its own plastic strain, and results are the means.
TEST(FullSolids, BecomePlasticPointByPoint) {
  SolidDeck deck;
  deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
  deck.cards = full_part("MAT_PLASTIC_KINEMATIC\n1,1.0,1.0,0.3,0.01,0.1,1.0") + no_bulk_viscosity;
  deck.node_set(1, [](const Vec& x) { return x[0] < 0.5; });
  deck.node_set(2, [](const Vec& x) { return x[0] > 0.5 && x[2] < 0.5; });
  deck.node_set(3, [](const Vec& x) { return x[0] > 0.5 && x[2] > 0.5; });
  deck.cards +=
      "*BOUNDARY_SPC_SET\n1,0,1,1,1\n2,0,0,1,1\n3,0,0,1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,1,0,1,0.5\n3,1,"
      "0,1,1.5\n"
      "*DEFINE_CURVE\n1\n0.0,0.01\n1e9,0.01\n";
  auto s = simulation_of(deck.text(100));
  while (s->clock().t < 10) s->step(do_nothing);
  for (auto* filler : s->world().passes.all<FieldFiller>()) filler->fill_fields(s->world());
  const FieldSet& fields = s->world().groups.at(0)->fields;
  const auto& points = dynamic_cast<const Field<Real>&>(*fields.find("plastic_strain_of_points"));
  const auto& mean = dynamic_cast<const Field<Real>&>(*fields.find("plastic_strain"));
  const auto& stress = dynamic_cast<const Field<Real>&>(*fields.find("stress"));
  Real sum = 0, sum_stress = 0;
  for (int p = 0; p < 8; ++p) {
    EXPECT_GT(points.data(p)[0], 0.01) << p;
    EXPECT_NEAR(points.data(p)[0], points.data(p ^ 2)[0], 1e-12) << "alike along y";
    if (p < 4) EXPECT_GT(points.data(p + 4)[0], 1.5 * points.data(p)[0]);
    sum += points.data(p)[0], sum_stress += stress_of_points(*s).data(6 * p)[0];
  }
  EXPECT_NEAR(mean[0], sum / 8, 1e-15);
  EXPECT_NEAR(stress.data(0)[0], sum_stress / 8, 1e-15);
}

// FS: all points fail at once where they are strained alike, as with one point.
TEST(FullSolids, AreDeleted) {
  Real time[2];
  for (const int elform : {1, 2}) {
    SolidDeck deck;
    deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
    deck.cards = fmt::format("*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,{}\n", elform) +
                 "*MAT_PLASTIC_KINEMATIC\n1,1.0,1.0,0.3,0.01,0.1,1.0\n0.0,0.0,0.05\n" + no_bulk_viscosity;
    deck.node_set(1, [](const Vec& x) { return x[0] < 0.5; });
    deck.node_set(2, [](const Vec& x) { return x[0] > 0.5; });
    deck.cards +=
        "*BOUNDARY_SPC_SET\n1,0,1,1,1\n2,0,0,1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,1,0,1\n*DEFINE_"
        "CURVE\n1\n0.0,0.01\n"
        "1e9,0.01\n";
    auto s = simulation_of(deck.text(100));
    test::start_ledger(*s);
    while (s->world().counters["deleted_elements"] == 0 && s->clock().t < 50) s->step(do_nothing);
    time[elform - 1] = s->clock().t;
    for (int k = 0; k < 3; ++k) s->step(do_nothing);
    for (int k = 0; k < 24; ++k) EXPECT_EQ(s->world().groups.at(0)->corner_force->data(k)[0], 0);
    EXPECT_GT(s->world().energy.dissipated, 1e-4);
  }
  EXPECT_LT(time[0], 49);
  EXPECT_NEAR(time[1], time[0], 0.5);
}

TEST(FullSolids, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const char* material : {"MAT_PLASTIC_KINEMATIC\n1,1000.0,1e6,0.3,1e3,1e4,0.3\n10.0,4.0,0.5,1",
                               "MAT_MOONEY-RIVLIN_RUBBER\n1,1000.0,0.49,1e5,2e4",
                               "MAT_SIMPLIFIED_JOHNSON_COOK\n1,1000.0,1e6,0.3\n1e3,2e3,0.5,0.02,0.8"}) {
    SolidDeck deck;
    deck.block(Vec(0.4, 0.3, 0.2), 8, 6, 4, 1);
    deck.cards = full_part(material);
    deck.cards += "*INITIAL_VELOCITY\n0\n-2.0,0.5,-3.0\n*RIGIDWALL_PLANAR\n0\n-0.01,0.0,0.0,1.0,0.0,0.0\n";
    expect_same_bits(deck.text(1), 150, 25);
  }
}

// A corner is pushed in so far that the determinant is below 0 at the point beside it, det 1/8 (1 + 2 d.grad
// N), though the volume of the element, 1 + d.(1, 1, 1)/4, is not.
TEST(FullSolids, StopWhereAPointIsInsideOut) {
  for (const Real pushed : {0.4, 0.9}) {  // at 0.536 the determinant is 0
    SolidDeck deck;
    deck.block(Vec(1, 1, 1), 1, 1, 1, 1,
               [&](const Vec& x) { return x.isApprox(Vec::Ones()) ? Vec(x - pushed * Vec::Ones()) : x; });
    deck.cards = full_part("MAT_ELASTIC\n1,1.0,2.5,0.25");
    auto s = simulation_of(deck.text(1));
    if (pushed < 0.5) {
      EXPECT_NO_THROW(s->step(do_nothing));
      continue;
    }
    try {
      for (int k = 0; k < 2; ++k) s->step(do_nothing);
      ADD_FAILURE() << "runs on";
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what()).find("turned inside out"), std::string::npos) << error.what();
      EXPECT_NE(error.hint, "");
    }
  }
}
