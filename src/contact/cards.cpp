#include "contact/cards.hpp"
#include "contact/contact_cards.hpp"

#include <algorithm>
#include <iterator>

#include "contact/contact_table.hpp"
#include "keyword/deck.hpp"
#include "keyword/registry.hpp"

namespace courant {
namespace {

using C = ContactCard;
constexpr Honour no = Honour::no, ignored = Honour::ignored, output_only = Honour::output_only;

/// In the order of the names.
constexpr ContactKind kinds[] = {
    {.nodes = true},
    {.single = true},
    {.symmetric = true},
    {},
    {.single = true, .edges = true},
    {.automatic = false, .nodes = true},
    {.automatic = false, .single = true},
    {.automatic = false, .symmetric = true},
    {.automatic = false},
    {.nodes = true, .eroding = true},
    {.single = true, .eroding = true},
    {.symmetric = true, .eroding = true},
    {.single = true, .edges = true, .inner = true},
    {.automatic = false, .nodes = true, .forming = true},
    {.automatic = false, .forming = true},
    {.automatic = false, .symmetric = true, .forming = true},
    {.single = true, .runs_as = "contact of nodes with faces, without _MORTAR"},
    {.symmetric = true, .runs_as = "contact of nodes with faces, without _MORTAR"},
    {.automatic = false, .forming = true, .runs_as = "contact of nodes with faces, without _MORTAR"},
    {.automatic = false,
     .symmetric = true,
     .forming = true,
     .runs_as = "contact of nodes with faces, without _MORTAR"}};
constexpr ContactKind tiebreak_kinds[] = {
    {.symmetric = true, .tiebreak = Tiebreak::by_option},
    {.tiebreak = Tiebreak::by_option},
    {.automatic = false, .nodes = true, .tiebreak = Tiebreak::force},
    {.automatic = false, .symmetric = true, .tiebreak = Tiebreak::stress}};
Tiebreak tiebreak_of(const C& card) {
  return tiebreak_kinds[card.name].tiebreak;
}

/// PARAM is a length with OPTION 6 and 8, a number else.
std::string convert_opening(C& card, const Conversion& conversion) {
  if (tiebreak_of(card) == Tiebreak::by_option && (card.option == 6 || card.option == 8))
    card.param *= conversion.units.of("L");
  return {};
}

/// Card 4 of those that hold until they break.
std::vector<CardOf<C>> tiebreak_cards() {
  constexpr FieldRules strength{.required = true, .check = Check::positive};
  constexpr FieldRules of_option{.check = Check::not_negative};
  return {
      {.fields =
           {{"OPTION",
             &C::option,
             "-",
             "nodes that touch at the start or later hold for ever (1), until the stress is reached (3); "
             "those that touch at the start until the stress (2), until the opening PARAM (6, 8), as a "
             "cohesive joint (9, 11)",
             {.standard = 1}},
            {"NFLS", &C::nfls, "M/LT2", "normal stress that breaks it", of_option},
            {"SFLS", &C::sfls, "M/LT2", "shear stress that breaks it", of_option},
            {"PARAM",
             &C::param,
             "-",
             "with OPTION 6 and 8: opening at which nothing holds any more, behind a straight fall; with 9 "
             "and 11 the exponent of the energies, < 0 of Benzeggagh and Kenane; 0: 1",
             {}},
            {"ERATEN", &C::eraten, "M/T2", "energy by area of opening, of OPTION 9 and 11", of_option},
            {"ERATES", &C::erates, "M/T2", "the same of shear", of_option},
            {"CT2CN", &C::ct2cn, "-", "stiffness of shear over CN, of the same options; 0: 1", of_option},
            {"CN", &C::cn, "M/L2T2", "stress over opening, of the same options; 0: of the penalty",
             of_option}},
       .when = [](const C& card) { return tiebreak_of(card) == Tiebreak::by_option; }},
      {.fields =
           {{"NFLF", &C::nfls, "ML/T2", "normal force on a node that breaks it", strength},
            {"SFLF", &C::sfls, "ML/T2", "shear force on a node that breaks it", strength},
            {"NEN", &C::nen, "-", "exponent of the normal force", {.standard = 2, .check = Check::positive}},
            {"MES", &C::mes, "-", "exponent of the shear force", {.standard = 2, .check = Check::positive}}},
       .when = [](const C& card) { return tiebreak_of(card) == Tiebreak::force; }},
      {.fields = {{"NFLS", &C::nfls, "M/LT2", "normal stress that breaks it", strength},
                  {"SFLS", &C::sfls, "M/LT2", "shear stress that breaks it", strength},
                  {"TBLCID", &C::tblcid, "-", "curve of stress over opening", {.honour = no}},
                  {"THKOFF", &C::thkoff, "-", "thickness of shells", {.honour = no}}},
       .when = [](const C& card) { return tiebreak_of(card) == Tiebreak::stress; }}};
}

KeywordOf<C> contact_keyword() {
  KeywordOf<C> out = contact_of_sides<C>(
      {"CONTACT_AUTOMATIC_NODES_TO_SURFACE",
       "CONTACT_AUTOMATIC_SINGLE_SURFACE",
       "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE",
       "CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE",
       "CONTACT_AUTOMATIC_GENERAL",
       "CONTACT_NODES_TO_SURFACE",
       "CONTACT_SINGLE_SURFACE",
       "CONTACT_SURFACE_TO_SURFACE",
       "CONTACT_ONE_WAY_SURFACE_TO_SURFACE",
       "CONTACT_ERODING_NODES_TO_SURFACE",
       "CONTACT_ERODING_SINGLE_SURFACE",
       "CONTACT_ERODING_SURFACE_TO_SURFACE",
       "CONTACT_AUTOMATIC_GENERAL_INTERIOR",
       "CONTACT_FORMING_NODES_TO_SURFACE",
       "CONTACT_FORMING_ONE_WAY_SURFACE_TO_SURFACE",
       "CONTACT_FORMING_SURFACE_TO_SURFACE",
       "CONTACT_AUTOMATIC_SINGLE_SURFACE_MORTAR",
       "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_MORTAR",
       "CONTACT_FORMING_ONE_WAY_SURFACE_TO_SURFACE_MORTAR",
       "CONTACT_FORMING_SURFACE_TO_SURFACE_MORTAR"},
      "penalty contact of nodes of elements, or particles (SURFA of _NODES_TO_SURFACE), with faces");
  out.cards.push_back(
      {.fields =
           {{"ISYM",
             &C::erode_isym,
             "-",
             "of eroding contacts: 1 leaves out faces of solids whose nodes are held along their normal",
             {.allowed = {0, 1}}},
            {"EROSOP",
             &C::erosop,
             "-",
             "of eroding contacts: 1 faces that deletion of solids lays bare, 0 those of the start alone",
             {.allowed = {0, 1}}},
            {"IADJ",
             &C::iadj,
             "-",
             "of eroding contacts: faces between parts count in both cases",
             {.allowed = {0, 1}}}},
       .when = [](const C& card) { return kinds[card.name].eroding; }});
  for (CardOf<C>& card : contact_optional_cards<C>()) out.cards.push_back(std::move(card));
  return out;
}
const RegisterKeyword<C> contact{contact_keyword()};

const char* const first_tiebreak = "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK";
KeywordOf<C> tiebreak_keyword() {
  KeywordOf<C> out = contact_of_sides<C>(
      {first_tiebreak, "CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE_TIEBREAK",
       "CONTACT_TIEBREAK_NODES_TO_SURFACE", "CONTACT_TIEBREAK_SURFACE_TO_SURFACE"},
      "contact of nodes of elements with faces that holds what touches at the start until it breaks");
  out.convert = convert_opening;
  for (CardOf<C>& card : tiebreak_cards()) out.cards.push_back(std::move(card));
  for (CardOf<C>& card : contact_optional_cards<C>()) out.cards.push_back(std::move(card));
  return out;
}
const RegisterKeyword<C> tiebreak_contact{tiebreak_keyword()};

const RegisterKeyword<ControlContact> control_contact{control_contact_table()};
const RegisterKeyword<LiteralPenalty> literal_penalty{courant_literal_penalty_table()};

}  // namespace

// Two keywords have cards of this type, each with kinds of its own.
ContactKind kind_of(const ContactCard& card) {
  const bool ties =
      card.keyword >= 0 &&
      keyword_registry()[static_cast<std::size_t>(card.keyword)]->names.front() == first_tiebreak;
  return ties ? tiebreak_kinds[card.name] : kinds[card.name];
}

bool asks_for_edges(const ContactCard& card) {
  const ContactKind kind = kind_of(card);
  if (kind.edges) return true;
  constexpr int depths[] = {5, 15, 25, 35};
  return card.soft == 2 && kind.automatic && !kind.eroding && kind.tiebreak == Tiebreak::none &&
         (kind.single || kind.symmetric) &&
         std::find(std::begin(depths), std::end(depths), card.depth) != std::end(depths);
}

void warn_of_sliding(const Deck& deck, const ContactCard& card, Diagnostics& diagnostics) {
  if (card.fs != 0 || !(card.fd > 0)) return;
  deck.warning(diagnostics, card, "FD",
               card.dc > 0 ? "with FS 0 friction grows from 0 at rest to FD with the speed of sliding"
                           : "has no effect with FS 0 and DC 0: nothing rubs",
               "give FS the coefficient of rest; with DC 0 it is that of sliding, too");
}

}  // namespace courant
