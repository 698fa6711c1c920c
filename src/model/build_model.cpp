#include "model/build_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/mesh/cards_beam.hpp"
#include "model/mesh/cards_inertia.hpp"
#include "model/mesh/mesh_cards.hpp"
#include "model/mesh/shell_composite.hpp"
#include "model/model_builder.hpp"
#include "model/sets/sets.hpp"

namespace courant {

Model build_model(const Deck& deck, Diagnostics& diagnostics, RunPhase phase) {
  return ModelBuilder(deck, diagnostics, phase).build();
}

void sort_mesh_cards(Deck& deck) {
  const auto sort = [&]<class Card, class Owner>(std::type_identity<Card>, Id Owner::*id) {
    std::vector<Card>& cards = deck.store<Card>();
    const auto before = [id](const Card& a, const Card& b) { return a.*id < b.*id; };
    if (!std::is_sorted(cards.begin(), cards.end(), before))
      std::stable_sort(cards.begin(), cards.end(), before);
  };
  sort(std::type_identity<NodeCard>(), &NodeCard::nid);
  sort(std::type_identity<ElementSphCard>(), &ElementSphCard::nid);
  sort(std::type_identity<ElementShellCard>(), &ElementShellCard::eid);
  sort(std::type_identity<ElementShellCompositeCard>(), &ElementShellCompositeCard::eid);
  sort(std::type_identity<ElementSolidCard>(), &ElementSolidCard::eid);
  sort(std::type_identity<ElementBeamCard>(), &ElementBeamCard::eid);
  sort(std::type_identity<ElementInertiaCard>(), &ElementInertiaCard::eid);
}

void release_mesh_cards(Deck& deck) {
  deck.release<NodeCard>();
  deck.release<ElementSphCard>();
  deck.release<ElementShellCard>();
  deck.release<ElementSolidCard>();
  release_set_cards(deck);
}

Model ModelBuilder::build() {
  model_.title = deck_.title;
  build_nodes();
  build_parts();
  build_particles();
  build_shells();
  build_solids();
  build_beams();
  check_part_contacts();
  check_shared_nodes();
  build_curves();
  build_function_curves();
  silence_curves();
  build_tables();
  build_boxes();
  build_local_boxes();
  build_sets();
  move_nodes();
  move_parts();
  build_coordinate_systems();  // of nodes: where these have gone
  build_vectors();
  perturb_nodes();
  check_solids();
  check_beams();
  build_inertias();
  build_control();
  build_relaxation();
  build_output();
  build_body_loads();
  build_constraints();
  build_velocities();
  finish_edge_nodes();
  warn_of_short_curves();
  if (errors_ > max_errors)
    diagnostics_.note({deck_.files.empty() ? "" : deck_.files[0].name, 0, 0},
                      fmt::format("{} more errors are not shown", errors_ - max_errors));
  return std::move(model_);
}

void ModelBuilder::error(const Entry& entry, std::string_view field, std::string message, std::string hint) {
  if (++errors_ <= max_errors) deck_.error(diagnostics_, entry, field, std::move(message), std::move(hint));
}

std::string ModelBuilder::place(const Location& where) const {
  return fmt::format("{}:{}", where.file, where.line);
}

void ModelBuilder::duplicate(const Entry& entry, std::string_view field, const char* what, Id id,
                             const Location& first) {
  error(entry, field, fmt::format("{} {} is defined twice, first at {}", what, id, place(first)));
}

void ModelBuilder::unknown(const Entry& entry, std::string_view field, const char* what, Id id,
                           const char* keyword) {
  error(entry, field, fmt::format("{} {} does not exist", what, id),
        fmt::format("define it with {}", keyword));
}

Index ModelBuilder::node(const Entry& entry, std::string_view field, Id id) {
  if (const Index n = node_of_id_.find(id); n >= 0) return n;
  error(entry, field, fmt::format("node {} has no coordinates", id), "define it with *NODE");
  return -1;
}

Index ModelBuilder::part(const Entry& entry, std::string_view field, Id id) {
  const auto it = model_.part_of_id.find(id);
  if (it != model_.part_of_id.end()) return it->second;
  unknown(entry, field, "part", id, "*PART");
  return -1;
}

const std::vector<Index>* ModelBuilder::node_set(const Entry& entry, std::string_view field, Id id) {
  const auto it = model_.node_sets.find(id);
  if (it != model_.node_sets.end()) return &it->second;
  unknown(entry, field, "node set", id, "*SET_NODE_LIST");
  return nullptr;
}

const std::vector<Index>* ModelBuilder::part_set(const Entry& entry, std::string_view field, Id id) {
  const auto it = model_.part_sets.find(id);
  if (it != model_.part_sets.end()) return &it->second;
  unknown(entry, field, "part set", id, "*SET_PART_LIST");
  return nullptr;
}

const Curve* ModelBuilder::curve(const Entry& entry, std::string_view field, Id id) {
  const auto it = model_.curves.find(id);
  if (it != model_.curves.end()) return &it->second;
  unknown(entry, field, "curve", id, "*DEFINE_CURVE");
  return nullptr;
}

const Box* ModelBuilder::box(const Entry& entry, std::string_view field, Id id) {
  const auto it = model_.boxes.find(id);
  if (it != model_.boxes.end()) return &it->second;
  unknown(entry, field, "box", id, "*DEFINE_BOX");
  return nullptr;
}

const CoordinateSystem* ModelBuilder::coordinate_system(const Entry& entry, std::string_view field, Id id) {
  const auto it = model_.coordinate_systems.find(id);
  if (it != model_.coordinate_systems.end()) return &it->second;
  unknown(entry, field, "coordinate system", id, "*DEFINE_COORDINATE_SYSTEM");
  return nullptr;
}

}  // namespace courant
