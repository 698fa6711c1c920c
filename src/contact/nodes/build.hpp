#pragma once
// Contact of nodes with faces from the cards of a deck.
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "contact/cards.hpp"
#include "contact/nodes/node_contact.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

enum class ContactSide { a, b };

/// A beam that touches.
struct BeamEdge {
  std::size_t group = 0;  ///< index into World::groups
  Index element = 0;
  std::array<Index, 2> node{};  ///< indices into World::nodes
  Real length = 0, area = 0;    ///< [L], [L2]
};

/// The faces and nodes that the sides of a card name. Faces of solids are added to world.segments where they
/// are not there yet. What is missing is reported.
class FaceFinder {
 public:
  /// `bulk_modulus(part)` of solids.
  FaceFinder(const Deck& deck, const Model& model, std::function<Real(Index)> bulk_modulus, World& world,
             Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        bulk_modulus_(std::move(bulk_modulus)),
        world_(world),
        diagnostics_(diagnostics) {}
  /// From here on faces between solids count, too, that deletion may lay bare; or not.
  void with_inner(bool inner) { inner_ = inner; }
  /// Indices into world.segments, ascending; none of a node set. `blank_is_all`: a side of no id is
  /// everything.
  std::vector<Index> faces(const ContactCard& card, ContactSide side, bool blank_is_all);
  std::vector<Index> faces(const ContactCard& card, ContactSide side) {
    return faces(card, side, kind_of(card).single);
  }
  /// Indices into world.nodes, ascending: corners of the faces, or of a node set those that elements have.
  std::vector<Index> nodes(const ContactCard& card, ContactSide side, const std::vector<Index>& faces);
  /// The same of a side that names parts: nodes of all elements that these have, of beams, too.
  std::vector<Index> nodes_of_elements(const ContactCard& card, ContactSide side);
  /// Whether the side names parts, none of which has shells or solids: parts of beams.
  bool has_no_faces(const ContactCard& card, ContactSide side) const;
  /// Beams with a length and a cross section that SURFA names by parts, or with all; those all of whose ends
  /// are in SABOXID.
  std::vector<BeamEdge> beams(const ContactCard& card);
  /// Whether a penalty of the card finds a stiffness there; an error where it does not: shells of *MAT_NULL
  /// have that of YM, which may be 0.
  /// `by_mass`: SOFT 1 takes it from masses.
  bool are_stiff(const ContactCard& card, const std::vector<Index>& faces, bool by_mass);
  /// Those that ISYM 1 of an eroding contact leaves out: faces of solids all of whose corners are held along
  /// their normal, if that is along a global axis.
  void leave_out_symmetric(const ContactCard& card, std::vector<Index>& faces) const;
  /// The box that restricts a side at the start; null: none, or an error where it does not exist.
  const Box* box_of(const ContactCard& card, ContactSide side) const;
  /// Leaves out faces with a corner outside of that box.
  void keep_in_box(const ContactCard& card, ContactSide side, std::vector<Index>& faces) const;
  /// All faces of the elements that nodes belong to.
  std::vector<Index> faces_around(const std::vector<Index>& nodes);

 private:
  using Key = std::array<Index, 4>;
  std::vector<Index> of_parts(const std::vector<char>& chosen);
  bool is_hidden(Index segment) const;
  std::vector<Index> of_parts(const ContactCard& card, const char* field, const std::vector<char>& chosen);
  std::vector<Index> of_segment_set(const ContactCard& card, const char* field, Id id);
  std::vector<Index> of_shell_set(const ContactCard& card, const char* field, Id id);
  std::vector<char> parts_of(const ContactCard& card, const char* field, Id id, int type);
  void keep_in_box(Id box, std::vector<Index>& nodes) const;
  const std::map<Id, Index>& node_of_id();
  const std::map<Key, Index>& face_of_corners();

  const Deck& deck_;
  const Model& model_;
  std::function<Real(Index)> bulk_modulus_;
  World& world_;
  Diagnostics& diagnostics_;
  bool inner_ = false;
  std::map<Id, Index> node_of_id_;
  std::map<Key, Index> face_of_corners_;
};

struct NodeContactOptions {
  /// Of the solids of a part. [M/LT2]
  std::function<Real(Index part)> bulk_modulus = [](Index) { return Real(0); };
  WallBodies bodies{};  ///< whose nodes and faces it touches
  Real tssfac = 0.9;
  std::set<Id> with_particles{};  ///< contacts that particles take part in
};

/// By the number of the card, counted from 1; those of which something can touch.
using NodeContactsByCard = std::map<int, std::shared_ptr<const NodeContact>>;

/// Contact of nodes for all *CONTACT cards of the deck, added to the passes of `world`; particles are left to
/// build_contacts. Elements must be there, and Nodes::held, ::follow be set. Reports what is not supported,
/// and as warnings initial penetrations and contacts of which nothing can touch.
NodeContactsByCard add_node_contacts(const Deck& deck, const Model& model, const NodeContactOptions& options,
                                     World& world, Diagnostics& diagnostics);

}  // namespace courant
