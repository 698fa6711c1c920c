// *LOAD_SEGMENT and _SET, *LOAD_SHELL_ELEMENT and _SET: pressure on faces between nodes.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "loads/blast/blast_cards.hpp"
#include "loads/load_cards.hpp"
#include "loads/loads.hpp"
#include "loads/middle_velocity.hpp"
#include "model/definitions/named_curve.hpp"
#include "model/transforms/transformation.hpp"
#include "parallel/counting_sort.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

using Segment = LoadSegment;

const RegisterKeyword<Segment> load_segment_keyword{load_segment_table()};
const RegisterKeyword<LoadSegmentSet> load_segment_set_keyword{load_segment_set_table()};

struct LoadShell : LoadShellFields {
  bool is_set() const { return name == 1; }  ///< names are in this order
};

const RegisterKeyword<LoadShell> load_shell_keyword{load_shell_element_table()};

/// A pressure and where it acts: corners as nodes of the world, of a triangle the third again.
struct PressureFace {
  std::array<Index, 4> node{};
  /// Nodes on the edges, where all have one: behind each corner; -1: none.
  std::array<Index, 4> on_edge{-1, -1, -1, -1};
  std::size_t load = 0;
  Index blast = -1;  ///< among the waves; -1: the load presses
  int corners() const { return node[2] == node[3] ? 3 : 4; }
};
struct PressureLoad {
  Curve curve{};
  Real sf = 1, at = 0;
  Real operator()(Real t) const { return t < at ? 0 : sf * curve(t - at); }  ///< [M/LT2]
};

/// What a charge does to a face, which stood there at the start.
struct BlastOnFace {
  std::size_t source = 0;
  BlastWave wave{};
  Real scale = 1;
};

/// The integral of N n dA of a node of a triangle of six nodes, corners first, then those on edges 12, 23,
/// 31: six points, exact for polynomials of degree 4 (Dunavant 1985), as N n dA is. So one pressure on all of
/// a closed surface has no moment. [L2]
Vec area_of_node(const std::array<Vec, 6>& x, std::size_t node) {
  constexpr Real beside[2]{0.445948490915965, 0.091576213509771},  // two coordinates of a point
      weight[2]{0.223381589678011, 0.109951743655322};
  Vec out = Vec::Zero();
  for (std::size_t point = 0; point < 6; ++point) {
    const std::size_t kind = point / 3;
    std::array<Real, 3> L{beside[kind], beside[kind], beside[kind]};
    L[point % 3] = 1 - 2 * beside[kind];
    std::array<Vec, 3> slope;  // by L1, L2, L3, as if they were independent
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;  // edge 3 + a joins a and b, 3 + c joins c and a
      slope[a] = (4 * L[a] - 1) * x[a] + 4 * L[b] * x[3 + a] + 4 * L[c] * x[3 + c];
    }
    const Real N = node < 3 ? L[node] * (2 * L[node] - 1) : 4 * L[node - 3] * L[(node - 2) % 3];
    out += 0.5 * weight[kind] * N * (slope[1] - slope[0]).cross(slope[2] - slope[0]);
  }
  return out;
}

/// The same of a face of eight nodes, corners first: 3 x 3 points of Gauss, which are exact.
Vec area_of_node(const std::array<Vec, 8>& x, std::size_t node) {
  constexpr Real at[3]{-0.774596669241483377, 0, 0.774596669241483377}, weight[3]{5.0 / 9, 8.0 / 9, 5.0 / 9};
  constexpr Real xi_of[8]{-1, 1, 1, -1, 0, 1, 0, -1}, eta_of[8]{-1, -1, 1, 1, -1, 0, 1, 0};
  Vec out = Vec::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Real xi = at[i], eta = at[j];
      Vec by_xi = Vec::Zero(), by_eta = Vec::Zero();
      Real of_node = 0;
      for (std::size_t c = 0; c < x.size(); ++c) {
        const Real a = xi_of[c], b = eta_of[c], A = 1 + a * xi, B = 1 + b * eta;
        Real N, dxi, deta;
        if (c < 4)
          N = A * B * (a * xi + b * eta - 1) / 4, dxi = a * B * (2 * a * xi + b * eta) / 4,
          deta = b * A * (2 * b * eta + a * xi) / 4;
        else if (a == 0)
          N = (1 - xi * xi) * B / 2, dxi = -xi * B, deta = b * (1 - xi * xi) / 2;
        else
          N = (1 - eta * eta) * A / 2, dxi = a * (1 - eta * eta) / 2, deta = -eta * A;
        by_xi += dxi * x[c], by_eta += deta * x[c];
        if (c == node) of_node = N;
      }
      out += weight[i] * weight[j] * of_node * by_xi.cross(by_eta);
    }
  return out;
}

/// -p A n, half the cross product of the diagonals, in equal shares for the corners. Each node works out the
/// faces it is a corner of, in the order of the deck: the same bits on any number of threads.
class SegmentPressure : public Force, public EnergyTerm {
 public:
  SegmentPressure(std::vector<PressureLoad> loads, std::vector<PressureFace> faces,
                  std::vector<BlastSource> charges, std::vector<BlastOnFace> blasts, WallBodies bodies,
                  World& world)
      : bodies_(std::move(bodies)),
        loads_(std::move(loads)),
        faces_(std::move(faces)),
        charges_(std::move(charges)),
        blasts_(std::move(blasts)),
        nodes_(&world.nodes) {
    std::vector<Index> node, face;
    for (std::size_t k = 0; k < faces_.size(); ++k) {
      for (int c = 0; c < faces_[k].corners(); ++c)
        node.push_back(faces_[k].node[static_cast<std::size_t>(c)]), face.push_back(static_cast<Index>(k));
      for (const Index n : faces_[k].on_edge)
        if (n >= 0) node.push_back(n), face.push_back(static_cast<Index>(k));
    }
    std::vector<Index> order;
    counting_sort(node, world.nodes.size(), first_, order);
    for (const Index k : order) of_node_.push_back(face[static_cast<std::size_t>(k)]);
  }
  std::string name() const override { return "pressure on segments"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).updates(world.nodes.f);
  }

  void start(World&, const Clock& clock) override {
    pressure_.clear(), now_ = clock.t, half_ = 0.5 * clock.dt_old;
    for (const PressureLoad& load : loads_) pressure_.push_back(load(clock.t));
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n)
      if (acts_on(n)) world.nodes.f.add(n, force(n));
  }
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const Points points = points_of(world.nodes);
    const MiddleVelocity middle(points, clock);
    const auto work_on = [&](Index n) -> Real {
      if (!acts_on(n)) return 0;
      return force(n).dot(nodes_->follow[n] ? middle_of_body(n, clock) : middle(n)) * clock.dt_mean();
    };
    ledger.external_work += sum(nodes_->size(), work_on);
    ledger.throughput += sum(nodes_->size(), [&](Index n) { return std::abs(work_on(n)); });
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  bool acts_on(Index n) const {
    return first_[static_cast<std::size_t>(n)] < first_[static_cast<std::size_t>(n) + 1];
  }
  Vec force(Index n) const {
    Vec out = Vec::Zero();
    for (Index k = first_[static_cast<std::size_t>(n)]; k < first_[static_cast<std::size_t>(n) + 1]; ++k) {
      const PressureFace& f = faces_[static_cast<std::size_t>(of_node_[static_cast<std::size_t>(k)])];
      const auto x = [&](std::size_t c) { return nodes_->x.vec(f.node[c]); };
      const Vec area = f.corners() == 3 ? Vec((x(1) - x(0)).cross(x(2) - x(0)) / 2)
                                        : Vec((x(2) - x(0)).cross(x(3) - x(1)) / 2);
      const Real p = f.blast < 0 ? pressure_[f.load] : blast_on(f, area);
      out -= f.on_edge[0] < 0   ? Vec(p / f.corners() * area)
             : f.corners() == 3 ? Vec(p * of_all<6>(f, n))
                                : Vec(p * of_all<8>(f, n));
    }
    return out;
  }
  /// Of a face with nodes on its edges.
  template <std::size_t count>
  Vec of_all(const PressureFace& f, Index n) const {
    std::array<Vec, count> x;
    std::size_t at = 0;
    for (std::size_t c = 0; c < count; ++c) {
      const Index node = c < count / 2 ? f.node[c] : f.on_edge[c - count / 2];
      x[c] = nodes_->x.vec(node);
      if (node == n) at = c;
    }
    return area_of_node(x, at);
  }

  Real blast_on(const PressureFace& f, const Vec& area) const {
    const BlastOnFace& blast = blasts_[static_cast<std::size_t>(f.blast)];
    const BlastSource& charge = charges_[blast.source];
    Vec middle = Vec::Zero();
    for (int c = 0; c < f.corners(); ++c)
      middle += nodes_->x.vec(f.node[static_cast<std::size_t>(c)]) / f.corners();
    const Vec to_charge = charge.place - middle;
    const Real cosine = area.dot(to_charge) / (area.norm() * to_charge.norm());
    return blast.scale * charge.pressure(blast.wave, now_, half_, cosine);
  }

  /// Of the velocities before and after the kick to come, as for other nodes.
  Vec middle_of_body(Index n, const Clock& clock) const {
    const Index body = bodies_.body(n);
    if (body < 0) return nodes_->v.vec(n);
    return nodes_->v.vec(n) + 0.5 * bodies_.change(body, nodes_->x.vec(n), clock);
  }

  WallBodies bodies_;
  std::vector<PressureLoad> loads_;
  std::vector<PressureFace> faces_;
  std::vector<BlastSource> charges_;
  std::vector<BlastOnFace> blasts_;
  Real now_ = 0, half_ = 0;  ///< half of the step before, for that to come [T]
  const Nodes* nodes_;
  std::vector<Index> first_, of_node_;  ///< faces of each node
  std::vector<Real> pressure_;          ///< of each load now [M/LT2]
};

class PressureReader {
 public:
  PressureReader(const Deck& deck, const Model& model, const World& world, std::vector<BlastSource> sources,
                 Diagnostics& diagnostics)
      : charges(std::move(sources)), deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {
    for (Index n = 0; n < world.nodes.size(); ++n) world_node_[world.nodes.id[n]] = n;
    for (const auto& [ends, middle] : nodes_on_edges(model.solids)) {
      const auto of_world = [&](Index n) {
        return world_node_.at(model.nodes[static_cast<std::size_t>(n)].id);
      };
      on_edge_[std::minmax({of_world(ends[0]), of_world(ends[1])})] = of_world(middle);
    }
  }
  void add(const LoadSegment& card) {
    std::array<Id, 4> id{card.n1, card.n2, card.n3, card.n4 == 0 ? card.n3 : card.n4};
    if (id[3] == id[0]) id[3] = id[2];  // the other way to write a triangle
    if (add_load(card, card.lcid, card.sf, card.at)) add_face(card, "N1", id);
  }
  void add(const LoadSegmentSet& card) {
    const auto set = model_.segment_sets.find(card.ssid);
    if (set == model_.segment_sets.end())
      return deck_.error(diagnostics_, card, "SSID", fmt::format("segment set {} does not exist", card.ssid),
                         "define it with *SET_SEGMENT");
    if (!add_load(card, card.lcid, card.sf, card.at)) return;
    for (const Index s : set->second)
      if (!add_face(card, "SSID", corners_of(model_.segments[static_cast<std::size_t>(s)].node))) return;
  }
  void add(const BlastSegment& card) {
    std::array<Id, 4> id{card.n1, card.n2, card.n3, card.n4 == 0 ? card.n3 : card.n4};
    if (id[3] == id[0]) id[3] = id[2];
    add_blast(card, "N1", id);
  }
  void add(const BlastSegmentSet& card) {
    const auto set = model_.segment_sets.find(card.ssid);
    if (set == model_.segment_sets.end())
      return deck_.error(diagnostics_, card, "SSID", fmt::format("segment set {} does not exist", card.ssid),
                         "define it with *SET_SEGMENT");
    for (const Index s : set->second)
      if (!add_blast(card, "SSID", corners_of(model_.segments[static_cast<std::size_t>(s)].node))) return;
  }
  void add(const LoadShell& card) {
    std::vector<Index> shells;
    if (card.is_set()) {
      const auto set = model_.shell_sets.find(card.eid);
      if (set == model_.shell_sets.end())
        return deck_.error(diagnostics_, card, "EID", fmt::format("shell set {} does not exist", card.eid),
                           "define it with *SET_SHELL_LIST");
      shells = set->second;
    } else {
      const auto found = shell_of(card.eid);
      if (found < 0)
        return deck_.error(diagnostics_, card, "EID", fmt::format("shell {} does not exist", card.eid),
                           "define it with *ELEMENT_SHELL");
      shells.push_back(found);
    }
    if (!add_load(card, card.lcid, card.sf, card.at)) return;
    for (const Index s : shells)
      if (!add_face(card, "EID", corners_of(model_.shells[static_cast<std::size_t>(s)].node))) return;
  }
  std::vector<PressureLoad> loads;
  std::vector<PressureFace> faces;
  std::vector<BlastSource> charges;
  std::vector<BlastOnFace> blasts;

 private:
  std::array<Id, 4> corners_of(const std::array<Index, 4>& node) const {
    std::array<Id, 4> id{};
    for (std::size_t c = 0; c < 4; ++c) id[c] = model_.nodes[static_cast<std::size_t>(node[c])].id;
    return id;
  }
  template <class Card>
  bool add_blast(const Card& card, const char* field, const std::array<Id, 4>& id) {
    const auto refuse = [&](const char* at, std::string message, const char* hint) {
      deck_.error(diagnostics_, card, at, std::move(message), hint);
      return false;
    };
    const auto charge = std::find_if(charges.begin(), charges.end(),
                                     [&](const BlastSource& one) { return one.id == card.bid; });
    if (charge == charges.end())
      return refuse("BID", fmt::format("charge {} does not exist", card.bid),
                    "define it with *LOAD_BLAST_ENHANCED");
    if (charge->refused) return false;
    if (world_.dim == 2)
      return refuse("BID", "blasts are not supported in plane scenes", "use *LOAD_SEGMENT");
    if (!add_face(card, field, id)) return false;
    PressureFace& face = faces.back();
    Vec middle = Vec::Zero();
    for (int c = 0; c < face.corners(); ++c)
      middle += world_.nodes.x.vec(face.node[static_cast<std::size_t>(c)]) / face.corners();
    const Real distance = (charge->place - middle).norm();
    const auto wave = charge->wave_at(distance);
    if (!wave) {
      const BlastRange range = blast_range(charge->kind);
      return refuse(field,
                    fmt::format("the face of node {} is {:.4g} ft/lb^(1/3) from charge {}, and the fits hold "
                                "from {:g} to {:g}",
                                id[0], charge->scaled(distance), card.bid, range.least, range.most),
                    "check M, the position of the charge and UNIT, or leave the face out");
    }
    face.blast = static_cast<Index>(blasts.size());
    blasts.push_back({static_cast<std::size_t>(charge - charges.begin()), *wave, card.scalep});
    return true;
  }
  /// Index into Model::shells; -1: there is none.
  Index shell_of(Id id) {
    if (shell_of_id_.empty())
      for (std::size_t s = 0; s < model_.shells.size(); ++s)
        shell_of_id_.emplace(model_.shells[s].id, static_cast<Index>(s));
    const auto found = shell_of_id_.find(id);
    return found == shell_of_id_.end() ? -1 : found->second;
  }
  template <class Card>
  bool add_load(const Card& card, Id lcid, Real sf, Real at) {
    const Curve* curve = curve_named(deck_, model_, card, "LCID", lcid, diagnostics_);
    if (!curve) return false;
    loads.push_back({*curve, sf, at});
    return true;
  }
  template <class Card>
  bool add_face(const Card& card, const char* field, const std::array<Id, 4>& id) {
    PressureFace face{.node = {}, .load = loads.size() - 1};
    for (std::size_t c = 0; c < 4; ++c) {
      const auto found = world_node_.find(id[c]);
      if (found == world_node_.end()) {
        deck_.error(diagnostics_, card, field,
                    fmt::format("node {} of a face under pressure is no corner of an element", id[c]),
                    "pressure acts on faces of solids and shells; that on particles comes from contact");
        return false;
      }
      face.node[c] = found->second;
    }
    const std::set<Index> different(face.node.begin(), face.node.end());
    if (static_cast<int>(different.size()) < face.corners()) {
      deck_.error(diagnostics_, card, field, "a face under pressure has a corner twice",
                  "give it three different nodes");
      return false;
    }
    const auto corners = static_cast<std::size_t>(face.corners());
    for (std::size_t c = 0; c < corners; ++c)
      if (const auto found = on_edge_.find(std::minmax({face.node[c], face.node[(c + 1) % corners]}));
          found != on_edge_.end())
        face.on_edge[c] = found->second;
    if (std::count(face.on_edge.begin(), face.on_edge.begin() + face.corners(), Index(-1)) > 0)
      face.on_edge.fill(-1);
    faces.push_back(face);
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  const World& world_;
  Diagnostics& diagnostics_;
  std::map<Id, Index> world_node_, shell_of_id_;
  std::map<std::pair<Index, Index>, Index> on_edge_;  ///< nodes of the world between two others
};

/// Of lists that are not all empty.
template <class... Lists>
const Entry& first_card(const Lists&... lists) {
  const Entry* out = nullptr;
  const auto look = [&out](const auto& list) {
    if (!out && !list.empty()) out = &list.front();
  };
  (look(lists), ...);
  return *out;
}

}  // namespace

/// The normal of a shell that is mirrored with its file is on the other side.
std::string keep_shell_side(LoadShellFields& card, const Affine& motion) {
  if (motion.linear().determinant() < 0) card.sf = -card.sf;
  return {};
}

/// A mirror turns faces inside out.
std::string keep_side(LoadSegment& card, const Affine& motion) {
  if (motion.linear().determinant() < 0) std::swap(card.n1, card.n3);
  return {};
}

std::shared_ptr<Force> make_segment_pressure(const Deck& deck, const Model& model, const WallBodies& bodies,
                                             World& world, Diagnostics& diagnostics) {
  const auto& segments = deck.all<LoadSegment>();
  const auto& sets = deck.all<LoadSegmentSet>();
  const auto& shells = deck.all<LoadShell>();
  const auto& blasts = deck.all<BlastSegment>();
  const auto& blast_sets = deck.all<BlastSegmentSet>();
  std::vector<BlastSource> charges = blast_sources(deck, model, diagnostics);
  if (!charges.empty() && blasts.empty() && blast_sets.empty())
    deck.warning(diagnostics, charges.front().card, "BID", "the blast pushes nothing",
                 "name faces by *LOAD_BLAST_SEGMENT or _SET");
  if (segments.empty() && sets.empty() && shells.empty() && blasts.empty() && blast_sets.empty())
    return nullptr;
  PressureReader reader(deck, model, world, std::move(charges), diagnostics);
  for (const LoadSegment& card : segments) reader.add(card);
  for (const LoadSegmentSet& card : sets) reader.add(card);
  for (const LoadShell& card : shells) reader.add(card);
  for (const BlastSegment& card : blasts) reader.add(card);
  for (const BlastSegmentSet& card : blast_sets) reader.add(card);
  if (reader.faces.empty()) return nullptr;
  if (shared_fields::eroded.find(world.segments.fields))
    diagnostics.warning(deck.where(first_card(segments, sets, shells, blasts, blast_sets)),
                        "elements may fail: the pressure goes on to push the nodes of faces that are deleted",
                        "end it by its curve");
  return std::make_shared<SegmentPressure>(std::move(reader.loads), std::move(reader.faces),
                                           std::move(reader.charges), std::move(reader.blasts), bodies,
                                           world);
}

}  // namespace courant
