#include "model/definitions/named_curve.hpp"

#include <fmt/format.h>

namespace courant {

const Curve* curve_named(const Deck& deck, const Model& model, const Entry& entry, const char* field, Id id,
                         Diagnostics& diagnostics) {
  const auto found = model.curves.find(id);
  if (found != model.curves.end()) return &found->second;
  deck.error(diagnostics, entry, field, fmt::format("curve {} does not exist", id),
             "define it with *DEFINE_CURVE");
  return nullptr;
}

}  // namespace courant
