#include <cmath>
#include <memory>

#include "laws/eos/eos.hpp"
#include "laws/eos/volume_table.hpp"

namespace courant {

namespace {

/// p = C(eV) + GAMA T(eV) E with eV = ln(V) = -ln(1 + mu).
struct Tabulated {
  static constexpr const char* name = "tabulated";
  struct Tables {
    VolumeTable C, T;
  };
  std::shared_ptr<const Tables> tables;
  Real gamma;
  Real A(Real mu) const { return tables->C(std::log1p(mu)); }
  Real dA(Real mu) const { return tables->C.slope(std::log1p(mu)) / (1 + mu); }
  Real B(Real mu) const { return gamma * tables->T(std::log1p(mu)); }
  Real dB(Real mu) const { return gamma * tables->T.slope(std::log1p(mu)) / (1 + mu); }
  bool uses_energy() const { return gamma != 0 && !tables->T.is_zero(); }
  const char* stiffness_field() const { return ""; }
};

struct EosTabulated : VolumePoints {
  VolumeTable pressures(const Model& model) const { return volume_table(model, lcc, *this, {c(), t()}, c()); }
  VolumeTable factors(const Model& model) const { return volume_table(model, lct, *this, {c(), t()}, t()); }
  Tabulated law(const Model& model) const {
    return {std::make_shared<Tabulated::Tables>(Tabulated::Tables{pressures(model), factors(model)}), gama};
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    if (!check_volume_table(deck, *this, "LCC", lcc, pressures(model), diagnostics)) return;
    if (gama != 0 && (lct != 0 || lcc != 0) && !(lct == 0 && factors(model).is_zero()))
      check_volume_table(deck, *this, "LCT", lct, factors(model), diagnostics);
  }
};

// By hand: EV 0.1, 0, -0.5; C -1, 0, 10; T 1, 1, 3; GAMA 1/2, E 4. At eV = -1/4 C = 5, T = 2, p = 5 + 4 = 9;
// at eV = 0.05 C = -1/2, T = 1, p = 3/2; beyond the last point, at eV = -1, C = 20, T = 5, p = 30.
const char* const example = "1,0.5\n0.1,0.0,-0.5\n\n-1.0,0.0,10.0\n\n1.0,1.0,3.0\n\n";
// The same towards expansion, without energy.
const char* const cold = "1,0.5\n-0.5,0.0,0.1\n\n10.0,0.0,-1.0\n\n";
// Towards 0, where nothing but the strain before shows that there is a point.
const char* const to_rest = "1\n-0.5,-0.25\n\n10.0,1.0\n\n";
// The first one by curves, over -eV.
const char* const by_curves =
    "1,0.5,0.0,1.0,7,8\n*DEFINE_CURVE\n7\n-0.1,-1.0\n0.0,0.0\n0.5,10.0\n*DEFINE_CURVE\n8\n0.0,1.0\n0.5,3.0\n";
const RegisterEos<EosTabulated> eos_tabulated{
    "p = C(eV) + GAMA T(eV) E, eV = ln V = -ln(rho/RO); C and T straight between points",
    "a table of pressures, Mie-Grueneisen in form",
    {{example, 0.2840254166877414, 4, 9},
     {example, -0.048770575499285991, 4, 1.5},
     {example, 1.718281828459045, 4, 30},
     {cold, 0.2840254166877414, 4, 5},
     {cold, -0.048770575499285991, 4, -0.5},
     {to_rest, 0.133148453066826, 0, 0.5},
     {by_curves, 0.2840254166877414, 4, 9}},
    eos_tabulated_table()};

}  // namespace

}  // namespace courant
