#pragma once
// Strength: the stress of a material at a strain rate. One file per law registers it with its card; nothing
// else is edited.
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "keyword/deck.hpp"
#include "keyword/registry.hpp"
#include "laws/check_cards.hpp"
#include "laws/point_block.hpp"
#include "model/model.hpp"

namespace courant {

struct MaterialAxes;

/// A history variable that a law stores for each point, 0 at the start: a number, or with six components a
/// symmetric tensor xx yy zz xy yz zx, which is rotated with the body before the law gets it, as the stress
/// is.
struct HistoryVariable {
  std::string name, dimension;
  int components = 1;
  bool is_tensor() const { return components == 6; }
};

/// Name of a history variable that becomes 1 beside deleted elements.
inline constexpr const char* beside_deleted = "beside_deleted_elements";

/// Name of a history variable that elements set at the start: the cube root of the volume of a solid or
/// particle, the square root of the area of a shell. 0: no element. [L]
inline constexpr const char* element_size = "element_size";

/// Failure strains of this size or larger mean no failure.
inline constexpr Real never_fails = 1e10;

/// A law read from the deck, or made for a test. It has no state: the state is in the block.
class StrengthLaw {
 public:
  virtual ~StrengthLaw() = default;
  /// Advances a block by its dt; with dt = 0 it computes the sound speed only.
  virtual void update(const PointBlock& block) const = 0;
  /// The same in plane stress, zz = 0 before and after: rates zz of the block are ignored; those that keep
  /// the stress 0 are returned in `rate_zz`, one for each point [1/T]. Unless a law overrides this, they are
  /// found by trial steps of `update` (plane_stress.cpp). Only for laws that compute the whole stress.
  virtual void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const;
  virtual std::vector<HistoryVariable> history() const { return {}; }
  /// The law gives the deviator only: pressure comes from an equation of state that the part must have.
  virtual bool deviator_only() const { return false; }
  /// The law computes the pressure from the equation of state of its parts.
  virtual bool takes_equation_of_state() const { return false; }
  virtual Real bulk_modulus() const = 0;   ///< at rest; 0 with `deviator_only` [M/LT2]
  virtual Real shear_modulus() const = 0;  ///< at rest [M/LT2]
  /// The directions a, b of the rates and stresses of the law (material_axes.hpp); null: none. Shells rotate
  /// to them; in solids the law itself rotates, by its history `material_directions`.
  virtual const MaterialAxes* axes() const { return nullptr; }
  /// Waves can be faster than at rest; shells then use `sound_speed` of a block.
  virtual bool stiffens() const { return false; }
  /// Whether shells and beams can have it; laws with directions are for shells only, or for solids only.
  virtual bool in_sheets() const { return true; }
  /// Largest stiffness of a sheet in plane stress with one side fixed: E/(1 - nu^2), at rest. [M/LT2]
  virtual Real plane_modulus() const;
  /// Value of its history `failure_variable` at which a point fails; infinity: never. [-]
  virtual Real failure_limit() const { return std::numeric_limits<Real>::infinity(); }
  virtual std::string failure_variable() const { return "plastic_strain"; }
  /// Time at which all points fail; infinity: never by time. [T]
  virtual Real failure_time() const { return std::numeric_limits<Real>::infinity(); }
  /// Steps of an element below which it fails: the step itself [T], and its ratio to the first one. [-]
  struct LeastStep {
    Real step = 0, ratio = 0;
  };
  virtual LeastStep least_step() const { return {}; }
  /// V/V0 below and above which an element fails. [-]
  virtual std::pair<Real, Real> volume_range() const { return {0, std::numeric_limits<Real>::infinity()}; }
  /// Lower limit of the pressure of the equation of state. [M/LT2]
  virtual Real pressure_cutoff() const { return -std::numeric_limits<Real>::infinity(); }
  /// Of a fluid, for the stable step. [M/LT]
  virtual Real viscosity() const { return 0; }
  /// Of compression waves at rest: sqrt((K + 4G/3)/RO). [L/T]
  virtual Real sound_speed() const;
  Real ro = 0;                 ///< reference density [M/L3]
  bool bulk_viscosity = true;  ///< whether that of *CONTROL_BULK_VISCOSITY acts, in solids
  int failing_layers = 0;      ///< points through the thickness that must fail to delete a shell; 0: all
};

/// A step and the stress that a law must return, computed by hand from its formula, for the generic test.
struct StrengthReference {
  std::string deck;                   ///< the keyword's cards, as in a deck
  std::array<Real, 6> strain;         ///< D dt, of the tensor [-]
  std::array<Real, 6> before, after;  ///< stress [M/LT2]
  /// By component, before (empty: 0) and after (empty: not compared).
  std::vector<Real> history{}, new_history{};
};

struct StrengthEntry {
  std::string keyword, equation, source;
  bool deviator_only = false;  ///< as StrengthLaw::deviator_only of its laws
  std::vector<StrengthReference> references;
  /// Every law of this kind in a deck, by the id of its material. The model has the curves and tables.
  std::function<std::vector<std::pair<Id, std::shared_ptr<StrengthLaw>>>(const Deck&, const Model&)> all;
  /// Checks of its cards beyond those of the table of the keyword.
  std::function<void(const Deck&, const Model&, Diagnostics&)> check;
};

/// In the order of keywords, independent of the order of linking.
std::vector<StrengthEntry>& strength_registry();
void add_to_strength_registry(StrengthEntry entry);

/// Damage and failure added to a law by cards besides that of its material. Returns the law itself if no card
/// is for the material.
using LawAddition = std::function<std::shared_ptr<StrengthLaw>(const Deck&, const Model&, Id mid,
                                                               std::shared_ptr<StrengthLaw> law)>;
std::vector<LawAddition>& law_additions();
std::shared_ptr<StrengthLaw> with_additions(const Deck& deck, const Model& model, Id mid,
                                            std::shared_ptr<StrengthLaw> law);

/// Card must have a member mid and a function law(), a std::shared_ptr<StrengthLaw> made from valid cards,
/// and may have check(deck, diagnostics), both with the model as last but one or only argument where they
/// need its curves; with laws that are `deviator_only` a static constexpr bool of that name, so that messages
/// suggest the keyword only where it is valid.
template <class Card>
struct RegisterStrength {
  RegisterStrength(std::string equation, std::string source, std::vector<StrengthReference> references,
                   KeywordOf<Card> keyword)
      : RegisterStrength(std::move(equation), std::move(source), std::move(references),
                         table_of(std::move(keyword))) {}
  template <std::same_as<KeywordTable> Made>
  RegisterStrength(std::string equation, std::string source, std::vector<StrengthReference> references,
                   Made keyword) {
    StrengthEntry entry;
    entry.keyword = keyword.names.front();
    entry.equation = std::move(equation);
    entry.source = std::move(source);
    entry.references = std::move(references);
    if constexpr (requires { Card::deviator_only; }) entry.deviator_only = Card::deviator_only;
    entry.all = [](const Deck& deck, const Model& model) {
      std::vector<std::pair<Id, std::shared_ptr<StrengthLaw>>> laws;
      for (const Card& card : deck.all<Card>())
        if constexpr (requires { card.law(deck, model); })
          laws.emplace_back(card.mid, with_additions(deck, model, card.mid, card.law(deck, model)));
        else if constexpr (requires { card.law(model); })
          laws.emplace_back(card.mid, with_additions(deck, model, card.mid, card.law(model)));
        else
          laws.emplace_back(card.mid, with_additions(deck, model, card.mid, card.law()));
      return laws;
    };
    entry.check = &check_cards<Card>;
    add_to_strength_registry(std::move(entry));
    register_keyword(make_keyword_spec<Card>(std::move(keyword)));
  }
};

}  // namespace courant
