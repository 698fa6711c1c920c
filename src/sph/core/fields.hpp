#pragma once
// Fields that several SPH passes share, each described in one position. A field exists once a pass asks for
// it.
#include <string>

#include "state/entities.hpp"
#include "state/shared_fields.hpp"

namespace courant::sph_fields {

/// Symmetric velocity gradient: xx yy zz xy yz zx
inline Field<Real>& strain_rate(Particles& p) {
  return p.fields.add<Real>({.name = "strain_rate", .dimension = "1/T", .components = 6, .restart = false});
}
inline Field<Real>& stress(Particles& p) {
  return shared_fields::stress.add(p.fields);
}

/// Half of the curl of the velocity
inline Field<Real>& spin(Particles& p) {
  return p.fields.add<Real>({.name = "spin", .dimension = "1/T", .components = 3, .restart = false});
}
/// Of the law of strength: Cauchy stress, the deviator where the part has an equation of state
inline Field<Real>& law_stress(Particles& p) {
  return p.fields.add<Real>({.name = "law_stress", .dimension = "M/LT2", .components = 6});
}
/// Against tension, as it acts between particles that are at their first distance
inline Field<Real>& artificial_stress(Particles& p) {
  return p.fields.add<Real>({.name = "artificial_stress",
                             .dimension = "M/LT2",
                             .components = 6,
                             .restart = false,
                             .exchange = true});
}
inline Field<Real>& artificial_stress_force(Particles& p) {
  return p.fields.add<Real>(
      {.name = "artificial_stress_force", .dimension = "ML/T2", .components = 3, .restart = false});
}
/// q1 c at the last motion; c for a Riemann flux
inline Field<Real>& viscous_speed(Particles& p) {
  return p.fields.add<Real>(
      {.name = "viscous_speed", .dimension = "L/T", .restart = false, .exchange = true});
}
/// MU and eddy viscosity, of the last materials
inline Field<Real>& viscosity(Particles& p) {
  return p.fields.add<Real>({.name = "viscosity", .dimension = "M/LT", .exchange = true});
}
/// nu_t of a turbulence model
inline Field<Real>& eddy_viscosity(Particles& p) {
  return p.fields.add<Real>(
      {.name = "eddy_viscosity", .dimension = "L2/T", .output = true, .exchange = true});
}
/// k and epsilon of k-epsilon models
inline Field<Real>& turbulent_energy(Particles& p) {
  return p.fields.add<Real>(
      {.name = "turbulent_energy", .dimension = "L2/T2", .output = true, .exchange = true});
}
inline Field<Real>& turbulent_dissipation(Particles& p) {
  return p.fields.add<Real>(
      {.name = "turbulent_dissipation", .dimension = "L2/T3", .output = true, .exchange = true});
}
/// p + q of the bulk viscosity
inline Field<Real>& pressure_plus_q(Particles& p) {
  return p.fields.add<Real>(
      {.name = "pressure_plus_q", .dimension = "M/LT2", .restart = false, .exchange = true});
}
/// Rate of density by diffusion, of the last forces: the next rates take it.
inline Field<Real>& density_diffusion(Particles& p) {
  return p.fields.add<Real>({.name = "density_diffusion", .dimension = "M/L3T"});
}
/// Rate of density by volume control, of its last evaluation.
inline Field<Real>& volume_rate(Particles& p) {
  return p.fields.add<Real>({.name = "volume_rate", .dimension = "M/L3T"});
}
/// Inverse of the moment matrix, or 1, less 1
inline Field<Real>& renormalisation(Particles& p) {
  return p.fields.add<Real>({.name = "renormalisation", .dimension = "-", .components = 6, .exchange = true});
}
/// Moment matrix sum_j V_j (x_j - x_i) (x) grad W_ij
inline Field<Real>& moment(Particles& p) {
  return p.fields.add<Real>({.name = "moment", .dimension = "-", .components = 6, .restart = false});
}
/// sum_j V_j v_ij (x) grad W_ij, symmetric part
inline Field<Real>& plain_gradient(Particles& p) {
  return p.fields.add<Real>(
      {.name = "plain_gradient", .dimension = "1/T", .components = 6, .restart = false});
}
/// Rate of density that re-initialises it within a step.
inline Field<Real>& reinitialisation_rate(Particles& p) {
  return p.fields.add<Real>({.name = "reinitialisation_rate", .dimension = "M/L3T", .restart = false});
}
/// Of body loads, -g.x where they are gravity; ghosts have that of their particle, as they have its pressure.
inline Field<Real>& potential(Particles& p) {
  return p.fields.add<Real>({.name = "potential", .dimension = "L2/T2", .exchange = true});
}
/// sum_j V_j (x_j - x_i).grad W_ij, 2 or 3 inside, of the last rates, as neighbours read it.
inline Field<Real>& spread(Particles& p) {
  return p.fields.add<Real>({.name = "spread", .dimension = "-", .exchange = true});
}
/// The same of the present rates.
inline Field<Real>& new_spread(Particles& p) {
  return p.fields.add<Real>({.name = "new_spread", .dimension = "-", .restart = false});
}
/// Gradient of the concentration of particles, with the term against pairs
inline Field<Real>& shift_gradient(Particles& p) {
  return p.fields.add<Real>(
      {.name = "shift_gradient", .dimension = "1/L", .components = 3, .restart = false});
}
/// Gradient of the spread: towards the water
inline Field<Real>& surface_normal(Particles& p) {
  return p.fields.add<Real>(
      {.name = "surface_normal", .dimension = "1/L", .components = 3, .restart = false});
}
/// > 0 where a surface is within reach
inline Field<Real>& surface_near(Particles& p) {
  return p.fields.add<Real>({.name = "surface_near", .dimension = "-", .restart = false});
}
/// Sum of kernels, sum_j V_j W_ij
inline Field<Real>& filling(Particles& p) {
  return p.fields.add<Real>({.name = "filling", .dimension = "-", .restart = false});
}
/// Gradient of component k of the velocity
inline Field<Real>& velocity_gradient(Particles& p, int k) {
  return p.fields.add<Real>({.name = std::string("velocity_gradient_") + "xyz"[k],
                             .dimension = "1/T",
                             .components = 3,
                             .restart = false});
}
/// Rate of density by the last drift
inline Field<Real>& drift_rate(Particles& p) {
  return p.fields.add<Real>({.name = "drift_rate", .dimension = "M/L3T", .restart = false});
}
/// Pressure before the materials of this step
inline Field<Real>& pressure_before(Particles& p) {
  return p.fields.add<Real>({.name = "pressure_before", .dimension = "M/LT2", .restart = false});
}
/// Change of positions in the last step besides the velocity
inline Field<Real>& drifted(Particles& p) {
  return p.fields.add<Real>({.name = "drifted", .dimension = "L/T", .components = 3, .exchange = true});
}
/// 1/theta(dx/h) at the start, without the constant of theta
inline Field<Real>& kernel_at_spacing(Particles& p) {
  return p.fields.add<Real>({.name = "kernel_at_spacing", .dimension = "-", .exchange = true});
}
/// int n W dS over the walls in sight, n out of the water
inline Field<Real>& wall_slope(Particles& p) {
  return p.fields.add<Real>({.name = "wall_slope", .dimension = "1/L", .components = 3, .restart = false});
}
/// Of the kernel's integral, what lies behind walls
inline Field<Real>& wall_fill(Particles& p) {
  return p.fields.add<Real>({.name = "wall_fill", .dimension = "-", .restart = false});
}
/// int CF W dS
inline Field<Real>& wall_rubbing(Particles& p) {
  return p.fields.add<Real>({.name = "wall_rubbing", .dimension = "1/L", .restart = false});
}
/// What walls add to `moment`: int (x' - x) (x) n W dS + wall_fill
inline Field<Real>& wall_moment(Particles& p) {
  return p.fields.add<Real>({.name = "wall_moment", .dimension = "-", .components = 6, .restart = false});
}
/// What walls add to `plain_gradient`: 2 int (v - v_wall) (x) n W dS, symmetric part
inline Field<Real>& wall_gradient(Particles& p) {
  return p.fields.add<Real>({.name = "wall_gradient", .dimension = "1/T", .components = 6, .restart = false});
}
/// Force of images in walls
inline Field<Real>& wall_force(Particles& p) {
  return p.fields.add<Real>({.name = "wall_force", .dimension = "ML/T2", .components = 3, .restart = false});
}
/// What is left out of how shares of ways change at edges, which past them have no water: 0 nothing, 1 all
inline Field<Real>& edge_loss(Particles& p) {
  return p.fields.add<Real>({.name = "edge_loss", .dimension = "-", .exchange = true});
}
/// Force of MU between pairs and with walls that hold water fast
inline Field<Real>& viscous_force(Particles& p) {
  return p.fields.add<Real>(
      {.name = "viscous_force", .dimension = "ML/T2", .components = 3, .restart = false});
}
/// That of walls by viscosity, where they hold water fast
inline Field<Real>& wall_drag(Particles& p) {
  return p.fields.add<Real>({.name = "wall_drag", .dimension = "ML/T2", .components = 3, .restart = false});
}
/// Of `wall_velocity`, what belts have beyond their shells
inline Field<Real>& wall_slide(Particles& p) {
  return p.fields.add<Real>({.name = "wall_slide", .dimension = "L/T", .components = 3, .restart = false});
}
/// Mean velocity of the walls in sight, each by its friction
inline Field<Real>& wall_velocity(Particles& p) {
  return p.fields.add<Real>({.name = "wall_velocity", .dimension = "L/T", .components = 3, .restart = false});
}
/// Power that artificial viscosity turns into heat
inline Field<Real>& dissipation(Particles& p) {
  return p.fields.add<Real>({.name = "dissipation", .dimension = "ML2/T3"});
}
/// That of bulk viscosity alone, of the step before until it is worked out again
inline Field<Real>& bulk_dissipation(Particles& p) {
  return p.fields.add<Real>({.name = "bulk_dissipation", .dimension = "ML2/T3"});
}
/// What the rate of density holds besides the motion of particles
inline Field<Real>& density_sources(Particles& p) {
  return p.fields.add<Real>({.name = "density_sources", .dimension = "M/L3T", .restart = false});
}
/// The same as equations of state take it over a step, made of the forces at both of its ends; and of the
/// last rates F, and its power more by F.v, so that less F.v' it is what F takes from velocities v'.
inline Field<Real>& viscous_heat(Particles& p) {
  return p.fields.add<Real>({.name = "viscous_heat", .dimension = "ML2/T3", .restart = false});
}
inline Field<Real>& last_viscous_force(Particles& p) {
  return p.fields.add<Real>({.name = "last_viscous_force", .dimension = "ML/T2", .components = 3});
}
inline Field<Real>& last_viscous_power(Particles& p) {
  return p.fields.add<Real>({.name = "last_viscous_power", .dimension = "ML2/T3"});
}
/// Pressure below which an equation of state is cut off, of materials with strength beside it: particles that
/// have spalled bear no tension
inline Field<Real>& least_pressure(Particles& p) {
  return p.fields.add<Real>({.name = "least_pressure", .dimension = "M/LT2"});
}
/// Power that MU turns into heat
inline Field<Real>& viscous_dissipation(Particles& p) {
  return p.fields.add<Real>({.name = "viscous_dissipation", .dimension = "ML2/T3"});
}

}  // namespace courant::sph_fields
