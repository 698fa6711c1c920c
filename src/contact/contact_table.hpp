#pragma once
// Cards common to all *CONTACT of two sides.
#include <string>
#include <utility>
#include <vector>

#include "contact/cards.hpp"
#include "keyword/registry.hpp"

namespace courant {

/// Id space of SURFA and SURFB, by the type beside them.
inline IdSpace space_of_side(int type) {
  constexpr IdSpace spaces[] = {IdSpace::segment_set, IdSpace::shell_set, IdSpace::part_set, IdSpace::part,
                                IdSpace::node_set,    IdSpace::none,      IdSpace::part_set};
  return type >= 0 && type <= 6 ? spaces[type] : IdSpace::none;
}

/// Cards 1 to 3. T: ContactCard, or what derives from it.
template <class T>
std::vector<CardOf<T>> contact_first_cards() {
  return {
      {.fields =
           {{"SURFA",
             &T::surfa,
             "-",
             "first side: of the kind SURFATYP; 0: all",
             {},
             [](const T& card) { return space_of_side(card.surfatyp); }},
            {"SURFB",
             &T::surfb,
             "-",
             "second side: of the kind SURFBTYP; of single surfaces none",
             {},
             [](const T& card) { return space_of_side(card.surfbtyp); }},
            {"SURFATYP",
             &T::surfatyp,
             "-",
             "0 segment set, 1 shell set, 2 part set, 3 part, 4 node set, 5 all, 6 all but a part set",
             {.allowed = {0, 1, 2, 3, 4, 5, 6}}},
            {"SURFBTYP",
             &T::surfbtyp,
             "-",
             "0 segment set, 1 shell set, 2 part set, 3 part, 5 all, 6 all but a part set",
             {.allowed = {0, 1, 2, 3, 5, 6}}},
            {"SABOXID", &T::saboxid, "-", "box that restricts SURFA at the start", {.refers = IdSpace::box}},
            {"SBBOXID", &T::sbboxid, "-", "box that restricts SURFB at the start", {.refers = IdSpace::box}},
            {"SAPR", &T::sapr, "-", "SURFA in interface files", {.honour = Honour::ignored}},
            {"SBPR", &T::sbpr, "-", "SURFB in interface files", {.honour = Honour::ignored}}}},
      {.fields =
           {{"FS", &T::fs, "-", "static friction; -2: as *DEFINE_FRICTION says", {}},
            {"FD",
             &T::fd,
             "-",
             "dynamic friction; with FS -2 number of the *DEFINE_FRICTION, 0: the only one",
             {.check = Check::not_negative}},
            {"DC", &T::dc, "T/L", "decay: mu = FD + (FS - FD) exp(-DC v)", {.check = Check::not_negative}},
            {"VC", &T::vc, "M/LT2", "largest friction stress, 0: no limit", {.check = Check::not_negative}},
            {"VDC", &T::vdc, "-", "normal damping in percent of critical", {.check = Check::not_negative}},
            {"PENCHK",
             &T::penchk,
             "-",
             "release of deep nodes, refused but for automatic contacts, where it has no effect",
             {}},
            {"BT", &T::bt, "T", "birth time", {.check = Check::not_negative}},
            {"DT", &T::dt, "T", "death time", {.standard = 1e20, .check = Check::positive}}}},
      {.fields = {
           {"SFSA", &T::sfsa, "-", "scale of SURFA stiffness", {.standard = 1, .check = Check::positive}},
           {"SFSB", &T::sfsb, "-", "scale of SURFB stiffness", {.standard = 1, .check = Check::positive}},
           {"SAST",
            &T::sast,
            "L",
            "contact thickness of shells or particles of SURFA; 0: of the section, or none (or ITHK)",
            {.check = Check::not_negative}},
           {"SBST",
            &T::sbst,
            "L",
            "contact thickness of shells of SURFB, 0: that of the section",
            {.check = Check::not_negative}},
           {"SFSAT",
            &T::sfsat,
            "-",
            "scale of thickness in SURFA",
            {.standard = 1, .check = Check::positive}},
           {"SFSBT",
            &T::sfsbt,
            "-",
            "scale of thickness in SURFB",
            {.standard = 1, .check = Check::positive}},
           {"FSF", &T::fsf, "-", "scale of friction", {.standard = 1, .check = Check::not_negative}},
           {"VSF", &T::vsf, "-", "scale of VC", {.standard = 1, .check = Check::not_negative}}}}};
}

/// Common part of all keywords of contacts.
template <class T>
KeywordOf<T> contact_head(std::vector<std::string> names, std::string purpose, std::vector<CardOf<T>> cards) {
  return {.names = std::move(names),
          .purpose = std::move(purpose),
          .id_space = IdSpace::contact,
          .id_option = true,
          .mpp_option = true,
          .id_may_repeat = true,
          .title = &T::title,
          .id = &T::cid,
          .many = false,
          .cards = std::move(cards)};
}
/// Those of two sides, with their first cards.
template <class T>
KeywordOf<T> contact_of_sides(std::vector<std::string> names, std::string purpose) {
  return contact_head<T>(std::move(names), std::move(purpose), contact_first_cards<T>());
}

/// Cards A to G, which may be missing.
template <class T>
std::vector<CardOf<T>> contact_optional_cards() {
  return {
      {.fields =
           {{"SOFT",
             &T::soft,
             "-",
             "0 penalty, 1 soft constraint, 2 by segments: as 1",
             {.allowed = {0, 1, 2}}},
            {"SOFSCL",
             &T::sofscl,
             "-",
             "scale of the SOFT 1 stiffness 0.5 m/dt^2",
             {.standard = 0.1, .check = Check::positive}},
            {"LCIDAB", &T::lcidab, "-", "airbag thickness curve", {.honour = Honour::no}},
            {"MAXPAR",
             &T::maxpar,
             "-",
             "segment extension in the search; corners have none to close here",
             {.standard = 1.025, .honour = Honour::ignored}},
            {"SBOPT", &T::sbopt, "-", "option of SOFT 2", {.standard = 2, .honour = Honour::ignored}},
            {"DEPTH",
             &T::depth,
             "-",
             "with SOFT 2: 5, 15, 25, 35 edges on edges, too; else of the search, which knows all that is "
             "near",
             {.standard = 2}},
            {"BSORT",
             &T::bsort,
             "-",
             "cycles between sorts; lists follow the particles instead",
             {.honour = Honour::ignored}},
            {"FRCFRQ", &T::frcfrq, "-", "cycles between force updates", {.standard = 1, .allowed = {1}}}},
       .optional = true},
      {.fields = {{"PENMAX",
                   &T::penmax,
                   "-",
                   "depth at which a node is given up, of the thickness; 0: 1",
                   {.check = Check::not_negative}},
                  {"THKOPT",
                   &T::thkopt,
                   "-",
                   "thickness in contacts that are not automatic: 0 as *CONTROL_CONTACT, 1 by SHLTHK, 2 none",
                   {.allowed = {0, 1, 2}}},
                  {"SHLTHK",
                   &T::shlthk,
                   "-",
                   "with THKOPT 1: 0 none, 1 of all but rigid shells, 2 of all",
                   {.allowed = {0, 1, 2}}},
                  {"SNLOG",
                   &T::snlog,
                   "-",
                   "1 skips shooting-node logic; there is none",
                   {.honour = Honour::ignored}},
                  {"ISYM", &T::isym, "-", "faces on symmetry planes", {.honour = Honour::no}},
                  {"I2D3D", &T::i2d3d, "-", "search order of shells and solids", {.honour = Honour::ignored}},
                  {"SLDTHK", &T::sldthk, "L", "contact thickness of solids", {.check = Check::not_negative}},
                  {"SLDSTF",
                   &T::sldstf,
                   "M/LT2",
                   "instead of the bulk modulus of solids",
                   {.check = Check::not_negative}}},
       .optional = true},
      {.fields =
           {{"IGAP", &T::igap, "-", "implicit gap treatment", {.standard = 1, .honour = Honour::ignored}},
            {"IGNORE",
             &T::ignore,
             "-",
             "initial penetrations: reported for all values; nodes of elements keep theirs without force",
             {.allowed = {0, 1, 2}}},
            {"DPRFAC", &T::dprfac, "-", "depth reduction of SOFT 2", {.honour = Honour::ignored}},
            {"DTSTIF",
             &T::dtstif,
             "T",
             "step in the SOFT 1 stiffness, 0: the largest so far",
             {.check = Check::not_negative}},
            {"EDGEK",
             &T::edgek,
             "-",
             "with edges on edges by DEPTH: scale of their stiffness; 0: 1",
             {.check = Check::not_negative}},
            {"", std::monostate{}, "-", "unused", {}},
            {"FLANGL", &T::flangl, "-", "feature angle of smooth contact", {.honour = Honour::no}},
            {"CID_RCF", &T::cid_rcf, "-", "system of the reported forces", {.honour = Honour::output_only}}},
       .optional = true},
      {.fields =
           {{"Q2TRI", &T::q2tri, "-", "splits quads for SOFT 2", {.honour = Honour::ignored}},
            {"DTPCHK", &T::dtpchk, "T", "interval of penetration reports", {.honour = Honour::output_only}},
            {"SFNBR", &T::sfnbr, "-", "scale of neighbour segments", {.honour = Honour::no}},
            {"FNLSCL", &T::fnlscl, "-", "nonlinear force scale", {.honour = Honour::no}},
            {"DNLSCL", &T::dnlscl, "L", "distance of the nonlinear force", {.honour = Honour::no}},
            {"TCSO", &T::tcso, "-", "thickness from contact segments only", {.honour = Honour::ignored}},
            {"TIEDID", &T::tiedid, "-", "update of tied contact", {.honour = Honour::ignored}},
            {"SHLEDG",
             &T::shledg,
             "-",
             "shell edges with SOFT 2: 2 round (as always), 1 square; 0 as *CONTROL_CONTACT",
             {.allowed = {0, 1, 2}}}},
       .optional = true},
      {.fields = {{"SHAREC", &T::sharec, "-", "segments sharing constraints", {.honour = Honour::ignored}},
                  {"CPARM8", &T::cparm8, "-", "beam handling", {.honour = Honour::ignored}},
                  {"IPBACK", &T::ipback, "-", "backup of tied contact", {.honour = Honour::ignored}},
                  {"SRNDE", &T::srnde, "-", "rounded edges; they always are", {.honour = Honour::ignored}},
                  {"FRICSF",
                   &T::fricsf,
                   "-",
                   "friction stiffness of SOFT 2",
                   {.standard = 1, .honour = Honour::ignored}},
                  {"ICOR", &T::icor, "-", "VDC as coefficient of restitution", {.honour = Honour::no}},
                  {"FTORQ", &T::ftorq, "-", "torsion of beams", {.honour = Honour::ignored}},
                  {"REGION", &T::region, "-", "region that limits the contact", {.honour = Honour::no}}},
       .optional = true},
      {.fields =
           {{"PSTIFF", &T::pstiff, "-", "stiffness of SOFT 2", {.honour = Honour::ignored}},
            {"IGNROFF", &T::ignroff, "-", "no thickness of rigid shells", {.honour = Honour::no}},
            {"", std::monostate{}, "-", "unused", {}},
            {"FSTOL", &T::fstol, "-", "of smooth contacts", {.standard = 2, .honour = Honour::ignored}},
            {"2DBINR", &T::binr, "-", "of plane contacts", {.honour = Honour::ignored}},
            {"SSFTYP", &T::ssftyp, "-", "which SSF of *PART_CONTACT counts", {.honour = Honour::ignored}},
            {"SWTPR", &T::swtpr, "-", "shells of varying thickness", {.honour = Honour::no}},
            {"TETFAC", &T::tetfac, "-", "stiffness of tetrahedra in SOFT 2", {.honour = Honour::ignored}}},
       .optional = true},
      {.fields = {{"", std::monostate{}, "-", "unused", {}},
                  {"SHLOFF", &T::shloff, "-", "offset of shells", {.honour = Honour::no}}},
       .optional = true}};
}

}  // namespace courant
