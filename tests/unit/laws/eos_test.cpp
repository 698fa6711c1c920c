#include "laws/eos/eos.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <unistd.h>

#include "keyword/deck.hpp"
#include "model/build_model.hpp"

using namespace courant;

namespace {

/// Reads one EOS from its cards, for a material of density rho0.
std::shared_ptr<EosLaw> law_of(const EosEntry& kind, const std::string& cards, Real rho0 = 1) {
  const auto path =
      std::filesystem::temp_directory_path() / ("eos_test_" + std::to_string(::getpid()) + ".k");
  std::ofstream(path) << "*KEYWORD\n*" << kind.keyword << "\n" << cards << "*END\n";
  Diagnostics diagnostics;
  const Deck deck = read_deck(path.string(), {}, diagnostics);
  std::filesystem::remove(path);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  Diagnostics of_no_whole_model;
  const auto laws = kind.all(deck, build_model(deck, of_no_whole_model));
  EXPECT_EQ(laws.size(), 1u);
  const auto law = laws.at(0).second;
  const auto of_density = law->at_density(rho0);
  return of_density ? of_density : law;
}

}  // namespace

TEST(EosRegistry, NamesTheFieldOfNearlyIncompressibleLiquidsOnly) {
  const std::vector<std::array<std::string, 3>> known = {
      {"EOS_LINEAR_POLYNOMIAL", "1,0.0,9.0e5\n", "C1"},
      {"EOS_LINEAR_POLYNOMIAL", "1,0.0,2.2e9,9.5e9,1.5e10\n", ""},  // a fit to a shock curve
      {"EOS_LINEAR_POLYNOMIAL", "1,0.0,2.2e9,0.0,1.5e10\n", ""},
      {"EOS_MURNAGHAN", "1,7.0,1.0e6\n", "K0"},
      {"EOS_GRUNEISEN", "1,1484.0\n", "C"},
      {"EOS_GRUNEISEN", "1,1484.0,1.979\n", ""},
      {"EOS_TABULATED", "1\n0.1,0.0,-0.5\n\n-1.0,0.0,10.0\n\n", ""},
      {"EOS_JWL", "1,7.4e11,2.7e10,2.0,1.0,0.5\n", ""}};
  for (const auto& [keyword, cards, field] : known)
    for (const EosEntry& kind : eos_registry())
      if (kind.keyword == keyword) EXPECT_EQ(law_of(kind, cards, 1000)->stiffness_field(), field) << cards;
}

TEST(EosRegistry, HoldsTheLawsAndEachHasReferences) {
  std::set<std::string> names;
  for (const EosEntry& kind : eos_registry()) {
    names.insert(kind.keyword);
    EXPECT_FALSE(kind.references.empty()) << kind.keyword;
    EXPECT_FALSE(kind.equation.empty());
    EXPECT_FALSE(kind.source.empty());
  }
  EXPECT_TRUE(names.contains("EOS_LINEAR_POLYNOMIAL"));
  EXPECT_TRUE(names.contains("EOS_MURNAGHAN"));
  EXPECT_TRUE(names.contains("EOS_GRUNEISEN"));
  EXPECT_TRUE(names.contains("EOS_IDEAL_GAS"));
  EXPECT_TRUE(names.contains("EOS_TABULATED"));
  EXPECT_TRUE(names.contains("EOS_TABULATED_COMPACTION"));
  EXPECT_TRUE(names.contains("EOS_SACK_TUESDAY"));
}

TEST(EosRegistry, EveryLawGivesItsReferenceValues) {
  for (const EosEntry& kind : eos_registry())
    for (const EosReference& r : kind.references)
      EXPECT_NEAR(law_of(kind, r.deck, r.rho0)->pressure(r.mu, r.E), r.p,
                  1e-12 * std::max(1.0, std::abs(r.p)))
          << kind.keyword;
}

TEST(EosRegistry, SoundSpeedIsTheSlopeOfPressureAlongAnIsentrope) {
  const Real rho0 = 3;
  for (const EosEntry& kind : eos_registry())
    for (const EosReference& r : kind.references) {
      const auto law = law_of(kind, r.deck, rho0);
      // both sides of mu: dE = -p dv with v = 1/(1 + mu)
      const Real d = 1e-6, p = law->pressure(r.mu, r.E);
      const auto along = [&](Real dmu) {
        const Real dv = 1 / (1 + r.mu + dmu) - 1 / (1 + r.mu);
        return law->pressure(r.mu + dmu, r.E - p * dv);
      };
      const Real c2 = (along(d) - along(-d)) / (2 * d) / rho0;
      const Real scale = std::max(1e-3, std::abs(c2));
      EXPECT_NEAR(law->slope(r.mu, r.E),
                  (law->pressure(r.mu + d, r.E) - law->pressure(r.mu - d, r.E)) / (2 * d),
                  1e-5 * rho0 * scale)
          << kind.keyword << " mu " << r.mu;
      if (law->memory()) {  // back it may be stiffer
        EXPECT_GE(law->sound_speed2(rho0, r.mu, r.E), c2 - 1e-6 * scale) << kind.keyword << " mu " << r.mu;
      } else if (r.mu != 0) {  // at mu = 0 the law may have a kink
        EXPECT_NEAR(law->sound_speed2(rho0, r.mu, r.E), c2, 1e-6 * scale) << kind.keyword << " mu " << r.mu;
      }
    }
}

TEST(EosRegistry, ABlockHasTheValuesOfItsPoints) {
  for (const EosEntry& kind : eos_registry())
    for (const EosReference& r : kind.references) {
      const auto law = law_of(kind, r.deck, r.rho0);
      const Real mu[3] = {-0.1, r.mu, 0.2};
      Real A[3], dA[3], B[3], dB[3];
      law->evaluate({3, mu, A, dA, B, dB});
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(A[k] + B[k] * r.E, law->pressure(mu[k], r.E)) << kind.keyword;
        if (law->memory())
          EXPECT_GE(dA[k] + dB[k] * r.E, law->slope(mu[k], r.E)) << kind.keyword;
        else
          EXPECT_EQ(dA[k] + dB[k] * r.E, law->slope(mu[k], r.E)) << kind.keyword;
      }
      Real alone[3], slope[3];
      law->evaluate({3, mu, alone, slope});
      EXPECT_EQ(alone[1], A[1]) << kind.keyword;
      EXPECT_EQ(slope[1], dA[1]) << kind.keyword;
    }
}

namespace {

/// What the checks of all equations of state in the cards say.
std::string faults_of(const std::string& cards) {
  ReadOptions options;
  options.open = [&](const std::string&) {
    return std::optional<std::string>("*KEYWORD\n" + cards + "*END\n");
  };
  Diagnostics diagnostics, of_no_whole_model;
  const Deck deck = read_deck("m.k", options, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  const Model model = build_model(deck, of_no_whole_model);
  for (const EosEntry& kind : eos_registry()) kind.check(deck, model, diagnostics);
  return diagnostics.text();
}
void expect_fault(const std::string& cards, const std::string& fault) {
  EXPECT_NE(faults_of(cards).find(fault), std::string::npos) << faults_of(cards);
}

const EosEntry& entry_of(const std::string& keyword) {
  for (const EosEntry& kind : eos_registry())
    if (kind.keyword == keyword) return kind;
  throw std::logic_error(keyword);
}

/// C 0, 1, 10 and K 20, 20, 40 at ln V = 0, -0.1, -0.5.
const char* const crushed = "1,0.0\n0.0,-0.1,-0.5\n\n0.0,1.0,10.0\n\n0.0\n\n20.0,20.0,40.0\n\n";

}  // namespace

TEST(EosTabulated, RefusesStrainsThatGoBothWays) {
  expect_fault("*EOS_TABULATED\n1,0.0\n0.1,-0.5,0.0\n\n-1.0,0.0,10.0\n\n",
               "expected strains that all rise or all fall, got '0' beside '-0.5'");
  expect_fault("*EOS_TABULATED\n1,0.0\n\n\n\n\n", "expected at least two points");
  EXPECT_EQ(faults_of("*EOS_TABULATED\n1,0.0\n-0.5,-0.1\n\n10.0,1.0\n\n"), "");
}

// In to ln V = -0.3, where C = 5.5 and K = 30; out along K, through 0 at -0.3 + 5.5/30 into tension; back in
// along it, and from -0.3 on along C again; out from -0.5 along K = 40, which holds beyond its last point,
// too.
TEST(EosTabulatedCompaction, GoesInAlongCAndBackAlongK) {
  const auto law = law_of(entry_of("EOS_TABULATED_COMPACTION"), crushed);
  Real memory = law->memory_at_start();
  EXPECT_EQ(memory, 0);
  const auto at = [&](Real eV) {
    const Real mu = std::expm1(-eV);
    Real A, dA;
    law->evaluate({1, &mu, &A, &dA, nullptr, nullptr, &memory});
    return std::pair(A, dA * (1 + mu));
  };
  struct Step {
    Real eV, p, modulus;
  };
  for (const Step& s : {Step{0.05, -1, 20},
                        {-0.05, 0.5, 20},
                        {0.0, -0.5, 20},
                        {-0.1, 1, 22.5},
                        {-0.3, 5.5, 30},
                        {-0.2, 2.5, 30},
                        {-0.1, -0.5, 30},
                        {0.1, -6.5, 30},
                        {-0.25, 4, 30},
                        {-0.3, 5.5, 30},
                        {-0.4, 7.75, 35},
                        {-0.5, 10, 40},
                        {-0.4, 6, 40},
                        {-0.6, 12.25, 40},
                        {-0.5, 8.25, 40}}) {
    const auto [p, modulus] = at(s.eV);
    EXPECT_NEAR(p, s.p, 1e-12) << s.eV;
    EXPECT_NEAR(modulus, s.modulus, s.eV == -0.1 ? 3 : 1e-12) << s.eV;  // a corner of C
  }
  EXPECT_NEAR(memory, std::expm1(0.6), 1e-12);
}

// The sound speed is that of the steeper way, else a step that is right on the way in is too long on the way
// back.
TEST(EosTabulatedCompaction, TakesTheSoundSpeedOfTheSteeperWay) {
  const auto law = law_of(entry_of("EOS_TABULATED_COMPACTION"), crushed);
  const Real mu = std::expm1(0.3), rho0 = 2;
  EXPECT_NEAR(law->sound_speed2(rho0, mu, 0), 30 / (1 + mu) / rho0, 1e-12);
  EXPECT_NEAR(law->slope(mu, 0), 22.5 / (1 + mu), 1e-12);
}

TEST(EosTabulatedCompaction, RefusesModuliThatDoNotHold) {
  const auto cards = [](const char* k) {
    return std::string("*EOS_TABULATED_COMPACTION\n1,0.0\n0.0,-0.1,-0.5\n\n0.0,1.0,10.0\n\n0.0\n\n") + k +
           "\n\n";
  };
  EXPECT_EQ(faults_of(cards("20.0,22.5,22.5")), "");
  expect_fault(cards("20.0,0.0,40.0"), "expected bulk moduli > 0 at all points, got '0'");
  expect_fault(cards("20.0,20.0,20.0"), "K = 20 at ln(V) = -0.1 is less steep than C, which rises by 22.5");
  expect_fault("*EOS_008\n1,0.0,0.0,1.0,7,0,7\n*DEFINE_CURVE\n7\n0.0,1.0\n",
               "curve 7 needs at least two points");
}
