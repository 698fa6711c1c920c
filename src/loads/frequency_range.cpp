// Cards of *DAMPING_FREQUENCY_RANGE, and the fit of relaxation mechanisms to a constant fraction of critical
// damping: Emmerich and Korn, Geophysics 52 (1987) 1252; Liu, Anderson and Kanamori, Geophys. J. R. astr.
// Soc. 47 (1976) 41.
#include "loads/frequency_range.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/QR>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "loads/frequency_range_cards.hpp"

namespace courant {

namespace {

using S = DampingFrequencyRange;
const RegisterKeyword<S> damping_frequency_range_keyword{damping_frequency_range_table()};

constexpr Real largest_ratio = 1e5;  // of FHIGH to FLOW: eight mechanisms

class RangeReader {
 public:
  RangeReader(const Deck& deck, const Model& model, bool of_stress,
              const std::function<std::string(std::size_t)>& why_not, Diagnostics& diagnostics)
      : deck_(deck), model_(model), of_stress_(of_stress), why_not_(why_not), diagnostics_(diagnostics) {
    out_.resize(model.parts.size());
  }
  std::vector<FrequencyRange> read() {
    for (const bool of_sets : {true, false})  // PSID 0: parts that no other card names
      for (const S& card : deck_.all<S>())
        if ((card.name == 1) == of_stress_ && (card.psid != 0) == of_sets) add(card);
    return std::move(out_);
  }

 private:
  void add(const S& card) {
    if (!(card.flow < card.fhigh))
      return error(card, "FHIGH", fmt::format("FLOW {:g} is not below FHIGH {:g}", card.flow, card.fhigh),
                   "frequencies are in cycles per unit of time");
    if (card.fhigh > largest_ratio * card.flow)
      return error(card, "FHIGH", fmt::format("FHIGH is more than {:g} times FLOW", largest_ratio),
                   "30 to 300 times is usual");
    const FrequencyRange range = fitted_range(card.cdamp, card.flow, card.fhigh, of_stress_);
    if (*std::min_element(range.share.begin(), range.share.end()) < 0)
      return error(
          card, "CDAMP",
          fmt::format("{:g} is too much for a range of frequencies: it is for small damping", card.cdamp),
          "0.01 to 0.05 is usual; *DAMPING_PART_MASS and *DAMPING_PART_STIFFNESS damp more");
    if (card.psid == 0) {
      if (std::exchange(has_rest_, true))
        return error(card, "PSID", "another card damps all parts that no part set names",
                     "name the parts of one of them by PSID");
      for (std::size_t part = 0; part < out_.size(); ++part)
        if (!out_[part].any()) take(card, part, range);
      return;
    }
    const auto set = model_.part_sets.find(card.psid);
    if (set == model_.part_sets.end())
      return error(card, "PSID", fmt::format("part set {} does not exist", card.psid),
                   "define it with *SET_PART");
    for (const Index part : set->second) take(card, static_cast<std::size_t>(part), range);
  }
  void take(const S& card, std::size_t part, const FrequencyRange& range) {
    const bool named = card.psid != 0;
    const Id id = model_.parts[part].id;
    if (model_.parts[part].rigid) {
      if (named)
        deck_.warning(
            diagnostics_, card, "PSID",
            fmt::format("part {} is rigid: damping over a range of frequencies does not act on it", id));
      return;
    }
    const ModelPart& of = model_.parts[part];
    if (!of.has_sph && !of.has_solid && !of.has_shell && !of.has_beam) {
      if (named)
        deck_.warning(diagnostics_, card, "PSID", fmt::format("part {} has no elements that are damped", id));
      return;
    }
    if (const std::string why = why_not_(part); !why.empty()) {
      std::string message = fmt::format("part {} is not damped: {}", id, why);
      if (named) return error(card, "PSID", std::move(message), "take it out of the part set");
      return deck_.warning(diagnostics_, card, "PSID", std::move(message),
                           "*DAMPING_PART_MASS damps it, or name the other parts by PSID");
    }
    if (out_[part].any())
      return error(card, "PSID", fmt::format("part {} is damped twice", id), "name each part once");
    out_[part] = range;
  }
  void error(const S& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  const Deck& deck_;
  const Model& model_;
  bool of_stress_;
  const std::function<std::string(std::size_t)>& why_not_;
  Diagnostics& diagnostics_;
  bool has_rest_ = false;  ///< a card names all other parts
  std::vector<FrequencyRange> out_;
};

}  // namespace

Real FrequencyRange::sum() const {
  return std::accumulate(share.begin(), share.end(), Real(0));
}
FrequencyRange::Step FrequencyRange::step(Real dt) const {
  Step out{};
  for (std::size_t k = 0; k < time.size(); ++k) {
    out.left[k] = std::exp(-dt / time[k]);
    out.mean[k] = dt > 0 ? -std::expm1(-dt / time[k]) * time[k] / dt : 1;
  }
  return out;
}

FrequencyRange fitted_range(Real cdamp, Real flow, Real fhigh, bool of_stress) {
  constexpr Real apart = 5.5;   // of neighbouring times: fits within 5 %
  constexpr Real narrow = 2.0;  // closer times are one mechanism
  constexpr int samples = 24;   // of each mechanism
  const Real wider = std::max(Real(1), std::sqrt(narrow * flow / fhigh));
  const Real low = 2 * pi * flow / wider, ratio = fhigh / flow * wider * wider;
  const int count = 1 + static_cast<int>(std::ceil(std::log(ratio) / std::log(apart)));
  FrequencyRange out;
  for (int k = 0; k < count; ++k) out.time.push_back(1 / (low * std::pow(ratio, Real(k) / (count - 1))));
  const int rows = samples * count;
  const Real loss = 2 * cdamp;
  Eigen::MatrixXd terms(rows, count);
  for (int j = 0; j < rows; ++j)
    for (int k = 0; k < count; ++k) {
      const Real x = low * std::pow(ratio, Real(j) / (rows - 1)) * out.time[static_cast<std::size_t>(k)];
      // loss over what the mechanism adds to stiffness, or to mass
      terms(j, k) = (x - loss * (of_stress ? x * x : 1)) / (1 + x * x);
    }
  const Eigen::VectorXd shares = terms.colPivHouseholderQr().solve(Eigen::VectorXd::Constant(rows, loss));
  out.share.assign(shares.data(), shares.data() + count);
  return out;
}

std::vector<FrequencyRange> frequency_ranges(const Deck& deck, const Model& model, bool of_stress,
                                             const std::function<std::string(std::size_t)>& why_not,
                                             Diagnostics& diagnostics) {
  return RangeReader(deck, model, of_stress, why_not, diagnostics).read();
}

}  // namespace courant
