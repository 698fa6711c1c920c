#include "laws/failure/fracture_strain.hpp"

#include <fmt/format.h>

namespace courant {

void check_positive_curves(const Deck& deck, const Model& model, const Entry& card, const char* field, Id id,
                           bool tables, const char* hint, Diagnostics& diagnostics) {
  if (id == 0) return;
  const auto fail = [&](const std::string& what) { deck.error(diagnostics, card, field, what, hint); };
  const auto table = model.tables.find(id);
  if (table != model.tables.end() && (!tables || table->second.of_tables))
    return fail(fmt::format("table {} is not supported", id));
  const std::vector<Id> curves = table == model.tables.end() ? std::vector<Id>{id} : table->second.curve;
  for (const Id one : curves) {
    const auto found = model.curves.find(one);
    if (found == model.curves.end()) return fail(fmt::format("curve {} does not exist", one));
    const std::vector<Real>&x = found->second.abscissa, &y = found->second.ordinate;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (k > 0 && !(x[k] > x[k - 1])) return fail(fmt::format("curve {} jumps at {:g}", one, x[k]));
      if (!(y[k] > 0))
        return fail(fmt::format("curve {}: expected numbers > 0, got '{:g}' at point {}", one, y[k], k + 1));
    }
  }
}

}  // namespace courant
