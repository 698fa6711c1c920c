// Particles of inlets: made at set-up, let in by the neighbour lists.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sph/cards.hpp"
#include "sph/inlets/injection.hpp"
#include "sph/inlets/inlet_flow.hpp"
#include "sph/materials/initial_stress.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

constexpr Real most_particles = 5e7;  // a typing error in a spacing should not fill the memory

/// Positions of an inlet that share a factor on the velocity, so that their particles come in together: all
/// of them where there is no profile.
struct Row {
  std::size_t inlet = 0;
  Real factor = 1;
  std::vector<std::size_t> places{};
  Index layers = 0;
};

/// The particles of a row that come in at one time.
struct Layer {
  Real needed = 0;  ///< when it must be there [T]
  std::size_t row = 0;
  Index number = 0;
};

/// When the middle of a layer crosses the plane. [T]
Real entry(const Injection& inlet, const Row& row, Real number) {
  const Real way = (number + 0.5) * (inlet.spacing / (inlet.speed() * row.factor));
  return inlet.rate.time_of(way, inlet.begin);
}

/// How long before it comes in a layer must be there. The same for all layers of a row, so that with a later
/// ENDTIM more follow behind the same ones. [T]
Real lead(const Injection& inlet, const Row& row) {
  constexpr Real slowest = 0.1;  // of the fastest: what is slower waits nearer by than the kernel reaches
  const Real rate = std::max(inlet.rate.least(), slowest * inlet.rate.most());
  return inlet.reach / (inlet.speed() * row.factor * rate);
}

/// Layers that enter by TEND and are needed by ENDTIM; at most `most`.
Real layers_of(const Injection& inlet, const Row& row, Real endtim, Real most) {
  const Real last = std::min(inlet.end, endtim + lead(inlet, row));
  if (inlet.rate.steady()) {
    const Real time_of_layer = inlet.spacing / (inlet.speed() * row.factor);
    return std::max(std::floor((last - inlet.begin) / time_of_layer + 0.5), Real(0));
  }
  Real n = 0;
  while (n < most && entry(inlet, row, n) <= last) ++n;
  return n;
}

std::vector<Row> rows_of(const std::vector<Injection>& inlets) {
  constexpr Real same = 1e-9;  // of a factor
  std::vector<Row> rows;
  for (std::size_t k = 0; k < inlets.size(); ++k) {
    const std::size_t first = rows.size();
    for (std::size_t n = 0; n < inlets[k].places.size(); ++n) {
      const Real factor = inlets[k].factor.empty() ? 1 : inlets[k].factor[n];
      auto row = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(first), rows.end(),
                              [&](const Row& r) { return std::abs(r.factor - factor) <= same * factor; });
      if (row == rows.end()) row = rows.insert(rows.end(), {.inlet = k, .factor = factor});
      row->places.push_back(n);
    }
  }
  return rows;
}

/// In the order in which they are needed, whatever ENDTIM is.
std::vector<Layer> layers_in_time(const std::vector<Injection>& inlets, const std::vector<Row>& rows) {
  std::vector<Layer> out;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Injection& inlet = inlets[rows[k].inlet];
    for (Index n = 0; n < rows[k].layers; ++n)
      out.push_back({entry(inlet, rows[k], static_cast<Real>(n)) - lead(inlet, rows[k]), k, n});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Layer& a, const Layer& b) { return a.needed < b.needed; });
  return out;
}

/// Adds layers to the model, one after the other.
class Layers {
 public:
  Layers(Injections& out, const std::vector<Row>& rows, Model& model)
      : out_(out), rows_(rows), model_(model) {
    for (const ModelNode& node : model.nodes) id_ = std::max(id_, node.id);
    for (const Injection& inlet : out.inlets) {
      has_surface_ |= inlet.surface.on;
      filled_.emplace_back(inlet.places.size(), 0.5);
    }
  }

  void add(const Layer& layer) {
    const Row& row = rows_[layer.row];
    Injection& inlet = out_.inlets[row.inlet];
    const Real volume = inlet.area / static_cast<Real>(inlet.places.size()) * inlet.spacing;
    const Real t = entry(inlet, row, static_cast<Real>(layer.number));
    const Vec v = velocity(inlet, row, layer.number, t), before = way(inlet, layer.number, v, t);
    for (const std::size_t n : row.places) {
      const Vec& place = inlet.places[n];
      if (inlet.surface.on && !takes_part(inlet, n, t, filled_[row.inlet][n])) continue;
      model_.sph.push_back({.node = static_cast<Index>(model_.nodes.size()),
                            .part = inlet.part,
                            .mass = -volume,
                            .card = inlet.card,
                            .spacing = inlet.is_lattice() ? 0 : std::max(inlet.spacing, inlet.cell)});
      model_.nodes.push_back({.id = ++id_, .x = place - before, .v = v});
      out_.inlet_of.push_back(static_cast<Index>(row.inlet));
      if (has_surface_) out_.head.push_back(inlet.surface.on ? inlet.surface.head(place, t, inlet.part) : 0);
      ++inlet.particles;
    }
  }

 private:
  /// With a curve that of the moment at which the layer comes in; where it stands still just then, of the
  /// mean of the half layer before.
  static Vec velocity(const Injection& inlet, const Row& row, Index number, Real t) {
    if (inlet.rate.steady()) return inlet.v * row.factor;
    const Real half = 0.5 * inlet.spacing / (inlet.speed() * row.factor);
    const Real before = number == 0 ? inlet.begin : inlet.rate.time_of(2 * half * number, inlet.begin);
    return inlet.v * row.factor * std::max(inlet.rate(t), 0.5 * half / (t - before));
  }
  /// From where a particle of the layer stands at t = 0 to its place in the plane. [L]
  static Vec way(const Injection& inlet, Index number, const Vec& v, Real t) {
    if (!inlet.rate.steady()) return v * t;
    return v * inlet.begin + (static_cast<Real>(number) + 0.5) * inlet.spacing * (inlet.v / inlet.speed());
  }
  /// Of a cell that the surface cuts, as many as its share below the surface: what flows in is right in the
  /// mean.
  static bool takes_part(const Injection& inlet, std::size_t n, Real t, Real& filled) {
    filled += inlet.surface.filled(inlet.places[n], t, inlet.cell, inlet.plane.normal);
    if (filled < 1) return false;
    filled -= 1;
    return true;
  }

  Injections& out_;
  const std::vector<Row>& rows_;
  Model& model_;
  Id id_ = 0;
  bool has_surface_ = false;
  std::vector<std::vector<Real>> filled_;  ///< by inlet and place: shares of a particle that are due
};

/// Water of the deck that stands where particles of an inlet come along.
void report_in_the_way(const Injection& inlet, const Deck& deck, const Model& model, Index particles,
                       Diagnostics& diagnostics) {
  const Real near = 0.5 * inlet.spacing;
  Real width = 0;
  for (const Vec& place : inlet.places) width = std::max(width, (place - inlet.plane.point).norm());
  const Real length = inlet.reach;
  for (Index i = 0; i < particles; ++i) {
    const ModelNode& node =
        model.nodes[static_cast<std::size_t>(model.sph[static_cast<std::size_t>(i)].node)];
    const Real upstream = (inlet.plane.point - node.x).dot(inlet.plane.normal);
    if (!(upstream > 0 && upstream < length)) continue;
    const Vec x = node.x + inlet.v * (upstream / inlet.speed());  // where the flow takes it to the plane
    if ((x - inlet.plane.point).norm() > width + near) continue;
    for (const Vec& place : inlet.places) {
      if ((x - place).norm() > near) continue;
      return diagnostics.error(
          deck.where(inlet.card),
          fmt::format("{}: particle {} is {:.4g} [L] upstream of the inlet, where entering particles wait",
                      deck.keyword(inlet.card), node.id, upstream),
          "leave the space upstream of an inlet empty");
    }
  }
}

/// Two inlets at one place: columns upstream would overlap, or leave a gap, but where they are one column
/// with pauses.
void report_same_place(const Injection& a, const Injection& b, const Deck& deck, Diagnostics& diagnostics) {
  const bool steady = a.rate.steady() && b.rate.steady() && a.factor == b.factor;
  const bool one_column = steady && a.v == b.v && (a.end <= b.begin || b.end <= a.begin);
  if (one_column) return;
  for (const Vec& x : a.places)
    for (const Vec& y : b.places) {
      if ((x - y).norm() > 0.5 * std::min(a.spacing, b.spacing)) continue;
      return diagnostics.error(
          deck.where(b.card),
          fmt::format("{}: particles enter where those of {} do", deck.keyword(b.card), deck.place(a.card)),
          "inlets at one position must have the same velocity, and one must end before the other begins");
    }
}

/// 0 where the deck leaves it to the geometry, which is not known without the inlets.
int dimension(const Deck& deck, const Entry& inlet, Diagnostics& diagnostics) {
  const ControlSph* control = deck.last<ControlSph>();
  if (control && control->idim != 0) return control->idim;
  const char* hint = "give IDIM 2 or 3: an inlet in 2D means water per unit of depth";
  if (control)
    deck.error(diagnostics, *control, "IDIM", "expected 2 or 3 beside an inlet", hint);
  else
    diagnostics.error(deck.where(inlet), fmt::format("{}: needs IDIM of *CONTROL_SPH", deck.keyword(inlet)),
                      hint);
  return 0;
}

/// Sets waiting particles to start + v t: the position does not depend, not even in the
/// last bits, on when it woke.
class WaitingMotion : public Motion {
 public:
  explicit WaitingMotion(const Field<Real>& start) : start_(start) {}
  std::string name() const override { return "motion of particles that wait"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(start_).reads(p.state).reads(p.v).revises(p.x);
  }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Particles& p = world.particles;
    for (Index i = std::max(begin, p.active); i < end; ++i)
      if (p.state[i] == particle_waiting) p.x.set(i, start_.vec(i) + p.v.vec(i) * (clock.t + clock.dt));
  }

 private:
  const Field<Real>& start_;
};

}  // namespace

Injections add_injected_particles(const Deck& deck, Model& model, Diagnostics& diagnostics) {
  Injections out;
  out.first = static_cast<Index>(model.sph.size());
  const int errors = diagnostics.errors();
  if (const Entry* card = first_injection(deck)) {
    const int dim = dimension(deck, *card, diagnostics);
    if (dim != 0) out.inlets = read_injections(deck, model, dim, diagnostics);
  } else {
    read_inflows(deck, model, out.inlets, diagnostics);  // cards without an inlet
  }
  if (out.inlets.empty() || diagnostics.errors() > errors) return out;
  std::vector<Row> rows = rows_of(out.inlets);
  Real count = out.first;
  for (Row& row : rows) {
    const Injection& inlet = out.inlets[row.inlet];
    const auto places = static_cast<Real>(row.places.size());
    const Real layers = layers_of(inlet, row, model.endtim, most_particles);
    count += layers * places;
    if (count > most_particles) {
      diagnostics.error(
          deck.where(inlet.card),
          fmt::format("{}: {:.3g} particles would enter up to ENDTIM = {:g}; {:.0e} are the limit",
                      deck.keyword(inlet.card), count, model.endtim, most_particles),
          "make ENDTIM or the speed smaller, or AREA and PSIZE larger");
      return out;
    }
    row.layers = static_cast<Index>(layers);
  }
  for (const Injection& inlet : out.inlets) {
    report_in_the_way(inlet, deck, model, out.first, diagnostics);
    model.parts[static_cast<std::size_t>(inlet.part)].has_sph = true;
  }
  for (std::size_t b = 1; b < out.inlets.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) report_same_place(out.inlets[a], out.inlets[b], deck, diagnostics);
  Layers layers(out, rows, model);
  for (const Layer& layer : layers_in_time(out.inlets, rows)) layers.add(layer);
  return out;
}

void make_injected_wait(const Injections& injections, World& world, Neighbours& neighbours) {
  if (injections.inlets.empty()) return;
  Particles& p = world.particles;
  auto& inlet = shared_fields::inlet.add(p.fields);
  auto& start = p.fields.add<Real>({.name = "start", .dimension = "L", .components = 3});
  for (std::size_t k = 0; k < injections.inlet_of.size(); ++k) {
    const Index i = injections.first + static_cast<Index>(k);
    inlet[i] = injections.inlet_of[k];
    p.state[i] = particle_waiting;
    start.set(i, p.x.vec(i));
  }
  world.passes.add(std::make_shared<WaitingMotion>(start));
  std::vector<InletPlane> planes;
  for (const Injection& one : injections.inlets) planes.push_back(one.plane);
  neighbours.set_inlets(std::move(planes), inlet, start);
}

void set_inlet_pressures(const Injections& injections, const Deck& deck, const Model& model,
                         const std::vector<PartMaterial>& materials, World& world, Diagnostics& diagnostics) {
  Particles& p = world.particles;
  Field<Real>& reference_volume = shared_fields::reference_volume.add(p.fields);
  for (std::size_t k = 0; k < injections.head.size(); ++k) {
    const Injection& inlet = injections.inlets[static_cast<std::size_t>(injections.inlet_of[k])];
    if (!inlet.surface.on) continue;
    const auto refuse = [&](std::string message, const char* hint) {
      diagnostics.error(deck.where(inlet.card), deck.keyword(inlet.card) + ": " + std::move(message), hint);
    };
    const PartMaterial& m = materials[static_cast<std::size_t>(inlet.part)];
    const Id part = model.parts[static_cast<std::size_t>(inlet.part)].id;
    if (!m.eos || m.strength)
      return refuse(fmt::format("part {} has strength, and its stress starts at 0", part),
                    "SURF of *COURANT_INFLOW is for fluids");
    const Real pressure = m.ro * injections.head[k];
    const auto mu = compression_at(*m.eos, m.ro, pressure);
    if (!mu)
      return refuse(fmt::format("the equation of state of part {} has no density with the pressure {:g} that "
                                "SURF of *COURANT_INFLOW asks for",
                                part, pressure),
                    "check the level and its units");
    const Index i = injections.first + static_cast<Index>(k);
    p.rho[i] = m.ro * (1 + *mu);
    p.m[i] *= 1 + *mu, reference_volume[i] *= 1 + *mu;
  }
}

std::string injections_text(const Injections& injections, const Model& model) {
  std::string text;
  for (const Injection& inlet : injections.inlets) {
    const auto flow = [&] {
      if (!inlet.rate.steady())
        return fmt::format("{} at a time as curve {} has it", inlet.places.size(), inlet.rate.curve());
      if (!inlet.factor.empty())
        return fmt::format("rows of {} positions at speeds of {:.4g} to {:.4g}", inlet.places.size(),
                           inlet.speed() * *std::min_element(inlet.factor.begin(), inlet.factor.end()),
                           inlet.speed() * *std::max_element(inlet.factor.begin(), inlet.factor.end()));
      return fmt::format("{} particles every {:.4g} [T]", inlet.places.size(), inlet.spacing / inlet.speed());
    };
    text +=
        fmt::format("  {:<12}part {}: {} from {:g}{}, {} wait; area {:.5g}", "inlet",
                    model.parts[static_cast<std::size_t>(inlet.part)].id, flow(), inlet.begin,
                    inlet.end < 1e20 ? fmt::format(" to {:g}", inlet.end) : "", inlet.particles, inlet.area);
    if (inlet.rate.steady())
      text +=
          fmt::format(", speed {:.5g}, volume per time {:.5g}", inlet.speed(), inlet.area * inlet.speed());
    text += '\n';
  }
  return text;
}

}  // namespace courant
