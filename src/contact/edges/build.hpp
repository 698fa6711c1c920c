#pragma once
// Contact of edges with edges from the cards of a deck.
#include "contact/nodes/build.hpp"

namespace courant {

/// For all *CONTACT cards that request it; `nodes`: contact of their nodes with faces. Elements must be
/// there, and Nodes::held, ::follow be set. Reports what is not supported, and as warnings initial
/// penetrations.
void add_edge_contacts(const Deck& deck, const Model& model, const NodeContactOptions& options,
                       const NodeContactsByCard& nodes, World& world, Diagnostics& diagnostics);

}  // namespace courant
