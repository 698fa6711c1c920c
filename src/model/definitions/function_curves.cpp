// Curves by a formula: *DEFINE_CURVE_FUNCTION, *DEFINE_CURVE_SMOOTH, *DEFINE_FUNCTION.
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/definitions/curve_expression.hpp"
#include "model/model_builder.hpp"
#include "model/transforms/included_entries.hpp"

namespace courant {

namespace {

struct CurveFunctionCard : Entry {
  std::string title;
  Id lcid = 0;
  int sidr = 0, dattyp = 0;
  Real sfa = 1, sfo = 1, offa = 0, offo = 0;
  std::vector<std::string> function;
};
struct CurveSmoothCard : Entry {
  std::string title;
  Id lcid = 0;
  int sidr = 0;
  Real dist = 0, tstart = 0, tend = 0, trise = 0, vmax = 0;
};
struct FunctionCard : Entry {
  Id fid = 0;
  std::string heading;
  std::vector<std::string> function;
};

template <class T>
std::string keep_units(T&, const Conversion& conversion) {
  return conversion.units.any() ? "the file has unit factors, which a formula does not know" : "";
}

using CF = CurveFunctionCard;
const RegisterKeyword<CF> define_curve_function{
    {.names = {"DEFINE_CURVE_FUNCTION"},
     .purpose = "curve over the time by an expression: SFO (f(t) + OFFO) at SFA (t + OFFA)",
     .id_space = IdSpace::curve,
     .title_option = true,
     .title = &CF::title,
     .many = false,
     .cards =
         {{.fields =
               {{"LCID", &CF::lcid, "-", "curve id", rules::required_id},
                {"SIDR", &CF::sidr, "-", "phase: 0 transient, 1 relaxation, 2 both", {.allowed = {0, 1, 2}}},
                {"SFA", &CF::sfa, "-", "scale of the abscissa", {.standard = 1}},
                {"SFO", &CF::sfo, "-", "scale of the ordinate", {.standard = 1}},
                {"OFFA", &CF::offa, "-", "offset of the abscissa"},
                {"OFFO", &CF::offo, "-", "offset of the ordinate"},
                {"DATTYP", &CF::dattyp, "-", "kind of data: 0 over time", {.allowed = {0}}}}},
          {.fields = {{"FUNCTION",
                       &CF::function,
                       "-",
                       "expression of TIME, on as many lines as it needs",
                       {.width = 80}}},
           .repeat = true,
           .whole_lines = true}},
     .convert = keep_units<CF>}};

using CS = CurveSmoothCard;
const RegisterKeyword<CS> define_curve_smooth{
    {.names = {"DEFINE_CURVE_SMOOTH"},
     .purpose =
         "curve over the time, as of a velocity: up by half a wave of a cosine, constant, and down the "
         "same shape, with a given area",
     .id_space = IdSpace::curve,
     .title_option = true,
     .title = &CS::title,
     .cards =
         {{.fields =
               {{"LCID", &CS::lcid, "-", "curve id", rules::required_id},
                {"SIDR", &CS::sidr, "-", "phase: 0 transient, 1 relaxation, 2 both", {.allowed = {0, 1, 2}}},
                {"DIST", &CS::dist, "-", "area under the curve: the distance at that speed"},
                {"TSTART", &CS::tstart, "T", "time at which it begins to rise"},
                {"TEND", &CS::tend, "T", "time at which it is 0 again; 0: follows from VMAX"},
                {"TRISE",
                 &CS::trise,
                 "T",
                 "how long it rises, and falls",
                 {.required = true, .check = Check::positive}},
                {"VMAX", &CS::vmax, "-", "largest value; 0: follows from TEND"}}}},
     .convert = keep_units<CS>}};

using F = FunctionCard;
const RegisterKeyword<F> define_function{
    {.names = {"DEFINE_FUNCTION"},
     .purpose = "function of the time for loads and motions: f(t) = ..., or float f(float t) { return ...; }",
     .id_space = IdSpace::curve,
     .many = false,
     .cards = {{.fields = {{"FID", &F::fid, "-", "id, among those of curves", rules::required_id},
                           {"HEADING", &F::heading, "-", "text", {.width = 70}}}},
               {.fields = {{"FUNCTION", &F::function, "-", "text of the function", {.width = 80}}},
                .repeat = true,
                .whole_lines = true}},
     .convert = keep_units<F>}};

/// All lines; `at` in it belongs to line `row`, column `column` of that, from 0.
std::string joined(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += line + "\n";
  return out;
}
std::pair<std::size_t, std::size_t> place_in(const std::vector<std::string>& lines, std::size_t at) {
  std::size_t row = 0;
  while (row + 1 < lines.size() && at > lines[row].size()) at -= lines[row++].size() + 1;
  return {row, at};
}

}  // namespace

void ModelBuilder::build_function_curves() {
  const auto* end = deck_.last<ControlTerminationCard>();
  const Real until = end && end->endtim > 0 ? end->endtim : 1;
  const auto told = [&](const Entry& card, const std::vector<std::string>& lines, const TextFault& fault) {
    if (!fault.any()) return false;
    const auto [row, column] = place_in(lines, fault.at);
    Location where = deck_.where(card, "FUNCTION", {.row = row});
    where.column = static_cast<int>(column) + 1;
    if (++errors_ <= max_errors)
      diagnostics_.error(where, deck_.keyword(card) + ": " + fault.message, fault.hint);
    return true;
  };
  SamplingBudget budget;
  const auto sample = [&](const Entry& card, const char* field, Id id, int sidr, std::size_t operations,
                          const std::function<Real(Real)>& f) {
    Curve& curve = model_.curves[id];
    curve = Curve{};
    curve.id = id, curve.sidr = sidr, curve.by_formula = true;
    if (const std::string why = sample_curve(f, operations, 0, until, budget, curve); !why.empty())
      error(card, field, fmt::format("curve {} cannot be taken between t = 0 and {:g}: {}", id, until, why),
            "IF chooses between expressions; where one of them has no value the other counts");
  };
  for (const CF& card : deck_.all<CF>()) {
    TextFault fault;
    const CurveExpression f = CurveExpression::of_time(joined(card.function), fault);
    model_.curves[card.lcid].id = card.lcid;
    if (told(card, card.function, fault)) continue;
    sample(card, "FUNCTION", card.lcid, card.sidr, f.operations(),
           [&](Real t) { return card.sfo * (f(t / card.sfa - card.offa) + card.offo); });
  }
  for (const F& card : deck_.all<F>()) {
    TextFault fault;
    const CurveExpression f = CurveExpression::of_function(joined(card.function), fault);
    model_.curves[card.fid].id = card.fid;
    if (told(card, card.function, fault)) continue;
    sample(card, "FUNCTION", card.fid, 0, f.operations(), [&](Real t) { return f(t); });
  }
  for (const CS& card : deck_.all<CS>()) add_smooth_curve(card, sample);
  check_function_curves();
}

// The area of a rise and of a fall is half of VMAX TRISE each, so DIST = VMAX (TEND - TSTART - TRISE).
template <class Card, class Sample>
void ModelBuilder::add_smooth_curve(const Card& card, const Sample& sample) {
  model_.curves[card.lcid].id = card.lcid;
  Real tend = card.tend, vmax = card.vmax;
  if ((tend != 0) == (vmax != 0))
    return error(card, "TEND", tend != 0 ? "TEND and VMAX are both given" : "neither TEND nor VMAX is given",
                 "give one of them: the other follows from DIST");
  if (vmax != 0) {
    if (!(card.dist / vmax >= card.trise))
      return error(
          card, "DIST",
          fmt::format("a rise of {:g} to VMAX {:g} and the fall behind it alone cover the distance {:g}",
                      card.trise, vmax, vmax * card.trise),
          "shorten TRISE, or lower VMAX; the signs of DIST and VMAX are the same");
    tend = card.tstart + card.trise + card.dist / vmax;
  } else {
    if (!(tend - card.tstart >= 2 * card.trise))
      return error(card, "TRISE", "rise and fall take longer than there is from TSTART to TEND",
                   "TEND - TSTART must be at least twice TRISE");
    vmax = card.dist / (tend - card.tstart - card.trise);
  }
  sample(card, "DIST", card.lcid, card.sidr, 5, [&](Real t) -> Real {
    const Real from_end = std::min(t - card.tstart, tend - t);
    if (from_end <= 0) return 0;
    return from_end >= card.trise ? vmax : 0.5 * vmax * (1 - std::cos(pi * from_end / card.trise));
  });
}

/// Where a curve by a formula of the time is not over the time, it is refused.
void ModelBuilder::check_function_curves() {
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k) {
    const KeywordSpec& spec = *registry[k];
    if (!spec.lacking.empty()) continue;
    spec.for_each(deck_, static_cast<std::int32_t>(k), [&](const Entry& entry) {
      spec.for_each_id(entry, [&](const IdUse& id) {
        if (id.space != IdSpace::curve || id.defines || id.id == 0) return;
        const auto found = model_.curves.find(std::abs(id.id));
        if (found == model_.curves.end() || !found->second.by_formula) return;
        const FieldSpec& field = spec.cards[id.card].fields[id.field];
        if (field.rules.honour != Honour::yes) return;
        if (curve_of(field, entry).abscissa == std::string_view("T")) return;
        error(
            entry, field.name,
            fmt::format("curve {} is a formula of the time, and this one is not over the time", found->first),
            "give points with *DEFINE_CURVE");
      });
    });
  }
}

}  // namespace courant
