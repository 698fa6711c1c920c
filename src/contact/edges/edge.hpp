#pragma once
// An edge that touches others: a line between two nodes with a radius.
#include <array>
#include <vector>

#include "state/world.hpp"

namespace courant {

struct ContactEdge {
  std::array<Index, 2> node{};  ///< indices into World::nodes
  Real r = 0;                   ///< others touch it at this distance [L]
  Real k = 0;                ///< K A/(longest diagonal) of a shell, K A/L of a beam, with its scales [M/T2]
  Real area = 0;             ///< what VC acts on [L2]
  Index of_part = -1;        ///< by index into the model's parts
  unsigned sides = 3;        ///< bit 0: of SURFA, bit 1: of SURFB
  std::vector<Index> faces;  ///< whose edge it is, indices into World::segments; of a beam none
  bool always = false;       ///< touches however many of its faces are there, if any
  const Field<Index>* eroded = nullptr;  ///< of a beam that may fail
  Index element = 0;                     ///< of that field
  bool has(Index n) const { return node[0] == n || node[1] == n; }
  Index other_end(Index n) const { return node[0] == n ? node[1] : node[0]; }
};

using EdgeEnds = std::array<Vec, 2>;

inline EdgeEnds ends_of(const ContactEdge& e, const Field<Real>& x) {
  return {x.vec(e.node[0]), x.vec(e.node[1])};
}

/// Where two edges are nearest to each other: a[0] + s (a[1] - a[0]), b[0] + t (b[1] - b[0]).
struct NearestPoints {
  Real s = 0, t = 0;        ///< in [0, 1]
  Vec w = Vec::Zero();      ///< from b to a [L]
  Real distance = 0;        ///< [L]
  Vec cross = Vec::Zero();  ///< of both directions, unit vectors each [-]
  bool inside = false;      ///< at the end of neither
};
/// Of edges that are parallel and beside each other: in the middle of where they are so.
NearestPoints nearest_points(const EdgeEnds& a, const EdgeEnds& b);
/// The part of a, in [0, 1], that b is beside: from, to; empty where the second is not above the first.
std::array<Real, 2> beside(const EdgeEnds& a, const EdgeEnds& b);
/// The same for a given point of a.
NearestPoints nearest_to_point(const EdgeEnds& a, const EdgeEnds& b, Real s);
/// Whether the edges went through each other between two times, with straight paths of their ends.
bool went_through(const EdgeEnds& a0, const EdgeEnds& b0, const EdgeEnds& a1, const EdgeEnds& b1);

}  // namespace courant
