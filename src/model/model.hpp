#pragma once
// What the deck means after validation, for everything that is not one physics' own business: mesh, parts,
// sets, curves, initial and boundary conditions, loads, control and output requests. Physics folders read
// their own cards (SECTION_SPH, CONTACT_..., MAT_..., EOS_...) from the deck and find parts and sets here.
#include <array>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"
#include "keyword/card.hpp"
#include "model/mesh/solid_edges.hpp"

namespace courant {

struct ModelNode {
  Id id = 0;
  Vec x = Vec::Zero();                                ///< [L]
  Vec v = Vec::Zero();                                ///< initial velocity [L/T]
  std::array<bool, 3> fixed = {false, false, false};  ///< translations held by BOUNDARY_SPC or TC
};

/// A layer of a composite.
struct ModelPly {
  Id mid = 0;
  Real thickness = 0;  ///< [L]
  Real angle = 0;      ///< of the material about the normal [degrees]
  bool operator==(const ModelPly&) const = default;
};

struct ModelPart {
  Id id = 0;
  std::string title;
  Id secid = 0, mid = 0, eosid = 0, hgid = 0;
  Location where;  ///< of the PART card, for messages
  Entry card;      ///< the PART card, for messages about one of its fields
  bool has_sph = false, has_shell = false, has_solid = false, has_beam = false;
  bool rigid = false;               ///< its material is a *MAT_RIGID
  bool null = false;                ///< shells or beams of *MAT_NULL: mass and faces without a stress
  bool velocity_given = false;      ///< INITIAL_VELOCITY_GENERATION names this part
  std::vector<ModelPly> plies{};    ///< of *PART_COMPOSITE, from the lower face to the upper; else none
  Real optt = 0, sft = 1, ssf = 1;  ///< of *PART_CONTACT [L, -, -]
};

/// Layers of single shells of a part, instead of those of the part.
struct ModelLayup {
  Index part = 0;                 ///< index into parts
  std::vector<ModelPly> plies{};  ///< from the lower face to the upper
  Entry card;                     ///< of the first such element, for messages
  Real thickness() const;         ///< of all layers [L]
};

struct ModelSph {
  Index node = 0;    ///< index into nodes; the particle's id is the node's
  Index part = 0;    ///< index into parts
  Real mass = 0;     ///< > 0 mass [M]; < 0: -volume [L3], times the material's RO (2D: per unit depth)
  Entry card;        ///< the ELEMENT_SPH card, for messages
  Real spacing = 0;  ///< of an inlet where particles do not wait on a lattice; else 0: places tell [L]
};

struct ModelShell {
  Id id = 0;
  Index part = 0;
  std::array<Index, 4> node = {0, 0, 0, 0};  ///< triangle: node[3] == node[2]
};

/// A hexahedron: nodes 1 to 4 run around the lower face, counter-clockwise seen from the upper one, 5 to 8
/// are above them; or what becomes of it where nodes stand several times: pentahedra, pyramids, tetrahedra.
/// Or a tetrahedron with nodes 5 to 10, or a hexahedron with nodes 9 to 20 on its edges, in the order of
/// model/mesh/solid_edges.hpp.
struct ModelSolid {
  Id id = 0;
  Index part = 0;
  std::array<Index, 20> node{};  ///< -1 behind the last

  /// As corners of a hexahedron. Of a tetrahedron with nodes a, b, c, d, however often it repeats which of
  /// them: a b c c d d d d, since other repetitions leave a warped face.
  std::array<Index, 8> corners() const;
  bool has_nodes_on_edges() const { return node[9] >= 0; }
  bool is_hexahedron_of_twenty() const { return node[19] >= 0; }
  /// With nodes on edges: 4 or 8 corners, behind which these are.
  std::size_t first_on_edge() const { return is_hexahedron_of_twenty() ? 8 : 4; }
  /// Edges with a node on them, by their corners: number k has node[first_on_edge() + k].
  std::span<const SolidEdge> edges_with_nodes() const;
  /// Ten or twenty with nodes on edges; else corners(), and -1 behind them.
  std::array<Index, 20> all_corners() const;
  /// How many of these count: 8, 10 or 20.
  int corner_count() const { return !has_nodes_on_edges() ? 8 : is_hexahedron_of_twenty() ? 20 : 10; }
  /// Different nodes among these: 8 of a hexahedron, 6 of a pentahedron, 5 of a pyramid, 4 of a tetrahedron.
  int different_corners() const;
  int different_nodes() const { return has_nodes_on_edges() ? corner_count() : different_corners(); }
};
/// Nodes on the edges of solids, by the ends of the edge, the lower index first.
std::map<std::array<Index, 2>, Index> nodes_on_edges(const std::vector<ModelSolid>& solids);

struct ModelBeam {
  Id id = 0;
  Index part = 0;
  std::array<Index, 2> node{};
  Index third = -1;                ///< N3, -1: none
  Vec direction = Vec::Zero();     ///< of _ORIENTATION, 0: none
  std::array<Real, 5> measures{};  ///< of _THICKNESS; 0: of the section
  std::array<int, 4> released{};   ///< RT1, RR1, RT2, RR2, as TC of *NODE; of local axes if LOCAL is 2
  bool released_globally = false;
  Entry card;  ///< the ELEMENT_BEAM card, for messages
};

/// *ELEMENT_INERTIA: mass and inertia on a node.
struct ModelInertia {
  Id id = 0;
  Index node = -1;
  Real mass = 0;              ///< [M]
  Matrix J = Matrix::Zero();  ///< about its own centre, global axes [ML2]
  Vec offset = Vec::Zero();   ///< of the centre from the node [L]
  Entry card;
  bool turns() const { return J.norm() > 0; }
};

/// A face told by its corners; triangle: node[3] == node[2], line in 2D: node[3] == node[2] == node[1]. Its
/// normal follows from the order of the corners.
struct ModelSegment {
  std::array<Index, 4> node{};
};

/// Piecewise linear, constant beyond its ends. Values are SFO (ordinate + OFFO) at SFA (abscissa + OFFA).
/// Two points with the same abscissa are a jump; at the abscissa itself the later one holds.
struct Curve {
  Id id = 0;
  std::vector<Real> abscissa, ordinate;
  bool by_formula = false;  ///< points of an expression of the time, up to ENDTIM
  int sidr = 0;             ///< phase of loads: 0 transient, 1 relaxation, 2 both
  bool silent = false;      ///< a load that does not act in this phase: 0
  Real operator()(Real a) const;
};

/// Curves over a parameter: DEFINE_TABLE and _2D (curve ids), _3D (ids of tables).
struct Table {
  Id id = 0;
  std::vector<Real> value{};  ///< SFA (VALUE + OFFA), increasing
  std::vector<Id> curve{};    ///< one for each value
  bool of_tables = false;
};

/// Cartesian, right-handed. Column k of `axes` is the local axis k.
struct CoordinateSystem {
  Id id = 0;
  Vec origin = Vec::Zero();
  Matrix axes = Matrix::Identity();
  bool moves = false;  ///< FLAG or NID: turns with nodes from t = 0 on
};

/// DEFINE_VECTOR
struct ModelVector {
  Id id = 0;
  Vec tail = Vec::Zero(), head = Vec::Zero();
  bool moves = false;  ///< given by nodes
};

struct Box {
  Id id = 0;
  Vec low = Vec::Zero(), high = Vec::Zero();  ///< along the axes below
  bool local = false;                         ///< DEFINE_BOX_LOCAL: with axes and an origin of its own
  Vec origin = Vec::Zero();
  Matrix axes = Matrix::Identity();
  bool contains(const Vec& point) const {
    const Vec x = local ? Vec(axes.transpose() * (point - origin)) : point;
    return (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
  }
};

/// LOAD_BODY_X/Y/Z, _VECTOR, LOAD_GRAVITY_PART: the base is accelerated by SF curve(t) along `direction`, and
/// the bodies feel the opposite, -SF curve(t) direction. LOAD_GRAVITY_PART has this sign, too: ACCEL > 0 with
/// DOF 3 is gravity along -z. LOAD_BODY_RX/RY/RZ: the base turns with SF curve(t) about `direction` through
/// `centre`, and the bodies feel the centrifugal acceleration -omega x (omega x r) of where they are now;
/// nothing follows from a change of omega, so its sign does not matter.
struct BodyLoad {
  enum class Kind { translation, rotation } kind = Kind::translation;
  Vec direction = Vec::UnitX();  ///< unit vector
  Vec centre = Vec::Zero();      ///< of a rotation [L]
  Curve curve{};                 ///< over time
  Real sf = 1;                   ///< SF curve(t): acceleration [L/T2], or angular velocity [1/T]
  std::vector<Index> parts{};    ///< on which it acts, sorted; empty: on all
};

/// When an output is due.
struct OutputTimes {
  /// IOOPT where a curve (LCUR, LCDT) tells the times t_k instead of an interval.
  enum class Rule {
    interval,    ///< every `interval`
    after_last,  ///< 1: t_{k+1} = t_k + f(t_k)
    implicit,    ///< 2: t_{k+1} = t_k + f(t_{k+1})
    abscissae,   ///< 3: at the abscissae of the curve
  };
  Real interval = 0;  ///< 0: not requested [T]
  Rule rule = Rule::interval;
  Curve curve{};  ///< interval over time, positive [T]
  bool asked() const { return interval > 0 || rule != Rule::interval; }
};

/// A node of *DATABASE_HISTORY_NODE.
struct HistoryNode {
  Id id = 0;
  Vec X = Vec::Zero();  ///< position at t = 0 [L]
  std::string title{};
  /// Of an accelerometer: local x from the node to the first of these, y towards the second. 0: none.
  std::array<Id, 2> axes{};
};

/// What goes into the field files, and how: *COURANT_OUTPUT, *DATABASE_EXTENT_BINARY. Zero or empty: not
/// given.
struct FieldRequests {
  Entry card{};                     ///< of *COURANT_OUTPUT, for messages; keyword < 0: none
  std::vector<std::string> fields;  ///< names of arrays of particles; empty: the usual ones
  std::vector<std::string> extra;   ///< besides these, where the run has them
  bool small = false;
  int bits = 32;                ///< of reals
  int compression = -1;         ///< 0 none, 1 zlib, 2 xz; -1 not given
  int level = -1;               ///< of the compression; -1 not given
  Real eps = -1;                ///< error of values, of the range of an array at that time; -1 not given
  Real epsx = -1;               ///< error of positions, of h; -1 not given
  std::vector<Index> left_out;  ///< parts, sorted
  bool in_box = false;
  Box box;
};

/// The output requests of the deck.
struct OutputRequests {
  OutputTimes d3plot;
  int d3plot_count = 0;  ///< NPLTC: interval is ENDTIM / NPLTC if given
  struct History {
    OutputTimes times{};
    int binary = 1;  ///< BINARY
  };
  std::map<std::string, History> histories{};  ///< by the name of the file: glstat
  /// Its times; none where the deck does not name it.
  OutputTimes history(const std::string& name) const {
    const auto at = histories.find(name);
    return at == histories.end() ? OutputTimes() : at->second.times;
  }
  std::vector<Id> history_sph;            ///< particles in sphout
  std::vector<HistoryNode> history_node;  ///< nodes in nodout
  FieldRequests fields;
};

/// What is computed: before the transient a relaxation to rest, with loads of its own, where the deck asks
/// for one.
enum class RunPhase { transient, relaxation };

struct Model {
  std::string title;
  RunPhase phase = RunPhase::transient;
  std::vector<ModelNode> nodes;
  std::vector<ModelPart> parts;
  std::vector<ModelSph> sph;
  std::vector<ModelShell> shells;
  std::vector<ModelSolid> solids;
  std::vector<ModelBeam> beams;
  std::vector<ModelInertia> inertias;
  std::unordered_map<Index, std::array<Real, 4>> shell_thickness;  ///< of shells with one of their own [L]
  std::unordered_map<Index, Real> shell_beta;  ///< angle of the material, of shells with one [degrees]
  std::unordered_map<Index, Real>
      shell_offset;                ///< height of the middle over the nodes, with one of their own [L]
  std::vector<ModelLayup> layups;  ///< different ones
  std::unordered_map<Index, Index> shell_layup;  ///< index into layups, of shells with layers of their own
  /// Of nodes, where some turn: rotations that BOUNDARY_SPC or RC hold, initial angular velocity.
  std::unordered_map<Index, std::array<bool, 3>> held_rotations;
  std::unordered_map<Index, Vec> angular_velocity;  ///< [1/T]
  std::vector<ModelSegment> segments;               ///< those of all segment sets
  std::unordered_map<Id, Index> part_of_id;
  std::map<Id, std::vector<Index>> node_sets;     ///< indices into nodes
  std::map<Id, std::vector<Index>> part_sets;     ///< indices into parts
  std::map<Id, std::vector<Index>> shell_sets;    ///< indices into shells
  std::map<Id, std::vector<Index>> solid_sets;    ///< indices into solids
  std::map<Id, std::vector<Index>> segment_sets;  ///< indices into segments
  std::map<Id, Curve> curves;
  std::map<Id, Table> tables;
  std::map<Id, Box> boxes;
  std::map<Id, CoordinateSystem> coordinate_systems;
  std::map<Id, ModelVector> vectors;
  std::vector<BodyLoad> body_loads;
  OutputRequests output;

  Real endtim = 0;  ///< [T]
  Id endcyc = 0;    ///< 0: no limit
  Real dtmin = 0;   ///< stop when dt < dtmin x first dt
  Real endeng = 0;  ///< stop when the energy ratio differs by more from 1, percent; 0 never
  Real tssfac = 0.9;
  Real dtinit = 0;  ///< first step, 0: computed [T]
  bool dt_max_given = false;
  Curve dt_max;  ///< LCTM: largest step over time

  /// Whether nodes may turn: shells and beams have moments, and nodes may have an inertia of their own.
  bool turns() const { return !shells.empty() || !beams.empty() || !inertias.empty(); }
  /// Gives back nodes, particles, elements and the sets of them, once the world is built from them.
  void release_mesh();
};

}  // namespace courant
