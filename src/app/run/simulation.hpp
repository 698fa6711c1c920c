#pragma once
// A deck as a running model. Programs that embed Courant start here.
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/check/deck_facts.hpp"
#include "app/run/program_hook.hpp"
#include "contact/contact.hpp"
#include "extension/builders.hpp"
#include "keyword/deck.hpp"
#include "keyword/deck_record.hpp"
#include "model/conditions/relaxation.hpp"
#include "model/model.hpp"
#include "output/sample.hpp"
#include "output/summary.hpp"
#include "rigid/bodies/rigid.hpp"
#include "sph/materials/materials.hpp"
#include "sph/sph.hpp"
#include "time/step.hpp"

namespace courant {

class Simulation {
 public:
  /// Reads, checks and builds. Returns nullptr when `diagnostics` has errors. `before`: the deck of the run
  /// that is to go on; only what may change between the parts of a run may differ from it.
  static std::unique_ptr<Simulation> build(const std::string& deck_path, const ReadOptions& options,
                                           Diagnostics& diagnostics, const DeckRecord* before = nullptr,
                                           RunPhase phase = RunPhase::transient);
  /// The same for a deck that was read from `deck_path`. Nothing is built where `diagnostics` has errors
  /// already.
  static std::unique_ptr<Simulation> from_deck(const std::string& deck_path, Deck deck,
                                               Diagnostics& diagnostics, const DeckRecord* before = nullptr,
                                               RunPhase phase = RunPhase::transient);

  /// One step; `at_time_level` sees x, p and f of the same time before the kick.
  void step(const AtTimeLevel& at_time_level);
  /// Brings rates, pressures and forces to the present time without moving anything. At the start (before
  /// `courant check` prints) or once at the end of a run: density advances here, so a step after it would
  /// advance density twice.
  void evaluate(std::string& dt_controlled_by);
  /// Everything the histories print at the present time, or only that time where not the `whole` of it is
  /// asked for; and the gauges of these numbers.
  Sample sample(const std::string& dt_controlled_by, bool whole = true,
                const std::vector<std::size_t>& gauges = {});
  /// Adds the forces on walls that do not move to nodes and segments, until the next step.
  void show_wall_forces();

  const DeckRecord& record() const { return record_; }  ///< the deck as it was read
  /// How the deck, and once its state is loaded what was made of it, differs from that of the run before, a
  /// line for each difference.
  const std::vector<std::string>& changes() const { return changes_; }
  const DeckFacts& unit_facts() const { return unit_facts_; }  ///< from which units are guessed
  const Deck& deck() const { return deck_; }                   ///< without nodes, elements and text
  const Model& model() const { return model_; }  ///< without nodes and particles: the world holds them
  World& world() { return world_; }
  const World& world() const { return world_; }
  Clock& clock() { return clock_; }
  const SphSettings& sph() const { return get<SphSettings>(); }
  bool has_particles() const { return lists() != nullptr; }
  const Neighbours& neighbours() const { return *lists(); }  ///< where there are particles
  const std::vector<PartMaterial>& materials() const { return get<std::vector<PartMaterial>>(); }
  const std::vector<std::shared_ptr<Contact>>& contacts() const {
    return get<std::vector<std::shared_ptr<Contact>>>();
  }
  const RigidBodies* bodies() const { return get<std::shared_ptr<RigidBodies>>().get(); }
  /// What builders left of a type.
  template <class T>
  const T& get() const {
    return assembly_.get<T>();
  }
  /// The reason why a run cannot continue until `end`: particles of inlets were made, and formulas of curves
  /// taken, up to ENDTIM. Empty where it can. [T]
  std::string why_not_until(Real end) const;
  static constexpr const char* how_until = "give the later end as ENDTIM";
  PassTimer& timer() { return timer_; }
  double read_seconds() const { return read_seconds_; }  ///< for deck and set-up: the first rows of timer()
  /// The phase before the run that the deck requests: another simulation of it, of RunPhase::relaxation, from
  /// which this one starts. app/run/relaxation.hpp.
  const Relaxation& relaxation() const { return get<Relaxation>(); }
  void slow_down(Real factor);    ///< all velocities times a factor
  void slow_bodies(Real factor);  ///< those of rigid bodies, without their nodes
  /// Takes the state of a relaxation: time begins with 0, velocities are those of the deck's start.
  void start_from(Simulation& relaxed);
  Guard& guard() { return *guard_; }  ///< checks every Guard::interval steps, and on request
  const Guard& guard() const { return *guard_; }
  /// Saves or loads all that later steps depend on; between steps only. A run that goes on after it, and one
  /// that is loaded into a fresh simulation of the same deck, have the same bits from then on. Throws
  /// RestartError where the state is that of another deck.
  void keep(Archive& archive);
  std::string passes() const;           ///< which passes and outputs are active, and why others are not
  std::string passes_in_short() const;  ///< how many are active and left out, on one line

 private:
  static std::unique_ptr<Simulation> from_read_deck(const std::string& deck_path, Deck deck,
                                                    Diagnostics& diagnostics, const DeckRecord* before,
                                                    RunPhase phase);
  Simulation() = default;
  void build_world(const std::string& deck_path, Diagnostics& diagnostics);
  void note_read_seconds(double reading, double building);
  void make_stepper();
  Neighbours* lists() const { return get<std::shared_ptr<Neighbours>>().get(); }
  std::vector<PassNote> outputs(bool wanted) const;
  void sample_all(const std::string& dt_controlled_by, Sample& s);

  Deck deck_;
  DeckRecord record_;
  DeckFacts unit_facts_;
  std::vector<std::string> changes_;
  Model model_;
  World world_;
  Clock clock_;
  Assembly assembly_;  ///< what builders left
  std::shared_ptr<Guard> guard_;
  PassTimer timer_;
  double read_seconds_ = 0;
  std::unique_ptr<Stepper> stepper_;
};

struct Restart;

struct RunOptions {
  std::string dir = ".";                             ///< where results go
  Real until = 0;                                    ///< > 0: end time instead of ENDTIM [T]
  std::vector<std::string> warnings;                 ///< of the deck, for summary.yaml
  std::vector<std::string> params;                   ///< NAME=VALUE, for the command to continue
  bool d3plot = false;                               ///< --d3plot, for the same
  Id load_case = 0;                                  ///< of a deck with several, for the same; 0: none
  std::function<void(const std::string&)> print;     ///< lines of messag
  std::function<void(const std::string&)> progress;  ///< one status line, about once a second
  const std::atomic<bool>* stop = nullptr;           ///< set by a signal: end cleanly after this step
  bool dump_at_end = true;                           ///< a restart file when the run has ended or is stopped
  bool choose_threads = false;                       ///< as many as are quickest, else those that are set
  bool keyboard = false;                             ///< sense switches may be typed
  Simulation* relaxing = nullptr;                    ///< before the run, if the deck requests it
  Restart* restart = nullptr;  ///< the state from which the run continues; emptied meanwhile
  ProgramHook hook{};          ///< a program that follows the run
};

/// Runs to the end and writes all results. Throws OutputError where the folder cannot be written at the
/// start; later failures end the run with `termination: error` in the summary.
Summary run(Simulation& simulation, const std::string& deck_path, const RunOptions& options);

}  // namespace courant
