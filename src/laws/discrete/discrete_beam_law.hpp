#pragma once
// Forces of discrete beams (ELFORM 6): six springs and dampers, along and about their axes r, s, t.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/straight_pieces.hpp"
#include "keyword/registry.hpp"
#include "laws/discrete/spring_law.hpp"
#include "model/model.hpp"

namespace courant {

/// Along r, s, t, then about them.
using SixOfBeam = std::array<Real, 6>;

/// A function that goes on beyond its points; of one that starts at 0, 0 the other side is the mirror image.
class ForceCurve {
 public:
  ForceCurve() = default;
  explicit ForceCurve(const Curve& curve);
  bool empty() const { return pieces_.empty(); }
  Real operator()(Real x) const;
  /// The largest |slope| within `reach` of x.
  Real steepest(Real x, Real reach) const;

 private:
  StraightPieces pieces_{};
  bool mirrored_ = false;
};

/// The force at which a spring yields, over its plastic stretch from 0 on.
class YieldCurve {
 public:
  YieldCurve() = default;
  explicit YieldCurve(const Curve& curve) : x_(curve.abscissa), y_(curve.ordinate) {}
  bool empty() const { return x_.empty(); }
  /// By which plastic stretch a spring of stiffness k is beyond `before`, that would else bear `force`. [L]
  Real flow(Real force, Real k, Real before) const;

 private:
  std::vector<Real> x_{}, y_{};
};

/// One of the six. Of turns forces are moments, stretches angles.
struct BeamSpring : SpringLaw {
  Real k = 0, c = 0, preload = 0;  ///< [M/T2], [M/T], [ML/T2]
  ForceCurve force{}, damping{};   ///< instead of k and c; empty: none
  YieldCurve yield{};              ///< of k; empty: elastic
  bool acts() const { return k > 0 || c > 0 || preload != 0 || !force.empty() || !damping.empty(); }
  /// State of springs that yield: force besides that of damping and preload, plastic stretch.
  SpringAnswer answer(const SpringMotion& motion, Real* state) const override;
};

/// What it fails at: the sum of squares of forces, or of displacements, over these comes to 1; 0: does not
/// count. `negative`: of displacements below 0.
struct BeamLimits {
  SixOfBeam force{}, displacement{}, negative{};
  bool apart = false;  ///< displacements above and below 0 have sums of their own
  bool any() const { return force != SixOfBeam{} || displacement != SixOfBeam{} || negative != SixOfBeam{}; }
  /// Why it fails; empty: it does not.
  std::string failure(const SixOfBeam& forces, const SixOfBeam& displacements) const;
};

struct DiscreteBeamLaw {
  Real ro = 0;  ///< [M/L3]
  std::array<BeamSpring, 6> springs{};
  BeamLimits limits{};
};

/// By the id of the material. Curves that are missing, or jump, are errors.
using DiscreteBeamLaws = std::map<Id, std::shared_ptr<const DiscreteBeamLaw>>;
DiscreteBeamLaws find_discrete_beam_laws(const Deck& deck, const Model& model, Diagnostics& diagnostics);

/// The curve that a card names, if it is one that a spring may have: two points or more that rise; null, and
/// an error, where it is not.
const Curve* beam_curve(const Deck& deck, const Model& model, const Entry& card, const char* field, Id id,
                        Diagnostics& diagnostics);

/// Whether a card of these materials has the id.
bool is_discrete_beam_material(const Deck& deck, Id mid);

struct DiscreteBeamKind {
  void (*add)(const Deck&, const Model&, DiscreteBeamLaws&, Diagnostics&);
  bool (*has)(const Deck&, Id mid);
};
std::vector<DiscreteBeamKind>& discrete_beam_kinds();

/// Registers the keyword and the law of a material. A card has mid and `std::shared_ptr<DiscreteBeamLaw>
/// law(deck, model, diagnostics) const`, null behind an error.
template <class Card>
struct RegisterDiscreteBeam {
  explicit RegisterDiscreteBeam(KeywordOf<Card> keyword)
      : RegisterDiscreteBeam(table_of(std::move(keyword))) {}
  template <std::same_as<KeywordTable> Made>
  explicit RegisterDiscreteBeam(Made keyword) : keyword_(std::move(keyword)) {
    discrete_beam_kinds().push_back(
        {[](const Deck& deck, const Model& model, DiscreteBeamLaws& laws, Diagnostics& diagnostics) {
           for (const Card& card : deck.all<Card>())
             if (auto law = card.law(deck, model, diagnostics)) laws[card.mid] = std::move(law);
         },
         [](const Deck& deck, Id mid) {
           const auto& cards = deck.all<Card>();
           return std::any_of(cards.begin(), cards.end(), [&](const Card& card) { return card.mid == mid; });
         }});
  }

 private:
  RegisterKeyword<Card> keyword_;
};

}  // namespace courant
