// *INITIAL_STRESS_SOLID and _SHELL: elements that start under stress.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "elements/histories/element_choice.hpp"
#include "elements/initial_cards.hpp"
#include "elements/kept_stress.hpp"
#include "elements/shell/layer_axes.hpp"
#include "elements/shell/shells.hpp"
#include "elements/solid/solids.hpp"
#include "extension/builders.hpp"
#include "keyword/conversion.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<InitialStressSolid> initial_stress_solid{initial_stress_solid_table()};
const RegisterKeyword<InitialStressShell> initial_stress_shell{initial_stress_shell_table()};

/// What a card gives of a point.
struct GivenPoint {
  Real height = 0;  ///< of shells, over half the thickness [-]
  Stress stress{};
  Real plastic = 0;
  std::vector<Real> more{};  ///< numbers of the law
};

constexpr int numbers_of(const InitialStressSolid&) {
  return 7;
}
constexpr int numbers_of(const InitialStressShell&) {
  return 8;
}
int points_of(const InitialStressSolid& card) {
  return card.nint;
}
int points_of(const InitialStressShell& card) {
  return card.nplane * card.nthick;
}
constexpr int in_large_line = 5, in_line = 8;
int up(int numbers, int a_line) {
  return (numbers + a_line - 1) / a_line;
}
/// Lines of a point.
template <class Card>
int lines_of(const Card& card) {
  if (card.large == 1) return up(numbers_of(card) + card.nhisv, in_large_line);
  return std::is_same_v<Card, InitialStressShell> ? 1 + up(card.nhisv, in_line) : 1;
}
template <class Card>
bool more_lines(const Card& card) {
  return static_cast<int>(card.large == 1 ? card.n1.size() : card.eps.size()) <
         points_of(card) * lines_of(card);
}

template <class Card>
std::vector<Real> row(const Card& card, std::size_t k) {
  if (card.large == 1) return {card.n1[k], card.n2[k], card.n3[k], card.n4[k], card.n5[k]};
  std::vector<Real> out;
  if constexpr (std::is_same_v<Card, InitialStressShell>) out.push_back(card.t[k]);
  out.insert(out.end(), {card.sigxx[k], card.sigyy[k], card.sigzz[k], card.sigxy[k], card.sigyz[k],
                         card.sigzx[k], card.eps[k]});
  return out;
}

template <class Card>
std::vector<GivenPoint> read_points(const Card& card) {
  constexpr std::size_t first = std::is_same_v<Card, InitialStressShell> ? 1 : 0;
  std::vector<GivenPoint> out;
  std::size_t line = 0;
  for (int p = 0; p < points_of(card); ++p) {
    std::vector<Real> all;
    for (int k = 0; k < lines_of(card); ++k) {
      const std::vector<Real> one = row(card, line++);
      all.insert(all.end(), one.begin(), one.end());
    }
    GivenPoint& point = out.emplace_back();
    if (first > 0) point.height = all[0];
    std::copy_n(all.begin() + first, 6, point.stress.begin());
    point.plastic = all[first + 6];
    point.more.assign(all.begin() + first + 7,
                      all.begin() + first + 7 + (card.large == 0 && first == 0 ? 0 : card.nhisv));
  }
  return out;
}

Stress turned(const Stress& s, const Matrix& axes) {
  Matrix global;
  global << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  const Matrix t = axes.transpose() * global * axes;
  return {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)};
}
/// Of an isotropic elastic body. [M/LT2]
Real elastic_energy(const StrengthLaw& law, const Stress& s) {
  const Real K = law.bulk_modulus(), G = law.shear_modulus(), mean = (s[0] + s[1] + s[2]) / 3;
  if (law.axes() || !(K > 0) || !(G > 0)) return 0;
  Stress deviator = s;
  for (std::size_t k = 0; k < 3; ++k) deviator[k] -= mean;
  return mean * mean / (2 * K) + std::pow(size_of(deviator), 2) / (4 * G);
}

/// A point of an element in the fields of its group.
struct PointState {
  const StrengthLaw* law = nullptr;
  std::array<Real*, 6> stress{};  ///< null: zz of shells
  std::vector<Real*> history{};   ///< of the law, component by component
  Real cosine = 1, sine = 0;      ///< of shells, from e1 to the direction a
  bool plane = false;
};

Keeps keeps(const PointState& at, const Stress& stress) {
  return keeps_stress(stress, at.history, [&](const PointBlock& points) {
    Real rate_zz = 0;
    if (!at.plane)
      at.law->update(points);
    else if (at.law->axes())
      update_along_axes(*at.law, &at.cosine, &at.sine, points, &rate_zz);
    else
      at.law->update_in_plane_stress(points, &rate_zz);
  });
}

Field<Real>* field_of(const ElementGroup& group, const std::string& name) {
  return dynamic_cast<Field<Real>*>(group.fields.find(name));
}

class StressReader {
 public:
  StressReader(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics,
               const std::vector<SolidPart>& solids, const std::vector<ShellPart>& shells)
      : deck_(deck),
        world_(world),
        diagnostics_(diagnostics),
        choice_(deck, model, world, diagnostics),
        solids_(solids),
        shells_(shells) {}

  template <class Card>
  void add(const Card& card) {
    const ElementKind kind =
        std::is_same_v<Card, InitialStressSolid> ? ElementKind::solid : ElementKind::shell;
    if (card.large == 0 && card.nhisv > 0 && kind == ElementKind::solid)
      return error(card, "NHISV", "numbers more need the format of LARGE 1", "give LARGE 1, or NHISV 0");
    const std::vector<GivenPoint> points = read_points(card);
    if (static_cast<int>(points.size()) < points_of(card)) return;  // reported with the lines
    std::vector<ReportedElement> elements;
    if (card.name == 1)
      elements = choice_.set(card, "EID", kind, card.eid, "the initial stress");
    else if (const auto* one = choice_.find(card, "EID", kind, card.eid, "the initial stress"))
      elements = {*one};
    for (const ReportedElement& one : elements)
      if (!(kind == ElementKind::solid ? set_solid(card, points, one) : set_shell(card, points, one))) return;
  }

  void finish() {
    const auto warn = [&](const Noted& of, Counted text, const char* hint) {
      if (of.points > 0) diagnostics_.warning(deck_.where(*of.first), text_of(of, text), hint);
    };
    warn(beyond_,
         "{}: the stress of {} points is beyond what the material yields at: it comes back to that in the "
         "first "
         "step",
         "check units, material and EPS");
    warn(directional_,
         "{}: {} points start without the elastic energy of their stress, as their material has directions: "
         "internal energy may fall below 0 by it",
         "motion and stress do not depend on it");
    if (more_.points > 0)
      diagnostics_.note(deck_.where(*more_.first),
                        text_of(more_,
                                "{}: numbers more of {} points have no effect: the material keeps its "
                                "plastic strain alone"));
  }

 private:
  /// Points of which there is something to say, and the card of the first.
  struct Noted {
    std::size_t points = 0;
    const Entry* first = nullptr;
    void count(const Entry& card) {
      if (points++ == 0) first = &card;
    }
  };
  using Counted = fmt::format_string<std::string, const std::size_t&>;
  std::string text_of(const Noted& noted, Counted text) const {
    return fmt::format(text, deck_.keyword(*noted.first), noted.points);
  }

  template <class Card>
  void error(const Card& card, const char* field, std::string message, std::string hint) {
    if (++errors_ <= most_errors) deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  bool set_solid(const Entry& entry, const std::vector<GivenPoint>& given, const ReportedElement& one) {
    const auto& card = static_cast<const InitialStressSolid&>(entry);
    const ElementGroup& group = one.reporter->reported();
    const SolidPart& part = solids_[static_cast<std::size_t>(group.part)];
    if (part.pressure) {
      error(card, "EID",
            fmt::format("the stress of solid {} has a pressure that follows from an equation of state",
                        one.id()),
            "use a material that gives all of the stress");
      return false;
    }
    const int count = part.formulation->points;
    Field<Real>* const stress = field_of(group, count > 1 ? "stress_of_points" : "stress");
    Real energy = 0;
    for (int p = 0; p < count; ++p) {
      PointState at{.law = part.law.get()};
      for (std::size_t k = 0; k < 6; ++k) at.stress[k] = stress->data(6 * p + static_cast<int>(k)) + one.e;
      for (const HistoryVariable& h : part.law->history()) {
        Field<Real>* const field = field_of(group, count > 1 ? h.name + "_of_points" : h.name);
        for (int k = 0; k < h.components; ++k)
          at.history.push_back(field->data(h.components * p + k) + one.e);
      }
      const GivenPoint point = of_solid(given, p, count);
      if (!put(card, point, point.stress, at, one.id())) return false;
      energy += elastic_energy(*part.law, point.stress) / count;
      note_directions(card, *part.law, point.stress);
    }
    (*field_of(group, "internal_energy"))[one.e] = energy * group.V0[one.e];
    return true;
  }
  /// Those of a card are near N1, N2, ...
  static GivenPoint of_solid(const std::vector<GivenPoint>& given, int p, int count) {
    if (given.size() == 1) return given.front();
    constexpr std::size_t near_node[] = {0, 1, 3, 2, 4, 5, 7, 6};
    if (static_cast<int>(given.size()) == count)
      return given[count == 8 ? near_node[p] : static_cast<std::size_t>(p)];
    return mean(given);
  }
  static GivenPoint mean(std::span<const GivenPoint> given) {
    GivenPoint out;
    const Real share = 1 / static_cast<Real>(given.size());
    out.more.resize(given.front().more.size());
    for (const GivenPoint& one : given) {
      out.height += share * one.height, out.plastic += share * one.plastic;
      for (std::size_t k = 0; k < 6; ++k) out.stress[k] += share * one.stress[k];
      for (std::size_t k = 0; k < out.more.size(); ++k) out.more[k] += share * one.more[k];
    }
    return out;
  }

  bool set_shell(const Entry& entry, const std::vector<GivenPoint>& given, const ReportedElement& one) {
    const auto& card = static_cast<const InitialStressShell&>(entry);
    const ElementGroup& group = one.reporter->reported();
    const ShellPart& part = shells_[static_cast<std::size_t>(group.part)].of(group.layup);
    const int layers = static_cast<int>(part.zeta.size());
    const int in_plane_points = part.full && group.corners() == 4 ? 4 : 1;
    Field<Real>& stress = layer_stress_of(group, in_plane_points * layers);
    std::array<Vec, 4> x;
    for (std::size_t c = 0; c < 4; ++c)
      x[c] = world_.nodes.x.vec(group.node.data(std::min(static_cast<int>(c), group.corners() - 1))[one.e]);
    const Matrix axes = shell_axes(x, group.corners(), part.control.invariant_axes);
    Real energy = 0;
    for (int p = 0; p < in_plane_points * layers; ++p) {
      const auto layer = static_cast<std::size_t>(p % layers);
      PointState at{.law = &part.law_of(layer), .plane = true};
      for (const int k : {0, 1, 3, 4, 5})
        at.stress[static_cast<std::size_t>(k)] = stress.data(at_layer(p, k)) + one.e;
      for (const HistoryVariable& h : at.law->history())
        for (int k = 0; k < h.components; ++k)
          at.history.push_back(layer_history_of(group, h, p).data(k) + one.e);
      if (part.has_axes()) {
        const Field<Real>& directions = layer_directions_of(group, part.zeta.size());
        at.cosine = directions.data(2 * (p % layers))[one.e];
        at.sine = directions.data(2 * (p % layers) + 1)[one.e];
      }
      const GivenPoint point = at_height(given, card.nplane, p / layers, in_plane_points, part.zeta[layer]);
      Stress local = turned(point.stress, axes);
      if (const Real most = size_of(local); std::abs(local[2]) > 0.01 * most)
        return error(card, "SIGZZ",
                     fmt::format(
                         "shell {} has a stress of {:.4g} across itself: stresses are along global axes, "
                         "and shells are in plane stress",
                         one.id(), local[2]),
                     "turn the stresses to global axes"),
               false;
      local[2] = 0;
      if (!put(card, point, local, at, one.id())) return false;
      energy += elastic_energy(*at.law, local) * part.share[layer] / in_plane_points;
      note_directions(card, *at.law, local);
    }
    (*field_of(group, "internal_energy"))[one.e] = energy * group.V0[one.e];
    return true;
  }
  /// On straight lines between the given heights, and on beyond the outermost two.
  static GivenPoint at_height(const std::vector<GivenPoint>& given, int in_plane, int corner,
                              int in_plane_points, Real zeta) {
    std::vector<GivenPoint> sorted = given, layers;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const GivenPoint& a, const GivenPoint& b) { return a.height < b.height; });
    const auto n = static_cast<std::size_t>(in_plane);
    for (std::size_t k = 0; k + n <= sorted.size(); k += n) {
      const std::span<const GivenPoint> here = std::span(sorted).subspan(k, n);
      layers.push_back(in_plane == in_plane_points ? here[static_cast<std::size_t>(corner)] : mean(here));
    }
    if (layers.size() == 1) return layers.front();
    std::size_t above = 1;
    while (above + 1 < layers.size() && layers[above].height < zeta) ++above;
    const GivenPoint &a = layers[above - 1], &b = layers[above];
    const Real s = b.height > a.height ? (zeta - a.height) / (b.height - a.height) : 0.5;
    constexpr Real same = 0.01;
    GivenPoint out = s < 0.5 ? a : b;
    if (std::abs(out.height - zeta) < same) return out;
    for (std::size_t k = 0; k < 6; ++k) out.stress[k] = (1 - s) * a.stress[k] + s * b.stress[k];
    out.plastic = std::max((1 - s) * a.plastic + s * b.plastic, Real(0));
    return out;
  }

  /// False with an error.
  template <class Card>
  bool put(const Card& card, const GivenPoint& given, const Stress& stress, const PointState& at, Id id) {
    const int plastic = plastic_strain_of(*at.law);
    if (given.plastic != 0 && plastic < 0) {
      error(card, "EPS", fmt::format("the material of element {} has no plastic strain", id), "leave it 0");
      return false;
    }
    if (plastic >= 0) *at.history[static_cast<std::size_t>(plastic)] = given.plastic;
    const bool any = std::any_of(given.more.begin(), given.more.end(), [](Real h) { return h != 0; });
    if (any && at.history.size() > (plastic >= 0 ? 1U : 0U)) {
      error(
          card, "NHISV",
          fmt::format("the material of element {} keeps numbers of its own, which are others than these", id),
          "leave them 0, or NHISV");
      return false;
    }
    if (any) more_.count(card);
    switch (keeps(at, stress)) {
      case Keeps::all:
        break;
      case Keeps::up_to_yield:
        beyond_.count(card);
        break;
      case Keeps::nothing:
        error(card, "SIGXX",
              fmt::format("the stress of element {} follows from its deformation alone, and cannot be given",
                          id),
              "elastic and plastic materials can have one");
        return false;
    }
    for (std::size_t k = 0; k < 6; ++k)
      if (at.stress[k]) *at.stress[k] = stress[k];
    return true;
  }

  void note_directions(const Entry& card, const StrengthLaw& law, const Stress& s) {
    if (law.axes() && size_of(s) > 0) directional_.count(card);
  }

  const Deck& deck_;
  const World& world_;
  Diagnostics& diagnostics_;
  ElementChoice choice_;
  const std::vector<SolidPart>& solids_;
  const std::vector<ShellPart>& shells_;
  Noted beyond_, more_, directional_;
  int errors_ = 0;
  static constexpr int most_errors = 20;
};

void set_stresses(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                  const std::vector<SolidPart>& solids, const std::vector<ShellPart>& shells) {
  const auto& of_solids = deck.all<InitialStressSolid>();
  const auto& of_shells = deck.all<InitialStressShell>();
  if (of_solids.empty() && of_shells.empty()) return;
  StressReader reader(deck, model, world, diagnostics, solids, shells);
  for (const InitialStressSolid& card : of_solids) reader.add(card);
  for (const InitialStressShell& card : of_shells) reader.add(card);
  reader.finish();
}

const RegisterBuilder initial_stresses(BuildPhase::conditions, "initial stresses", set_stresses);

std::string why_not_converted(const Conversion& conversion) {
  return conversion.units.any() ? "the numbers of a point have no dimension of their own" : "";
}
std::string why_not_turned(const Affine& motion) {
  return motion.linear() == Matrix::Identity()
             ? ""
             : "its stresses are along global axes, which a transformation that "
               "turns or stretches the file would change";
}

}  // namespace

bool has_more_lines(const InitialStressSolid& card) {
  return card.large == 0 && more_lines(card);
}
bool has_more_large_lines(const InitialStressSolid& card) {
  return card.large == 1 && more_lines(card);
}
bool has_more_lines(const InitialStressShell& card) {
  return card.large == 0 && more_lines(card);
}
bool has_more_large_lines(const InitialStressShell& card) {
  return card.large == 1 && more_lines(card);
}
std::string convert_stresses(InitialStressSolid&, const Conversion& conversion) {
  return why_not_converted(conversion);
}
std::string convert_stresses(InitialStressShell&, const Conversion& conversion) {
  return why_not_converted(conversion);
}
std::string turn_stresses(InitialStressSolid&, const Affine& motion) {
  return why_not_turned(motion);
}
std::string turn_stresses(InitialStressShell&, const Affine& motion) {
  return why_not_turned(motion);
}

}  // namespace courant
