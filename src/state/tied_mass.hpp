#pragma once
#include "state/shared_fields.hpp"

namespace courant::shared_fields {

/// Nodes: the part of their mass that belongs to nodes which they carry, whose weight acts there; of a
/// carried node the part that rigid bodies have. [M]
inline const SharedField<Real> tied_mass{{.name = "tied_mass", .dimension = "M"}};

/// Carrying nodes: momentum not yet transferred in the last step. [ML/T]
inline const SharedField<Real> open_momentum{{.name = "open_momentum", .dimension = "ML/T", .components = 3}};
/// Nodes: one number for all that linear equations, node sets or failing ties join, above 0; -1: a support
/// holds them for a time, or along oblique axes; 0: neither.
inline const SharedField<Index> joined_nodes{{.name = "joined_nodes", .dimension = "-", .restart = false}};
/// Nodes: axes along which they move with the other nodes of a node set, 1 x + 2 y + 4 z.
inline const SharedField<Index> alike_axes{{.name = "alike_axes", .dimension = "-", .restart = false}};
/// Nodes and particles: force with which SPC hold them. [ML/T2]
inline const SharedField<Real> support_force{
    {.name = "support_force", .dimension = "ML/T2", .components = 3, .restart = false}};

}  // namespace courant::shared_fields
