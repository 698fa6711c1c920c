// Cards of tied contacts.
#include <string_view>

#include "contact/contact_table.hpp"
#include "contact/tied/tied_card.hpp"

namespace courant {

namespace {

using TC = TiedCard;

/// In the order of the names.
constexpr TiedKind tied_kinds[] = {{},
                                   {.form = TieForm::spring},
                                   {},
                                   {},
                                   {.form = TieForm::spring},
                                   {},
                                   {.turns = true},
                                   {.turns = true},
                                   {.turns = true, .welds = true},
                                   {.form = TieForm::beam, .turns = true},
                                   {.form = TieForm::spring, .turns = true},
                                   {.form = TieForm::beam, .turns = true, .welds = true}};

/// The rules of a field that means something else here than in contacts that open.
void change(KeywordOf<TC>& keyword, std::string_view name, const char* meaning, const FieldRules& rules) {
  for (CardOf<TC>& card : keyword.cards)
    for (FieldOf<TC>& field : card.fields)
      if (field.name == name) {
        if (meaning) field.meaning = meaning;
        field.rules = rules;
      }
}

KeywordOf<TC> tied_keyword() {
  KeywordOf<TC> out = contact_of_sides<TC>(
      {"CONTACT_TIED_NODES_TO_SURFACE", "CONTACT_TIED_NODES_TO_SURFACE_OFFSET",
       "CONTACT_TIED_NODES_TO_SURFACE_CONSTRAINED_OFFSET", "CONTACT_TIED_SURFACE_TO_SURFACE",
       "CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET", "CONTACT_TIED_SURFACE_TO_SURFACE_CONSTRAINED_OFFSET",
       "CONTACT_TIED_SHELL_EDGE_TO_SURFACE", "CONTACT_TIED_SHELL_EDGE_TO_SURFACE_CONSTRAINED_OFFSET",
       "CONTACT_SPOTWELD", "CONTACT_TIED_SHELL_EDGE_TO_SURFACE_BEAM_OFFSET",
       "CONTACT_TIED_SHELL_EDGE_TO_SURFACE_OFFSET", "CONTACT_SPOTWELD_BEAM_OFFSET"},
      "nodes of elements that go with the faces next to which they are at the start: "
      "exactly, or with _OFFSET held by springs; of shell edges and welds rotations, too; with "
      "_BEAM_OFFSET exactly where that can be, else by springs of displacements and rotations");
  for (CardOf<TC>& card : contact_optional_cards<TC>()) out.cards.push_back(std::move(card));
  for (const char* name : {"FS", "FD", "DC", "VC", "VDC"})
    change(out, name, "of contacts that are not tied", no_effect);
  for (const char* name : {"FSF", "VSF"}) change(out, name, nullptr, no_effect_but(1));
  change(out, "PENCHK", nullptr, no_effect);
  change(out, "BT", "birth time: from the start", {});
  change(out, "DT", "death time", {.standard = 1e20, .check = Check::positive});
  change(out, "SAST", "thickness of shells of SURFA, 0: of the section; < 0, or SBST < 0: largest distance",
         {});
  change(out, "SBST", "thickness of shells of SURFB, 0: of the section; < 0: -SBST is the largest distance",
         {});
  for (const char* name : {"SOFT", "PENMAX", "THKOPT", "SHLTHK", "DTSTIF", "IGNORE", "FLANGL", "SHLEDG"})
    change(out, name, "of contacts that are not tied", no_effect);
  change(out, "SOFSCL", "of contacts that are not tied", no_effect_but(0.1));
  return out;
}
const RegisterKeyword<TC> tied_contact{tied_keyword()};

const char* const failing_name = "CONTACT_TIED_SURFACE_TO_SURFACE_FAILURE";
/// The same card with other meanings of FS and FD.
KeywordOf<TC> failing_keyword() {
  KeywordOf<TC> out = tied_keyword();
  out.names = {failing_name};
  out.purpose =
      "nodes of elements that springs hold at the faces next to which they are at the start, until "
      "(max(sigma_n, 0)/FS)^2 + (tau/FD)^2 >= 1; then nothing is between them";
  const FieldRules strength{.required = true, .check = Check::positive};
  for (const auto& [name, meaning] :
       {std::pair("FS", "normal stress that breaks it"), std::pair("FD", "shear stress that breaks it")})
    for (CardOf<TC>& card : out.cards)
      for (FieldOf<TC>& field : card.fields)
        if (field.name == name) field.dimension = "M/LT2", field.meaning = meaning, field.rules = strength;
  return out;
}
const RegisterKeyword<TC> tied_failing{failing_keyword()};

}  // namespace

TiedKind kind_of(const TiedCard& card) {
  const bool fails =
      card.keyword >= 0 &&
      keyword_registry()[static_cast<std::size_t>(card.keyword)]->names.front() == failing_name;
  if (fails) return {.form = TieForm::spring, .fails = true};
  return tied_kinds[card.name];
}

}  // namespace courant
