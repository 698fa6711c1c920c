#include "loads/blast_cards.hpp"
#include "loads/load_cards.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

struct LoadBlastEnhanced : Entry {
  Id bid = 0, nidbo = 0, vid = 0, gnid = 0, gvid = 0;
  Real m = 0, xbo = 0, ybo = 0, zbo = 0, tbo = 0, cfm = 0, cfl = 0, cft = 0, cfp = 0, death = 1e20;
  Real vel = 0, temp = 0, ratio = 0;
  int unit = 2, blast = 2, negphs = 0;
};
using Charge = LoadBlastEnhanced;
/// Of kinds of blasts that are refused.
constexpr FieldRules idle_reference(IdSpace space) {
  return {.honour = Honour::ignored, .refers = space};
}
constexpr FieldRules factor_of_units{.check = Check::not_negative};

/// Mass, places and time are converted, and those of the fits are not.
template <class Card>
std::string keep_units_of_fits(Card&, const Conversion& conversion) {
  return conversion.units.any() ? "the units of a blast are those that UNIT names" : "";
}
const RegisterKeyword<Charge> load_blast_enhanced{
    {.names = {"LOAD_BLAST_ENHANCED"},
     .purpose =
         "charge whose air blast pushes faces of *LOAD_BLAST_SEGMENT, by the fits of Kingery and Bulmash",
     .cards =
         {{.fields =
               {{"BID", &Charge::bid, "-", "number of the charge", rules::required_id},
                {"M", &Charge::m, "M", "equivalent mass of TNT", rules::required_positive},
                {"XBO", &Charge::xbo, "L", "its place, x", rules::point},
                {"YBO", &Charge::ybo, "L", "its place, y"},
                {"ZBO", &Charge::zbo, "L", "its place, z"},
                {"TBO", &Charge::tbo, "T", "time of detonation"},
                {"UNIT",
                 &Charge::unit,
                 "-",
                 "1 ft lb s psi, 2 m kg s Pa, 3 in (12 slugs) s psi, 4 cm g us Mbar, 5 CFM to CFP, 6 mm kg "
                 "ms GPa, 7 mm t s MPa, 8 mm g ms MPa",
                 {.standard = 2, .allowed = {1, 2, 3, 4, 5, 6, 7, 8}}},
                {"BLAST",
                 &Charge::blast,
                 "-",
                 "1 hemisphere on the ground, 2 sphere in free air; others (3, 4) are refused",
                 {.standard = 2}}}},
          {.fields = {{"CFM", &Charge::cfm, "-", "UNIT 5: pounds per unit of mass", factor_of_units},
                      {"CFL", &Charge::cfl, "-", "UNIT 5: feet per unit of length", factor_of_units},
                      {"CFT", &Charge::cft, "-", "UNIT 5: milliseconds per unit of time", factor_of_units},
                      {"CFP", &Charge::cfp, "-", "UNIT 5: psi per unit of pressure", factor_of_units},
                      {"NIDBO", &Charge::nidbo, "-", "node at whose place at the start it is",
                       rules::optional_id_of(IdSpace::node)},
                      {"DEATH", &Charge::death, "T", "when the pressure ends", rules::or_blank(1e20)},
                      {"NEGPHS", &Charge::negphs, "-", "0: suction follows, 1: none", {.allowed = {0, 1}}}}},
          {.fields = {{"VEL", &Charge::vel, "L/T", "speed of the charge", unsupported},
                      {"TEMP", &Charge::temp, "-", "temperature of the air", no_effect},
                      {"RATIO", &Charge::ratio, "-", "aspect ratio of the charge", no_effect},
                      {"VID", &Charge::vid, "-", "direction of the charge", idle_reference(IdSpace::vector)}},
           .when = [](const Charge& b) { return b.blast == 3; }},
          {.fields = {{"GNID", &Charge::gnid, "-", "node on the ground", idle_reference(IdSpace::node)},
                      {"GVID", &Charge::gvid, "-", "normal of the ground", idle_reference(IdSpace::vector)}},
           .when = [](const Charge& b) { return b.blast == 4; }}},
     .convert = keep_units_of_fits<Charge>}};

constexpr FieldRules ambient_part{.honour = Honour::no, .refers = IdSpace::part};
using BlastFaceCard = BlastSegment;
const RegisterKeyword<BlastFaceCard> load_blast_segment{
    {.names = {"LOAD_BLAST_SEGMENT"},
     .purpose =
         "face that a blast pushes; its normal, up where N1 to N4 run counter-clockwise, looks to the charge",
     .cards = {{.fields =
                    {{"BID", &BlastFaceCard::bid, "-", "charge", rules::required_id},
                     {"N1", &BlastFaceCard::n1, "-", "corner", rules::required_id_of(IdSpace::node)},
                     {"N2", &BlastFaceCard::n2, "-", "corner", rules::required_id_of(IdSpace::node)},
                     {"N3", &BlastFaceCard::n3, "-", "corner", rules::required_id_of(IdSpace::node)},
                     {"N4", &BlastFaceCard::n4, "-", "corner; of a triangle N3 or 0",
                      rules::optional_id_of(IdSpace::node)},
                     {"ALEPID", &BlastFaceCard::alepid, "-", "ambient part of an ALE air", ambient_part},
                     {"SFNRB", &BlastFaceCard::sfnrb, "-", "of ambient parts", no_effect},
                     {"SCALEP", &BlastFaceCard::scalep, "-", "factor on the pressure", rules::or_blank(1)}}}},
     .move = [](BlastFaceCard& card, const Affine& motion) {
       if (motion.linear().determinant() < 0) std::swap(card.n1, card.n3);
       return std::string();
     }}};
const RegisterKeyword<BlastSegmentSet> load_blast_segment_set{load_blast_segment_set_table()};

/// Pounds, feet, milliseconds and psi per unit of mass, length, time and pressure, by UNIT - 1; of 5 none.
constexpr Real foot = 0.3048, pound = 0.45359237, psi = 6894.757293168361, slug_dozen = 175.12683524647636;
constexpr std::array<std::array<Real, 4>, 8> factors_of_units{{{1, 1, 1000, 1},
                                                               {1 / pound, 1 / foot, 1000, 1 / psi},
                                                               {slug_dozen / pound, 1.0 / 12, 1000, 1},
                                                               {1e-3 / pound, 0.01 / foot, 1e-3, 1e11 / psi},
                                                               {0, 0, 0, 0},
                                                               {1 / pound, 1e-3 / foot, 1, 1e9 / psi},
                                                               {1e3 / pound, 1e-3 / foot, 1000, 1e6 / psi},
                                                               {1e-3 / pound, 1e-3 / foot, 1, 1e6 / psi}}};

bool read_source(const LoadBlastEnhanced& card, const Deck& deck, const Model& model, BlastSource& out,
                 Diagnostics& diagnostics) {
  const auto error = [&](const char* field, std::string message, const char* hint) {
    deck.error(diagnostics, card, field, std::move(message), hint);
    return false;
  };
  if (card.blast != 1 && card.blast != 2)
    return error("BLAST", fmt::format("'{}' is not supported", card.blast),
                 "1 for a hemisphere on the ground, 2 for a sphere in free air");
  out = {.id = card.bid,
         .kind = card.blast == 1 ? BlastKind::surface : BlastKind::air,
         .mass = card.m,
         .place = Vec(card.xbo, card.ybo, card.zbo),
         .start = card.tbo,
         .death = card.death,
         .positive_only = card.negphs == 1,
         .card = card};
  std::array<Real, 4> factors{card.cfm, card.cfl, card.cft, card.cfp};
  if (card.unit != 5) factors = factors_of_units[static_cast<std::size_t>(card.unit) - 1];
  if (std::any_of(factors.begin(), factors.end(), [](Real f) { return !(f > 0); }))
    return error("CFM", "expected numbers > 0 in CFM, CFL, CFT and CFP beside UNIT 5",
                 "they are pounds, feet, milliseconds and psi per unit of the deck");
  out.pounds = factors[0], out.feet = factors[1], out.milliseconds = factors[2], out.psi = factors[3];
  if (card.nidbo == 0) return true;
  const auto node = std::find_if(model.nodes.begin(), model.nodes.end(),
                                 [&](const ModelNode& one) { return one.id == card.nidbo; });
  if (node == model.nodes.end())
    return error("NIDBO", fmt::format("node {} does not exist", card.nidbo), "define it with *NODE");
  out.place = node->x;
  return true;
}

}  // namespace

Real BlastSource::scaled(Real distance) const {
  return distance * feet / std::cbrt(mass * pounds);
}

std::optional<BlastWave> BlastSource::wave_at(Real distance) const {
  const BlastRange range = blast_range(kind);
  const Real z = scaled(distance);
  if (!(z >= range.least && z <= range.most)) return std::nullopt;
  return blast_wave(kind, mass * pounds, distance * feet);
}

Real BlastSource::pressure(const BlastWave& wave, Real t, Real half, Real cosine) const {
  if (t >= death) return 0;
  const Real now = (t - start) * milliseconds, h = half * milliseconds;
  if (!(h > 0)) return wave.pressure(now, cosine, positive_only) / psi;
  const Real mean =
      (wave.impulse(now + h, cosine, positive_only) - wave.impulse(now - h, cosine, positive_only)) / (2 * h);
  return mean / psi;
}

std::vector<BlastSource> blast_sources(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  std::vector<BlastSource> out;
  for (const LoadBlastEnhanced& card : deck.all<LoadBlastEnhanced>()) {
    const auto same = [&](const BlastSource& one) { return one.id == card.bid; };
    if (std::any_of(out.begin(), out.end(), same))
      deck.error(diagnostics, card, "BID", fmt::format("charge {} is defined twice", card.bid),
                 "give it another number");
    BlastSource source;
    if (read_source(card, deck, model, source, diagnostics)) out.push_back(std::move(source));
  }
  return out;
}

}  // namespace courant
