// What the field files hold.
#include <fmt/format.h>
#include <algorithm>
#include <cctype>

#include "model/model_builder.hpp"
#include "model/requests/output_cards.hpp"

namespace courant {

namespace {

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

void ModelBuilder::leave_out(const std::vector<Index>& parts) {
  std::vector<Index>& out = model_.output.fields.left_out;
  out.insert(out.end(), parts.begin(), parts.end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

void ModelBuilder::build_left_out_parts(const Entry& card, Id psetid) {
  if (psetid == 0) return;
  if (const auto* parts = part_set(card, "PSETID", psetid)) leave_out(*parts);
}

void ModelBuilder::build_field_output() {
  FieldRequests& out = model_.output.fields;
  if (const auto* card = deck_.last<DatabaseExtentBinary>()) {
    if (card->neiph > 0) out.extra = {"stress", "strain_rate", "sound_speed", "density_rate"};
    if (card->resplt == 1) out.extra.push_back("force");
    if (card->strflg >= 10)
      deck_.warning(diagnostics_, *card, "STRFLG",
                    "tensors of plastic and thermal strains are not written: those of all strain are",
                    "1 says the same without this warning");
  }
  const auto* card = deck_.last<CourantOutputCard>();
  if (!card) return;
  out.card = *card;
  out.small = card->small == 1;
  out.bits = card->bits;
  const auto number = [&](const char* field, int value, int most) {
    if (value < -1 || value > most)
      error(*card, field, fmt::format("{} is not among -1 ... {}", value, most));
    return value;
  };
  out.compression = number("COMP", card->comp, 2);
  out.level = number("LEVEL", card->level, 9);
  const auto share = [&](const char* field, Real value) {
    if (value != -1 && !(value >= 0 && value <= 0.5))
      error(*card, field, fmt::format("an error of {:g} is not between 0 and 0.5", value));
    return value;
  };
  out.eps = share("EPS", card->eps);
  out.epsx = share("EPSX", card->epsx);
  for (const std::string& name : card->fields)
    if (!name.empty()) out.fields.push_back(lower_case(name));
  if (card->boxid != 0)
    if (const Box* found = box(*card, "BOXID", card->boxid)) out.in_box = true, out.box = *found;
  if (card->pset == 0) return;
  const auto* wanted = part_set(*card, "PSET", card->pset);
  if (!wanted) return;
  std::vector<Index> others;
  for (std::size_t k = 0; k < model_.parts.size(); ++k)
    if (std::find(wanted->begin(), wanted->end(), static_cast<Index>(k)) == wanted->end())
      others.push_back(static_cast<Index>(k));
  leave_out(others);
}

}  // namespace courant
