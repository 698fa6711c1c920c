#pragma once
// What the deck means after validation, for everything that is not one physics' own business: mesh, parts,
// sets, curves, initial and boundary conditions, loads, control and output requests. Physics folders read
// their own cards (SECTION_SPH, CONTACT_..., MAT_..., EOS_...) from the deck and find parts and sets here.
#include <array>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"
#include "keyword/card.hpp"

namespace courant {

struct ModelNode {
  Id id = 0;
  Vec x = Vec::Zero();                                ///< [L]
  Vec v = Vec::Zero();                                ///< initial velocity [L/T]
  std::array<bool, 3> fixed = {false, false, false};  ///< translations held by BOUNDARY_SPC or TC
};

struct ModelPart {
  Id id = 0;
  std::string title;
  Id secid = 0, mid = 0, eosid = 0, hgid = 0;
  Location where;  ///< of the PART card, for messages
  Entry card;      ///< the PART card, for messages about one of its fields
  bool has_sph = false, has_shell = false;
  bool velocity_given = false;  ///< INITIAL_VELOCITY_GENERATION names this part
};

struct ModelSph {
  Index node = 0;  ///< index into nodes; the particle's id is the node's
  Index part = 0;  ///< index into parts
  Real mass = 0;   ///< > 0 mass [M]; < 0: -volume [L3], times the material's RO (2D: per unit depth)
  Entry card;      ///< the ELEMENT_SPH card, for messages
};

struct ModelShell {
  Id id = 0;
  Index part = 0;
  std::array<Index, 4> node = {0, 0, 0, 0};  ///< triangle: node[3] == node[2]
};

/// Piecewise linear, constant beyond its ends. Values are SFO (ordinate + OFFO) at SFA (abscissa + OFFA).
struct Curve {
  Id id = 0;
  std::vector<Real> abscissa, ordinate;
  Real operator()(Real a) const;
};

struct Box {
  Id id = 0;
  Vec low = Vec::Zero(), high = Vec::Zero();
  bool contains(const Vec& x) const {
    return (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
  }
};

/// LOAD_BODY_X/Y/Z: base acceleration SF curve(t) along an axis; the bodies feel the opposite.
struct BodyLoad {
  int axis = 0;
  Curve curve;
  Real sf = 1;
};

/// Interval of an output, 0: not asked for. [T]
struct OutputRequests {
  Real d3plot = 0;
  int d3plot_count = 0;  ///< NPLTC: interval is ENDTIM / NPLTC if given
  Real glstat = 0, matsum = 0, rcforc = 0, sphout = 0;
  std::vector<Id> history_sph;  ///< particles in sphout
};

struct Model {
  std::string title;
  std::vector<ModelNode> nodes;
  std::vector<ModelPart> parts;
  std::vector<ModelSph> sph;
  std::vector<ModelShell> shells;
  std::unordered_map<Id, Index> part_of_id;
  std::map<Id, std::vector<Index>> node_sets;  ///< indices into nodes
  std::map<Id, std::vector<Index>> part_sets;  ///< indices into parts
  std::map<Id, Curve> curves;
  std::map<Id, Box> boxes;
  std::vector<BodyLoad> body_loads;
  OutputRequests output;

  Real endtim = 0;  ///< [T]
  Id endcyc = 0;    ///< 0: no limit
  Real dtmin = 0;   ///< stop when dt < dtmin x first dt
  Real tssfac = 0.9;
  Real dtinit = 0;  ///< first step, 0: computed [T]
  bool dt_max_given = false;
  Curve dt_max;  ///< LCTM: largest step over time

  /// Gives back nodes, particles and node sets, once the world is built from them.
  void release_mesh();
};

}  // namespace courant
