#include "app/run/field_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/nearest_word.hpp"
#include "extension/builders.hpp"

namespace courant {

namespace {

/// SMALL: what pictures and `courant post` need. Mass and smoothing length hardly change and cost nothing.
const std::vector<std::string> small_fields = {"id",      "part",     "active", "velocity",
                                               "density", "pressure", "mass",   "smoothing_length"};
constexpr Real small_eps = 1.0 / 256, small_epsx = 1.0 / 64;
constexpr int small_level = 2;

/// Refuses names of arrays in *COURANT_OUTPUT that the run does not have.
void check_field_names(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics) {
  if (world.particles.size() == 0) return;
  const FieldRequests& wanted = model.output.fields;
  const std::vector<std::string> names = particle_array_names(world);
  for (const std::string& name : wanted.fields) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const std::string near = nearest_word(name, names);
    deck.error(diagnostics, wanted.card, "FIELDS", fmt::format("this run has no array '{}'", name),
               near.empty() ? fmt::format("it has {}", fmt::join(names, ", "))
                            : fmt::format("did you mean {}?", near));
  }
}

const RegisterBuilder names(BuildPhase::checks, "names of fields", check_field_names, Errors::go_on);

}  // namespace

FieldWriterOptions field_options(const Model& model, bool hide_inactive) {
  const FieldRequests& wanted = model.output.fields;
  const bool small = wanted.small;
  FieldWriterOptions o;
  for (const ModelPart& part : model.parts)
    o.part_ids.push_back(part.id), o.part_titles.push_back(part.title);
  o.hide_inactive = hide_inactive;
  o.left_out = wanted.left_out;
  if (wanted.in_box) o.inside = [box = wanted.box](const Vec& x) { return box.contains(x); };
  o.fields = wanted.fields.empty() && small ? small_fields : wanted.fields;
  o.extra = wanted.extra;
  o.float64 = wanted.bits == 64;
  o.eps = wanted.eps >= 0 ? wanted.eps : small ? small_eps : 0;
  o.epsx = wanted.epsx >= 0 ? wanted.epsx : small ? small_epsx : 0;
  using Method = Compression::Method;
  constexpr Method methods[] = {Method::none, Method::zlib, Method::xz};
  const int method = wanted.compression >= 0 ? wanted.compression : small ? 2 : 1;
  o.compression = {methods[method],
                   wanted.level >= 0 ? wanted.level
                   : small           ? small_level
                                     : -1,
                   small || wanted.level >= 0 || wanted.compression == 2};
  o.sparse_shells = small;
  return o;
}

}  // namespace courant
