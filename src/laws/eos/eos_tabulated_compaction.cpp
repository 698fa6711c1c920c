#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "laws/eos/eos.hpp"
#include "laws/eos/volume_table.hpp"

namespace courant {

namespace {

/// What crushes and does not come back: with eV = ln(V) and the least it ever was, eC,
///   p = C(eC) - K(eC) (eV - eC) + GAMA T(eV) E.
/// Where eV = eC that is the curve C; back from there, and up to there again, p goes along K.
struct Compaction {
  static constexpr const char* name = "tabulated compaction";
  static constexpr const char* memory = "greatest_compression";
  struct Tables {
    VolumeTable C, T, K;
  };
  std::shared_ptr<const Tables> tables;
  Real gamma;
  Real A(Real mu, Real most) const {
    const Real e = std::log1p(most);
    return tables->C(e) + (mu < most ? tables->K.held(e) * (std::log1p(mu) - e) : 0);
  }
  Real dA(Real mu, Real most) const {
    const Real e = std::log1p(most);
    return (mu < most ? tables->K.held(e) : tables->C.slope(e)) / (1 + mu);
  }
  /// Of the steeper of the two ways from a point of the curve.
  Real stiffness(Real mu, Real most) const {
    const Real e = std::log1p(most), K = tables->K.held(e);
    return (mu < most ? K : std::max(K, tables->C.slope(e))) / (1 + mu);
  }
  Real B(Real mu) const { return gamma * tables->T(std::log1p(mu)); }
  Real dB(Real mu) const { return gamma * tables->T.slope(std::log1p(mu)) / (1 + mu); }
  bool uses_energy() const { return gamma != 0 && !tables->T.is_zero(); }
  const char* stiffness_field() const { return ""; }
};

struct EosTabulatedCompaction : VolumePoints {
  Column k() const { return {k1, k2, k3, k4, k5, k6, k7, k8, k9, k10}; }
  VolumeTable table(const Model& model, Id id, const Column& column) const {
    return volume_table(model, id, *this, {c(), t(), k()}, column);
  }
  Compaction law(const Model& model) const {
    return {std::make_shared<Compaction::Tables>(
                Compaction::Tables{table(model, lcc, c()), table(model, lct, t()), table(model, lck, k())}),
            gama};
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};
using Table008 = EosTabulatedCompaction;

void Table008::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const VolumeTable C = table(model, lcc, c()), T = table(model, lct, t()), K = table(model, lck, k());
  if (!check_volume_table(deck, *this, "LCC", lcc, C, diagnostics) ||
      !check_volume_table(deck, *this, "LCK", lck, K, diagnostics))
    return;
  if (gama != 0 && !(lct == 0 && T.is_zero()) && !check_volume_table(deck, *this, "LCT", lct, T, diagnostics))
    return;
  const char* field = lck != 0 ? "LCK" : "K1";
  const auto least = std::min_element(K.value().begin(), K.value().end());
  if (!(*least > 0))
    return deck.error(diagnostics, *this, field,
                      fmt::format("expected bulk moduli > 0 at all points, got '{:g}'", *least),
                      "K is the modulus along which the pressure falls when the volume grows again");
  for (std::size_t k = 0; k + 1 < C.strain().size(); ++k) {
    const Real e = C.strain()[k], slope = C.slope(std::nextafter(e, C.strain()[k + 1]));
    constexpr Real round_off = 1e-9;
    if (C.strain()[k + 1] <= 0 || slope <= K.held(std::max(e, Real(0))) * (1 + round_off)) continue;
    return deck.warning(
        diagnostics, *this, field,
        fmt::format(
            "K = {:g} at ln(V) = {:g} is less steep than C, which rises by {:g}: what is unloaded there "
            "gives back more than it took",
            K.held(std::max(e, Real(0))), -std::max(e, Real(0)), slope),
        "K is at least -dC/d ln(V)");
  }
}

// By hand, on the first way in: EV 0, -0.1, -0.5; C 0, 1, 10; T 1, 1, 3; K 20, 20, 40; GAMA 1/2, E 4. At eV =
// -0.3 C = 5.5, T = 2, p = 9.5. Expanded, along K of rest: at eV = 0.05 p = -1 + 2 = 1, T still being 1.
const char* const crushed = "1,0.5\n0.0,-0.1,-0.5\n\n0.0,1.0,10.0\n\n1.0,1.0,3.0\n\n20.0,20.0,40.0\n\n";
const char* const crushed_by_curves =
    "1,0.5,0.0,1.0,7,8,9\n*DEFINE_CURVE\n7\n0.0,0.0\n0.1,1.0\n0.5,10.0\n*DEFINE_CURVE\n8\n0.0,1.0\n0.1,1.0\n"
    "0.5,3.0\n*DEFINE_CURVE\n9\n0.0,20.0\n0.5,40.0\n";
const RegisterEos<Table008> eos_tabulated_compaction{
    "p = C(eC) - K(eC) (eV - eC) + GAMA T(eV) E, eV = ln V = -ln(rho/RO), eC the least eV so far",
    "LS-DYNA's EOS 8: a table of crushing, and back along its bulk moduli",
    {{crushed, 0.3498588075760032, 4, 9.5},
     {crushed, -0.048770575499285991, 4, 1},
     {crushed_by_curves, 0.3498588075760032, 4, 9.5},
     {crushed_by_curves, -0.048770575499285991, 4, 1}},
    eos_tabulated_compaction_table()};

}  // namespace

std::optional<CompactionCurves> compaction_curves(const Deck& deck, const Model& model, Id eosid) {
  for (const EosTabulatedCompaction& card : deck.all<EosTabulatedCompaction>()) {
    if (card.eosid != eosid) continue;
    const bool cold = card.gama == 0 || (card.lct == 0 && card.table(model, 0, card.t()).is_zero());
    return CompactionCurves{card.table(model, card.lcc, card.c()), card.table(model, card.lck, card.k()),
                            cold && card.V0 == 1};
  }
  return std::nullopt;
}

}  // namespace courant
