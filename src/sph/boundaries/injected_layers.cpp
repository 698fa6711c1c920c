// Particles of inlets: made at set-up, let in by the neighbour lists.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sph/boundaries/injection.hpp"
#include "sph/cards.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

constexpr Real most_particles = 5e7;  // a typing error in a spacing should not fill the memory

/// A layer of an inlet.
struct Layer {
  Real needed = 0;  ///< when it must be there [T]
  std::size_t inlet = 0;
  Index number = 0;
};

/// When the middle of a layer crosses the plane. [T]
Real entry(const Injection& inlet, Index number) {
  return inlet.begin + (number + 0.5) * inlet.time_of_layer();
}

/// Layers that enter by TEND and are needed by ENDTIM.
Real layers_of(const Injection& inlet, Real endtim) {
  const Real last = std::min(inlet.end, endtim + inlet.lead);
  return std::max(std::floor((last - inlet.begin) / inlet.time_of_layer() + 0.5), Real(0));
}

/// In the order in which they are needed, whatever ENDTIM is.
std::vector<Layer> layers_in_time(const std::vector<Injection>& inlets) {
  std::vector<Layer> out;
  for (std::size_t k = 0; k < inlets.size(); ++k)
    for (Index n = 0; n < inlets[k].layers; ++n) out.push_back({entry(inlets[k], n) - inlets[k].lead, k, n});
  std::stable_sort(out.begin(), out.end(),
                   [](const Layer& a, const Layer& b) { return a.needed < b.needed; });
  return out;
}

void add_layer(const Injection& inlet, Index number, Id& id, Model& model) {
  const Real volume = inlet.area / static_cast<Real>(inlet.places.size()) * inlet.spacing;
  for (const Vec& place : inlet.places) {
    const Vec before = inlet.v * inlet.begin + (number + 0.5) * inlet.spacing * (inlet.v / inlet.speed());
    model.sph.push_back({.node = static_cast<Index>(model.nodes.size()),
                         .part = inlet.part,
                         .mass = -volume,
                         .card = inlet.card});
    model.nodes.push_back({.id = ++id, .x = place - before, .v = inlet.v});
  }
}

/// Water of the deck that stands where particles of an inlet come along.
void report_in_the_way(const Injection& inlet, const Deck& deck, const Model& model, Index particles,
                       Diagnostics& diagnostics) {
  const Real near = 0.5 * inlet.spacing;
  Real width = 0;
  for (const Vec& place : inlet.places) width = std::max(width, (place - inlet.plane.point).norm());
  const Real length = inlet.lead * inlet.speed();
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
          fmt::format("{}: particle {} stands {:.4g} [L] upstream of the inlet, where those that enter wait",
                      deck.keyword(inlet.card), node.id, upstream),
          "leave the room upstream of an inlet empty");
    }
  }
}

/// Two inlets at one place: columns upstream would overlap, or leave a gap, but where they are one column
/// with pauses.
void report_same_place(const Injection& a, const Injection& b, const Deck& deck, Diagnostics& diagnostics) {
  const bool one_column = a.v == b.v && (a.end <= b.begin || b.end <= a.begin);
  if (one_column) return;
  for (const Vec& x : a.places)
    for (const Vec& y : b.places) {
      if ((x - y).norm() > 0.5 * std::min(a.spacing, b.spacing)) continue;
      return diagnostics.error(
          deck.where(b.card),
          fmt::format("{}: particles enter where those of {} do", deck.keyword(b.card), deck.place(a.card)),
          "inlets at one place must have the same velocity, and one must end before the other begins");
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

}  // namespace

Injections add_injected_particles(const Deck& deck, Model& model, Diagnostics& diagnostics) {
  Injections out;
  out.first = static_cast<Index>(model.sph.size());
  const int errors = diagnostics.errors();
  if (const Entry* card = first_injection(deck)) {
    const int dim = dimension(deck, *card, diagnostics);
    if (dim != 0) out.inlets = read_injections(deck, model, dim, diagnostics);
  }
  if (out.inlets.empty() || diagnostics.errors() > errors) return out;
  Real count = out.first;
  for (Injection& inlet : out.inlets) {
    const Real layers = layers_of(inlet, model.endtim);
    count += layers * static_cast<Real>(inlet.places.size());
    if (count > most_particles) {
      diagnostics.error(
          deck.where(inlet.card),
          fmt::format("{}: {:.3g} particles would enter up to ENDTIM = {:g}; {:.0e} are the limit",
                      deck.keyword(inlet.card), count, model.endtim, most_particles),
          "make ENDTIM or the speed smaller, or AREA and PSIZE larger");
      return out;
    }
    inlet.layers = static_cast<Index>(layers);
    report_in_the_way(inlet, deck, model, out.first, diagnostics);
    model.parts[static_cast<std::size_t>(inlet.part)].has_sph = true;
  }
  for (std::size_t b = 1; b < out.inlets.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) report_same_place(out.inlets[a], out.inlets[b], deck, diagnostics);
  Id id = 0;
  for (const ModelNode& node : model.nodes) id = std::max(id, node.id);
  for (const Layer& layer : layers_in_time(out.inlets)) {
    const Injection& inlet = out.inlets[layer.inlet];
    add_layer(inlet, layer.number, id, model);
    out.inlet_of.insert(out.inlet_of.end(), inlet.places.size(), static_cast<Index>(layer.inlet));
  }
  return out;
}

void make_injected_wait(const Injections& injections, World& world, Neighbours& neighbours) {
  if (injections.inlets.empty()) return;
  Particles& p = world.particles;
  auto& inlet = shared_fields::inlet.add(p.fields);
  for (std::size_t k = 0; k < injections.inlet_of.size(); ++k) {
    const Index i = injections.first + static_cast<Index>(k);
    inlet[i] = injections.inlet_of[k];
    p.state[i] = particle_waiting;
  }
  std::vector<InletPlane> planes;
  for (const Injection& one : injections.inlets) planes.push_back(one.plane);
  neighbours.set_inlets(std::move(planes), inlet);
}

std::string injections_text(const Injections& injections, const Model& model) {
  std::string text;
  for (const Injection& inlet : injections.inlets) {
    text += fmt::format(
        "  {:<12}part {}: {} particles every {:.4g} [T] from {:g}{}, {} wait; area {:.5g}, speed {:.5g}, "
        "volume "
        "per time {:.5g}\n",
        "inlet", model.parts[static_cast<std::size_t>(inlet.part)].id, inlet.places.size(),
        inlet.time_of_layer(), inlet.begin, inlet.end < 1e20 ? fmt::format(" to {:g}", inlet.end) : "",
        inlet.layers * static_cast<Index>(inlet.places.size()), inlet.area, inlet.speed(),
        inlet.area * inlet.speed());
  }
  return text;
}

}  // namespace courant
