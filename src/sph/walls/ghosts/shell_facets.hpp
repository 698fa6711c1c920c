#pragma once
// The shells behind which ghosts are laid, as facets.
#include <map>
#include <vector>

#include "sph/walls/ghosts/ghost_lattice.hpp"
#include "sph/walls/ghosts/wall_facet.hpp"

namespace courant {

constexpr Real facet_tolerance = 1e-3;  ///< of a spacing: points so near an edge are on it

/// Those of the shells `segments`, then copies of them behind planes, where these are within the reach: there
/// are corners between facets and copies. Shells beyond a plane, or on it, are left out.
std::vector<WallFacet> facets_of_shells(const World& world, const std::vector<Index>& segments,
                                        const GhostLattice& lattice);
/// Whether a part encloses something: all of its edges belong to two facets, or are on a plane.
std::map<Index, bool> closed_parts(const std::vector<WallFacet>& facets, const GhostLattice& lattice);
/// Whether x is more than `margin` [L] beyond a plane.
bool is_beyond(const std::vector<GhostPlane>& planes, const Vec& x, Real margin);
/// Whether all of these points are so beyond the same plane.
bool are_beyond(const std::vector<GhostPlane>& planes, const std::vector<Vec>& points, Real margin);

}  // namespace courant
