#pragma once
// A scene as d3plot: its nodes, elements and parts as the deck has them, and the words of a state.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "d3plot/words.hpp"
#include "elements/discrete/discrete.hpp"
#include "elements/element_report.hpp"
#include "state/pass.hpp"
#include "state/world.hpp"

namespace courant {

/// How much of elements a state holds, from *DATABASE_EXTENT_BINARY.
struct D3plotExtent {
  int bits = 32;                         ///< of a word
  int history_of_solids = 0;             ///< NEIPH
  int points_of_solids = 1;              ///< NINTSLD: 1 or 8
  int history_of_shells = 0;             ///< NEIPS
  int points_of_shells = 3;              ///< MAXINT; 3: middle, lower, upper
  int points_of_beams = 0;               ///< BEAMIP
  bool stress = true, plastic = true;    ///< SIGFLG, EPSFLG, of shells
  bool resultants = true, extra = true;  ///< RLTFLG, ENGFLG, of shells
  bool strains = false;                  ///< STRFLG: of a point of solids, of the outer points of shells
  /// Strains of solids count as the last numbers of their law.
  int numbers_of_solids() const { return history_of_solids + 6 * strains; }
  int words_of_solid() const { return points_of_solids * (7 + numbers_of_solids()); }
  int words_of_beam() const { return 6 + 5 * points_of_beams; }
  int words_of_shell() const {
    return points_of_shells * (6 * stress + plastic + history_of_shells) + 8 * resultants + 4 * extra +
           12 * strains;
  }
};

/// An element as the deck has it. Nodes and part: positions in the lists of the model, -1 none.
struct D3plotElement {
  Id id = 0;
  Index part = 0;
  std::array<Index, 8> node{};
  bool spring = false;  ///< a spring or damper, which is a beam here
};

struct D3plotPart {
  Id id = 0;
  std::string title;
  ElementKind kind = ElementKind::solid;
  bool sph = false;
  Index index = 0;  ///< into Model::parts
};

/// Lists are sorted by id.
struct D3plotMesh {
  std::string title;
  std::vector<Id> node_ids;
  std::vector<Vec> places;  ///< in the deck [L]
  std::vector<D3plotPart> parts;
  std::vector<D3plotElement> solids, beams, shells;
  std::vector<D3plotElement> particles;  ///< node[0] and part
  const std::vector<D3plotElement>& of(ElementKind kind) const {
    return kind == ElementKind::solid ? solids : kind == ElementKind::beam ? beams : shells;
  }
};

/// The pass of a scene whose deck requests d3plot; it computes nothing.
class D3plotModel : public Pass {
 public:
  D3plotModel(D3plotMesh mesh, D3plotExtent extent, bool vtk, std::size_t most)
      : beside_vtk(vtk), most_bytes(most), mesh_(std::move(mesh)), extent_(extent) {}
  std::string name() const override { return "d3plot"; }

  const bool beside_vtk;         ///< VTK files are written, too
  const std::size_t most_bytes;  ///< of a file of states
  const D3plotExtent& extent() const { return extent_; }

  /// Control words, geometry, numbers and titles: the file `d3plot`.
  std::string head(const World& world) const;
  /// The words of the state at t^n with x, p and f known. The number of words never changes.
  std::string state(World& world, const Clock& clock);
  std::size_t state_bytes(const World& world) const;

 private:
  struct Source {  ///< where the world keeps an element
    const ElementReporter* reporter = nullptr;
    Index e = 0;
    const SpringReporter* spring = nullptr;
    std::optional<Index> segment{};  ///< of a face without a group
  };
  void find_sources(const World& world);
  void find_springs(const World& world);
  /// Where the particles of the mesh are in the world, which sorts them again now and then; -1 none.
  std::vector<Index> find_particles(const World& world) const;
  std::size_t global_words(const World& world) const;
  void put_globals(const World& world, Words& out) const;
  void put_nodes(const World& world, const Clock& clock, const std::vector<Index>& particles,
                 Words& out) const;
  void put_elements(const World& world, Words& out) const;
  void put_solid(const World& world, const Source& source, Words& out) const;
  void put_beam(const World& world, const Source& source, Words& out) const;
  void put_shell(const World& world, const Source& source, Words& out) const;
  void put_particles(const World& world, const std::vector<Index>& particles, Words& out) const;
  bool may_delete() const { return !(mesh_.solids.empty() && mesh_.beams.empty() && mesh_.shells.empty()); }
  std::size_t elements() const { return mesh_.solids.size() + mesh_.beams.size() + mesh_.shells.size(); }

  D3plotMesh mesh_;
  D3plotExtent extent_;
  bool has_sources_ = false;
  std::vector<Source> solids_, beams_, shells_;
  std::vector<Index> node_of_;  ///< of each node of the mesh in World::nodes, -1: a particle or nothing
};

}  // namespace courant
