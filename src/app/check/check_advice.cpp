// `courant check`: choices of an SPH deck against the height and the speeds of its scene, and what to type.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "app/check/check.hpp"
#include "contact/cards.hpp"

namespace courant {

namespace {

/// What the flow of a scene is measured by.
struct FlowScale {
  Real g = 0;       ///< size of the acceleration by body loads [L/T2]
  Real height = 0;  ///< of the particles over the lowest of particles and walls, against it [L]
  Real start = 0;   ///< largest speed at the start [L/T]
  Real speed = 0;   ///< that a fall over the height adds to [L/T]
  Real length = 0;  ///< of the particles across it, the longer one [L]
};

FlowScale flow_scale(const Simulation& s) {
  FlowScale f;
  const Particles& p = s.world().particles;
  const BodyAcceleration::At loads = acceleration_of_particles(s.model()).at(0);
  Vec a = Vec::Zero();
  for (Index i = 0; i < p.size(); ++i) {
    const Vec one = loads(p.x.vec(i), p.part[i]);
    if (one.norm() > a.norm()) a = one;
    f.start = std::max(f.start, p.v.vec(i).norm());
  }
  const SupportedWalls& beside = s.sph().walls;
  for (const Index segment : beside.segments)
    if (const int belt = beside.belts.of(segment); belt >= 0) {
      const WallBelts::Belt& b = beside.belts.belts[static_cast<std::size_t>(belt)];
      const Vec x = s.world().nodes.x.vec(s.world().segments.node0[segment]);
      f.start = std::max(f.start, std::abs(b.factor(0)) * b.motion.at(x).norm());
    }
  f.g = a.norm();
  if (f.g > 0 && p.size() > 0) {
    const Vec up = -a / f.g;
    Real low = up.dot(p.x.vec(0)), high = low;
    Vec least = p.x.vec(0), most = least;
    for (Index i = 0; i < p.size(); ++i) {
      const Vec x = p.x.vec(i);
      const Real z = up.dot(x);
      low = std::min(low, z), high = std::max(high, z);
      least = least.cwiseMin(x), most = most.cwiseMax(x);
    }
    const Vec size = most - least;
    f.length = (size - up.cwiseAbs().cwiseProduct(size)).maxCoeff();
    const Segments& walls = s.world().segments;
    for (Index k = 0; k < walls.size(); ++k)
      for (const Index n : walls.nodes(k)) low = std::min(low, up.dot(s.world().nodes.x.vec(n)));
    f.height = high - low;
  }
  f.speed = std::sqrt(2 * f.g * f.height + f.start * f.start);
  return f;
}

/// Standard deviation of a kernel over h, in the plane: kernels of equal width smooth alike.
Real width_of(KernelChoice choice) {
  return with_kernel(choice, [](auto kernel) {
    constexpr int steps = 200;
    constexpr Real dR = decltype(kernel)::support / steps;
    Real all = 0, second = 0;
    for (int k = 0; k < steps; ++k) {
      const Real R = (k + 0.5) * dR, share = R * kernel.shape(R);
      all += share, second += R * R * share;
    }
    return std::sqrt(second / (2 * all));
  });
}

class ChoiceAdvice {
 public:
  ChoiceAdvice(const Simulation& s, const ModelFacts& facts) : s_(s), facts_(facts), flow_(flow_scale(s)) {}

  std::vector<std::string> all() {
    if (!s_.has_particles()) return {};
    for (std::size_t k = 0; k < s_.materials().size(); ++k) {
      const PartMaterial& m = s_.materials()[k];
      if (!m.found || m.strength || !m.holds_cold() || !(facts_.parts[k].h > 0)) continue;
      sound_speed(k);
      resolution(k);
      smoothing_length(k);
      tension(k);
      viscous_layer(k);
      waves(k);
      slowest_ = std::min(slowest_, m.c0());
    }
    if (std::isfinite(slowest_) && flow_.speed > 0) contacts();
    if (std::isfinite(slowest_) && flow_.g > 0) bodies_afloat();
    return std::move(out_);
  }

 private:
  template <class... Values>
  void add(fmt::format_string<Values...> text, Values&&... values) {
    out_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }

  void sound_speed(std::size_t k) {
    constexpr Real usual = 10, least = 5, most = 50;
    const PartMaterial& m = s_.materials()[k];
    const Real ratio = m.c0() / flow_.speed;
    if (!(flow_.speed > 0) || (ratio >= least && ratio <= most)) return;
    if (ratio < least && m.stiffness_field().empty()) return;  // an impact that its law is made for
    const Real modulus = m.ro * usual * usual * flow_.speed * flow_.speed;
    const char* why = ratio < least ? "the liquid is squeezed by more than some per cent"
                                    : "steps are short for sound that the flow does not feel";
    add("part {}: its sound speed {:.4g} is {:.3g} times the speed of {:.4g} that the scene gives, {} is "
        "usual: {}; "
        "type C1 = {:.4g} of *EOS_LINEAR_POLYNOMIAL (K0 = that / GAMMA of *EOS_MURNAGHAN)",
        id(k), m.c0(), ratio, flow_.speed, usual, why, modulus);
  }

  void resolution(std::size_t k) {
    constexpr Real least = 10, usual = 20;
    const Real spacings = flow_.height / facts_.parts[k].spacing;
    if (!(flow_.height > 0) || spacings > least - 0.01) return;  // but for rounding
    add("part {}: {:.3g} spacings of {:.4g} over the height of {:.4g} are few; type particles {:.3g} apart",
        id(k), spacings, facts_.parts[k].spacing, flow_.height, flow_.height / usual);
  }

  /// Widths as of the cubic spline; wider than 1.5 spacings it and the quadratic one let particles pair.
  void smoothing_length(std::size_t k) {
    constexpr Real least = 1.1, most = 1.5, most_smooth = 2, usual = 1.2;
    const KernelChoice kernel = s_.sph().kernel;
    const bool pairs = kernel == KernelChoice::cubic_spline || kernel == KernelChoice::quadratic_spline;
    const Real support = kernel_support(kernel), dx = facts_.parts[k].spacing, h = facts_.parts[k].h;
    const Real as_cubic = width_of(kernel) / width_of(KernelChoice::cubic_spline);
    const Real width = as_cubic * h / dx;
    if (!(dx > 0) || (width >= least && width <= (pairs ? most : most_smooth))) return;
    add("part {}: particles reach {:.3g} spacings, {:.2g} is usual: {}; type CSLH = {:.3g} (and SPHINI 0) in "
        "*SECTION_SPH",
        id(k), support * h / dx, support * usual / as_cubic,
        width < least ? "sums have too few neighbours" : "details are smoothed away", usual / as_cubic);
  }

  void tension(std::size_t k) {
    if (s_.materials()[k].pc != 0 || !(flow_.g > 0)) return;
    add("part {}: with PC = 0 the liquid takes no tension, comes apart where a flow stretches it, and its "
        "density "
        "falls; type PC = -1.0E20 in *MAT_NULL",
        id(k));
  }

  /// No slip needs rows within the viscous layer of a wall, some 5 nu/u* thick, u* about a twentieth of the
  /// speed.
  void viscous_layer(std::size_t k) {
    constexpr Real most = 5, share = 0.05;
    const auto& mu = s_.sph().mu;
    if (!s_.sph().walls.hold || mu.empty() || !(mu[k] > 0) || s_.sph().turbulence.on()) return;
    const Real nu = mu[k] / s_.materials()[k].ro, dx = facts_.parts[k].spacing;
    const Real rows = share * flow_.speed * dx / nu;
    if (!(dx > 0) || !(rows > most)) return;
    add("part {}: at {:.3g} the viscous layer of a wall is about {:.2g} thick and the spacing {:.3g}: no "
        "slip "
        "(LAW 2 of *COURANT_WALL_SUPPORT) rubs too little where water is turbulent; type LAW = 1 and the "
        "roughness KS",
        id(k), flow_.speed, most * nu / (share * flow_.speed), dx);
  }

  /// Monaghan's viscosity is nu = Q h c/8 in the plane, Q h c/10 in space (Monaghan 2005, eq. 8.10), and a
  /// wave of number k loses exp(-2 nu k^2 t) of its height (Lamb 1932, art. 348).
  void waves(std::size_t k) {
    constexpr Real most = 0.02;  // of the height in a period
    const Real q = s_.sph().q[k].q1, L = flow_.length;
    if (!std::holds_alternative<MonaghanViscosity>(s_.sph().viscosity) || !(flow_.g > 0) || !(L > 0)) return;
    const Real number = 2 * pi / L;
    const Real period = 2 * pi / std::sqrt(flow_.g * number * std::tanh(number * flow_.height));
    const Real nu = q * facts_.parts[k].h * s_.materials()[k].c0() / (s_.world().dim == 2 ? 8 : 10);
    const Real lost = 1 - std::exp(-2 * nu * number * number * period);
    if (lost > most)
      add("part {}: by artificial viscosity a wave as long as the water, {:.3g}, loses {:.2g} % of its "
          "height in a period of {:.3g}, one of half that length {:.2g} %; if waves matter, type Q2 = "
          "1.0E-20 of "
          "*HOURGLASS, CSLH = 2, *COURANT_KERNEL wendland_c4 and *COURANT_DENSITY_DIFFUSION 0.1",
          id(k), L, 100 * lost, period, 100 * (1 - std::pow(1 - lost, std::pow(2, 1.5))));
  }

  /// The lattice of the cubic spline resists shear (docs/theory_sph.md, Kernel).
  void bodies_afloat() {
    if (s_.sph().kernel != KernelChoice::cubic_spline || !s_.bodies()) return;
    for (const RigidBody& b : s_.bodies()->bodies()) {
      if (b.fixed() || !b.motions.empty()) continue;
      return add(
          "{}: if it floats, it heaves a fifth and rolls a third too little, as particles of the cubic "
          "spline "
          "resist shear under pressure; type SPHKERN = 1 in *SECTION_SPH",
          b.name);
    }
  }

  void contacts() {
    const auto* control = s_.deck().last<ControlContact>();
    const Real slsfac = control && control->slsfac > 0 ? control->slsfac : 0.1;
    constexpr Real least = 0.5, most = 10;  // of the stiffness of the liquid
    for (const ContactCard& card : s_.deck().all<ContactCard>()) {
      const Real ratio = slsfac * card.sfsa;
      if (!kind_of(card).nodes || (ratio >= least && ratio <= most) || !(ratio > 0)) continue;
      if (ratio < least)
        add("{} {}: SLSFAC x SFSA = {:.3g} makes particles that much softer against walls than the liquid "
            "is: one that "
            "hits at {:.4g} goes {:.2g} of a spacing deep; type SFSA = {:.3g}",
            s_.deck().keyword(card), card.cid, ratio, flow_.speed,
            flow_.speed / (slowest_ * std::sqrt(ratio)), 1 / slsfac);
      else
        add("{} {}: SLSFAC x SFSA = {:.3g} makes particles bounce off walls, with steps of their own; type "
            "SFSA = "
            "{:.3g}",
            s_.deck().keyword(card), card.cid, ratio, 1 / slsfac);
    }
  }

  Id id(std::size_t k) const { return s_.model().parts[k].id; }

  const Simulation& s_;
  const ModelFacts& facts_;
  FlowScale flow_;
  Real slowest_ = std::numeric_limits<Real>::infinity();  ///< sound speed of the liquids
  std::vector<std::string> out_;
};

}  // namespace

std::vector<std::string> choice_advice(const Simulation& simulation, const ModelFacts& facts) {
  return ChoiceAdvice(simulation, facts).all();
}

std::string advice_text(const std::vector<std::string>& advice) {
  constexpr std::size_t width = 100;
  std::string out = advice.empty() ? "" : "Choices to look at\n";
  for (const std::string& one : advice) {
    std::string line = " ";
    for (std::size_t begin = 0; begin < one.size();) {
      const std::size_t end = std::min(one.find(' ', begin), one.size());
      if (line.size() + 1 + end - begin > width) out += line + "\n", line = "   ";
      line += " " + one.substr(begin, end - begin);
      begin = end + 1;
    }
    out += line + "\n";
  }
  return out;
}

}  // namespace courant
