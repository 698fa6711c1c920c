#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "laws/eos/eos.hpp"
#include "laws/eos/eos_fields.hpp"

namespace courant {

namespace {

/// p = C(eV) + GAMA T(eV) E with eV = ln(V) = -ln(1 + mu); C and T straight between points and beyond the
/// last.
struct Tabulated {
  static constexpr const char* name = "tabulated";
  static constexpr std::size_t most = 10;
  std::array<Real, most> ev, c, t;  // [-], [M/LT2], [-]; ev decreasing: towards compression
  std::size_t count;
  Real gamma;
  Real A(Real mu) const { return at(c, mu); }
  Real dA(Real mu) const { return -slope(c, piece(mu)) / (1 + mu); }
  Real B(Real mu) const { return gamma * at(t, mu); }
  Real dB(Real mu) const { return -gamma * slope(t, piece(mu)) / (1 + mu); }
  bool uses_energy() const {
    for (std::size_t k = 0; k < count; ++k)
      if (gamma * t[k] != 0) return true;
    return false;
  }

 private:
  std::size_t piece(Real mu) const {
    const Real e = -std::log1p(mu);
    std::size_t k = 0;
    while (k + 2 < count && e < ev[k + 1]) ++k;
    return k;
  }
  Real slope(const std::array<Real, most>& y, std::size_t k) const {
    return (y[k + 1] - y[k]) / (ev[k + 1] - ev[k]);
  }
  Real at(const std::array<Real, most>& y, Real mu) const {
    const std::size_t k = piece(mu);
    return y[k] + slope(y, k) * (-std::log1p(mu) - ev[k]);
  }
};

struct EosTabulated : Entry {
  Id eosid = 0, lcc = 0, lct = 0;
  Real gama = 0, E0 = 0, V0 = 1;
  Real ev1 = 0, ev2 = 0, ev3 = 0, ev4 = 0, ev5 = 0, ev6 = 0, ev7 = 0, ev8 = 0, ev9 = 0, ev10 = 0;
  Real c1 = 0, c2 = 0, c3 = 0, c4 = 0, c5 = 0, c6 = 0, c7 = 0, c8 = 0, c9 = 0, c10 = 0;
  Real t1 = 0, t2 = 0, t3 = 0, t4 = 0, t5 = 0, t6 = 0, t7 = 0, t8 = 0, t9 = 0, t10 = 0;
  std::string title;

  /// As in the deck, but towards compression.
  Tabulated law() const {
    Tabulated out{{ev1, ev2, ev3, ev4, ev5, ev6, ev7, ev8, ev9, ev10},
                  {c1, c2, c3, c4, c5, c6, c7, c8, c9, c10},
                  {t1, t2, t3, t4, t5, t6, t7, t8, t9, t10},
                  Tabulated::most,
                  gama};
    auto& n = out.count;  // zeros behind the last point are blank fields
    while (n > 2 && out.ev[n - 1] == 0 && out.c[n - 1] == 0 && out.t[n - 1] == 0) --n;
    if (out.ev[1] > out.ev[0])
      for (auto* column : {&out.ev, &out.c, &out.t}) std::reverse(column->begin(), column->begin() + n);
    return out;
  }
  Real e0() const { return E0; }
  Real v0() const { return V0; }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    const Tabulated table = law();
    for (std::size_t k = 1; k < table.count; ++k)
      if (!(table.ev[k] < table.ev[k - 1]))
        return deck.error(diagnostics, *this, "EV2",
                          fmt::format("expected strains that all rise or all fall, got '{:g}' beside '{:g}'",
                                      table.ev[k], table.ev[k - 1]),
                          "give at least two points, from expansion (EV > 0) to compression (EV < 0)");
  }
};

const FieldRules wide{.width = 16};

#define EV(k)                                                                             \
  FieldOf<EosTabulated> {                                                                 \
    "EV" #k, &EosTabulated::ev##k, "-", "ln(V) of point " #k ", < 0 in compression", wide \
  }
#define C(k)                                                                       \
  FieldOf<EosTabulated> {                                                          \
    "C" #k, &EosTabulated::c##k, "M/LT2", "pressure without energy at EV" #k, wide \
  }
#define T(k)                                                            \
  FieldOf<EosTabulated> {                                               \
    "T" #k, &EosTabulated::t##k, "-", "factor of GAMA E at EV" #k, wide \
  }

// By hand: EV 0.1, 0, -0.5; C -1, 0, 10; T 1, 1, 3; GAMA 1/2, E 4. At eV = -1/4 C = 5, T = 2, p = 5 + 4 = 9;
// at eV = 0.05 C = -1/2, T = 1, p = 3/2; beyond the last point, at eV = -1, C = 20, T = 5, p = 30.
const char* const example = "1,0.5\n0.1,0.0,-0.5\n\n-1.0,0.0,10.0\n\n1.0,1.0,3.0\n\n";
// The same towards expansion, without energy.
const char* const cold = "1,0.5\n-0.5,0.0,0.1\n\n10.0,0.0,-1.0\n\n";
const RegisterEos<EosTabulated> eos_tabulated{
    "p = C(eV) + GAMA T(eV) E, eV = ln V = -ln(rho/RO); C and T straight between points",
    "a table of pressures, Mie-Grueneisen in form",
    {{example, 0.2840254166877414, 4, 9},
     {example, -0.048770575499285991, 4, 1.5},
     {example, 1.718281828459045, 4, 30},
     {cold, 0.2840254166877414, 4, 5},
     {cold, -0.048770575499285991, 4, -0.5}},
    {.names = {"EOS_TABULATED", "EOS_009"},
     .purpose = "pressure from a table over the volumetric strain, with energy",
     .id_space = IdSpace::eos,
     .title_option = true,
     .title = &EosTabulated::title,
     .cards = {
         {.fields = {eosid_field<EosTabulated>(),
                     {"GAMA", &EosTabulated::gama, "-", "factor of T E", {}},
                     {"E0", &EosTabulated::E0, "M/LT2", "initial internal energy per reference volume", {}},
                     v0_field<EosTabulated>(),
                     {"LCC",
                      &EosTabulated::lcc,
                      "-",
                      "curve of C instead of points",
                      {.honour = Honour::no, .refers = IdSpace::curve}},
                     {"LCT",
                      &EosTabulated::lct,
                      "-",
                      "curve of T instead of points",
                      {.honour = Honour::no, .refers = IdSpace::curve}}}},
         {.fields = {EV(1), EV(2), EV(3), EV(4), EV(5)}},
         {.fields = {EV(6), EV(7), EV(8), EV(9), EV(10)}},
         {.fields = {C(1), C(2), C(3), C(4), C(5)}},
         {.fields = {C(6), C(7), C(8), C(9), C(10)}},
         {.fields = {T(1), T(2), T(3), T(4), T(5)}, .optional = true},
         {.fields = {T(6), T(7), T(8), T(9), T(10)}, .optional = true}}}};
#undef EV
#undef C
#undef T

}  // namespace

}  // namespace courant
