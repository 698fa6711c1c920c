// ELFORM 60 of *SECTION_SOLID: the tetrahedron of four nodes with one point, which computes what ELFORM 10
// does.
#include <algorithm>
#include <cmath>

#include "elements/solid/formulation.hpp"
#include "extension/compiled_against.hpp"
#include "laws/objective.hpp"

namespace {

using namespace courant;

/// Edges from the first corner as columns, kept in the first nine rows of the scratch.
Matrix kept(const Real (*rows)[block_size], Index i) {
  Matrix out;
  for (int m = 0; m < 3; ++m)
    for (int k = 0; k < 3; ++k) out(k, m) = rows[3 * m + k][i];
  return out;
}
/// dV/dx of the last three corners as columns. [L2]
Matrix volume_slopes(const Matrix& r) {
  Matrix out;
  for (int m = 0; m < 3; ++m) {
    const Vec a = r.col((m + 1) % 3), b = r.col((m + 2) % 3);
    out.col(m) = a.cross(b) / 6;
  }
  return out;
}
/// Volume over the largest face. [L]
Real thickness(const Matrix& r) {
  const Matrix b = 3 * volume_slopes(r);  // areas
  const Vec last = b.rowwise().sum();
  return r.determinant() / 6 / std::max(last.norm(), b.colwise().norm().maxCoeff());
}

/// The stress work of one end of the step: power of D, with the mean stress through `opened` where it heats.
Real half_work(const Real s[6], Index i, Real dt, int end, bool heats, const SolidScratch& scratch) {
  const auto& D = scratch.rate;
  const Real half = 0.5 * dt * scratch.middle_volume[i];
  Real power = 0;
  for (int k = 0; k < 6; ++k) power += (k < 3 ? 1 : 2) * s[k] * D[k][i];
  Real out = half * power;
  if (heats)
    out += (s[0] + s[1] + s[2]) / 3 * (scratch.opened[end][i] - half * (D[0][i] + D[1][i] + D[2][i]));
  return out;
}

void strain(const ElementBlock& block, const SolidMesh& mesh, const SolidControl&, const SolidState& state,
            SolidScratch& scratch) {
  for (Index i = 0; i < block.count; ++i) {
    const Index e = block.begin + i;
    for (int m = 0; m < 3; ++m)
      for (int k = 0; k < 3; ++k) {
        const Index n = mesh.corner[m + 1][e], first = mesh.corner[0][e];
        scratch.position[3 * m + k][i] = mesh.x[k][n] - mesh.x[k][first];
        scratch.speed[3 * m + k][i] = mesh.v[k][n] - mesh.v[k][first];
      }
    const Matrix r = kept(scratch.position, i), w = kept(scratch.speed, i), middle = r - 0.5 * block.dt * w;
    scratch.compression[i] = 6 * state.V0[e] / r.determinant() - 1;
    for (int end = 0; state.heats && end < 2; ++end)
      scratch.opened[end][i] =
          0.5 * block.dt * volume_slopes(r - (1 - end) * block.dt * w).cwiseProduct(w).sum();
    scratch.middle_volume[i] = middle.determinant() / 6;
    const Matrix L = w * middle.inverse();
    Real D[6] = {L(0, 0),
                 L(1, 1),
                 L(2, 2),
                 0.5 * (L(0, 1) + L(1, 0)),
                 0.5 * (L(1, 2) + L(2, 1)),
                 0.5 * (L(2, 0) + L(0, 2))};
    const Vec h = 0.25 * block.dt * Vec(L(2, 1) - L(1, 2), L(0, 2) - L(2, 0), L(1, 0) - L(0, 1));
    turn_rate(h[0], h[1], h[2], D[0], D[1], D[2], D[3], D[4], D[5]);
    const auto turn = [&](Real* const tensor[6]) {
      turn_tensor(h[0], h[1], h[2], tensor[0][e], tensor[1][e], tensor[2][e], tensor[3][e], tensor[4][e],
                  tensor[5][e]);
    };
    turn(state.stress);
    for (int t = 0; t < state.tensors; ++t) turn(state.tensor[t]);
    Real s[6];
    for (int k = 0; k < 6; ++k) scratch.rate[k][i] = D[k], s[k] = state.stress[k][e];
    for (int k = 0; k < 3; ++k) scratch.half_turn[k][i] = h[k];
    scratch.work[i] = half_work(s, i, block.dt, 0, state.heats, scratch);
  }
}

void work(const ElementBlock& block, const SolidState& state, SolidScratch& scratch) {
  for (Index i = 0; i < block.count; ++i) {
    Real s[6];
    for (int k = 0; k < 6; ++k) s[k] = state.stress[k][block.begin + i];
    scratch.work[i] += half_work(s, i, block.dt, 1, state.heats, scratch);
  }
}

StableStep forces(const ElementBlock& block, const SolidControl& control, const SolidState& state,
                  SolidScratch& scratch) {
  for (Index i = 0; i < block.count; ++i) {
    const Index e = block.begin + i;
    const Matrix r = kept(scratch.position, i), b = volume_slopes(r);
    const Real V = r.determinant() / 6, length = thickness(r), c = scratch.sound_speed[i], l = std::cbrt(V);
    const Real trace = scratch.rate[0][i] + scratch.rate[1][i] + scratch.rate[2][i];
    const Real rho = state.rho0[e] * state.V0[e] / V, closing = std::max<Real>(-trace, 0);
    const Real of_speed = control.Q2 * c + control.Q1 * l * closing;
    Real q = rho * l * closing * of_speed;
    const Real Q = (closing > 0 ? l / length * of_speed : 0) + 4.0 / 3 * control.MU / (rho * length);
    scratch.relative_volume[i] = V / state.V0[e];
    scratch.step_limit[i] = length / (Q + std::sqrt(Q * Q + c * c)), scratch.wave_time[i] = length / c;
    if (state.heats) {
      q = state.viscous_pressure[e];
    } else if (state.viscous_pressure) {
      state.bulk_viscosity_energy[e] -=
          0.5 * block.dt * scratch.middle_volume[i] * trace * (q + state.viscous_pressure[e]);
      state.viscous_pressure[e] = q;
    }
    const auto s = [&](int k) { return state.stress[k][e]; };
    Matrix T;
    T << s(0) - q, s(3), s(5), s(3), s(1) - q, s(4), s(5), s(4), s(2) - q;
    const Matrix f = -T * b;
    const Vec first = -f.rowwise().sum();
    for (int k = 0; k < 3; ++k) {
      state.corner_force[k][e] = first[k];
      for (int m = 0; m < 3; ++m) state.corner_force[3 * (m + 1) + k][e] = f(k, m);
    }
    if (state.internal_energy) state.internal_energy[e] += scratch.work[i];
  }
  const auto least = [&](const Real* values) {
    Index at = 0;
    for (Index i = 1; i < block.count; ++i)
      if (!(values[i] >= values[at]) && values[at] == values[at]) at = i;
    return at;
  };
  const Index shortest = least(scratch.step_limit), smallest = least(scratch.relative_volume);
  return {scratch.step_limit[shortest], block.begin + shortest, scratch.relative_volume[smallest],
          block.begin + smallest};
}

/// Bulk viscosity beside an equation of state is the same for all.
OnePointLoops tetrahedron_loops() {
  return {&strain, hexahedron_loops().viscosity, &work, &forces};
}

const RegisterSolidFormulation registered{
    {.elforms =
         {{.number = 60, .nodes = 4, .shape = "tetrahedra", .offer = "60 (tetrahedra of four corners)"}},
     .corners = 4,
     .one_point = &tetrahedron_loops}};

}  // namespace
