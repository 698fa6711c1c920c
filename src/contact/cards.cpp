#include "contact/cards.hpp"

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
constexpr ContactKind kinds[] = {{.nodes = true},
                                 {.single = true},
                                 {.two_way = true},
                                 {},
                                 {.single = true, .edges = true},
                                 {.automatic = false, .nodes = true},
                                 {.automatic = false, .single = true},
                                 {.automatic = false, .two_way = true},
                                 {.automatic = false},
                                 {.nodes = true, .eroding = true},
                                 {.single = true, .eroding = true},
                                 {.two_way = true, .eroding = true},
                                 {.single = true, .edges = true, .inner = true}};
constexpr ContactKind tiebreak_kinds[] = {
    {.two_way = true, .tiebreak = Tiebreak::by_option},
    {.tiebreak = Tiebreak::by_option},
    {.automatic = false, .nodes = true, .tiebreak = Tiebreak::force},
    {.automatic = false, .two_way = true, .tiebreak = Tiebreak::stress}};
Tiebreak tiebreak_of(const C& card) {
  return tiebreak_kinds[card.name].tiebreak;
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
             "those that touch at the start until the stress (2), until the opening PARAM (6, 8)",
             {.standard = 1}},
            {"NFLS", &C::nfls, "M/LT2", "normal stress that breaks it", of_option},
            {"SFLS", &C::sfls, "M/LT2", "shear stress that breaks it", of_option},
            {"PARAM",
             &C::param,
             "L",
             "with OPTION 6 and 8: opening at which nothing holds any more, behind a straight fall",
             {.check = Check::not_negative}},
            {"ERATEN", &C::eraten, "M/T2", "of other options", {.honour = no}},
            {"ERATES", &C::erates, "M/T2", "of other options", {.honour = no}},
            {"CT2CN", &C::ct2cn, "-", "of other options", {.honour = no}},
            {"CN", &C::cn, "M/L2T2", "of other options", {.honour = no}}},
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
      {"CONTACT_AUTOMATIC_NODES_TO_SURFACE", "CONTACT_AUTOMATIC_SINGLE_SURFACE",
       "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", "CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE",
       "CONTACT_AUTOMATIC_GENERAL", "CONTACT_NODES_TO_SURFACE", "CONTACT_SINGLE_SURFACE",
       "CONTACT_SURFACE_TO_SURFACE", "CONTACT_ONE_WAY_SURFACE_TO_SURFACE", "CONTACT_ERODING_NODES_TO_SURFACE",
       "CONTACT_ERODING_SINGLE_SURFACE", "CONTACT_ERODING_SURFACE_TO_SURFACE",
       "CONTACT_AUTOMATIC_GENERAL_INTERIOR"},
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
  for (CardOf<C>& card : tiebreak_cards()) out.cards.push_back(std::move(card));
  for (CardOf<C>& card : contact_optional_cards<C>()) out.cards.push_back(std::move(card));
  return out;
}
const RegisterKeyword<C> tiebreak_contact{tiebreak_keyword()};

using K = ControlContact;

const RegisterKeyword<K> control_contact{
    {.names = {"CONTROL_CONTACT"},
     .purpose = "defaults of all contacts",
     .once = true,
     .many = false,
     .cards = {
         {.fields =
              {{"SLSFAC",
                &K::slsfac,
                "-",
                "scale of all penalties",
                {.standard = 0.1, .check = Check::positive}},
               {"RWPNAL",
                &K::rwpnal,
                "-",
                "penalty of nodes of rigid bodies at rigid walls, which do not hold them",
                {.honour = ignored}},
               {"ISLCHK",
                &K::islchk,
                "-",
                "initial penetrations are always reported",
                {.standard = 1, .honour = ignored}},
               {"SHLTHK",
                &K::shlthk,
                "-",
                "shell thickness in contacts that are not automatic: 0 none, 1 but of rigid ones, 2 all",
                {.allowed = {0, 1, 2}}},
               {"PENOPT",
                &K::penopt,
                "-",
                "stiffness: 1 least of both sides, 2 segment, 3 node or particle",
                {.standard = 1, .allowed = {1, 2, 3}}},
               {"THKCHG",
                &K::thkchg,
                "-",
                "thinning; contact thickness is that of the start",
                {.honour = ignored}},
               {"ORIEN",
                &K::orien,
                "-",
                "segments act on both sides, so none needs turning",
                {.standard = 1, .honour = ignored}},
               {"ENMASS",
                &K::enmass,
                "-",
                "nodes whose elements are all deleted: 0 touch nothing, 1 those of solids go on, 2 all go on",
                {.allowed = {0, 1, 2}}}}},
         {.fields = {{"USRSTR", &K::usrstr, "-", "user interface", {.honour = no}},
                     {"USRFRC", &K::usrfrc, "-", "user friction", {.honour = no}},
                     {"NSBCS", &K::nsbcs, "-", "cycles between searches", {.honour = ignored}},
                     {"INTERM", &K::interm, "-", "intermittent search", {.honour = ignored}},
                     {"XPENE",
                      &K::xpene,
                      "-",
                      "penetration check of non-automatic contacts",
                      {.standard = 4, .honour = ignored}},
                     {"SSTHK",
                      &K::ssthk,
                      "-",
                      "thickness in single surface contacts: 0 at most 0.4 of the shortest edge, 1 true",
                      {.allowed = {0, 1}}},
                     {"ECDT", &K::ecdt, "-", "eroding contact and the step", {.honour = ignored}},
                     {"TIEDPRJ", &K::tiedprj, "-", "projection of tied contact", {.honour = ignored}}},
          .optional = true},
         {.fields = {{"SFRIC", &K::sfric, "-", "for *PART_CONTACT", {.honour = ignored}},
                     {"DFRIC", &K::dfric, "-", "for *PART_CONTACT", {.honour = ignored}},
                     {"EDC", &K::edc, "T/L", "for *PART_CONTACT", {.honour = ignored}},
                     {"VFC", &K::vfc, "M/LT2", "for *PART_CONTACT", {.honour = ignored}},
                     {"TH", &K::th, "L", "for *PART_CONTACT", {.honour = ignored}},
                     {"TH_SF", &K::th_sf, "-", "for *PART_CONTACT", {.honour = ignored}},
                     {"PEN_SF", &K::pen_sf, "-", "for *PART_CONTACT", {.honour = ignored}},
                     {"PTSCL", &K::ptscl, "-", "for solid shells", {.standard = 1, .honour = ignored}}},
          .optional = true},
         {.fields = {{"IGNORE",
                      &K::ignore,
                      "-",
                      "initial penetrations: tracked and reported for all values",
                      {.allowed = {0, 1, 2}}},
                     {"FRCENG", &K::frceng, "-", "friction energy; always computed", {.honour = ignored}},
                     {"SKIPRWG", &K::skiprwg, "-", "display of rigid walls", {.honour = ignored}},
                     {"OUTSEG", &K::outseg, "-", "spot welds", {.honour = ignored}},
                     {"SPOTSTP", &K::spotstp, "-", "spot welds", {.honour = ignored}},
                     {"SPOTDEL", &K::spotdel, "-", "spot welds", {.honour = ignored}},
                     {"SPOTHIN", &K::spothin, "-", "spot welds", {.honour = ignored}},
                     {"DIR_TIE", &K::dir_tie, "-", "tied contact", {.honour = ignored}}},
          .optional = true},
         {.fields = {{"ISYM", &K::isym, "-", "symmetry faces", {.honour = no}},
                     {"NSEROD", &K::nserod, "-", "eroding contact", {.honour = ignored}},
                     {"RWGAPS", &K::rwgaps, "-", "rigid walls", {.standard = 1, .honour = ignored}},
                     {"RWGDTH", &K::rwgdth, "T", "rigid walls", {.honour = ignored}},
                     {"RWKSF", &K::rwksf, "-", "rigid walls", {.standard = 1, .honour = ignored}},
                     {"ICOV", &K::icov, "-", "forming contact", {.honour = ignored}},
                     {"SWRADF", &K::swradf, "-", "spot welds", {.honour = ignored}},
                     {"ITHOFF", &K::ithoff, "-", "thermal contact", {.honour = ignored}}},
          .optional = true},
         {.fields = {{"SHLEDG", &K::shledg, "-", "shell edges: 0 round, 1 square", {.honour = no}},
                     {"PSTIFF", &K::pstiff, "-", "option of SOFT 2", {.honour = ignored}},
                     {"ITHCNT", &K::ithcnt, "-", "thermal contact", {.honour = ignored}},
                     {"TDCNOF", &K::tdcnof, "-", "tied contact", {.honour = ignored}},
                     {"FTALL", &K::ftall, "-", "output of force transducers", {.honour = ignored}},
                     {"", std::monostate{}, "-", "unused", {}},
                     {"SHLTRW", &K::shltrw, "-", "shell thickness at rigid walls", {.honour = no}},
                     {"IGACTC", &K::igactc, "-", "isogeometric shells", {.honour = ignored}}},
          .optional = true}}}};

const RegisterKeyword<LiteralPenalty> literal_penalty{
    {.names = {"COURANT_LITERAL_PENALTY"},
     .purpose = "contact whose walls do nothing but their penalty, whoever goes through",
     .cards = {{.fields = {{"CID",
                            &LiteralPenalty::cid,
                            "-",
                            "id of the *CONTACT, or its number among those without; 0: all",
                            {.check = Check::not_negative}}}}}}};

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
         (kind.single || kind.two_way) &&
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
