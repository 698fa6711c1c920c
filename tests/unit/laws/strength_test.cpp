// Every law of strength against its own references, and what must hold for all of them.
#include "laws/strength/strength.hpp"
#include "laws/strength/yield_return.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "laws/objective.hpp"
#include "model/build_model.hpp"

using namespace courant;

namespace {

using Tensor = std::array<Real, 6>;

std::shared_ptr<StrengthLaw> law_of(const std::string& keyword, const std::string& cards,
                                    std::string* faults = nullptr) {
  ReadOptions options;
  options.open = [&](const std::string&) {
    return std::optional<std::string>("*KEYWORD\n*" + keyword + "\n" + cards + "*END\n");
  };
  Diagnostics diagnostics;
  const Deck deck = read_deck("m.k", options, diagnostics);
  Diagnostics of_no_whole_model;
  const Model model = build_model(deck, of_no_whole_model);
  for (const StrengthEntry& kind : strength_registry()) {
    if (kind.keyword != keyword) continue;
    kind.check(deck, model, diagnostics);
    if (faults)
      *faults = diagnostics.text();
    else {
      EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
    }
    const auto laws = kind.all(deck, model);
    if (laws.size() == 1) return laws[0].second;
  }
  return nullptr;
}

/// One point that a law works on.
struct Point {
  explicit Point(const StrengthLaw& of) : law(of) {
    for (const HistoryVariable& h : of.history()) {
      if (h.is_tensor()) tensors.push_back(history.size());
      history.resize(history.size() + h.components, 0.0);
    }
  }
  const StrengthLaw& law;
  Tensor stress{};
  std::vector<Real> history;
  std::vector<std::size_t> tensors{};  ///< where in `history` they start
  Real compression = 0, c = 0, dt = 1;

  void strain(const Tensor& increment) {
    Tensor rate = increment;
    for (Real& r : rate) r /= dt;
    std::vector<Real*> kept;
    for (Real& h : history) kept.push_back(&h);
    PointBlock block;
    block.count = 1, block.dt = dt;
    for (int k = 0; k < 6; ++k) block.rate[k] = &rate[k], block.stress[k] = &stress[k];
    block.compression = &compression, block.sound_speed = &c, block.history = kept;
    law.update(block);
  }
  void turn(const Vec& angle) {
    const Real spin[3] = {angle[0] / dt, angle[1] / dt, angle[2] / dt};
    const Real* const w[3] = {&spin[0], &spin[1], &spin[2]};
    Real* const s[6] = {&stress[0], &stress[1], &stress[2], &stress[3], &stress[4], &stress[5]};
    turn_stress(w, dt, s, 1);
    for (const std::size_t t : tensors) {
      Real* const a[6] = {&history[t],     &history[t + 1], &history[t + 2],
                          &history[t + 3], &history[t + 4], &history[t + 5]};
      turn_stress(w, dt, a, 1);
    }
  }
  /// History with its tensors as they look from axes turned by R.
  std::vector<Real> seen_from(const Matrix& R) const;
};

Matrix matrix(const Tensor& t) {
  Matrix m;
  m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  return m;
}
Tensor tensor(const Matrix& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
}
std::vector<Real> Point::seen_from(const Matrix& R) const {
  std::vector<Real> out = history;
  for (const std::size_t t : tensors) {
    Tensor a;
    std::copy_n(history.begin() + static_cast<long>(t), 6, a.begin());
    a = tensor(R * matrix(a) * R.transpose());
    std::copy_n(a.begin(), 6, out.begin() + static_cast<long>(t));
  }
  return out;
}
/// Of Hughes and Winget: (1 - W/2)^-1 (1 + W/2).
Matrix rotation(const Vec& angle) {
  Matrix W;
  W << 0, -angle[2], angle[1], angle[2], 0, -angle[0], -angle[1], angle[0], 0;
  return (Matrix::Identity() - 0.5 * W).inverse() * (Matrix::Identity() + 0.5 * W);
}
void expect_near(const Tensor& a, const Tensor& b, Real tolerance, const std::string& where) {
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(a[k], b[k], tolerance) << where << " component " << k;
}
Real contract(const Tensor& a, const Tensor& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// What the equation of a yield stress that depends on the rate leaves.
constexpr Real with_rates = 1e-7;

/// A law whose stress follows from the strain since the start.
bool is_hyperelastic(const StrengthLaw& law) {
  const auto kept = law.history();
  return !kept.empty() && kept.front().name == "left_cauchy_green_less_1";
}

template <class Body>
void for_each_law(const Body& body) {
  for (const StrengthEntry& kind : strength_registry())
    for (const StrengthReference& r : kind.references) {
      const auto law = law_of(kind.keyword, r.deck);
      ASSERT_NE(law, nullptr) << kind.keyword;
      body(kind, r, *law);
    }
}

}  // namespace

TEST(StrengthRegistry, HoldsTheLawsAndEachHasReferences) {
  std::set<std::string> names;
  for (const StrengthEntry& kind : strength_registry()) {
    names.insert(kind.keyword);
    EXPECT_FALSE(kind.references.empty()) << kind.keyword;
    EXPECT_FALSE(kind.equation.empty()) << kind.keyword;
    EXPECT_FALSE(kind.source.empty()) << kind.keyword;
  }
  EXPECT_TRUE(names.contains("MAT_ELASTIC"));
  EXPECT_TRUE(names.contains("MAT_ELASTIC_PLASTIC_HYDRO"));
  EXPECT_TRUE(names.contains("MAT_PLASTIC_KINEMATIC"));
  EXPECT_TRUE(names.contains("MAT_PIECEWISE_LINEAR_PLASTICITY"));
}

TEST(StrengthRegistry, EveryLawGivesItsReferenceValues) {
  for_each_law([](const StrengthEntry& kind, const StrengthReference& r, const StrengthLaw& law) {
    Point point(law);
    point.dt = 0.5;
    point.stress = r.before;
    ASSERT_LE(r.history.size(), point.history.size()) << kind.keyword;
    std::copy(r.history.begin(), r.history.end(), point.history.begin());
    point.strain(r.strain);
    // equations with rates are solved so closely (yield_return_loops.cpp)
    const auto kept = law.history();
    const Real within = !kept.empty() && kept.front().name == "plastic_strain" ? with_rates : 1e-12;
    expect_near(point.stress, r.after, within, kind.keyword);
    for (std::size_t k = 0; k < r.new_history.size(); ++k)
      EXPECT_NEAR(point.history[k], r.new_history[k], within) << kind.keyword;
  });
}

TEST(StrengthRegistry, SoundSpeedIsTheSlopeOfStressInUniaxialStrain) {
  for_each_law([](const StrengthEntry& kind, const StrengthReference&, const StrengthLaw& law) {
    if (law.axes()) return;
    const Real e = 1e-7;
    Point point(law);
    point.dt = 1e-9;  // before anything relaxes
    point.strain({e, 0, 0, 0, 0, 0});
    const Real nonlinear = is_hyperelastic(law) ? 1e-6 : 0;  // the strain itself makes it stiffer
    EXPECT_NEAR(point.c, law.sound_speed(), (1e-12 + nonlinear) * point.c) << kind.keyword;
    EXPECT_NEAR(point.stress[0] / e / law.ro, point.c * point.c, 1e-6 * point.c * point.c) << kind.keyword;
    const Real stiffness = law.ro * point.c * point.c;
    EXPECT_NEAR(law.bulk_modulus() + 4 * law.shear_modulus() / 3, stiffness,
                (1e-9 + 2 * nonlinear) * stiffness)
        << kind.keyword;
    if (is_hyperelastic(law)) return;
    // denser, the same stiffness: c^2 rho = constant
    Point dense(law);
    dense.compression = 0.21;
    dense.strain({e, 0, 0, 0, 0, 0});
    EXPECT_NEAR(dense.c, point.c / 1.1, 1e-12 * point.c) << kind.keyword;
  });
}

TEST(StrengthRegistry, KindsSayWhetherTheirLawsGiveTheDeviatorOnly) {
  for_each_law([](const StrengthEntry& kind, const StrengthReference&, const StrengthLaw& law) {
    EXPECT_EQ(kind.deviator_only, law.deviator_only()) << kind.keyword;
  });
}

TEST(StrengthRegistry, DeviatorsHaveNoTrace) {
  for_each_law([](const StrengthEntry& kind, const StrengthReference& r, const StrengthLaw& law) {
    if (!law.deviator_only()) return;
    Point point(law);
    for (int k = 0; k < 5; ++k) point.strain(r.strain);
    EXPECT_NEAR(point.stress[0] + point.stress[1] + point.stress[2], 0, 1e-12) << kind.keyword;
    EXPECT_EQ(law.bulk_modulus(), 0) << kind.keyword;
  });
}

TEST(StrengthRegistry, AnswersDoNotDependOnTheAxes) {
  // a path seen from turned axes gives the turned stress, and a body that turns on its path, too
  const Vec axis(0.4, -0.7, 0.3), step(0.05, 0.02, -0.04);
  for_each_law([&](const StrengthEntry& kind, const StrengthReference& r, const StrengthLaw& law) {
    if (law.axes()) return;
    Point still(law), turned(law), turning(law);
    const Matrix R = rotation(axis), dR = rotation(step);
    Matrix now = Matrix::Identity();
    const Tensor dev = {0.02, -0.03, 0.01, 0.04, -0.01, 0.02};
    for (int k = 0; k < 40; ++k) {
      Matrix e = 0.05 * matrix(r.strain) + (k % 3 == 0 ? -1 : 1) * matrix(dev);
      still.strain(tensor(e));
      turned.strain(tensor(R * e * R.transpose()));
      now = dR * now;
      turning.turn(step);
      turning.strain(tensor(now * e * now.transpose()));
    }
    const Matrix s = matrix(still.stress);
    const Real scale = 1e-12 * (1 + s.norm());
    expect_near(turned.stress, tensor(R * s * R.transpose()), scale, kind.keyword);
    expect_near(turning.stress, tensor(now * s * now.transpose()), scale, kind.keyword + " turning");
    const std::vector<Real> as_turned = still.seen_from(R), as_turning = still.seen_from(now);
    for (std::size_t k = 0; k < still.history.size(); ++k) {
      EXPECT_NEAR(turned.history[k], as_turned[k], 1e-12) << kind.keyword;
      EXPECT_NEAR(turning.history[k], as_turning[k], 1e-12) << kind.keyword << " turning";
    }
  });
}

namespace {

/// No strain of it is elastic.
bool damages_from_the_start(const StrengthLaw& law) {
  const std::vector<HistoryVariable> kept = law.history();
  return std::any_of(kept.begin(), kept.end(),
                     [](const HistoryVariable& h) { return h.name == "largest_shear"; });
}

}  // namespace

TEST(StrengthRegistry, AClosedCycleOfStrainGivesNoWork) {
  // 0 for elastic strains, at least 0 beyond
  for_each_law([](const StrengthEntry& kind, const StrengthReference&, const StrengthLaw& law) {
    if (is_hyperelastic(law)) return;  // a cycle of rates is no closed one of large strains
    for (const Real size : {1e-6, 10.0}) {
      Point point(law);
      if (size < 1) point.dt = 1e-15;  // nothing relaxes
      Real work = 0, most = 0;
      const int n = 200;
      const auto at = [&](int k) -> Tensor {
        const Real a = 2 * pi * (k % n) / n;
        return {size * std::sin(a),           size * (std::cos(a) - 1),      -0.5 * size * std::sin(2 * a), 0,
                size * std::sin(a) * (2 - 1), 0.3 * size * (std::cos(a) - 1)};
      };
      for (int k = 0; k < n; ++k) {
        Tensor e = at(k + 1), from = at(k), before = point.stress, mean;
        for (int j = 0; j < 6; ++j) e[j] -= from[j];
        point.strain(e);
        for (int j = 0; j < 6; ++j) mean[j] = 0.5 * (before[j] + point.stress[j]);
        work += contract(mean, e);
        most = std::max(most, std::abs(work));
      }
      if (damages_from_the_start(law))
        EXPECT_GE(work, 0) << kind.keyword;
      else if (size < 1 || point.history.empty())
        EXPECT_NEAR(work, 0, 1e-10 * most) << kind.keyword;
      else if (law.axes())
        EXPECT_GE(work, -1e-10 * most) << kind.keyword;  // all of a ply may be gone, fabric is elastic
      else
        EXPECT_GT(work, 0) << kind.keyword;
    }
  });
}

TEST(TurnStress, IsTheRotationOfHughesAndWinget) {
  const Tensor s = {1, -2, 3, 0.5, -0.7, 1.1};
  const auto elastic = law_of("MAT_ELASTIC", "1,1.0,1.0,0.3\n");
  Point point(*elastic);
  point.dt = 0.2;
  point.stress = s;
  const Vec angle(0.7, -0.3, 1.2);
  point.turn(angle);
  const Matrix R = rotation(angle);
  expect_near(point.stress, tensor(R * matrix(s) * R.transpose()), 1e-14, "one step");
  point.stress = s;
  for (int k = 0; k < 100000; ++k) point.turn(angle);
  EXPECT_NEAR(contract(point.stress, point.stress), contract(s, s), 1e-9);
  EXPECT_NEAR(matrix(point.stress).determinant(), matrix(s).determinant(), 1e-9);
}

TEST(MatElastic, ChecksItsCard) {
  std::string faults;
  law_of("MAT_ELASTIC", "1,1.0,1.0,0.5\n", &faults);
  EXPECT_NE(faults.find("(PR, Poisson ratio, below 0.5 [-]): expected a number < 0.5, got '0.5'"),
            std::string::npos)
      << faults;
  law_of("MAT_ELASTIC", "1,1.0,1.0,0.3,0.1\n", &faults);
  EXPECT_NE(faults.find("DA"), std::string::npos) << faults;
  law_of("MAT_ELASTIC", "1,1.0,1.0,0.3,,,7.0\n", &faults);
  EXPECT_EQ(faults, "");
}

TEST(MatElasticPlasticHydro, ChecksItsCards) {
  const auto faults_of = [](const std::string& cards) {
    std::string faults;
    law_of("MAT_ELASTIC_PLASTIC_HYDRO", cards, &faults);
    return faults;
  };
  EXPECT_EQ(faults_of("1,1.0,1.0,0.1\n"), "");
  EXPECT_NE(faults_of("1,1.0,1.0\n").find("SIGY"), std::string::npos);
  EXPECT_NE(faults_of("1,1.0,1.0,0.1,,,-0.5\n").find("FS"), std::string::npos);
  EXPECT_NE(faults_of("1,1.0,1.0,0.1,,,,0.5\n").find("CHARL"), std::string::npos);
  EXPECT_NE(faults_of("1,1.0,1.0\n0.0,0.2,0.1\n\n1.0,2.0,3.0\n").find("EPS3"), std::string::npos);
  EXPECT_NE(faults_of("1,1.0,1.0\n0.1,0.2\n\n1.0,2.0\n").find("EPS1"), std::string::npos);
  EXPECT_NE(faults_of("1,1.0,1.0\n0.0,0.2\n\n1.0\n").find("ES2"), std::string::npos);
  EXPECT_NE(faults_of("1,1.0,1.0\n\n\n1.0\n").find("EPS2"), std::string::npos);
}

TEST(MatElasticPlasticHydro, FollowsItsTableInShear) {
  // s_xy sqrt(3) is the yield stress at the plastic strain; points at 0, 0.1, 0.3, from there on straight
  const auto law = law_of("MAT_ELASTIC_PLASTIC_HYDRO", "1,1.0,10.0,,,-2.5\n0.0,0.1,0.3\n\n1.0,2.0,2.5\n");
  EXPECT_EQ(law->pressure_cutoff(), -2.5);
  for (const Real step : {0.01, 0.5}) {  // one step may pass several points
    Point point(*law);
    for (Real e = 0; e < 0.999; e += step) point.strain({0, 0, 0, step, 0, 0});
    const Real plastic = point.history[0], q = std::sqrt(3.0) * point.stress[3];
    EXPECT_NEAR(q, 2.5 + 2.5 * (plastic - 0.3), 1e-12);
    // of the strain 1: elastic s/(2G), plastic sqrt(3)/2 e
    EXPECT_NEAR(point.stress[3] / 20 + std::sqrt(3.0) / 2 * plastic, 1, 1e-12);
  }
  EXPECT_EQ(law_of("MAT_ELASTIC_PLASTIC_HYDRO", "1,1.0,10.0,1.0\n")->pressure_cutoff(),
            -std::numeric_limits<Real>::infinity());
}

TEST(MatElasticPlasticHydro, SofteningEndsAtNoStrength) {
  const auto law = law_of("MAT_ELASTIC_PLASTIC_HYDRO", "1,1.0,10.0\n0.0,0.1\n\n1.0,0.5\n");
  Point point(*law);
  for (int k = 0; k < 100; ++k) point.strain({0, 0, 0, 0.01, 0, 0});
  EXPECT_NEAR(point.stress[3], 0, 1e-14);
}

namespace {

/// Pulls a bar, the sides free of stress, by small steps up to the axial strains, one after the other: the
/// axial stress at each of them.
std::vector<Real> pull(Point& point, const std::vector<Real>& strains, Real step) {
  std::vector<Real> out;
  Real e = 0;
  for (const Real goal : strains) {
    const int n = static_cast<int>(std::ceil(std::abs(goal - e) / step));
    for (int k = 0; k < n; ++k) {
      const Point before = point;
      Real low = -2 * std::abs(goal - e) / n, high = -low;  // of the sides: their stress grows with it
      for (int b = 0; b < 60; ++b) {
        const Real side = 0.5 * (low + high);
        point.stress = before.stress, point.history = before.history;
        point.strain({(goal - e) / n, side, side, 0, 0, 0});
        (point.stress[1] > 0 ? high : low) = side;
      }
    }
    e = goal;
    out.push_back(point.stress[0]);
  }
  return out;
}

}  // namespace

// Closed form in uniaxial stress: slope E up to SIGY, then ETAN; the elastic range behind a turn is 2 SIGY
// (kinematic), 2 s_turn (isotropic), and 2 (SIGY + BETA (s_turn - SIGY)) between; beyond it ETAN again.
TEST(MatPlasticKinematic, PulledToAndFroShowsTheBauschingerEffect) {
  const Real E = 200, SIGY = 0.4, ETAN = 20;
  for (const Real beta : {0.0, 0.4, 1.0}) {
    const auto law =
        law_of("MAT_PLASTIC_KINEMATIC", "1,7.8,200.0,0.3,0.4,20.0," + std::to_string(beta) + "\n");
    Point point(*law);
    const Real top = SIGY + ETAN * (0.01 - SIGY / E);
    const Real range = 2 * (SIGY + beta * (top - SIGY));
    const Real bottom = top - range - ETAN * (0.02 - range / E);
    const std::vector<Real> s = pull(point, {0.001, 0.01, 0.01 - 0.99 * range / E, -0.01}, 2e-4);
    EXPECT_NEAR(s[0], E * 0.001, 1e-9);
    EXPECT_NEAR(s[1], top, 1e-9);
    EXPECT_NEAR(s[2], top - 0.99 * range, 1e-9) << "elastic up to the end of the range, BETA " << beta;
    EXPECT_NEAR(s[3], bottom, 1e-9) << "BETA " << beta;
  }
}

TEST(MatPlasticKinematic, ShearedToAndFroInOneStepOrMany) {
  // G = 80, yield in shear k = SIGY/sqrt(3), slope G Ep/(3 G + Ep) beyond it; kinematic: yields back after 2
  // k
  const Real E = 208, nu = 0.3, G = E / (2 * (1 + nu)), ETAN = 30, Ep = E * ETAN / (E - ETAN);
  const Real k = 0.5 / std::sqrt(3.0), slope = G * Ep / (3 * G + Ep), g = 0.02;  // g: engineering shear
  const auto law = law_of("MAT_PLASTIC_KINEMATIC", "1,7.8,208.0,0.3,0.5,30.0,0.0\n");
  for (const int n : {1, 50}) {
    Point point(*law);
    for (int j = 0; j < n; ++j) point.strain({0, 0, 0, 0.5 * g / n, 0, 0});
    const Real top = k + slope * (g - k / G);
    EXPECT_NEAR(point.stress[3], top, 1e-12);
    for (int j = 0; j < n; ++j) point.strain({0, 0, 0, -0.5 * g / n, 0, 0});
    EXPECT_NEAR(point.stress[3], top - 2 * k - slope * (g - 2 * k / G), 1e-12);
  }
}

TEST(MatPlasticKinematic, FollowsTheRateOfStrain) {
  // perfectly plastic, SIGY 0.3, C 40, P 5: (1 + (rate/C)^(1/P)) SIGY; pulled so far that all strain is
  // plastic
  for (const int vp : {0, 1})
    for (const Real rate : {0.0125, 40.0, 1e4}) {
      const auto law = law_of("MAT_PLASTIC_KINEMATIC",
                              "1,7.8,200.0,0.3,0.3,0.0,1.0\n40.0,5.0,0.0," + std::to_string(vp) + "\n");
      Point point(*law);
      const Real step = 1e-3;
      point.dt = step / rate;
      for (int k = 0; k < 100; ++k) point.strain({step, -0.5 * step, -0.5 * step, 0, 0, 0});
      const Real q = point.stress[0] - point.stress[1];
      EXPECT_NEAR(q, 0.3 * (1 + std::pow(rate / 40, 0.2)), 1e-9) << "VP " << vp << " rate " << rate;
    }
}

TEST(MatPlasticKinematic, WithAndWithoutHardeningByPlasticRateSolvesItsEquation) {
  // VP 1: q = (1 + (de/(C dt))^(1/P)) (SIGY + BETA Ep e), at e behind the step; q and de as the step left
  // them
  for (const Real P : {0.5, 1.0, 4.0, 8.0})
    for (const Real dt : {1e-7, 1e-3, 10.0}) {
      const auto law = law_of("MAT_PLASTIC_KINEMATIC",
                              "1,7.8,200.0,0.3,0.3,10.0,0.5\n40.0," + std::to_string(P) + ",0.0,1\n");
      Point point(*law);
      point.dt = dt;
      point.strain({0.02, -0.01, -0.01, 0.003, 0, 0});
      const Real de = point.history[0], Ep = 200.0 * 10 / 190;
      Tensor xi = point.stress;
      for (int k = 0; k < 6; ++k) xi[k] -= point.history[1 + k];
      const Real mean = (xi[0] + xi[1] + xi[2]) / 3;
      for (int k = 0; k < 3; ++k) xi[k] -= mean;
      const Real q = std::sqrt(1.5 * contract(xi, xi));
      EXPECT_GT(de, 0);
      EXPECT_NEAR(q, (1 + std::pow(de / (40 * dt), 1 / P)) * (0.3 + 0.5 * Ep * de), with_rates * q)
          << P << " " << dt;
    }
}

TEST(MatPlasticKinematic, ChecksItsCards) {
  const auto faults_of = [](const std::string& cards) {
    std::string faults;
    law_of("MAT_PLASTIC_KINEMATIC", cards, &faults);
    return faults;
  };
  EXPECT_EQ(faults_of("1,7.8,200.0,0.3,0.4\n"), "");
  EXPECT_EQ(faults_of("1,7.8,200.0,0.3,0.4,1.0,0.5\n40.0,5.0,0.0,1\n"), "");
  EXPECT_NE(faults_of("1,7.8,200.0,0.3,0.4\n0.0,0.0,-0.5\n").find("FS"), std::string::npos);
  EXPECT_NE(faults_of("1,7.8,200.0,0.3\n").find("SIGY"), std::string::npos);
  EXPECT_NE(faults_of("1,7.8,200.0,0.5,0.4\n").find("expected a number < 0.5, got '0.5'"), std::string::npos);
  EXPECT_NE(faults_of("1,7.8,200.0,0.3,0.4,200.0\n").find("ETAN"), std::string::npos);
  EXPECT_NE(faults_of("1,7.8,200.0,0.3,0.4,1.0,1.5\n").find("BETA"), std::string::npos);
  EXPECT_NE(faults_of("1,7.8,200.0,0.3,0.4,1.0,1.0\n40.0\n").find("SRP"), std::string::npos);
  EXPECT_NE(faults_of("1,7.8,200.0,0.3,0.4,1.0,1.0\n0.0,5.0\n").find("SRC"), std::string::npos);
  EXPECT_NE(faults_of("1,7.8,200.0,0.3,0.4,1.0,1.0\n0.0,0.0,0.0,2\n").find("VP"), std::string::npos);
}

namespace {

/// Yield stress 1 to 2 at rest, 3 to 3.5 at rate 10 and faster, at plastic strains 0 and 1; a factor of 1 to
/// 2 up to rate 5.
const std::string curves_of_rates =
    "*DEFINE_CURVE\n1\n0.0,1.0\n1.0,2.0\n*DEFINE_CURVE\n2\n0.0,3.0\n1.0,3.5\n*DEFINE_TABLE_2D\n3\n0.0,1\n"
    "10.0,2\n*DEFINE_CURVE\n4\n0.0,1.0\n5.0,2.0\n";

struct RateCase {
  const char* cards;
  std::function<Real(Real plastic, Real plastic_rate)> yield;
};
const RateCase rate_cases[] = {
    {"1,1.0,260.0,0.3\n,,3\n\n\n",
     [](Real e, Real r) {
       const Real w = std::min(r / 10, 1.0);
       return (1 - w) * (1 + e) + w * (3 + 0.5 * e);
     }},
    {"1,1.0,260.0,0.3\n,,3,,1\n\n\n",
     [](Real e, Real p) {
       const Real w = std::min(p / 10, 1.0);
       return (1 - w) * (1 + e) + w * (3 + 0.5 * e);
     }},
    {"1,1.0,260.0,0.3\n,,1,4\n\n\n", [](Real e, Real r) { return (1 + e) * (1 + std::min(r / 5, 1.0)); }},
    {"1,1.0,260.0,0.3\n2.0,3.0,1,,1\n\n\n", [](Real e, Real p) { return (1 + e) * (1 + std::cbrt(p / 2)); }},
    {"1,1.0,260.0,0.3,0.5\n2.0,3.0,1,,1\n\n\n",
     [](Real e, Real p) { return 1 + e + 0.5 * std::cbrt(p / 2); }},
    {"1,1.0,260.0,0.3\n2.0,3.0,1\n\n\n", [](Real e, Real r) { return (1 + e) * (1 + std::cbrt(r / 2)); }}};

}  // namespace

TEST(MatPiecewiseLinearPlasticity, StaysOnTheYieldStressOfItsRate) {
  for (const RateCase& a : rate_cases)
    for (const Real rate : {0.1, 1.0, 7.0, 40.0}) {
      const auto law = law_of("MAT_PIECEWISE_LINEAR_PLASTICITY", std::string(a.cards) + curves_of_rates);
      ASSERT_NE(law, nullptr);
      Point point(*law);
      point.dt = 0.02 / rate;
      for (int k = 0; k < 30; ++k) {
        const Real before = point.history[0];
        point.strain({0, 0, 0, std::sqrt(0.75) * rate * point.dt, 0, 0});
        const Real e = point.history[0], q = std::sqrt(3.0) * point.stress[3];
        if (k > 3) {
          EXPECT_NEAR(q, a.yield(e, (e - before) / point.dt), with_rates) << a.cards << rate;
        }
      }
    }
}

TEST(MatPiecewiseLinearPlasticity, ChecksItsCards) {
  const auto faults_of = [](const std::string& cards) {
    std::string faults;
    law_of("MAT_PIECEWISE_LINEAR_PLASTICITY", cards, &faults);
    return faults;
  };
  EXPECT_EQ(faults_of("1,1.0,1.0,0.3,0.1\n"), "");
  const auto complains = [&](const std::string& cards, const char* of) {
    const std::string faults = faults_of(cards);
    EXPECT_NE(faults.find(of), std::string::npos) << cards << faults;
  };
  complains("1,1.0,1.0,0.3\n", "SIGY");
  complains("1,1.0,1.0,0.5,0.1\n", "PR");
  complains("1,1.0,1.0,0.3,0.1,1.0\n", "ETAN");
  complains("1,1.0,1.0,0.3,0.1,,-0.2\n", "FAIL");
  complains("1,1.0,1.0,0.3,0.1,,,-0.2\n", "TDEL");
  complains("1,1.0,1.0,0.3,0.1\n1.0\n", "(P,");
  complains("1,1.0,1.0,0.3,0.1\n,1.0\n", "(C,");
  complains("1,1.0,1.0,0.3,0.1\n,,9\n", "there is no curve or table 9");
  complains("1,1.0,1.0,0.3,0.1\n,,,9\n", "curve 9 does not exist");
  complains("1,1.0,1.0,0.3,0.1\n,,,,3\n", "VP");
  complains("1,1.0,1.0,0.3,0.1\n1.0,1.0,,1\n\n\n*DEFINE_CURVE\n1\n0.0,1.0\n1.0,2.0\n",
            "is given with C and P");
  complains("1,1.0,1.0,0.3,0.1\n,,,1\n\n\n*DEFINE_CURVE\n1\n0.0,1.0\n1.0,0.0\n", "not > 0");
  complains("1,1.0,1.0,0.3\n\n0.1,0.2\n1.0,2.0\n", "EPS1");
  complains("1,1.0,1.0,0.3\n,,1\n\n\n*DEFINE_CURVE\n1\n0.0,0.0\n1.0,1.0\n", "yield stresses > 0");
  complains("1,1.0,1.0,0.3\n,,1\n\n\n*DEFINE_CURVE\n1\n0.0,1.0\n0.0,2.0\n", "jumps");
  complains("1,1.0,1.0,0.3\n,,1\n\n\n*DEFINE_CURVE\n1\n0.0,1.0\n0.1,0.5\n", "3 G");
  complains("1,1.0,1.0,0.3\n,,1\n\n\n*DEFINE_CURVE\n1\n0.01,1.0\n0.1,1.5\n", "begins at");
}

TEST(MatMooneyRivlin, HasTheModuliOfItsConstants) {
  for (const Real nu : {0.3, 0.463, 0.495}) {
    const auto law = law_of("MAT_MOONEY-RIVLIN_RUBBER", "1,1000.0," + std::to_string(nu) + ",3.0,2.0\n");
    const Real G = 10, K = 2 * G * (1 + nu) / (3 * (1 - 2 * nu));
    EXPECT_NEAR(law->shear_modulus(), G, 1e-12);
    EXPECT_NEAR(law->bulk_modulus(), K, 1e-10 * K) << nu;
    Point shear(*law);
    shear.strain({0, 0, 0, 1e-7, 0, 0});
    EXPECT_NEAR(shear.stress[3] / 2e-7, G, 1e-6);
  }
}

TEST(MatMooneyRivlin, StretchesAsInClosedForm) {
  // incompressible in the limit: pulled to l in x at constant volume, sxx - syy = 2 (l^2 - 1/l)(A + B/l)
  const auto law = law_of("MAT_MOONEY-RIVLIN_RUBBER", "1,1000.0,0.45,3.0,2.0\n");
  for (const Real l : {0.5, 1.5, 3.0}) {
    Point point(*law);
    const int steps = 1000;
    const Real d = std::log(l) / steps;
    // the step's exponential is (1 + x/2)/(1 - x/2)
    const auto increment = [](Real strain) { return 2 * std::tanh(strain / 2); };
    for (int k = 0; k < steps; ++k)
      point.strain({increment(d), increment(-d / 2), increment(-d / 2), 0, 0, 0});
    EXPECT_NEAR(point.stress[0] - point.stress[1], 2 * (l * l - 1 / l) * (3 + 2 / l), 1e-9);
    // there and back is where it was, without any work
    Real work = 0;
    for (int k = 0; k < steps; ++k) {
      const Real before = point.stress[0] - point.stress[1];
      point.strain({increment(-d), increment(d / 2), increment(d / 2), 0, 0, 0});
      work -= 0.5 * (before + point.stress[0] - point.stress[1]) * d;
    }
    EXPECT_NEAR(point.stress[0], 0, 1e-9);
    const Real stored = 3 * (l * l + 2 / l - 3) + 2 * (2 * l + 1 / (l * l) - 3);
    EXPECT_NEAR(work, -stored, 1e-4 * stored);
  }
}

TEST(MatMooneyRivlin, WavesAreNoFasterThanItSays) {
  // slope of the stress along x at several stretches, against rho c^2
  const auto law = law_of("MAT_MOONEY-RIVLIN_RUBBER", "1,1000.0,0.48,3.0,2.0\n");
  for (const Vec& stretch : {Vec(1.3, 1, 1), Vec(0.8, 1, 1), Vec(0.8, 0.9, 1.2), Vec(2, 0.7, 0.72)})
    for (int axis = 0; axis < 3; ++axis) {
      Point point(*law);
      const auto increment = [](Real strain) { return 2 * std::tanh(strain / 2); };
      point.strain({increment(std::log(stretch[0])), increment(std::log(stretch[1])),
                    increment(std::log(stretch[2])), 0, 0, 0});
      const Real J = stretch.prod(), before = point.stress[axis], e = 1e-6, c = point.c;
      Tensor more{};
      more[axis] = e;
      point.strain(more);
      // of nominal stress: d(J s/l)/dl l^2/J = ds/de for the force on the same material area
      const Real slope = (point.stress[axis] - before) / e;
      EXPECT_GT(1000 / J * c * c * (1 + 1e-4), slope) << axis << stretch.transpose();
    }
}

// A yield stress whose equation has no answer within the rounds: NaN, with which a run ends.
TEST(YieldReturn, APointWithoutAnAnswerIsNoNumber) {
  ReturnPoints r;
  r.at.count = 2;
  for (Index i = 0; i < 2; ++i)
    r.x[i] = 0.5, r.low[i] = 0, r.high[i] = 1, r.q[i] = 2, r.at.stress[i] = i == 0 ? 1 : 2, r.least[i] = 0;
  int rounds = 0;
  find_return([] {}, [](YieldPoints&) {}, [&](int) { return ++rounds > 0; }, r);
  EXPECT_EQ(rounds, 100);
  EXPECT_TRUE(std::isnan(r.x[0]));
  EXPECT_EQ(r.x[1], 0.5) << "on the yield stress";
}
