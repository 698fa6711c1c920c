#pragma once
#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "output/fields/field_writer.hpp"

namespace courant {

/// How the field files are written, from the deck's requests. hide_inactive: ISHOW 1.
FieldWriterOptions field_options(const Model& model, bool hide_inactive);

}  // namespace courant
