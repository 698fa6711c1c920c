#pragma once
// The steps of build_model, over several files: mesh, sets, conditions.
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "keyword/deck.hpp"
#include "model/cards.hpp"
#include "model/definitions/define_cards.hpp"
#include "model/mesh/mesh_cards.hpp"
#include "model/mesh/shell_composite.hpp"
#include "model/model.hpp"
#include "model/sets/id_index.hpp"

namespace courant {

class ModelBuilder {
 public:
  ModelBuilder(const Deck& deck, Diagnostics& diagnostics, RunPhase phase)
      : deck_(deck), diagnostics_(diagnostics) {
    model_.phase = phase;
  }
  Model build();

 private:
  // build_mesh.cpp
  void build_nodes();
  void build_parts();
  void check_part_contacts();
  void check_plies(const Entry& card, const std::vector<ModelPly>& plies, const std::string& whose);
  void build_particles();
  void build_shells();
  Index add_shell(const ElementShellCard& card);
  void build_layered_shells(const std::vector<ElementShellCompositeCard>& cards);
  void add_particle(const ElementSphCard& card, Id nid, Index part);
  void check_shared_nodes();
  // build_solids.cpp
  void build_solids();
  void add_to_part(const ElementSolidCard& card, const ModelSolid& solid, std::vector<bool>& told);
  void check_shared_nodes_of_solids(const std::vector<Index>& owner, std::vector<bool>& told);
  void check_solids();
  void check_solid_shapes();
  void warn_of_loose_edges();
  Real least_volume(const ModelSolid& solid) const;
  Real volume(const ModelSolid& solid) const;
  // edge_nodes.cpp
  void order_edge_nodes(ModelSolid& solid) const;
  static bool wants_edge_nodes(const ElementSolidCard& card);
  bool make_edge_nodes(const ElementSolidCard& card, ModelSolid& solid);
  void position_edge_nodes();
  void finish_edge_nodes();
  Real least_volume_of_twenty(const ModelSolid& solid) const;
  void check_control_solid(const ControlSolid& card);
  // build_histories.cpp
  void build_histories();
  void build_history_sph();
  void build_history_node();
  void build_accelerometers();
  static constexpr Real most_due = 1e15;  ///< of intervals until ENDTIM: their times differ
  void check_curve(const Entry& card, std::string_view field, const Curve& curve);
  void check_interval(const Entry& card, std::string_view field, Real interval, Real most);
  void build_output_curve(const Entry& card, std::string_view field, Id id, int ioopt, OutputTimes& out);
  std::vector<Index> listed_nodes(const Entry& card, const std::vector<Id>& ids, bool sets,
                                  std::unordered_set<Id>& sets_seen);
  // build_beams.cpp
  void build_beams();
  void check_beams();
  // build_inertias.cpp
  void build_inertias();
  // build_field_output.cpp
  void build_field_output();
  void build_left_out_parts(const Entry& card, Id psetid);
  void leave_out(const std::vector<Index>& parts);
  // build_definitions.cpp
  void build_sets();
  void build_curves();
  void build_boxes();
  // function_curves.cpp
  void build_function_curves();
  template <class Card, class Sample>
  void add_smooth_curve(const Card& card, const Sample& sample);
  void check_function_curves();
  // relaxation.cpp
  void silence_curves();
  // short_curves.cpp
  void warn_of_short_curves();
  // move_nodes.cpp
  void move_nodes();
  void move_parts();
  // perturbation.cpp
  void perturb_nodes();
  // build_frames.cpp
  void build_local_boxes();
  void build_coordinate_systems();
  void build_vectors();
  void add_system(const CoordinateNodesCard& card);
  void add_system(const CoordinateSystemCard& card);
  void build_tables();
  void add_table(const Entry& card, Table table);
  void check_tables();
  // build_conditions.cpp
  void build_control();
  void build_relaxation();
  void build_output();
  void build_body_loads();
  bool take_relaxing(const Entry& card, const char* field, Id id, Curve& out);
  void build_gravity_of_parts();
  std::vector<Index> loaded_parts();
  void build_constraints();
  std::array<bool, 3> held_directions(const BoundarySpcCard& card, const std::array<bool, 3>& held,
                                      const char* what);
  // held_planes.cpp
  void hold_planes(bool turn);
  std::vector<Index> nodes_on_plane(const Vec& through, const Vec& normal, Real tolerance) const;
  // build_conditions.cpp
  void hold_rotations(Index n, const std::array<bool, 3>& held);
  Matrix axes_of(const Entry& card, Id icid);
  void build_velocities();
  void set_velocity(const InitialVelocityCard& card);
  void set_velocity(const InitialVelocityGenerationCard& card);
  std::vector<Index> nodes_of(const InitialVelocityGenerationCard& card);
  std::vector<Index> nodes_of_parts(const std::vector<Index>& parts) const;

  /// Index of a node, part, ... named in a field; -1 with an error if the deck has none.
  Index node(const Entry& entry, std::string_view field, Id id);
  Index part(const Entry& entry, std::string_view field, Id id);
  const std::vector<Index>* node_set(const Entry& entry, std::string_view field, Id id);
  const std::vector<Index>* part_set(const Entry& entry, std::string_view field, Id id);
  const Curve* curve(const Entry& entry, std::string_view field, Id id);
  const Box* box(const Entry& entry, std::string_view field, Id id);
  const CoordinateSystem* coordinate_system(const Entry& entry, std::string_view field, Id id);
  void unknown(const Entry& entry, std::string_view field, const char* what, Id id, const char* keyword);

  void error(const Entry& entry, std::string_view field, std::string message, std::string hint = {});
  void duplicate(const Entry& entry, std::string_view field, const char* what, Id id, const Location& first);
  std::string place(const Location& where) const;

  static constexpr int max_errors = 100;  ///< that many are reported

  const Deck& deck_;
  Diagnostics& diagnostics_;
  Model model_;
  IdIndex node_of_id_;
  std::vector<const ElementSolidCard*> solid_cards_;  ///< of model_.solids
  std::map<std::array<Index, 2>, Index>
      made_;  ///< nodes that the deck does not have, by the ends of their edge
  const ElementSolidCard* first_made_ = nullptr;
  std::unordered_map<Id, const ElementShellCard*> shell_cards_;
  int errors_ = 0;
};

}  // namespace courant
