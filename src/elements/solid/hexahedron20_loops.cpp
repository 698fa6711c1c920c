// The hexahedron of twenty nodes with 3 x 3 x 3 points (ELFORM 23), compiled once for each instruction set;
// see docs/architecture.md and hexahedron_loops.cpp.
//
// Positions are x = a_0 + sum a_m phi_m with the 19 products phi_m of xi, eta, zeta below, which span the
// same functions as the nodes; the loops keep these vectors of positions and velocities. With 2 x 2 x 2
// points of Gauss six motions would have no stiffness; the fourteen of Irons (1971) do not integrate forces
// of a uniform stress exactly where faces are warped.
//
// The law sees tr D, and the nodes the pressure, as the linear functions of xi, eta, zeta next to those of
// the points in the mean square over the volume. So bodies that keep their volume do not lock, and as this
// projection is its own transpose, a uniform strain and a uniform pressure remain what they are.
#include "elements/solid/solid_math.hpp"
#ifdef COURANT_ONCE
#include "base/instruction_set.hpp"
#include "elements/solid/formulation.hpp"
#endif

namespace courant::COURANT_SIMD {

namespace {

constexpr int corners = 20, vectors = 19, points = 27;

/// Numbers of the products, with j and l behind i in the circle of 0, 1, 2: xi_i is i itself.
constexpr int next(int i) {
  return (i + 1) % 3;
}
constexpr int mixed(int i) {  // xi_j xi_l
  return 3 + i;
}
constexpr int square(int i) {  // xi_i^2
  return 6 + i;
}
constexpr int bent(int i, int other) {  // xi_i^2 xi_j, xi_i^2 xi_l
  return 9 + 2 * i + other;
}
constexpr int triple_product = 15;
constexpr int high(int i) {  // xi_i^2 xi_j xi_l
  return 16 + i;
}

constexpr Real sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                             {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
/// Nodes on edges along xi_i, with the signs of xi_j and xi_l.
constexpr int on_edge[3][4] = {{8, 10, 14, 12}, {11, 15, 13, 9}, {16, 17, 18, 19}};
constexpr Real sign_j[4] = {-1, 1, 1, -1}, sign_l[4] = {-1, -1, 1, 1};

/// Derivatives of the products by xi_i at a point, those that are not 0.
struct Terms {
  int count = 0, mode[12]{};
  Real factor[12]{};
  constexpr void add(int m, Real f) {
    if (f != 0) mode[count] = m, factor[count++] = f;
  }
};
struct Rule {
  Real xi[points][3]{}, weight[points]{};
  Terms terms[points][3]{};
  constexpr Rule() {
    constexpr Real apart = 0.774596669241483377;  // sqrt 3/5
    int p = 0;
    for (int zeros = 0; zeros <= 3; ++zeros)  // those near the corners first
      for (int at = 0; at < 27; ++at) {
        const int index[3] = {at % 3, at / 3 % 3, at / 9};  // 1: in the middle
        int found = 0;
        for (const int k : index) found += k == 1;
        if (found != zeros) continue;
        weight[p] = 1;
        for (int i = 0; i < 3; ++i)
          xi[p][i] = apart * (index[i] - 1), weight[p] *= index[i] == 1 ? 8.0 / 9 : 5.0 / 9;
        ++p;
      }
    for (p = 0; p < points; ++p)
      for (int i = 0; i < 3; ++i) {
        const int j = next(i), l = next(j);
        const Real a = xi[p][i], b = xi[p][j], c = xi[p][l];
        Terms& of = terms[p][i];
        of.add(i, 1), of.add(mixed(j), c), of.add(mixed(l), b), of.add(square(i), 2 * a);
        of.add(bent(i, 0), 2 * a * b), of.add(bent(i, 1), 2 * a * c);
        of.add(bent(j, 1), b * b), of.add(bent(l, 0), c * c), of.add(triple_product, b * c);
        of.add(high(i), 2 * a * b * c), of.add(high(j), b * b * c), of.add(high(l), c * c * b);
      }
  }
};
constexpr Rule rule;

/// The vectors of one component at the nodes.
COURANT_INLINE void vectors_of(const Native at[corners], Native out[vectors]) {
  Native p[corners];
  for (int c = 0; c < corners; ++c) p[c] = at[c] - at[0];
  Native sum = p[0], of[3], pair[3], product = all(0);  // over the corners, with signs
  for (int i = 0; i < 3; ++i) of[i] = pair[i] = all(0);
  for (int c = 1; c < 8; ++c) {
    sum += p[c];
    product += (sign[c][0] * sign[c][1] * sign[c][2]) * p[c];
    for (int i = 0; i < 3; ++i) {
      const int j = next(i), l = next(j);
      of[i] += sign[c][i] * p[c], pair[i] += (sign[c][j] * sign[c][l]) * p[c];
    }
  }
  for (int i = 0; i < 3; ++i) out[i] = -0.125 * of[i];
  out[triple_product] = 0.125 * product;
  for (int i = 0; i < 3; ++i) {
    const int j = next(i), l = next(j);
    Native edges = all(0), along_j = all(0), along_l = all(0), both = all(0);
    for (int e = 0; e < 4; ++e) {
      const Native& q = p[on_edge[i][e]];
      edges += q, along_j += sign_j[e] * q, along_l += sign_l[e] * q, both += (sign_j[e] * sign_l[e]) * q;
    }
    out[j] += 0.25 * along_j, out[l] += 0.25 * along_l;
    out[mixed(i)] = 0.25 * both, out[square(i)] = 0.125 * sum - 0.25 * edges;
    out[bent(i, 0)] = 0.125 * of[j] - 0.25 * along_j;
    out[bent(i, 1)] = 0.125 * of[l] - 0.25 * along_l;
    out[high(i)] = 0.125 * pair[i] - 0.25 * both;
  }
}

/// The transpose: forces on the nodes of forces on the vectors.
COURANT_INLINE void nodal(const Native F[vectors], Native out[corners]) {
  const Native squares = F[square(0)] + F[square(1)] + F[square(2)];
  for (int c = 0; c < 8; ++c) {
    Native f = squares + (sign[c][0] * sign[c][1] * sign[c][2]) * F[triple_product];
    for (int i = 0; i < 3; ++i) {
      const int j = next(i), l = next(j);
      f += sign[c][j] * F[bent(i, 0)] + sign[c][l] * F[bent(i, 1)] - sign[c][i] * F[i];
      f += (sign[c][j] * sign[c][l]) * F[high(i)];
    }
    out[c] = 0.125 * f;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = next(i), l = next(j);
    const Native along_j = F[j] - F[bent(i, 0)], along_l = F[l] - F[bent(i, 1)],
                 both = F[mixed(i)] - F[high(i)];
    for (int e = 0; e < 4; ++e)
      out[on_edge[i][e]] =
          0.25 * (sign_j[e] * along_j + sign_l[e] * along_l + (sign_j[e] * sign_l[e]) * both - F[square(i)]);
  }
}

/// r_1, r_2, r_3 at a point.
COURANT_INLINE void slopes(const Real (*rows)[block_size], Index k, int point, Triple out[3]) {
  for (int i = 0; i < 3; ++i) {
    const Terms& of = rule.terms[point][i];
    out[i] = triple(rows + 3 * of.mode[0], k);  // of factor 1
    for (int t = 1; t < of.count; ++t) out[i] = out[i] + of.factor[t] * triple(rows + 3 * of.mode[t], k);
  }
}
/// The same with the positions `later` steps from the end of the step.
COURANT_INLINE void slopes_at(Index k, Real dt, Real later, const PointScratch& scratch, int point,
                              Triple r[3], Triple u[3]) {
  slopes(scratch.position, k, point, r), slopes(scratch.speed, k, point, u);
  for (int i = 0; i < 3; ++i) r[i] = r[i] + (later * dt) * u[i];
}

/// Sums over the points that linear functions of xi need, and these functions.
struct Moments {
  Native V = all(0), first[3] = {all(0), all(0), all(0)},
         second[6] = {all(0), all(0), all(0), all(0), all(0), all(0)};
  COURANT_INLINE void add(int point, Native volume) {
    const Real* const xi = rule.xi[point];
    V += volume;
    for (int i = 0; i < 3; ++i) {
      first[i] += xi[i] * volume;
      second[i] += (xi[i] * xi[i]) * volume, second[3 + i] += (xi[i] * xi[next(i)]) * volume;
    }
  }
  COURANT_INLINE Native middle(int i) const { return first[i] / V; }
  /// Of a quantity with `deviation`[i] = sum V (xi_i - middle_i) q: its slopes, such that q is next to
  /// mean + slope.(xi - middle).
  COURANT_INLINE void slopes_of(const Native deviation[3], Native out[3]) const {
    Native A[3], B[3];  // second moments about the middle: ii, and i with the next
    for (int i = 0; i < 3; ++i)
      A[i] = second[i] - first[i] * middle(i), B[i] = second[3 + i] - first[i] * middle(next(i));
    const Native C[3] = {A[1] * A[2] - B[1] * B[1], A[2] * A[0] - B[2] * B[2], A[0] * A[1] - B[0] * B[0]};
    const Native D[3] = {B[1] * B[2] - B[0] * A[2], B[2] * B[0] - B[1] * A[0], B[0] * B[1] - B[2] * A[1]};
    const Native det = A[0] * C[0] + B[0] * D[0] + B[2] * D[2];
    for (int i = 0; i < 3; ++i)
      out[i] =
          (C[i] * deviation[i] + D[i] * deviation[next(i)] + D[next(next(i))] * deviation[next(next(i))]) /
          det;
  }
};
/// Rows behind those of the vectors. Of positions: the middle of xi at the end of the step; of speeds: tr D
/// as a linear function, constant and slopes; of forces: sum V (xi - middle) p.
constexpr int more = 3 * vectors;
static_assert(more + 4 <= PointScratch::rows);

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
  Moments sums;
  for (int p = 0; p < points; ++p) {
    Triple r[3], C[3];
    slopes(scratch.position, k, p, r);
    sums.add(p, rule.weight[p] * cofactors(r, C));
  }
  for (int i = 0; i < 3; ++i) store(scratch.position[more + i] + k, sums.middle(i));
  store(scratch.compression + k, load(state.V0 + first, n) / sums.V - 1.0);
}

/// dV of the step ahead, half of it, with the positions at the start (-1) or the end (0) of the step.
COURANT_INLINE Native opened_at(Index k, Real dt, Real later, const PointScratch& scratch) {
  Native rate = all(0);
  for (int p = 0; p < points; ++p) {
    Triple r[3], u[3], C[3];
    slopes_at(k, dt, later, scratch, p, r, u), cofactors(r, C);
    rate += rule.weight[p] * (dot(C[0], u[0]) + dot(C[1], u[1]) + dot(C[2], u[2]));
  }
  return (0.5 * dt) * rate;
}

COURANT_INLINE void begin_of(Index k, Real dt, bool heats, PointScratch& scratch) {
  for (int end = 0; heats && end < 2; ++end)
    store(scratch.opened[end] + k, opened_at(k, dt, end - 1.0, scratch));
  Moments sums;
  Native rate = all(0), deviation[3] = {all(0), all(0), all(0)}, slope[3];
  for (int p = 0; p < points; ++p) {
    Triple r[3], u[3], C[3];
    slopes_at(k, dt, -0.5, scratch, p, r, u);
    sums.add(p, rule.weight[p] * cofactors(r, C));
    const Native own = rule.weight[p] * (dot(C[0], u[0]) + dot(C[1], u[1]) + dot(C[2], u[2]));
    rate += own;
    for (int i = 0; i < 3; ++i) deviation[i] += rule.xi[p][i] * own;
  }
  for (int i = 0; i < 3; ++i) deviation[i] -= sums.middle(i) * rate;
  sums.slopes_of(deviation, slope);
  Native constant = rate / sums.V;
  store(scratch.mean_trace + k, constant), store(scratch.middle_volume + k, sums.V);
  for (int i = 0; i < 3; ++i)
    constant -= slope[i] * sums.middle(i), store(scratch.speed[more + 1 + i] + k, slope[i]);
  store(scratch.speed[more] + k, constant);
  for (auto& force : scratch.force) store(force + k, all(0));
  store(scratch.pressure + k, all(0)), store(scratch.fastest + k, all(0)), store(scratch.work + k, all(0));
}

COURANT_INLINE void strain_of(Index first, Index n, Index k, Real dt, int point, const SolidState& state,
                              PointScratch& scratch) {
  Triple r[3], u[3], C[3];
  slopes_at(k, dt, -0.5, scratch, point, r, u);
  const Native det = cofactors(r, C);
  store(scratch.weight + k, rule.weight[point] * det);
  Native trace = load(scratch.speed[more] + k);
  for (int i = 0; i < 3; ++i) trace += rule.xi[point][i] * load(scratch.speed[more + 1 + i] + k);
  strain_point(first, n, k, dt, u, C, det, trace, 1, state, scratch);
}

/// Adds forces of a point, of which `P`[i][m] along xi_m acts on component i.
COURANT_INLINE void push(int point, Index k, const Triple P[3], PointScratch& scratch) {
  for (int m = 0; m < 3; ++m) {
    const Terms& of = rule.terms[point][m];
    for (int t = 0; t < of.count; ++t) {
      Real(*const rows)[block_size] = scratch.force + 3 * of.mode[t];
      store(rows[0] + k, load(rows[0] + k) + of.factor[t] * P[m].x);
      store(rows[1] + k, load(rows[1] + k) + of.factor[t] * P[m].y);
      store(rows[2] + k, load(rows[2] + k) + of.factor[t] * P[m].z);
    }
  }
}

COURANT_INLINE void add_of(Index first, Index n, Index k, Real dt, int point, const SolidState& state,
                           PointScratch& scratch) {
  Triple r[3], C[3];
  slopes(scratch.position, k, point, r);
  const Native volume = rule.weight[point] * cofactors(r, C);
  Native s[6];
  for (int j = 0; j < 6; ++j) s[j] = load(state.stress[j] + first, n);
  add_work(s, dt, k, scratch);
  const Native mean = (s[0] + s[1] + s[2]) * (1.0 / 3);
  store(scratch.pressure + k, load(scratch.pressure + k) - volume * mean);
  for (int i = 0; i < 3; ++i) {
    Real* const sum = scratch.force[more + i] + k;
    store(sum, load(sum) - volume * mean * (rule.xi[point][i] - load(scratch.position[more + i] + k)));
  }
  store(scratch.fastest + k, native_max(load(scratch.fastest + k), load(scratch.sound_speed + k)));
  for (int j = 0; j < 3; ++j) s[j] -= mean;
  const Triple T[3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
  Triple P[3];
  for (int m = 0; m < 3; ++m)
    P[m] = -rule.weight[point] * Triple{dot(T[0], C[m]), dot(T[1], C[m]), dot(T[2], C[m])};
  push(point, k, P, scratch);
}

/// Of a step, over the least half of a thickness at the points. 0.5 is stable: a free element alone has 2/w
/// of at least that over c, in any shape and with any Poisson's ratio; 0.56 is usual. Uniform stresses push
/// corners against nodes on edges, so the highest modes always ring, and steps near the stable one do not
/// keep their energy.
constexpr Real of_half = 0.4;

COURANT_INLINE void forces_of(Index first, Index n, Index k, Real dt, const SolidControl& control,
                              const SolidState& state, PointScratch& scratch) {
  Triple r[3], C[3];
  Moments sums;
  Native least = all(1e300), flattest = all(1e300);
  for (int p = 0; p < points; ++p) {
    slopes(scratch.position, k, p, r);
    const Native det = cofactors(r, C);
    const Native face = native_max(dot(C[0], C[0]), native_max(dot(C[1], C[1]), dot(C[2], C[2])));
    const Native half2 = det * det / face;
    sums.add(p, rule.weight[p] * det), least = det < least ? det : least;
    flattest = half2 < flattest ? half2 : flattest;
  }
  store(scratch.sound_speed + k, load(scratch.fastest + k));
  // bulk viscosity goes by the mean, not by what the last point had
  store(scratch.rate[0] + k, load(scratch.mean_trace + k));
  store(scratch.rate[1] + k, all(0)), store(scratch.rate[2] + k, all(0));
  const Compressed of =
      compressed(first, n, k, dt, control, state, 64.0 * sums.V, of_half * root(flattest), scratch);
  const Native V0 = load(state.V0 + first, n);
  store(scratch.relative_volume + k, least > 0.0 ? sums.V / V0 : 8.0 * least / V0);
  Native deviation[3], slope[3];
  for (int i = 0; i < 3; ++i) deviation[i] = load(scratch.force[more + i] + k);
  sums.slopes_of(deviation, slope);
  const Native mean = load(scratch.pressure + k) / sums.V + of.q;
  for (int p = 0; p < points; ++p) {
    slopes(scratch.position, k, p, r), cofactors(r, C);
    Native pressure = mean;
    for (int i = 0; i < 3; ++i) pressure += slope[i] * (rule.xi[p][i] - load(scratch.position[more + i] + k));
    for (Triple& c : C) c = (rule.weight[p] * pressure) * c;
    push(p, k, C, scratch);
  }
  for (int d = 0; d < 3; ++d) {
    Native F[vectors], f[corners];
    for (int m = 0; m < vectors; ++m) F[m] = load(scratch.force[3 * m + d] + k);
    nodal(F, f);
    for (int c = 0; c < corners; ++c) store(state.corner_force[3 * c + d] + first, f[c], n);
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
void strain(const ElementBlock& block, int point, const SolidControl&, const SolidState& state,
            PointScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    strain_of(block.begin + k, lanes_at(k, block), k, block.dt, point, state, scratch);
}
void add_point(const ElementBlock& block, int point, const SolidControl&, const SolidState& state,
               PointScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    add_of(block.begin + k, lanes_at(k, block), k, block.dt, point, state, scratch);
}
StableStep forces(const ElementBlock& block, const SolidControl& control, const SolidState& state,
                  PointScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    forces_of(block.begin + k, lanes_at(k, block), k, block.dt, control, state, scratch);
  return found_in(block, scratch);
}

}  // namespace

PointLoops hexahedron20_loops() {
  return {&gather, &begin, &strain, &add_point, &forces};
}

}  // namespace courant::COURANT_SIMD

#ifdef COURANT_ONCE
namespace courant {

PointLoops hexahedron20_loops();
COURANT_DECLARE_VARIANTS(hexahedron20_loops)

PointLoops hexahedron20_loops() {
  return COURANT_VARIANT(hexahedron20_loops)();
}

namespace {

// Masses in proportion to the diagonal of the consistent matrix of a brick (Hinton, Rock and Zienkiewicz
// 1976), since sums over its rows are negative at corners.
constexpr Real corner = 7.0 / 248, edge = 2.0 / 31;
const RegisterSolidFormulation twenty_nodes{
    {.elforms = {{.number = 23,
                  .nodes = 20,
                  .shape = "hexahedra of twenty nodes",
                  .offer = "23 (hexahedra of twenty nodes)"}},
     .corners = 20,
     .points = 27,
     .several = &hexahedron20_loops,
     .mass_shares = {corner, corner, corner, corner, corner, corner, corner, corner, edge, edge,
                     edge,   edge,   edge,   edge,   edge,   edge,   edge,   edge,   edge, edge},
     .resolved_length = 0.5,
     .failing_points = 14}};  // with fewer left some motions may have no stiffness

}  // namespace

}  // namespace courant
#endif
