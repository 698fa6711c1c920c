#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/beam/beams.hpp"
#include "elements/mass_scaling.hpp"
#include "elements/nodal_rotations.hpp"

namespace courant {

namespace {

struct Moduli {
  Real E, G;
};
Moduli moduli_of(const StrengthLaw& law) {
  const Real K = law.bulk_modulus(), G = law.shear_modulus();
  return {9 * K * G / (3 * K + G), G};
}

}  // namespace

std::vector<Index> beam_nodes(const Model& model) {
  std::vector<Index> out;
  for (const ModelBeam& beam : model.beams) out.insert(out.end(), beam.node.begin(), beam.node.end());
  return out;
}

// With half the mass m/2 and the inertia J at each end, of a beam alone: (theta the rotation of both ends
// against the line between them) bending has 2 EI/(L J) where ends turn against each other and k (1/J + 8/(m
// L^2)) where they turn alike, k = 6 EI/(L (1 + phi)), or with one point along the beam k = SA G L/2. Waves
// along it have 4 E A/(L m). The stiffness of resultants is that of the length without stress, however long
// the beam is.
Real largest_square(BeamKind kind, const StrengthLaw& law, const BeamMeasures& m, Real mass, Real inertia,
                    Real start, Real length, Real pull) {
  const auto [E, G] = moduli_of(law);
  const Real resists = kind == BeamKind::resultant ? start : length;
  const Real across = 4 * std::max(pull, Real(0)) / (length * mass);
  const Real along = 4 * E * m.A / (resists * mass);
  if (kind == BeamKind::truss) return along + across;
  const Real I = m.coupled ? m.Iss + m.Itt : std::max(m.Iss, m.Itt);  // not below the largest of any axes
  const Real twist = 2 * G * m.J / (resists * inertia), apart = 2 * E * I / (resists * inertia);
  const Real phi = m.shear_area > 0 ? 12 * E * I / (G * m.shear_area * resists * resists) : 0;
  const Real k =
      kind == BeamKind::integrated ? 0.5 * m.shear_area * G * length : 6 * E * I / (resists * (1 + phi));
  const Real alike = k * (1 / inertia + 8 / (mass * length * length)) + across;
  if (m.coupled)  // no more than the traces of what goes together
    return std::max(along + apart + across, twist + 2 * alike);
  return std::max({along + across, twist, apart, alike});
}

// The physical inertia about the axis, or more where bending would else ask for a smaller step than waves
// along the beam.
Real end_inertia(BeamKind kind, const StrengthLaw& law, const BeamMeasures& m, Real mass, Real length) {
  const auto [E, G] = moduli_of(law);
  const Real I = std::max(m.Iss, m.Itt), per_length = mass / (m.A * length);
  const Real polar = 0.5 * per_length * length * (m.Iss + m.Itt);
  constexpr Real least_rest = 0.25;  // of very short beams, which have smaller steps
  if (kind == BeamKind::integrated) {
    const Real shear = m.shear_area / m.A * G / E;
    return std::max(polar, 0.125 * mass * length * length * shear / std::max(1 - shear, least_rest));
  }
  const Real rest = 1 - 12 * I / (m.A * length * length);
  return std::max(polar, 1.5 * per_length * I * length / std::max(rest, least_rest));
}

void build_beams(const Model& model, std::vector<BeamPart>& parts, const std::vector<Index>& node_of,
                 World& world, Diagnostics& diagnostics) {
  for (BeamPart& part : parts) {
    if (!part.law) continue;
    const ModelPart& of_model = model.parts[static_cast<std::size_t>(part.part)];
    if (world.dim == 2)
      return diagnostics.error(of_model.where, "beams are not supported in 2D scenes (IDIM 2)",
                               "make the scene three-dimensional");
    FieldSet& set = world.add_set(fmt::format("beams of part {}", of_model.id));
    set.resize(static_cast<Index>(part.beams.size()));
    part.group =
        world.groups
            .emplace_back(std::make_unique<ElementGroup>(
                set, part.part, 2, part.null ? ElementGroup::Leaves::nothing : ElementGroup::Leaves::corners))
            .get();
    ElementGroup& group = *part.group;
    const bool turns = part.kind != BeamKind::truss;
    if (turns) {
      NodalRotations(world.nodes.fields);
      group.keep_corner_moments();
    }
    for (Index e = 0; e < group.size(); ++e) {
      const auto at = static_cast<std::size_t>(e);
      const ModelBeam& beam = *part.beams[at];
      const BeamMeasures& m = part.measures[at];
      group.id[e] = beam.id;
      std::array<Vec, 2> x;
      for (int c = 0; c < 2; ++c) {
        const Index n = node_of[static_cast<std::size_t>(beam.node[static_cast<std::size_t>(c)])];
        group.node.data(c)[e] = n;
        x[static_cast<std::size_t>(c)] = world.nodes.x.vec(n);
      }
      const Real length = (x[1] - x[0]).norm();
      group.V0[e] = m.A * length;
      group.mass[e] = (part.law->ro * m.A + part.nsm) * length;
      const Real inertia = turns ? end_inertia(part.kind, *part.law, m, group.mass[e], length) : 0;
      for (int c = 0; c < 2; ++c) {
        const Index n = group.node.data(c)[e];
        world.nodes.m[n] += group.mass[e] / 2;
        if (turns) NodalRotations(world.nodes.fields).inertia[n] += inertia;
      }
    }
  }
}

MassScaling scaling_of(const BeamPart& part, const MassScaling& of_deck) {
  if (part.null) return {};
  MassScaling out = of_deck;
  if (part.weld && part.weld->dt > out.step) out = {.step = part.weld->dt};
  out.once = true;
  return out;
}

void report_beam_scaling(const Deck& deck, const Model& model, const std::vector<BeamPart>& parts,
                         const World& world, Diagnostics& diagnostics) {
  constexpr Real much = 5;  // per cent of all mass of elements
  Real all = 0;
  for (const auto& group : world.groups)
    for (Index e = 0; e < group->size(); ++e) all += group->mass[e];
  const MassScaling of_deck = mass_scaling_of(deck);
  for (const BeamPart& part : parts) {
    if (!part.group) continue;
    const Real added = added_mass(*part.group);
    if (added == 0) continue;
    const ModelPart& of_model = model.parts[static_cast<std::size_t>(part.part)];
    const Real step = scaling_of(part, of_deck).step;
    std::string text = fmt::format(
        "mass scaling to {} = {:g} of {}: the beams of part {} have {:.4g} [M] more, {:.3g} % of the mass of "
        "all elements",
        step > of_deck.step ? "DT" : "|DT2MS|", step,
        step > of_deck.step ? "*MAT_SPOTWELD" : "*CONTROL_TIMESTEP", of_model.id, added,
        100 * added / (all - added));
    if (std::abs(added) > much / 100 * (all - added))
      diagnostics.warning(of_model.where, std::move(text), "a shorter step adds less");
    else
      diagnostics.note(of_model.where, std::move(text));
  }
}

}  // namespace courant
