#pragma once
// Elements that fail are deleted: their stress and forces are gone, their mass stays with the nodes.
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "elements/mass_scaling.hpp"
#include "keyword/deck.hpp"
#include "laws/strength/strength.hpp"
#include "loads/frequency_range.hpp"
#include "model/model.hpp"
#include "state/reports.hpp"
#include "state/world.hpp"

namespace courant {

/// When points of the elements of a part fail, and how many of them take the element away. Infinity: a
/// criterion is not requested. Signs: stress and strain > 0 in tension, pressure > 0 in compression.
struct FailureRules {
  static constexpr Real never = std::numeric_limits<Real>::infinity();
  /// Of the law (FS, FAIL, damage): a point has no stress from there on, an element goes when all points have
  /// failed. What it is the limit of: the law's history variable.
  Real law_limit = never;
  std::string law_variable = "plastic_strain";
  Real law_time = never;                       ///< all points fail then [T]
  Real least_volume = 0, most_volume = never;  ///< V/V0 (CEROD, TEROD)
  // *MAT_ADD_EROSION
  Real most_pressure = never, least_pressure = -never, principal_stress = never, mises = never;  ///< [M/LT2]
  Real most_strain = never, least_strain = -never;  ///< principal, of the logarithmic strain [-]
  Real shear_strain = never, effective_strain = never, plastic_strain = never;
  Real expansion = never, contraction = -never;  ///< logarithm of the volume ratio
  Real threshold = 0, impulse = never;           ///< integral of (s1 - threshold)^2 dt [M/LT2], [M2/L2T3]
  Real time = never;                             ///< [T]
  int conditions = 1;                            ///< NCS: how many of them must hold at once
  int points = 1;                                ///< NUMFIP; < 0: per cent of all
  int law_points = 0;  ///< how many points the law must take away, of layers that differ; 0: all
  StrengthLaw::LeastStep least_step;  ///< of the law: an element with a smaller one goes
  std::map<Id, Real> deaths{};        ///< *DEFINE_ELEMENT_DEATH: by element [T]
  bool distorted = false;             ///< shells that turn inwards; set by the pass with their positions
  bool small_step = false;  ///< ERODE: elements that would bring the step below DTMIN times the first
  bool measures_strain() const;
  bool of_points() const;  ///< any but `small_step` and volume
  bool of_volume() const { return least_volume > 0 || most_volume < never; }
  bool of_step() const { return least_step.step > 0 || least_step.ratio > 0; }
  bool any() const { return distorted || small_step || of_step() || of_volume() || of_points(); }
};

/// By part of the model; `laws`: null where a part has no elements that deform; `goes_on`: from a restart
/// file. Cards for parts of particles
/// are errors, those without effect warnings.
std::vector<FailureRules> failure_rules(const Deck& deck, const Model& model,
                                        const std::vector<std::shared_ptr<StrengthLaw>>& laws, bool goes_on,
                                        Diagnostics& diagnostics);

/// *DEFINE_ELEMENT_DEATH and, of a run that goes on, *DELETE: times at which solids and shells are deleted,
/// into the rules of their parts. Elements that nothing can take away are errors.
void take_deaths(const Deck& deck, const Model& model, const std::vector<std::shared_ptr<StrengthLaw>>& laws,
                 bool goes_on, std::vector<FailureRules>& rules, Diagnostics& diagnostics);

/// Whether a *MAT_ADD_EROSION is for this material.
bool has_erosion_card(const Deck& deck, Id mid);

/// The points of a block at the end of a step; all arrays start with the first element of the block.
struct FailingPoints {
  int point = 0;                         ///< through the thickness
  Index begin = 0, count = 0;            ///< elements of the group
  Real t = 0, dt = 0;                    ///< [T]
  std::array<const Real*, 6> rate{};     ///< D: xx yy zz xy yz zx [1/T]
  std::array<Real*, 6> stress{};         ///< [M/LT2]
  const Real* plastic = nullptr;         ///< effective plastic strain; null: the law has none [-]
  const Real* by_law = nullptr;          ///< what FailureRules::law_limit is the limit
                                         ///< of; null: of nothing [-]
  Real law_limit = FailureRules::never;  ///< of this point, where layers differ; never: of the rules
};

/// What elements of a block push their corners with at the end of a step: corner c in direction k at 3 c + k,
/// from the first element of the block on. `moment` null: corners do not turn. [ML/T2], [ML2/T2]
struct CornerPush {
  static constexpr std::size_t most = 60;
  std::array<const Real*, most> force{}, moment{};
  Real dt = 0;  ///< of the step [T]
  /// What is in `corner_force` and `corner_moment` of a group.
  CornerPush(const ElementGroup& group, Index begin, Real dt);
  /// Of shells, from the rows that their loops leave.
  template <class Rows>
  CornerPush(const Rows& forces, const Rows& moments, Real dt) : dt(dt) {
    for (std::size_t k = 0; k < std::size(forces); ++k) force[k] = forces[k], moment[k] = moments[k];
  }
};

/// The elements of a group that may fail: solids, shells, beams. Deleted ones keep their energies, which
/// count as dissipated.
class Erosion {
 public:
  struct Energies {
    Field<Real>*internal, *bulk_viscosity, *hourglass;  ///< the last two null: there are none
  };
  /// Adds fields to `group` and to world.segments.
  Erosion(const FailureRules& rules, const ElementGroup& group, int points, Energies energies, World& world);
  /// Fields that are 0 in dead elements: stress, tensors of the law.
  void vanishes(Field<Real>& field) { vanishing_.push_back(&field); }
  /// Of points whose law weakens beside deleted elements: 1 from then on. [-]
  void weakens(Field<Real>& field) { weakening_.push_back(&field); }
  bool weakens() const { return !weakening_.empty(); }
  void weaken(Index e) const;
  void declare(const World& world, Accesses& a) const;
  const FailureRules& rules() const { return rules_; }
  const ElementGroup& group() const { return group_; }
  /// Logarithmic strain of a solid, to be turned with the stress; null: not needed.
  Field<Real>* strain() { return strain_; }
  bool dead(Index e) const { return eroded_[e] != 0; }
  bool any_dead(Index begin) const { return dead_[static_cast<std::size_t>(begin / block_size)] > 0; }

  /// Before the loops work on a block: energies are kept, dead elements have no stress.
  void begin_block(Index begin, Index count);
  /// No stress, no strain.
  void clear(Index e) const;
  /// Behind the law: strains advance, points fail and lose their stress.
  void look(const FailingPoints& points);
  /// Takes an element away for another reason; before `judge`.
  void fail(Index begin, Index e, std::string why) { strike(begin, e, std::move(why)); }
  /// Behind the forces. `share`: of the step that is taken [-]; `volume`: relative ones, null: shells. Marks
  /// who fails now, and takes the forces of all that are dead and the limits they have on the step. The half
  /// step of work that forces of `push` would do, but do not any more, is taken out of the energies again.
  void judge(Index begin, Index count, Real share, Real* step_limit, Real* wave_time, Real* volume,
             const CornerPush& push);

  // for the pass that deletes:
  void declare_booking(Accesses& a) const;
  void set_least_step(Real step) { least_step_ = step; }  ///< DTMIN times the first [T]
  struct Failed {
    Index element;
    std::string why;
  };
  /// Those that failed in this step, in order; empties the list.
  std::vector<Failed> take_failed();
  Real energy_of(Index e) const;  ///< [ML2/T2]
  bool all_dead() const;
  void loaded();

 private:
  static constexpr Index by_law = 1, by_card = 2;
  std::string failure_of(const FailingPoints& points, Index i) const;
  std::string why_by_law() const;
  std::string why_by_step(Index e, Real step) const;
  void put_back(Index e, const std::array<Real, 3>& kept) const;
  bool turned_inside_out(const Real* volume, Index i) const {
    return rules_.small_step && volume && !(volume[i] > 0);
  }
  void take_back(Index e, Index i, const CornerPush& push) const;
  Index points_needed() const;
  void strike(Index begin, Index e, std::string why);

  FailureRules rules_;
  const ElementGroup& group_;
  int points_;
  Energies energies_;
  const Field<Real>*v_, *w_;  ///< of nodes; `w_` null: they do not turn
  Field<Index>& eroded_;
  Field<Index>& failed_;  ///< by point: by_law, by_card
  Field<Real>*strain_ = nullptr, *impulse_ = nullptr;
  Field<Real>* first_step_ = nullptr;  ///< of each element; null: not needed [T]
  std::vector<Field<Real>*> vanishing_, weakening_;
  Real least_step_ = 0;
  std::vector<Real> death_;                 ///< of each element, empty: none has one [T]
  std::vector<Index> dead_;                 ///< by block
  std::vector<std::vector<Failed>> newly_;  ///< by block
  std::vector<std::vector<Failed>> why_;    ///< what points failed by in this step, by block
  std::vector<std::array<Real, 3>> kept_;   ///< energies before the step, by element
};

/// Further values of elements of all kinds.
struct ElementOptions {
  MassScaling scaling;
  std::vector<FailureRules> failure;                ///< by part of the model
  std::vector<Real> stiffness_damping;              ///< COEF by part of the model, 0: none
  std::vector<FrequencyRange> stress_ranges;        ///< mechanisms of damping by part of the model
  bool sections = false;                            ///< cross sections read forces on corners
  bool strains = false;                             ///< STRFLG: strains at points are kept
  std::vector<std::shared_ptr<Erosion>> eroding{};  ///< out: of groups that may fail
};

/// Index of a history variable among the numbers of a law; -1: it has none.
int history_at(const StrengthLaw& law, const std::string& variable);
inline int plastic_strain_of(const StrengthLaw& law) {
  return history_at(law, "plastic_strain");
}

/// Adds the pass that books deleted elements: energies, faces, what the messages tell.
void add_erosion(const Model& model, std::vector<std::shared_ptr<Erosion>> groups, World& world);

}  // namespace courant
