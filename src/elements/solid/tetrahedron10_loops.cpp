// The tetrahedron of ten nodes with four points (ELFORM 16), compiled once for each instruction set; see
// docs/architecture.md and hexahedron_loops.cpp.
//
// With xi_1, xi_2, xi_3 the coordinates of nodes 2, 3, 4, positions are quadratic, so that their derivatives
// r_i = dx/dxi_i are linear: at point 0, beside node 1, they are B_i, at point j, beside node j + 1, B_i +
// E_ij with E_ij = E_ji of the second derivatives. These nine vectors are what the loops keep of positions
// and velocities. Points of weight 1/24 have coordinates 1/4 +- sqrt(5)/20 (Hammer, Marlowe and Stroud 1956).
//
// Of the trace of D the law sees the mean over the element and, of what the points differ from it,
// SolidControl::dilatation; the mean stress acts through the same. With 1 the element is the usual one, which
// nearly incompressible bodies lock, as four points ask more than the nodes can give; with 0 the quadratic
// motions that change angles nowhere (conformal ones) would have no stiffness. sqrt(13 G/(6 K)), at most 1,
// leaves these motions as stiff as in a body with a Poisson's ratio of 0.3.
#include "elements/solid/solid_math.hpp"
#ifdef COURANT_ONCE
#include "base/instruction_set.hpp"
#include "elements/solid/formulation.hpp"
#endif

namespace courant::COURANT_SIMD {

namespace {

constexpr int corners = 10, vectors = 9, points = 4;
constexpr Real weight = 1.0 / 24;
constexpr Real reach = 0.44721359549995793928;  ///< of second derivatives in E, 1/sqrt(5)

/// Number of E_ij among the nine vectors.
constexpr int bent(int i, int j) {
  constexpr int at[3][3] = {{3, 6, 8}, {6, 4, 7}, {8, 7, 5}};
  return at[i][j];
}
/// The node on the edge of nodes 1 and i + 2; and of nodes i + 2 and j + 2.
constexpr int from_first[3] = {4, 6, 7};
constexpr int between(int i, int j) {
  constexpr int at[3][3] = {{-1, 5, 8}, {5, -1, 9}, {8, 9, -1}};
  return at[i][j];
}
constexpr int pairs[3][2] = {{0, 1}, {1, 2}, {2, 0}};

/// The nine vectors of one component at the corners.
COURANT_INLINE void vectors_of(const Native p[corners], Native out[vectors]) {
  Native first[3];
  for (int i = 0; i < 3; ++i) {
    first[i] = p[0] - p[from_first[i]];
    out[bent(i, i)] = (4 * reach) * (first[i] + (p[1 + i] - p[from_first[i]]));
  }
  for (const auto& [i, j] : pairs)
    out[bent(i, j)] = (4 * reach) * (first[i] + (p[between(i, j)] - p[from_first[j]]));
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    const Native middle = (p[between(i, j)] - p[from_first[j]]) + (p[between(i, l)] - p[from_first[l]]);
    out[i] = middle - 0.25 * (out[bent(i, 0)] + out[bent(i, 1)] + out[bent(i, 2)]);
  }
}

/// The transpose: forces on the nodes of forces on the nine vectors.
COURANT_INLINE void nodal(const Native F[vectors], Native out[corners]) {
  Native second[vectors];
  for (int i = 0; i < 3; ++i) {
    second[bent(i, i)] = (4 * reach) * (F[bent(i, i)] - 0.25 * F[i]);
    out[1 + i] = second[bent(i, i)];
    out[from_first[i]] = -2.0 * out[1 + i] - (F[0] + F[1] + F[2] - F[i]);
  }
  out[0] = out[1] + out[2] + out[3];
  for (const auto& [i, j] : pairs) {
    const Native both = F[i] + F[j];
    second[bent(i, j)] = (4 * reach) * (F[bent(i, j)] - 0.25 * both);
    out[between(i, j)] = second[bent(i, j)] + both;
    out[from_first[i]] -= second[bent(i, j)], out[from_first[j]] -= second[bent(i, j)];
    out[0] += second[bent(i, j)];
  }
}

/// r_1, r_2, r_3 at a point.
COURANT_INLINE void slopes(const Triple a[vectors], int point, Triple out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = point == 0 ? a[i] : a[i] + a[bent(i, point - 1)];
}
COURANT_INLINE void kept(const Real (*rows)[block_size], Index k, Triple out[vectors]) {
  for (int m = 0; m < vectors; ++m) out[m] = triple(rows + 3 * m, k);
}

COURANT_INLINE void gather_of(Index first, Index n, Index k, const SolidMesh& mesh, const SolidState& state,
                              PointScratch& scratch) {
  Native px[3][corners], pv[3][corners];
  gather_corners(mesh, first, n, px, pv);
  for (int d = 0; d < 3; ++d) {
    Native x[vectors], v[vectors];
    vectors_of(px[d], x), vectors_of(pv[d], v);
    for (int m = 0; m < vectors; ++m)
      store(scratch.position[3 * m + d] + k, x[m]), store(scratch.speed[3 * m + d] + k, v[m]);
  }
  Triple a[vectors], r[3], C[3];
  kept(scratch.position, k, a);
  Native sum = all(0);
  for (int p = 0; p < points; ++p) slopes(a, p, r), sum += cofactors(r, C);
  store(scratch.compression + k, load(state.V0 + first, n) / (weight * sum) - 1.0);
}

/// V and dV/dt with the positions `later` steps from the end of the step.
struct Opening {
  Native V, rate;
};
COURANT_INLINE Opening opening_at(Index k, Real dt, Real later, const PointScratch& scratch) {
  Triple a[vectors], w[vectors], r[3], u[3], C[3];
  kept(scratch.position, k, a), kept(scratch.speed, k, w);
  for (int m = 0; m < vectors; ++m) a[m] = a[m] + (later * dt) * w[m];
  Opening out{all(0), all(0)};
  for (int p = 0; p < points; ++p) {
    slopes(a, p, r), slopes(w, p, u);
    out.V += weight * cofactors(r, C);
    out.rate += weight * (dot(C[0], u[0]) + dot(C[1], u[1]) + dot(C[2], u[2]));
  }
  return out;
}

COURANT_INLINE void begin_of(Index k, Real dt, bool heats, PointScratch& scratch) {
  if (heats)
    for (int end = 0; end < 2; ++end)
      store(scratch.opened[end] + k, (0.5 * dt) * opening_at(k, dt, end - 1.0, scratch).rate);
  const Opening middle = opening_at(k, dt, -0.5, scratch);
  store(scratch.mean_trace + k, middle.rate / middle.V);
  store(scratch.middle_volume + k, middle.V);
  for (auto& force : scratch.force) store(force + k, all(0));
  store(scratch.pressure + k, all(0)), store(scratch.fastest + k, all(0)), store(scratch.work + k, all(0));
}

COURANT_INLINE void strain_of(Index first, Index n, Index k, Real dt, int point, const SolidControl& control,
                              const SolidState& state, PointScratch& scratch) {
  Triple a[vectors], w[vectors], r[3], u[3], C[3];
  kept(scratch.position, k, a), kept(scratch.speed, k, w);
  for (int m = 0; m < vectors; ++m) a[m] = a[m] + (-0.5 * dt) * w[m];
  slopes(a, point, r), slopes(w, point, u);
  const Native det = cofactors(r, C);
  store(scratch.weight + k, weight * det);
  strain_point(first, n, k, dt, u, C, det, load(scratch.mean_trace + k), 1 - control.dilatation, state,
               scratch);
}

COURANT_INLINE void add_of(Index first, Index n, Index k, Real dt, int point, const SolidControl& control,
                           const SolidState& state, PointScratch& scratch) {
  Triple a[vectors], r[3], C[3];
  kept(scratch.position, k, a);
  slopes(a, point, r);
  const Native of_point = weight * cofactors(r, C);
  Native s[6];
  for (int j = 0; j < 6; ++j) s[j] = load(state.stress[j] + first, n);
  add_work(s, dt, k, scratch);
  const Native mean = (s[0] + s[1] + s[2]) * (1.0 / 3);
  store(scratch.pressure + k, load(scratch.pressure + k) - of_point * mean);
  store(scratch.fastest + k, native_max(load(scratch.fastest + k), load(scratch.sound_speed + k)));
  for (int j = 0; j < 3; ++j) s[j] -= (1 - control.dilatation) * mean;
  const Triple T[3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
  for (int i = 0; i < 3; ++i) {
    const auto row = [&](int m) { return scratch.force[3 * m + i] + k; };
    for (int m = 0; m < 3; ++m) {
      const Native P = -weight * dot(T[i], C[m]);
      store(row(m), load(row(m)) + P);
      if (point == 0) continue;
      Real* const second = row(bent(m, point - 1));
      store(second, load(second) + P);
    }
  }
}

/// Of a stable step, over the least height of a tetrahedron at the four points: with masses of 1/36 of an
/// element at its corners and 4/27 on its edges 2/w is at least 0.265 of that over c, in a free element of
/// any shape and Poisson's ratio; 0.34 in a regular one.
constexpr Real of_height = 0.29;

COURANT_INLINE void forces_of(Index first, Index n, Index k, Real dt, const SolidControl& control,
                              const SolidState& state, PointScratch& scratch) {
  Triple a[vectors], r[3], C[3], slope[vectors];
  kept(scratch.position, k, a);
  for (Triple& m : slope) m = {all(0), all(0), all(0)};
  Native V = all(0), least = all(1e300), flattest = all(1e300);
  for (int p = 0; p < points; ++p) {
    slopes(a, p, r);
    const Native det = cofactors(r, C);
    const Triple last = C[0] + C[1] + C[2];
    const Native face = native_max(native_max(dot(C[0], C[0]), dot(C[1], C[1])),
                                   native_max(dot(C[2], C[2]), dot(last, last)));
    const Native height2 = det * det / face;
    V += weight * det, least = det < least ? det : least;
    flattest = height2 < flattest ? height2 : flattest;
    for (int m = 0; m < 3; ++m) {
      slope[m] = slope[m] + weight * C[m];
      if (p > 0) slope[bent(m, p - 1)] = slope[bent(m, p - 1)] + weight * C[m];
    }
  }
  store(scratch.sound_speed + k, load(scratch.fastest + k));
  // bulk viscosity goes by the mean, not by what the last point had
  store(scratch.rate[0] + k, load(scratch.mean_trace + k));
  store(scratch.rate[1] + k, all(0)), store(scratch.rate[2] + k, all(0));
  const Compressed of =
      compressed(first, n, k, dt, control, state, 64.0 * V, of_height * root(flattest), scratch);
  const Native V0 = load(state.V0 + first, n);
  store(scratch.relative_volume + k, least > 0.0 ? V / V0 : least / (6.0 * V0));
  const Native p = (1 - control.dilatation) * load(scratch.pressure + k) / V + of.q;
  for (int i = 0; i < 3; ++i) {
    Native F[vectors], f[corners];
    for (int m = 0; m < vectors; ++m)
      F[m] = load(scratch.force[3 * m + i] + k) + p * (i == 0   ? slope[m].x
                                                       : i == 1 ? slope[m].y
                                                                : slope[m].z);
    nodal(F, f);
    for (int c = 0; c < corners; ++c) store(state.corner_force[3 * c + i] + first, f[c], n);
  }
  if (state.internal_energy) add(state.internal_energy + first, load(scratch.work + k), n);
}

void gather(const ElementBlock& block, const SolidMesh& mesh, const SolidState& state,
            PointScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    gather_of(block.begin + k, lanes_at(k, block), k, mesh, state, scratch);
}
void begin(const ElementBlock& block, bool heats, PointScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes) begin_of(k, block.dt, heats, scratch);
}
void strain(const ElementBlock& block, int point, const SolidControl& control, const SolidState& state,
            PointScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    strain_of(block.begin + k, lanes_at(k, block), k, block.dt, point, control, state, scratch);
}
void add_point(const ElementBlock& block, int point, const SolidControl& control, const SolidState& state,
               PointScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    add_of(block.begin + k, lanes_at(k, block), k, block.dt, point, control, state, scratch);
}
StableStep forces(const ElementBlock& block, const SolidControl& control, const SolidState& state,
                  PointScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    forces_of(block.begin + k, lanes_at(k, block), k, block.dt, control, state, scratch);
  return found_in(block, scratch);
}

}  // namespace

PointLoops tetrahedron10_loops() {
  return {&gather, &begin, &strain, &add_point, &forces};
}

}  // namespace courant::COURANT_SIMD

#ifdef COURANT_ONCE
namespace courant {

PointLoops tetrahedron10_loops();
COURANT_DECLARE_VARIANTS(tetrahedron10_loops)

PointLoops tetrahedron10_loops() {
  return COURANT_VARIANT(tetrahedron10_loops)();
}

namespace {

// Masses in proportion to the diagonal of the consistent matrix (Hinton, Rock and Zienkiewicz 1976), since
// sums over its rows are negative at corners.
constexpr Real corner = 1.0 / 36, edge = 4.0 / 27;
const RegisterSolidFormulation quadratic{
    {.elforms = {{.number = 16,
                  .nodes = 10,
                  .shape = "tetrahedra of ten nodes",
                  .offer = "16 (tetrahedra of ten nodes; 17 becomes it)"},
                 {.number = 17,
                  .nodes = 10,
                  .shape = "tetrahedra of ten nodes",
                  .warning = "{1} is not there: the tetrahedra of part {0} are those of ELFORM 16, not "
                             "composed of linear ones",
                  .hint = "16 says the same without this warning"}},
     .corners = 10,
     .points = 4,
     .several = &tetrahedron10_loops,
     .mass_shares = {corner, corner, corner, corner, edge, edge, edge, edge, edge, edge},
     .resolved_length = 0.5,
     .failing_points = 1,
     .linear_dilatation = true}};

}  // namespace

}  // namespace courant
#endif
