// *DATABASE_TRACER and *DATABASE_TRHIST: motion, stress and density of single particles and nodes, in the
// text file trhist.
#include <fmt/format.h>
#include <fmt/printf.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "extension/additions.hpp"
#include "extension/history_interval.hpp"
#include "gauges/tracer_cards.hpp"
#include "keyword/registry.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

const RegisterKeyword<TracerCard> tracer_keyword{database_tracer_table()};

struct TrhistCard : HistoryInterval {};
const RegisterKeyword<TrhistCard> trhist_keyword{history_interval<TrhistCard>(
    "DATABASE_TRHIST", "interval of trhist: particles and nodes of *DATABASE_TRACER")};

/// A particle or node by its id, which stays when particles are sorted.
struct Tracer {
  Id id = 0;
  Real from = 0;  ///< active from then on [T]
};

class Tracers : public Pass {
 public:
  explicit Tracers(std::vector<Tracer> all) : all_(std::move(all)) {}
  std::string name() const override { return "tracers"; }
  std::string text(const World& world, const Clock& clock) const {
    std::string out = fmt::sprintf("%13.5E\n", clock.t);
    for (const auto& [id, row] : rows(world, clock))
      for (std::size_t k = 0; k < row.size(); ++k)
        out += fmt::sprintf("%13.5E%s", row[k], k % 4 == 3 ? "\n" : "");
    return out;
  }
  void add_numbers(const World& world, const Clock& clock, HistoryNumbers& to) const {
    using R = std::pair<Id, Row>;
    const std::vector<R> all = rows(world, clock);
    HistoryRows arrays(to, "", all, &R::first, "tracers");
    constexpr const char* names[] = {"x",  "y",   "z",   "vx",  "vy",  "vz",  "sx",   "sy",
                                     "sz", "sxy", "syz", "szx", "efp", "rho", "rvol", "active"};
    for (std::size_t k = 0; k < 16; ++k) arrays.real(names[k], [k](const R& r) { return r.second[k]; });
    std::size_t at = 0;
    for (const auto& [id, row] : all) {
      arrays.value(at, "x", "L", {row.begin(), row.begin() + 3});
      arrays.value(at, "v", "L/T", {row.begin() + 3, row.begin() + 6});
      arrays.value(at, "stress", "M/LT2", {row.begin() + 6, row.begin() + 12});
      arrays.value(at, "rho", "M/L3", {row[13]});
      arrays.value(at++, "active", "-", {row[15]});
    }
  }
  std::size_t size() const { return all_.size(); }

 private:
  /// x y z vx vy vz sx sy sz sxy syz szx efp rho rvol active
  using Row = std::array<Real, 16>;
  std::vector<std::pair<Id, Row>> rows(const World& world, const Clock& clock) const {
    std::unordered_map<Id, Index> particle, node;
    for (const Tracer& one : all_) particle[one.id] = node[one.id] = -1;
    find(world.particles.id, world.particles.size(), particle);
    find(world.nodes.id, world.nodes.size(), node);
    std::vector<std::pair<Id, Row>> out;
    for (const Tracer& one : all_) {
      Row row = particle.at(one.id) >= 0 ? of_particle(world, clock, particle.at(one.id))
                                         : of_node(world, node.at(one.id));
      if (clock.t < one.from) row[15] = 0;
      out.emplace_back(one.id, row);
    }
    return out;
  }
  static void find(const Field<Id>& id, Index n, std::unordered_map<Id, Index>& to) {
    for (Index i = 0; i < n; ++i)
      if (const auto at = to.find(id[i]); at != to.end()) at->second = i;
  }
  static void put(Row& row, std::size_t at, const Vec& v) {
    for (std::size_t k = 0; k < 3; ++k) row[at + k] = v[static_cast<Index>(k)];
  }
  static Row of_particle(const World& world, const Clock& clock, Index i) {
    const Particles& p = world.particles;
    Row row{};
    put(row, 0, p.place(i, clock.t));
    put(row, 3, p.v.vec(i));
    const auto* tau = shared_fields::stress.find(p.fields);
    for (std::size_t k = 0; k < 6; ++k)
      row[6 + k] = (tau ? tau->data(static_cast<int>(k))[i] : 0) - (k < 3 ? p.p[i] : 0);
    row[13] = p.rho[i];
    const auto* V0 = shared_fields::reference_volume.find(p.fields);
    row[14] = V0 && (*V0)[i] > 0 ? p.m[i] / p.rho[i] / (*V0)[i] : 1;
    row[15] = i < p.active ? 1 : 0;
    return row;
  }
  static Row of_node(const World& world, Index n) {
    Row row{};
    if (n < 0) return row;
    put(row, 0, world.nodes.x.vec(n));
    put(row, 3, world.nodes.v.vec(n));
    row[14] = row[15] = 1;
    return row;
  }
  std::vector<Tracer> all_;
};

/// The id of the nearest of [0, n).
template <class Points>
Id nearest(const Points& points, Index n, const Vec& x) {
  Id id = 0;
  Real least = std::numeric_limits<Real>::infinity();
  for (Index i = 0; i < n; ++i)
    if (const Real d = (points.x.vec(i) - x).squaredNorm(); d < least) least = d, id = points.id[i];
  return id;
}

template <class Points>
bool has_id(const Points& points, Id id) {
  for (Index i = 0; i < points.size(); ++i)
    if (points.id[i] == id) return true;
  return false;
}

void build_tracers(const Deck& deck, const Model&, World& world, Diagnostics& diagnostics) {
  const std::vector<TracerCard>& cards = deck.all<TracerCard>();
  const bool asked = interval_in<TrhistCard>(deck) > 0;
  if (asked && cards.empty())
    deck.warning(diagnostics, *deck.last<TrhistCard>(), "DT", "no tracer is named: trhist holds no values",
                 "name particles and nodes by *DATABASE_TRACER");
  if (!asked && !cards.empty())
    deck.warning(diagnostics, cards.front(), "", "tracers are written nowhere",
                 "*DATABASE_TRHIST gives the interval");
  std::vector<Tracer> all;
  for (const TracerCard& card : cards) {
    const Vec x(card.x, card.y, world.dim == 3 ? card.z : 0);
    Id id = card.nid;
    if (id == 0)
      id = world.particles.size() > 0 ? nearest(world.particles, world.particles.size(), x)
                                      : nearest(world.nodes, world.nodes.size(), x);
    else if (!has_id(world.particles, id) && !has_id(world.nodes, id)) {
      deck.error(diagnostics, card, "NID", fmt::format("node {} is no particle, and no element has it", id),
                 "a tracer follows a particle or a node of an element");
      continue;
    }
    all.push_back({id, card.time});
  }
  if (!all.empty()) world.passes.add(std::make_shared<Tracers>(std::move(all)));
}

const RegisterAddition tracers_added{"tracers", build_tracers};

const RegisterAsciiHistory trhist{
    {.name = "trhist",
     .interval = [](const Deck& deck) { return interval_in<TrhistCard>(deck); },
     .text =
         [](const World& world, const Clock& clock) {
           std::string out;
           for (const auto* tracers : world.passes.all<const Tracers>()) out += tracers->text(world, clock);
           return out;
         },
     .columns = "  x  y  z  vx\n  vy  vz  sx  sy\n  sz  sxy  syz  szx\n  efp  rho  rvol  active\n",
     .numbers =
         [](const World& world, const Clock& clock, HistoryNumbers& to) {
           for (const auto* tracers : world.passes.all<const Tracers>())
             tracers->add_numbers(world, clock, to);
         },
     .binary = binary_in<TrhistCard>}};

}  // namespace

}  // namespace courant
