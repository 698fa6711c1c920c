// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/boundaries/wall_mirror_loops.hpp"

#include "sph/core/kernel_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

constexpr Real nowhere = 1e30;  ///< so far off is the wall of a particle that has none [L]

/// Walls of eight particles' rooms.
template <int Dim, int Walls>
struct EightRooms {
  Difference<Dim> n[Walls];
  Pack height[Walls];   ///< of the particles themselves
  Real without[lanes];  ///< 1: this one has none, or is not looked at

  /// `set`: strange ones are found here, else they are known.
  EightRooms(const WallMirrorArrays& a, Index i, Index count, Real back, bool set) {
    Real normal[Walls][3][lanes], offset[Walls][lanes];
    for (Index l = 0; l < lanes; ++l) {
      const WallRoom* room = l < count ? a.room[i + l] : nullptr;
      if (set && l < count) a.strange[i + l] = 0;
      if (room && !set && a.strange[i + l] != 0) room = nullptr;
      if (room && set)
        for (int k = 0; k < room->walls; ++k) {
          Real h = -room->offset[k];
          for (int c = 0; c < Dim; ++c)
            h += room->n[k][c] * (a.x[c][i + l] + a.aside[c] - back * a.v[c][i + l]);
          if (!(h > 0)) a.strange[i + l] = 1;
        }
      if (room && set && a.strange[i + l] != 0) room = nullptr;
      without[l] = room == nullptr;
      for (int k = 0; k < Walls; ++k) {
        const bool has = room && k < room->walls;
        for (int c = 0; c < 3; ++c) normal[k][c][l] = has ? room->n[k][c] : 0;
        offset[k][l] = has ? room->offset[k] : -nowhere;
        for (int c = 0; has && c < Dim; ++c) offset[k][l] -= room->n[k][c] * a.aside[c];
      }
    }
    for (int k = 0; k < Walls; ++k) {
      n[k].x = Pack::load(normal[k][0]), n[k].y = Pack::load(normal[k][1]);
      if constexpr (Dim == 3) n[k].z = Pack::load(normal[k][2]);
      height[k] = Pack::zero() - Pack::load(offset[k]);
    }
  }
  COURANT_INLINE void stand_at(const Places<Dim>& x) {
    for (int k = 0; k < Walls; ++k) {
      height[k] += n[k].x * x.x + n[k].y * x.y;
      if constexpr (Dim == 3) height[k] += n[k].z * x.z;
    }
  }
};

/// Calls f(S, shape) for each set S of walls, a number of bits, behind which j stands within reach.
template <int Walls, class Kernel, class F>
COURANT_INLINE void for_each_image(const Kernel& kernel, const Pack& r2, const Pack (&farther)[Walls],
                                   const Pack& reach2, Real hinv, const F& f) {
  for (int S = 1; S < 1 << Walls; ++S) {
    Pack far2 = r2;
    for (int k = 0; k < Walls; ++k)
      if (S >> k & 1) far2 += farther[k];
    if (!any_less(far2, reach2)) continue;
    const Pack rinv = rsqrt(far2);
    f(S, gradient_shape(kernel, far2 * rinv * hinv, rinv));
  }
}

template <int Walls>
COURANT_INLINE Pack least(const Pack (&of)[Walls]) {
  Pack out = of[0];
  for (int k = 1; k < Walls; ++k) out = min(out, of[k]);
  return out;
}

/// Notes those of eight particles that have somebody within reach behind one of their walls.
template <int Walls>
void find_strange(char* strange, Index count, const Pack& r2, const Pack& reach2,
                  const Pack (&there)[Walls]) {
  Real distance2[lanes], reach[lanes], height[lanes];
  r2.store(distance2), reach2.store(reach), least<Walls>(there).store(height);
  for (Index l = 0; l < count; ++l)
    if (distance2[l] < reach[l] && !(height[l] > 0)) strange[l] = 1;
}

template <class Kernel, int Dim, int Walls>
void group_rates(const Kernel& kernel, const WallMirrorArrays& a, const Index* list, const Index* end,
                 Index i, Index count) {
  const Real half = a.half_step, hinv = 1 / a.h;
  const Pack reach2 = Pack::of(power<2>(kernel.support * a.h)), tiny = Pack::of(tiny_distance2 * a.h * a.h);
  EightRooms<Dim, Walls> rooms(a, i, count, half, true);
  Places<Dim> xi(a.x, i, count);
  const Places<Dim> vi(a.v, i, count);
  xi.x -= half * vi.x, xi.y -= half * vi.y;
  if constexpr (Dim == 3) xi.z -= half * vi.z;
  rooms.stand_at(xi);
  Pack speed[Walls];  // along the normals
  for (int k = 0; k < Walls; ++k) {
    speed[k] = rooms.n[k].x * vi.x + rooms.n[k].y * vi.y;
    if constexpr (Dim == 3) speed[k] += rooms.n[k].z * vi.z;
  }
  Pack div = Pack::zero();
  for (; list != end; ++list) {
    const std::ptrdiff_t j = *list;
    Difference<Dim> d, u(vi, a.v, j);
    d.x = xi.x - (a.x[0][j] - half * a.v[0][j]), d.y = xi.y - (a.x[1][j] - half * a.v[1][j]);
    if constexpr (Dim == 3) d.z = xi.z - (a.x[2][j] - half * a.v[2][j]);
    const Pack r2 = dot_plus(d, d, tiny);
    Pack there[Walls], farther[Walls];
    for (int k = 0; k < Walls; ++k) {
      there[k] = rooms.height[k] - dot(rooms.n[k], d);
      farther[k] = 4 * rooms.height[k] * positive(there[k]);  // who is behind has no image
    }
    if (!any_less(r2 + least<Walls>(farther), reach2)) continue;
    if (any_less(least<Walls>(there), Pack::zero()))
      find_strange<Walls>(a.strange + i, count, r2, reach2, there);
    Pack more[Walls];
    for (int k = 0; k < Walls; ++k)
      more[k] = 2 * (speed[k] * there[k] + (speed[k] - dot(rooms.n[k], u)) * rooms.height[k]);
    const Pack u_dot_d = dot(u, d);
    Pack change = Pack::zero();
    for_each_image<Walls>(kernel, r2, farther, reach2, hinv, [&](int S, const Pack& shape) {
      Pack along = u_dot_d;
      for (int k = 0; k < Walls; ++k)
        if (S >> k & 1) along += more[k];
      change += shape * along;
    });
    div += a.V[j] * change;
  }
  Real rate[lanes];
  (gradient_norm<Dim>(kernel, a.h) * div).store(rate);
  for (Index l = 0; l < count; ++l)
    if (rooms.without[l] == 0 && a.strange[i + l] == 0) a.drhodt[i + l] += a.rho[i + l] * rate[l];
}

template <class Kernel, int Dim, int Walls>
void group_forces(const Kernel& kernel, const WallMirrorArrays& a, const Index* list, const Index* end,
                  Index i, Index count) {
  const Real hinv = 1 / a.h;
  const Pack reach2 = Pack::of(power<2>(kernel.support * a.h)), tiny = Pack::of(tiny_distance2 * a.h * a.h);
  EightRooms<Dim, Walls> rooms(a, i, count, 0, false);
  const Places<Dim> xi(a.x, i, count);
  rooms.stand_at(xi);
  const bool diffuses = a.diffusion != nullptr;
  const Pack pi = Pack::load(a.p + i, count), rho = Pack::load(a.rho + i, count),
             phi = diffuses ? Pack::load(a.potential + i, count) : Pack::zero();
  Sum<Dim> force;
  Pack across[Walls], diffusion = Pack::zero();
  for (int k = 0; k < Walls; ++k) across[k] = Pack::zero();
  for (; list != end; ++list) {
    const std::ptrdiff_t j = *list;
    const Difference<Dim> d(xi, a.x, j);
    const Pack r2 = dot_plus(d, d, tiny);
    Pack there[Walls], farther[Walls];
    for (int k = 0; k < Walls; ++k) {
      there[k] = rooms.height[k] - dot(rooms.n[k], d);
      farther[k] = 4 * rooms.height[k] * positive(there[k]);  // who is behind has no image
    }
    if (!any_less(r2 + least<Walls>(farther), reach2)) continue;
    Pack all = Pack::zero(), by[Walls];
    for (int k = 0; k < Walls; ++k) by[k] = Pack::zero();
    for_each_image<Walls>(kernel, r2, farther, reach2, hinv, [&](int S, const Pack& shape) {
      all += shape;
      for (int k = 0; k < Walls; ++k)
        if (S >> k & 1) by[k] += shape;
    });
    const Pack pressure = a.V[j] * (pi + a.p[j]);
    force.add(pressure * all, d);
    for (int k = 0; k < Walls; ++k) across[k] += 2 * pressure * there[k] * by[k];
    if (diffuses) diffusion += a.V[j] * all * (a.p[j] - pi + rho * (a.potential[j] - phi));
  }
  for (int k = 0; k < Walls; ++k) force.add(across[k], rooms.n[k]);
  const Pack factor = (0 - gradient_norm<Dim>(kernel, a.h)) * Pack::load(a.V + i, count);
  Real of[4][lanes];
  (factor * force.x).store(of[0]), (factor * force.y).store(of[1]), (factor * force.z).store(of[2]);
  (-2 * a.delta * a.h * gradient_norm<Dim>(kernel, a.h) * diffusion).store(of[3]);
  for (Index l = 0; l < count; ++l) {
    if (rooms.without[l] != 0) continue;
    for (int c = 0; c < Dim; ++c) a.f[c][i + l] += of[c][l], a.wall_force[c][i + l] = of[c][l];
    if (diffuses) a.diffusion[i + l] += of[3][l] / a.c[i + l];
  }
}

/// Calls the loop for as many walls as any of a group of eight has.
template <class Kernel, int Dim, bool Rates>
void loop(const WallMirrorArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    int walls = 0;
    for (Index l = 0; l < count; ++l)
      if (const WallRoom* room = a.room[i + l]) walls = walls < room->walls ? room->walls : walls;
    if (walls == 0) continue;
    const Index *list = lists.list + lists.start[g], *end = lists.list + lists.start[g + 1];
    if constexpr (Rates) {
      if (walls == 1) group_rates<Kernel, Dim, 1>(kernel, a, list, end, i, count);
      if (walls == 2) group_rates<Kernel, Dim, 2>(kernel, a, list, end, i, count);
      if (Dim == 3 && walls == 3) group_rates<Kernel, Dim, 3>(kernel, a, list, end, i, count);
    } else {
      if (walls == 1) group_forces<Kernel, Dim, 1>(kernel, a, list, end, i, count);
      if (walls == 2) group_forces<Kernel, Dim, 2>(kernel, a, list, end, i, count);
      if (Dim == 3 && walls == 3) group_forces<Kernel, Dim, 3>(kernel, a, list, end, i, count);
    }
  }
}

}  // namespace

WallMirrorLoop mirror_rates_loop(KernelChoice choice, int dim) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> WallMirrorLoop {
    return dim == 2 ? &loop<Kernel, 2, true> : &loop<Kernel, 3, true>;
  });
}
WallMirrorLoop mirror_forces_loop(KernelChoice choice, int dim) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> WallMirrorLoop {
    return dim == 2 ? &loop<Kernel, 2, false> : &loop<Kernel, 3, false>;
  });
}

}  // namespace courant::COURANT_SIMD
