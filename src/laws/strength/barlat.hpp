#pragma once
// Sheets that yield differently along the directions a and b of their plane (Barlat & Lian 1989):
//   1/2 (A |K1 + K2|^M + A |K1 - K2|^M + C |2 K2|^M) = q^M <= yield stress^M,
//   K1 = (s_a + H s_b)/2, K2^2 = ((s_a - H s_b)/2)^2 + P^2 s_ab^2.
// With M = 2 it is Hill's surface (1948).
#include <array>
#include <memory>

#include "base/indexed_pieces.hpp"
#include "laws/strength/material_axes.hpp"
#include "laws/strength/strength.hpp"
#include "laws/strength/yield_points.hpp"

namespace courant {

/// The same with coefficients of its own, as other surfaces of the kind have them: K1 = k s, K2^2 = (d s)^2 +
/// t^2 s_ab^2 beside it, and alone K3^2 = (e s)^2 + u^2 s_ab^2 instead of K2, s = (s_a, s_b).
struct SheetSurface {
  Real A = 1, C = 1, M = 2;
  std::array<Real, 2> k{}, d{}, e{};
  Real t = 0, u = 0;
  bool one = false;  ///< K3 is K2
};

struct BarlatSurface {
  SheetSurface sheet() const {
    return {A, C, M, {0.5, 0.5 * H}, {0.5, -0.5 * H}, {0.5, -0.5 * H}, P, P, true};
  }
  Real A = 1, C = 1, H = 1, P = 1;
  Real M = 2;  ///< at least 2
  /// From the ratios of the plastic strain across the tension to that through the thickness, in tension along
  /// a, between a and b, and along b. [-]
  static BarlatSurface of_ratios(Real R00, Real R45, Real R90, Real M);
  /// q^M of these stresses a, b, ab, and its slopes over them.
  Real power(const std::array<Real, 3>& stress, std::array<Real, 3>& slope) const;
  /// Ratio R in tension at this angle to a. [-]
  Real ratio(Real radians) const;
};

/// Points of a block on the return to the surface.
struct BarlatPoints {
  YieldPoints at;
  Real before[block_size];                          ///< plastic strain before the step [-]
  Real a[block_size], b[block_size];                ///< plastic strain of the step along a and b [-]
  Real before_a[block_size], before_b[block_size];  ///< stress before it [M/LT2]
  Real trial_a[block_size], trial_b[block_size], trial_ab[block_size];  ///< of an elastic step [M/LT2]
};

/// Compiled once for each instruction set. `elastic`: aa, ab, G of the plane. [M/LT2]
struct BarlatLoops {
  void (*go)(const std::array<Real, 3>& elastic, const PointBlock& block, BarlatPoints& points);
  /// Yield stresses are there. A step to the surface: whether there are points that were not close to it. Or
  /// with `turning` flow along the normal there, instead of that at the trial stress.
  bool (*step)(bool turning, const SheetSurface& surface, const std::array<Real, 3>& elastic,
               const PointBlock& block, BarlatPoints& points);
  /// Rate zz. `by_plane`: strain zz over the sum of the stresses in the plane. [LT2/M]
  void (*settle)(Real by_plane, const PointBlock& block, const BarlatPoints& points, Real* rate_zz);
};
/// For the machine the program runs on.
BarlatLoops barlat_loops();

/// Yield stress over plastic strain: SIGY + Ep e, K (e0 + e)^N - less, top - range exp(-rate e^power), or a
/// curve.
struct SheetHardening {
  Real yield = 0, slope = 0;                     ///< [M/LT2]
  Real K = 0, e0 = 0, N = 0, less = 0;           ///< K and less [M/LT2]
  Real top = 0, range = 0, rate = 0, power = 1;  ///< of Voce, Hockett and Sherby; top and range [M/LT2]
  IndexedPieces curve{};
};

/// The elastic body of such a sheet.
struct SheetElasticity {
  Real ro, E, nu;  ///< [M/L3], [M/LT2], [-]
};
std::shared_ptr<StrengthLaw> make_sheet(const SheetElasticity& elastic, const SheetSurface& surface,
                                        const MaterialAxes& axes, SheetHardening hardening);
/// What is wrong with a curve of yield stresses, for `field` of a card; nothing is reported where it is
/// right.
void check_sheet_curve(const Deck& deck, const Model& model, const Entry& card, const char* field, Id id,
                       const char* hint, Diagnostics& diagnostics);

/// What cards of such sheets have alike.
struct BarlatCard : DirectionsCard {
  std::string title;
  Id mid = 0, lcid = 0;
  Real ro = 0, E = 0, pr = 0, hr = 1, p1 = 0, p2 = 0, r00 = 0, r45 = 0, r90 = 0, e0 = 0, spi = 0, beta = 0;

  std::shared_ptr<StrengthLaw> law_of(const Model& model, const BarlatSurface& surface) const;
  void check_hardening(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  void check_ratios(const Deck& deck, Diagnostics& diagnostics) const;
  void expect(const Deck& deck, Diagnostics& diagnostics, bool holds, const char* field, const char* what,
              Real value, const char* hint) const;

  /// P2 of HR 1 and SPI above `largest_strain` are stresses.
  static constexpr Real largest_strain = 0.02;
  void convert_stresses(const Conversion& conversion);

 private:
  bool spi_is_stress_ = false;  ///< known before it was converted
  Real first_strain() const;
};

template <class C>
std::string convert_hardening(C& card, const Conversion& conversion) {
  card.convert_stresses(conversion);
  return "";
}

}  // namespace courant
