// *MAT_PIECEWISE_LINEAR_PLASTICITY_LOG_INTERPOLATION: curves of a table by the logarithm of the rate.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "driven_point.hpp"
#include "model/build_model.hpp"

namespace log_interpolation_test {

using namespace courant;
using test::DrivenPoint;

namespace {

Deck deck_of(const std::string& text, Diagnostics& diagnostics) {
  ReadOptions options;
  options.open = [&](const std::string&) {
    return std::optional<std::string>("*KEYWORD\n" + text + "*END\n");
  };
  return read_deck("m.k", options, diagnostics);
}
const StrengthEntry& entry_of_024() {
  for (const StrengthEntry& kind : strength_registry())
    if (kind.keyword == "MAT_PIECEWISE_LINEAR_PLASTICITY") return kind;
  throw std::runtime_error("no such law");
}
/// Yield stresses 1, 2.5 and 3 at three values of a table.
std::string cards(const std::string& keyword, const std::array<Real, 3>& values, int vp) {
  std::string out = fmt::format("*{}\n1,2.0,2.5,0.25\n,,6,,{}\n\n\n", keyword, vp);
  for (const auto& [id, stress] : {std::pair{1, 1.0}, {2, 2.5}, {3, 3.0}})
    out += fmt::format("*DEFINE_CURVE\n{}\n0.0,{}\n1e3,{}\n", id, stress, stress);
  return out + fmt::format("*DEFINE_TABLE_2D\n6\n{:.17g},1\n{:.17g},2\n{:.17g},3\n", values[0], values[1],
                           values[2]);
}
std::shared_ptr<StrengthLaw> law(const std::string& keyword, const std::array<Real, 3>& values, int vp = 0) {
  Diagnostics diagnostics, none;
  const Deck deck = deck_of(cards(keyword, values, vp), diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  return entry_of_024().all(deck, build_model(deck, none)).at(0).second;
}
/// q of a point that flows at constant volume at this rate.
Real yield_at(const std::shared_ptr<StrengthLaw>& of, Real rate) {
  DrivenPoint point(of);
  point.dt = 1 / rate;
  for (int n = 0; n < 20; ++n) point.strain({1, -0.5, -0.5, 0, 0, 0});
  return 1.5 * point.stress[0];
}

}  // namespace

// Between rates r1 and r2 the share of the second curve is ln(r/r1)/ln(r2/r1), beyond them the curve holds.
TEST(LogInterpolation, IsStraightOverTheLogarithm) {
  for (const char* keyword :
       {"MAT_PIECEWISE_LINEAR_PLASTICITY_LOG_INTERPOLATION", "MAT_024_LOG_INTERPOLATION"})
    for (const int vp : {0, 1}) {
      const auto made = law(keyword, {0.25, 64, 1000}, vp);
      for (const Real rate : {0.01, 0.25, 1.0, 4.0, 50.0, 64.0, 300.0, 1000.0, 1e5}) {
        Real expected = 3;
        if (rate <= 0.25)
          expected = 1;
        else if (rate < 64)
          expected = 1 + 1.5 * std::log(rate / 0.25) / std::log(64 / 0.25);
        else if (rate < 1000)
          expected = 2.5 + 0.5 * std::log(rate / 64) / std::log(1000 / 64.0);
        // the rate of flow is that of the strain, as the stress is steady
        EXPECT_NEAR(yield_at(made, rate), expected, 1e-9) << keyword << " " << vp << " " << rate;
      }
    }
}

// Rates above 1 alone are rates, too; the card without the option stays straight over the rate.
TEST(LogInterpolation, IsAnOption) {
  const auto by_log = law("MAT_024_LOG_INTERPOLATION", {10, 1000, 1e5});
  const auto plain = law("MAT_024", {10, 1000, 1e5});
  const auto logarithms = law("MAT_024", {std::log(0.1), std::log(10), std::log(1000)});
  EXPECT_NEAR(yield_at(by_log, 100), 1.75, 1e-9);
  EXPECT_NEAR(yield_at(plain, 100), 1 + 1.5 * 90 / 990, 1e-9);
  EXPECT_NEAR(yield_at(logarithms, 1), 1.75, 1e-9);
}

TEST(LogInterpolation, NeedsRatesAboveZero) {
  for (const auto& [first, sound] : {std::pair{0.0, false}, {-2.0, false}, {1e-3, true}}) {
    Diagnostics diagnostics, none;
    const Deck deck = deck_of(cards("MAT_024_LOG_INTERPOLATION", {first, 64, 1000}, 0), diagnostics);
    entry_of_024().check(deck, build_model(deck, none), diagnostics);
    EXPECT_EQ(diagnostics.ok(), sound) << diagnostics.text();
    EXPECT_EQ(diagnostics.text().find("which has no logarithm") == std::string::npos, sound);
  }
}

}  // namespace log_interpolation_test
