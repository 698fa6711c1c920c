// Every law of strength against its own references, and what must hold for all of them.
#include "laws/strength/strength.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "laws/objective.hpp"

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
  for (const StrengthEntry& kind : strength_registry()) {
    if (kind.keyword != keyword) continue;
    kind.check(deck, diagnostics);
    if (faults)
      *faults = diagnostics.text();
    else {
      EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
    }
    const auto laws = kind.all(deck);
    if (laws.size() == 1) return laws[0].second;
  }
  return nullptr;
}

/// One point that a law works on.
struct Point {
  explicit Point(const StrengthLaw& of) : law(of), history(of.history().size(), 0.0) {}
  const StrengthLaw& law;
  Tensor stress{};
  std::vector<Real> history;
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
  }
};

Matrix matrix(const Tensor& t) {
  Matrix m;
  m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  return m;
}
Tensor tensor(const Matrix& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
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
}

TEST(StrengthRegistry, EveryLawGivesItsReferenceValues) {
  for_each_law([](const StrengthEntry& kind, const StrengthReference& r, const StrengthLaw& law) {
    Point point(law);
    point.dt = 0.5;
    point.stress = r.before;
    if (!r.history.empty()) point.history = r.history;
    point.strain(r.strain);
    expect_near(point.stress, r.after, 1e-12, kind.keyword);
    for (std::size_t k = 0; k < r.new_history.size(); ++k)
      EXPECT_NEAR(point.history[k], r.new_history[k], 1e-12) << kind.keyword;
  });
}

TEST(StrengthRegistry, SoundSpeedIsTheSlopeOfStressInUniaxialStrain) {
  for_each_law([](const StrengthEntry& kind, const StrengthReference&, const StrengthLaw& law) {
    const Real e = 1e-7;
    Point point(law);
    point.strain({e, 0, 0, 0, 0, 0});
    EXPECT_NEAR(point.c, law.sound_speed(), 1e-12 * point.c) << kind.keyword;
    EXPECT_NEAR(point.stress[0] / e / law.ro, point.c * point.c, 1e-6 * point.c * point.c) << kind.keyword;
    EXPECT_NEAR(law.bulk_modulus() + 4 * law.shear_modulus() / 3, law.ro * point.c * point.c, 1e-9);
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
    for (std::size_t k = 0; k < still.history.size(); ++k) {
      EXPECT_NEAR(turned.history[k], still.history[k], 1e-12) << kind.keyword;
    }
  });
}

TEST(StrengthRegistry, AClosedCycleOfStrainGivesNoWork) {
  // 0 for elastic strains, at least 0 beyond
  for_each_law([](const StrengthEntry& kind, const StrengthReference&, const StrengthLaw& law) {
    for (const Real size : {1e-3, 10.0}) {
      Point point(law);
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
      if (size < 1 || point.history.empty())
        EXPECT_NEAR(work, 0, 1e-10 * most) << kind.keyword;
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
  EXPECT_NE(faults_of("1,1.0,1.0,0.1,,,0.5\n").find("FS"), std::string::npos);
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
