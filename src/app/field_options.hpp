#pragma once
#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "output/field_writer.hpp"

namespace courant {

/// Refuses names of arrays in *COURANT_OUTPUT that the run does not have; all passes must be there.
void check_field_names(const Deck& deck, const FieldRequests& wanted, const World& world,
                       Diagnostics& diagnostics);

/// How the field files are written, from the deck's requests. hide_inactive: ISHOW 1.
FieldWriterOptions field_options(const Model& model, bool hide_inactive);

}  // namespace courant
