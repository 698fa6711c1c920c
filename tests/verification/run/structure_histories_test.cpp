// Cross sections and stress of elements against statics and waves.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "beam_decks.hpp"
#include "elements/histories/secforc.hpp"
#include "extension/additions.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"

namespace courant::test::structure_histories {

namespace {

constexpr Real modulus = 2.1e11, density = 7850;
const std::string ramp = "*DEFINE_CURVE\n1\n0.0,0.0\n1.0e-3,1.0\n1.0e3,1.0\n";

std::string elastic(int id, Real nu) {
  return fmt::format("*MAT_ELASTIC\n{},{},{:e},{}\n", id, density, modulus, nu);
}

std::string plane_at(Real x, const std::string& more = "") {
  return fmt::format("*DATABASE_CROSS_SECTION_PLANE\n0,{0},0.0,0.0,{1},0.0,0.0\n0.0,0.0,0.0,0.0,0.0{2}\n", x,
                     x + 1, more);
}

const std::vector<CrossSection>& sections_of(const Simulation& s) {
  return s.world().passes.all<const CrossSections>().front()->sections;
}
const CrossSection& section_of(const Simulation& s, Id id) {
  for (const CrossSection& one : sections_of(s))
    if (one.id == id) return one;
  throw std::logic_error("no such section");
}

/// What the sections carry at the first time level from `end` on, after all before it.
std::vector<SectionForce> forces_at(Simulation& s, Real end) {
  std::vector<SectionForce> out;
  while (out.empty())
    s.step([&](World& world, const Clock& clock, const std::string&) {
      if (clock.t < end) return;
      for (const CrossSection& one : sections_of(s)) out.push_back(one.force(world));
    });
  return out;
}

std::string text_of(Simulation& s, const char* name) {
  for (const AsciiHistory& one : ascii_histories())
    if (one.name == name) return one.text(s.world(), s.clock());
  return "";
}

std::vector<ElementReport> reports_of(const Simulation& s, ElementKind kind,
                                      ElementReportOptions options = {}) {
  std::map<Id, ElementReport> by_id;
  for (const auto* reporter : s.world().passes.all<const ElementReporter>())
    for (Index e = 0; reporter->kind() == kind && e < reporter->reported().size(); ++e)
      by_id[reporter->reported().id[e]] = reporter->report_element(s.world(), e, options);
  std::vector<ElementReport> out;
  for (auto& [id, report] : by_id) out.push_back(std::move(report));
  return out;
}

/// A bar of n solids of 0.1 x 0.1, 1 long, held at x = 0 along x.
SolidDeck bar(int n, int formulation, Real nu) {
  SolidDeck deck;
  deck.block({1, 0.1, 0.1}, n, 1, 1, 1);
  deck.cards += fmt::format("*PART\nbar\n1,1,1\n*SECTION_SOLID\n1,{}\n", formulation) + elastic(1, nu) + ramp;
  deck.node_set(1, [](const Vec& x) { return x[0] == 0; });
  deck.node_set(2, [](const Vec& x) { return x[1] == 0; });
  deck.node_set(3, [](const Vec& x) { return x[2] == 0; });
  deck.node_set(4, [](const Vec& x) { return x[0] == 1; });
  deck.cards += "*BOUNDARY_SPC_SET\n1,0,1\n2,0,0,1\n3,0,0,0,1\n";
  return deck;
}

}  // namespace

// Hourglass modes without a stiffness come to rest last.
// What is at rest passes the load on through every section; nodes on the plane count as behind it.
TEST(CrossSections, CarryTheLoadOfABarAtRest) {
  constexpr Real load = 1000, area = 0.01;
  for (const int formulation : {1, 2})
    for (const int n : {5, 10}) {
      SolidDeck deck = bar(n, formulation, 0.3);
      deck.cards += fmt::format("*LOAD_NODE_SET\n4,1,1,{}\n*DAMPING_GLOBAL\n0,16000.0\n", load / 4);
      deck.cards += plane_at(0.53) + plane_at(0.6) + plane_at(0.2);
      auto s = simulation_of(deck.text(1));
      for (const SectionForce& f : forces_at(*s, 0.05)) {
        EXPECT_NEAR(f.force[0], load, 1e-9 * load) << formulation << " " << n;
        EXPECT_NEAR(std::hypot(f.force[1], f.force[2]), 0, 1e-9 * load);
        EXPECT_NEAR(f.moment.norm(), 0, 1e-9 * load);
        EXPECT_NEAR(f.area, area, 1e-6 * area);
        EXPECT_NEAR(f.centroid[1], 0.05, 1e-6);
        EXPECT_NEAR(f.centroid[2], 0.05, 1e-6);
      }
      EXPECT_NEAR(section_of(*s, 1).force(s->world()).centroid[0], 0.53, 1e-6);
      for (const bool all : {false, true})
        for (const ElementReport& one : reports_of(*s, ElementKind::solid, {.all_points = all})) {
          ASSERT_EQ(one.points.size(), formulation == 2 && all ? 8u : 1u);
          for (const PointReport& point : one.points) {
            EXPECT_NEAR(point.stress[0], load / area, 2e-6 * load / area);
            EXPECT_NEAR(std::abs(point.stress[1]) + std::abs(point.stress[3]), 0, 2e-6 * load / area);
          }
        }
    }
}

// Behind the wave of a bar that meets a wall with v: rho c v A.
TEST(CrossSections, CarryTheForceOfAWave) {
  const Real c = std::sqrt(modulus / density), theory = density * c * 0.01;
  for (const int n : {50, 100}) {
    SolidDeck deck = bar(n, 1, 0);
    deck.cards += "*INITIAL_VELOCITY_GENERATION\n1,2,0.0,-1.0,0.0,0.0\n\n" + plane_at(0.5 + 0.25 / n);
    auto s = simulation_of(deck.text(1));
    Real sum = 0, time = 0;
    while (s->clock().t < 1.3 / c)
      s->step([&](World& world, const Clock& clock, const std::string&) {
        if (clock.t < 0.7 / c || clock.t > 1.3 / c) return;
        sum += sections_of(*s).front().force(world).force[0] * clock.dt, time += clock.dt;
      });
    const Real error = std::abs(sum / time / theory + 1);
    RecordProperty(fmt::format("error_{}", n), fmt::format("{:.2e}", error));
    EXPECT_LT(error, 1e-3) << n;
  }
}

namespace {

/// A cantilever of shells along x, turned by `tilt` about y, with a load at its end along its normal.
ShellDeck cantilever_of_shells(Real tilt, int elform, bool triangles, Real load, Real L, Real w, Real t,
                               int n) {
  ShellDeck deck;
  const auto turn = [tilt](const Vec& x) {
    return Vec(std::cos(tilt) * x[0] + std::sin(tilt) * x[2], x[1],
               -std::sin(tilt) * x[0] + std::cos(tilt) * x[2]);
  };
  deck.plate(L, w, n, 1, 1, turn, triangles);
  deck.cards +=
      fmt::format("*PART\nplate\n1,1,1\n*SECTION_SHELL\n1,{},1.0,3\n{}\n", elform, t) + elastic(1, 0) + ramp;
  const Vec along = turn({1, 0, 0}), normal = turn({0, 0, 1});
  deck.hold(1, "xyzXYZ", [&](const Vec& x) { return std::abs(x.dot(along)) < 1e-9; });
  deck.node_set(2, [&](const Vec& x) { return std::abs(x.dot(along) - L) < 1e-9; });
  deck.cards += "*LOAD_NODE_SET\n";
  for (const int k : {0, 2})
    if (normal[k] != 0) deck.cards += fmt::format("2,{},1,{:.12e}\n", k + 1, load / 2 * normal[k]);
  return deck;
}

}  // namespace

// Through a cantilever goes the load, with P (L - x) about its centroid; stress at the layers is M z/I.
TEST(CrossSections, CarryTheMomentOfACantileverOfShells) {
  constexpr Real L = 1, w = 0.1, t = 0.02, P = 1, x = 0.4375;
  for (const auto& [elform, triangles] : {std::pair(2, false), std::pair(16, false), std::pair(4, true)})
    for (const Real tilt : {0.0, 0.5}) {
      ShellDeck deck = cantilever_of_shells(tilt, elform, triangles, P, L, w, t, 8);
      deck.cards += "*DAMPING_GLOBAL\n0,200.0\n";
      const Vec along(std::cos(tilt), 0, -std::sin(tilt)), normal(std::sin(tilt), 0, std::cos(tilt));
      const Vec tail = x * along, head = tail + along;
      deck.cards += fmt::format("*DATABASE_CROSS_SECTION_PLANE\n0,{:.7f},0.0,{:.7f},{:.7f},0.0,{:.7f}\n",
                                tail[0], tail[2], head[0], head[2]);
      deck.cards += "0.0,0.0,0.0,0.0,0.0,7,2\n*DEFINE_COORDINATE_VECTOR\n" +
                    fmt::format("7,{:.9f},0.0,{:.9f},0.0,1.0,0.0\n", along[0], along[2]);
      auto s = simulation_of(deck.text(1));
      const SectionForce f = forces_at(*s, 0.25).front();
      // in the system 7: x along, y as global, z = x cross y the normal
      EXPECT_NEAR(f.force[2], P, 2e-5 * P) << elform << " " << tilt;
      EXPECT_NEAR(f.force[0], 0, 1e-4 * P);
      EXPECT_NEAR(f.moment[1], -P * (L - x), 1e-4 * P * (L - x)) << elform << " " << tilt;
      EXPECT_NEAR(f.area, w * t, 1e-5 * w * t);
      EXPECT_NEAR(f.centroid.dot(along), x, 1e-5);
      if (triangles) continue;
      const auto reports = reports_of(*s, ElementKind::shell);
      ASSERT_EQ(reports[3].points.size(), 3u);
      const Real most = P * (L - x) * (t / 2) / (w * t * t * t / 12) * std::sqrt(0.6);
      for (std::size_t k = 0; k < 3; ++k) {
        // pulled below, where the load points up; the shear is even over the thickness
        const Real sigma = most * (1 - static_cast<Real>(k)), shear = P / (w * t);
        const Matrix theory = sigma * along * along.transpose() +
                              shear * (along * normal.transpose() + normal * along.transpose());
        const auto& stress = reports[3].points[k].stress;
        for (const auto& [at, i, j] : {std::tuple(0, 0, 0), std::tuple(1, 1, 1), std::tuple(2, 2, 2),
                                       std::tuple(3, 0, 1), std::tuple(4, 1, 2), std::tuple(5, 2, 0)})
          EXPECT_NEAR(stress[static_cast<std::size_t>(at)], theory(i, j), 1e-3 * most)
              << elform << " " << tilt << " " << k << " " << at;
        EXPECT_NEAR(reports_of(*s, ElementKind::shell, {.local_axes = true})[3].points[k].stress[0], sigma,
                    2e-3 * most);
      }
    }
}

// The middle of a beam tells the same as a section there.
TEST(CrossSections, AndElementsTellResultantsOfBeams) {
  using namespace beams;
  constexpr Real L = 1, P = 0.02;
  for (const std::string& section : {square_1, square_2}) {
    BeamDeck deck;
    deck.line(5, L, [](int k) { return k == 0 ? ",7,7" : ""; });
    deck.part(1, section, steel_of_beams);
    deck.cards +=
        ramp +
        fmt::format("*LOAD_NODE_POINT\n6,3,1,{0}\n6,1,1,{1}\n6,2,1,{2}\n6,5,1,{3}\n", P, P, P / 2, P / 4) +
        "*DAMPING_GLOBAL\n0,100.0\n" + plane_at(0.5);
    auto s = simulation_of(deck.text(1));
    const SectionForce f = forces_at(*s, 0.5).front();
    const ElementReport middle = reports_of(*s, ElementKind::beam)[2];
    // the third node lies along y: s is y, t is z
    const Real theory[] = {P, P / 2, P, -P * L / 2, P / 2 * L / 2, P / 4};
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(middle.resultants[k], theory[k], 1e-3 * P) << k;
    const Real of_section[] = {f.force[0], f.force[1], f.force[2], f.moment[1], f.moment[2], f.moment[0]};
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(of_section[k], theory[k], 1e-3 * P) << k;
    EXPECT_NEAR(f.area, 1e-4, 1e-10);
    EXPECT_EQ(middle.points.empty(), section == square_2);
    Real pull = 0;
    for (const PointReport& point : middle.points)
      pull += point.stress[0] * 1e-4 / static_cast<Real>(middle.points.size());
    if (!middle.points.empty()) EXPECT_NEAR(pull, P, 1e-3 * P);
  }
}

namespace {

/// Three strips along x, 1 long, of solids, shells and beams, held at x = 0 and pulled at x = 1. Sets 11 to
/// 13 are what lies between x = 0.4 and 0.5, 21 to 23 what lies between 0.5 and 0.6, and 5 the nodes between.
struct Strips {
  std::string material = elastic(1, 0), beams = "2\n4.0e-4,1.3e-8,1.3e-8,2.6e-8";
  Real to_solids = 40, to_shells = 10, to_beams = 20, damping = 16000;
};
std::string three_strips(const std::string& more, const Strips& strips = {}) {
  std::string out = "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n" + ramp + strips.material +
                    "*PART\nsolids\n1,1,1\n*PART\nshells\n2,2,1\n*PART\nbeams\n3,3,1\n*SECTION_SOLID\n1,1\n"
                    "*SECTION_SHELL\n2,2,1.0,2\n0.02\n*SECTION_BEAM\n3," +
                    strips.beams + "\n*NODE\n";
  for (int i = 0; i <= 10; ++i) {
    const char* codes = i == 0 ? "7,7" : "0,0";
    for (int k = 0; k < 4; ++k)
      out += fmt::format("{},{},{},{},{}\n", 100 * i + k + 1, 0.1 * i, k % 3 == 0 ? 0.0 : 0.1,
                         k < 2 ? 0.0 : 0.1, codes);
    for (int k = 0; k < 2; ++k)
      out += fmt::format("{},{},{},0.0,{}\n", 100 * i + k + 11, 0.1 * i, 0.3 + 0.1 * k, codes);
    out += fmt::format("{},{},0.6,0.0,{}\n", 100 * i + 21, 0.1 * i, codes);
  }
  out += "9999,0.0,5.0,0.0,7,7\n*ELEMENT_SOLID\n";
  const auto row = [&out](std::initializer_list<int> numbers) {
    for (const int n : numbers) out += fmt::format("{:8}", n);
    out += "\n";
  };
  for (int i = 0; i < 10; ++i) {
    const int a = 100 * i, b = a + 100;
    row({i + 1, 1, a + 1, b + 1, b + 2, a + 2, a + 4, b + 4, b + 3, a + 3});
  }
  out += "*ELEMENT_SHELL\n";
  for (int i = 0; i < 10; ++i) row({i + 1, 2, 100 * i + 11, 100 * i + 111, 100 * i + 112, 100 * i + 12});
  out += "*ELEMENT_BEAM\n";
  for (int i = 0; i < 10; ++i) row({i + 1, 3, 100 * i + 21, 100 * i + 121, 9999});
  for (const int side : {1, 2})
    for (const auto& [k, keyword] : {std::pair(1, "SOLID"), std::pair(2, "SHELL_LIST"), std::pair(3, "BEAM")})
      out += fmt::format("*SET_{}\n{}\n{}\n", keyword, 10 * side + k, 4 + side);
  out += "*SET_NODE_LIST\n5\n501,502,503,504,511,512,521\n*LOAD_NODE_POINT\n";
  for (int k = 1; k <= 4; ++k) out += fmt::format("{},1,1,{}\n", 1000 + k, strips.to_solids / 4);
  for (int k = 11; k <= 12; ++k) out += fmt::format("{},1,1,{}\n", 1000 + k, strips.to_shells / 2);
  out += fmt::format("1021,1,1,{}\n", strips.to_beams);
  return out + fmt::format("*DAMPING_GLOBAL\n0,{}\n", strips.damping) + more + "*END\n";
}

}  // namespace

// A plane through all kinds, one of their parts, pieces of it, and sets from both sides.
TEST(CrossSections, CutWhatTheyAreToldTo) {
  const std::string cards =
      "*SET_PART_LIST\n1\n2,3\n" + plane_at(0.45) +
      "*DATABASE_CROSS_SECTION_PLANE_ID\n"
      "        20shells and beams\n1,0.45,0.0,0.0,2.0,0.0,0.0\n0.0,0.0,0.0\n"
      "        30solids in a disc\n0,0.45,0.05,0.05,2.0,0.05,0.05,0.1\n0.0,0.0,0.0\n"
      "        40the disc ends in the solids\n0,0.45,0.05,0.05,2.0,0.05,0.05,0.06\n0.0,0.0,0.0\n"
      "        50beams in a piece\n0,0.45,0.5,-0.5,2.0,0.5,-0.5\n0.45,1.5,-0.5,0.2,1.0\n"
      "*DATABASE_CROSS_SECTION_SET_ID\n        60behind\n5,11,13,12\n        70before\n5,21,23,22\n";
  auto s = simulation_of(three_strips(cards));
  const auto f = forces_at(*s, 0.05);
  ASSERT_EQ(f.size(), 7u);
  const auto expect = [&](std::size_t k, Real pull, Real area, const Vec& centroid, const Vec& moment) {
    EXPECT_NEAR(f[k].force[0], pull, 1e-8 * 70) << k;
    EXPECT_NEAR(std::hypot(f[k].force[1], f[k].force[2]), 0, 1e-8 * 70) << k;
    EXPECT_NEAR(f[k].area, area, 1e-7 * 0.0124) << k;
    EXPECT_NEAR((f[k].centroid - centroid).norm(), 0, 1e-6) << k;
    EXPECT_NEAR((f[k].moment - moment).norm(), 0, 1e-6 * 70) << k;
  };
  const Vec at[] = {{0, 0.05, 0.05}, {0, 0.35, 0}, {0, 0.6, 0}};
  const Real areas[] = {0.01, 0.002, 4e-4}, pulls[] = {40, 10, 20};
  const auto all_of = [&](std::size_t k, int first, int last, Real x) {
    Real area = 0, pull = 0;
    Vec centroid = Vec::Zero(), moment = Vec::Zero();
    for (int p = first; p <= last; ++p) area += areas[p], pull += pulls[p], centroid += areas[p] * at[p];
    centroid /= area;
    for (int p = first; p <= last; ++p) moment += (at[p] - centroid).cross(Vec(pulls[p], 0, 0));
    expect(k, pull, area, centroid + Vec(x, 0, 0), moment);
  };
  all_of(0, 0, 2, 0.45), all_of(1, 1, 2, 0.45), all_of(2, 0, 0, 0.45);
  expect(3, 0, 0, Vec::Zero(), Vec::Zero());
  all_of(4, 2, 2, 0.45);
  // elements behind the nodes pull them back
  EXPECT_NEAR(f[5].force[0], -70, 1e-8 * 70);
  EXPECT_NEAR(f[5].area, 0.0124, 1e-7 * 0.0124);
  EXPECT_NEAR((f[5].force + f[6].force).norm(), 0, 1e-8 * 70);
  EXPECT_NEAR((f[5].moment + f[6].moment).norm(), 0, 1e-6 * 70);
}

// While all yields, plastic strain is that of the law: (effective stress - SIGY)/(plastic modulus).
TEST(CrossSections, AndElementsTellPlasticStrain) {
  constexpr Real yield = 250e6, tangent = 2.1e9, hardening = modulus * tangent / (modulus - tangent),
                 pull = 260e6;
  const Strips strips{.material = fmt::format("*MAT_PLASTIC_KINEMATIC\n1,{},{:e},0.0,{:e},{:e},1.0\n",
                                              density, modulus, yield, tangent),
                      .beams = "1,1.0,2\n0.02,0.02,0.02,0.02",
                      .to_solids = 0.01 * pull,
                      .to_shells = 0.002 * pull,
                      .to_beams = 4e-4 * pull};
  auto s =
      simulation_of(three_strips(plane_at(0.45) + "*DATABASE_HISTORY_SOLID\n5\n*DATABASE_HISTORY_SHELL\n5\n"
                                                  "*DATABASE_HISTORY_BEAM\n5\n*DATABASE_ELOUT\n1.0\n",
                                 strips));
  forces_at(*s, 0.015);
  for (const ElementKind kind : {ElementKind::solid, ElementKind::shell, ElementKind::beam}) {
    const auto reports = reports_of(*s, kind);
    for (const PointReport& point : reports[4].points) {
      const auto& c = point.stress;
      const Real effective =
          std::sqrt(0.5 * (std::pow(c[0] - c[1], 2) + std::pow(c[1] - c[2], 2) + std::pow(c[2] - c[0], 2)) +
                    3 * (c[3] * c[3] + c[4] * c[4] + c[5] * c[5]));
      EXPECT_GT(point.plastic, 1e-3) << element_word(kind);
      EXPECT_NEAR(point.plastic, (effective - yield) / hardening, 1e-4 * point.plastic) << element_word(kind);
    }
  }
  EXPECT_NE(text_of(*s, "elout").find("1 plastic "), std::string::npos);
  EXPECT_EQ(text_of(*s, "elout").find("1 elastic "), std::string::npos);
}

// The texts are the same on any number of threads and after a restart.
TEST(CrossSections, AndElementsHaveTheSameBits) {
  const std::string deck =
      three_strips(plane_at(0.45) +
                       "*DATABASE_HISTORY_SOLID\n5\n*DATABASE_HISTORY_SHELL\n5\n*DATABASE_HISTORY_BEAM\n5\n"
                       "*DATABASE_ELOUT\n1.0e-4\n*DATABASE_SECFORC\n1.0e-4\n",
                   {.damping = 100});
  expect_same_bits(deck, 60, 31);
  std::string first;
  for (const int threads : {1, 2}) {
    set_threads(threads);
    auto s = simulation_of(deck);
    for (int k = 0; k < 60; ++k) s->step(do_nothing);
    const std::string text = text_of(*s, "elout") + text_of(*s, "secforc");
    EXPECT_GT(text.size(), 1000u);
    if (first.empty()) first = text;
    EXPECT_EQ(text, first);
  }
  set_threads(0);
}

namespace {

std::string faults_of(const std::string& cards) {
  Diagnostics diagnostics;
  ReadOptions options;
  options.open = [text = three_strips(cards)](const std::string&) { return text; };
  Simulation::build("test.k", options, diagnostics);
  return diagnostics.text();
}

}  // namespace

TEST(CrossSections, RefuseByNameWhatTheyCannotDo) {
  const auto expect_fault = [](const std::string& cards, const std::string& says) {
    const std::string faults = faults_of(cards);
    EXPECT_NE(faults.find(says), std::string::npos) << says << "\n" << faults;
  };
  const auto plane = [](const std::string& second) {
    return "*DATABASE_CROSS_SECTION_PLANE\n0,0.45,0.0,0.0,1.0,0.0,0.0\n" + second + "\n";
  };
  expect_fault((plane("0.0,0.0,0.0,0.0,0.0,1,0")), "axes of a rigid body are not supported");
  expect_fault((plane("0.0,0.0,0.0,0.0,0.0,1,1")), "axes of an accelerometer are not supported");
  expect_fault((plane("0.0,0.0,0.0,0.0,0.0,8,2")), "coordinate system 8 does not exist");
  expect_fault((plane("2.0,0.0,0.0,0.5")), "does not lie in the plane");
  expect_fault(("*DATABASE_CROSS_SECTION_PLANE\n0,0.45,0.0,0.0,0.45,0.0,0.0\n0.0\n"), "are the same point");
  expect_fault(("*DATABASE_CROSS_SECTION_PLANE\n0,7.0,0.0,0.0,8.0,0.0,0.0\n0.0\n"),
               "cuts no element that deforms");
  expect_fault(("*DATABASE_CROSS_SECTION_PLANE\n9,0.45,0.0,0.0,8.0,0.0,0.0\n0.0\n"),
               "part set 9 does not exist");
  expect_fault(("*DATABASE_CROSS_SECTION_SET\n6,11\n"), "node set 6 does not exist");
  expect_fault(("*DATABASE_CROSS_SECTION_SET\n5,0,99\n"), "beam set 99 does not exist");
  expect_fault(("*DATABASE_CROSS_SECTION_SET\n5,11,0,0,1\n"), "TSID");
  expect_fault(("*DATABASE_CROSS_SECTION_SET\n5,11,0,0,0,1\n"), "DSID");
  expect_fault(("*DATABASE_CROSS_SECTION_SET_ID\n         3a\n5,11\n         3b\n5,11\n"),
               "two cross sections 3");
  expect_fault(("*DATABASE_SECFORC\n0.1\n"), "there is no cross section");
  expect_fault(("*DATABASE_HISTORY_SHELL\n77\n*DATABASE_ELOUT\n0.1\n"), "shell 77 does not exist");
  expect_fault(("*DATABASE_HISTORY_BEAM_SET\n77\n*DATABASE_ELOUT\n0.1\n"), "beam set 77 does not exist");
  expect_fault(("*DATABASE_ELOUT\n0.1\n"), "no element is named");
}

}  // namespace courant::test::structure_histories
