#pragma once
#include "laws/eos/eos.hpp"
#include "laws/strength/strength.hpp"
#include "model/model.hpp"
#include "sph/sph.hpp"
#include "state/world.hpp"

namespace courant {

/// The material and EOS of one SPH part; one of `eos` and `strength` may be null.
struct PartMaterial {
  bool found = false;
  Real ro = 0;  ///< reference density [M/L3]
  Real pc = 0;  ///< tensile pressure cut-off, <= 0 [M/LT2]
  Real mu = 0;  ///< dynamic viscosity [M/LT]
  std::shared_ptr<EosLaw> eos;
  std::shared_ptr<StrengthLaw> strength;

  /// Sound speed at the start. [L/T]
  Real c0() const;
  /// It has a sound speed without heat, as liquids and solids do, and gases do not.
  bool holds_cold() const { return !eos || eos->sound_speed2(ro, 0, 0) > 0; }
  /// Its pressure at the start is small beside its bulk modulus, not that of a gas or of the products of a
  /// detonation, which expand.
  bool starts_at_rest() const;
  /// The field that sets how nearly incompressible a liquid is; empty: it is none, or compression is the
  /// subject of its equation of state.
  std::string stiffness_field() const;
  SphMaterial for_particles() const;
};

/// Material of every part of the model; parts without particles stay empty. Missing or unsuitable ones are
/// errors.
std::vector<PartMaterial> find_materials(const Deck& deck, const Model& model, Diagnostics& diagnostics);

/// Sets p, c, E of particles with an equation of state from rho, and adds one pass per equation of state to
/// the world. The heat of artificial viscosity and of MU goes into E.
void add_equations_of_state(World& world, const Model& model, const std::vector<PartMaterial>& materials,
                            const SphSettings& s);

/// The power of the artificial viscosity as it goes into E over a step; adds the pass that works it out,
/// where there is one.
const Field<Real>& add_viscous_heat(const SphSettings& s, World& world);

}  // namespace courant
