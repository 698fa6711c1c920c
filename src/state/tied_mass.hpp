#pragma once
#include "state/shared_fields.hpp"

namespace courant::shared_fields {

/// Nodes: the share of their mass that belongs to nodes which are tied to their faces, and weighs there. [M]
inline const SharedField<Real> tied_mass{{.name = "tied_mass", .dimension = "M", .restart = false}};

}  // namespace courant::shared_fields
