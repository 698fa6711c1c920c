#include "loads/blast/blast_cards.hpp"
#include "loads/load_cards.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<LoadBlastEnhanced> load_blast_enhanced{load_blast_enhanced_table()};
const RegisterKeyword<BlastSegment> load_blast_segment{load_blast_segment_table()};
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

/// Mass, places and time are converted, and those of the fits are not.
std::string keep_units_of_fits(LoadBlastEnhanced&, const Conversion& conversion) {
  return conversion.units.any() ? "the units of a blast are those that UNIT names" : "";
}

std::string keep_side_of_blast(BlastSegment& card, const Affine& motion) {
  if (motion.linear().determinant() < 0) std::swap(card.n1, card.n3);
  return {};
}

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
    source.refused = !read_source(card, deck, model, source, diagnostics);
    source.id = card.bid;
    out.push_back(std::move(source));
  }
  return out;
}

}  // namespace courant
