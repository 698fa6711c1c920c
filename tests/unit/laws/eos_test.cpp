#include "laws/eos/eos.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <unistd.h>

#include "keyword/deck.hpp"

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
  const auto laws = kind.all(deck);
  EXPECT_EQ(laws.size(), 1u);
  const auto law = laws.at(0).second;
  const auto of_density = law->at_density(rho0);
  return of_density ? of_density : law;
}

}  // namespace

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
      if (r.mu != 0) {  // at mu = 0 the law may have a kink
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
        EXPECT_EQ(dA[k] + dB[k] * r.E, law->slope(mu[k], r.E)) << kind.keyword;
      }
      Real alone[3], slope[3];
      law->evaluate({3, mu, alone, slope});
      EXPECT_EQ(alone[1], A[1]) << kind.keyword;
      EXPECT_EQ(slope[1], dA[1]) << kind.keyword;
    }
}

TEST(EosTabulated, RefusesStrainsThatGoBothWays) {
  ReadOptions options;
  options.open = [](const std::string&) {
    return std::optional<std::string>(
        "*KEYWORD\n*EOS_TABULATED\n1,0.0\n0.1,-0.5,0.0\n\n-1.0,0.0,10.0\n\n*END\n");
  };
  Diagnostics diagnostics;
  const Deck deck = read_deck("m.k", options, diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << diagnostics.text();
  for (const EosEntry& kind : eos_registry()) kind.check(deck, diagnostics);
  EXPECT_NE(diagnostics.text().find("expected strains that all rise or all fall, got '0' beside '-0.5'"),
            std::string::npos)
      << diagnostics.text();
}
