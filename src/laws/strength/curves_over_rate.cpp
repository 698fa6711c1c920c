#include "laws/strength/curves_over_rate.hpp"

#include <fmt/format.h>

#include <cmath>

namespace courant {

namespace {

std::vector<Id> curves_of(const Model& model, Id id) {
  const auto table = model.tables.find(id);
  return table == model.tables.end() ? std::vector<Id>{id} : table->second.curve;
}

}  // namespace

CurvesOverRate::CurvesOverRate(const Model& model, Id id, Real length, Real area) {
  for (const Id one : curves_of(model, id)) {
    const auto found = model.curves.find(one);
    if (found == model.curves.end()) continue;
    std::vector<Real> x = found->second.abscissa, y = found->second.ordinate;
    for (Real& strain : x) strain /= length;
    for (Real& stress : y) stress /= area;
    begins = std::max(begins, x.front());
    curves.emplace_back(std::move(x), std::move(y));
  }
  const auto table = model.tables.find(id);
  rates = table == model.tables.end() ? std::vector<Real>{0} : table->second.value;
}

Real CurvesOverRate::steepest_at_0() const {
  constexpr Real small = 1e-9;
  Real out = 0;
  for (const StraightPieces& curve : curves) out = std::max(out, curve.steepest(-small, small));
  return out;
}

void check_curves_over_rate(const Deck& deck, const Model& model, const Entry& card, const char* field, Id id,
                            Real least, Diagnostics& diagnostics) {
  const auto fail = [&](const std::string& what) {
    deck.error(diagnostics, card, field, what, "stress over strain, from (0, 0), or a table of such curves");
  };
  const auto table = model.tables.find(id);
  if (table != model.tables.end() && table->second.of_tables)
    return fail(fmt::format("table {} is one of tables", id));
  for (const Id one : curves_of(model, id)) {
    const auto found = model.curves.find(one);
    if (found == model.curves.end()) return fail(fmt::format("there is no curve or table {}", one));
    const std::vector<Real>&x = found->second.abscissa, &y = found->second.ordinate;
    if (x.size() < 2) return fail(fmt::format("curve {} has less than two points", one));
    for (std::size_t k = 1; k < x.size(); ++k)
      if (!(x[k] > x[k - 1])) return fail(fmt::format("curve {} jumps at {:g}", one, x[k]));
    if (!(x.front() > least))
      return fail(fmt::format("curve {} begins at {:g}, and nothing is so short", one, x.front()));
    Real largest = 0;
    for (const Real stress : y) largest = std::max(largest, std::abs(stress));
    constexpr Real round_off = 1e-9;
    if (x.front() > 0 || x.back() < 0 || std::abs(StraightPieces(x, y)(0)) > round_off * largest)
      return fail(fmt::format("curve {} does not pass through (0, 0)", one));
  }
}

}  // namespace courant
