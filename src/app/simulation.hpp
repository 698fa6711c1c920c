#pragma once
// A deck as a running model: the one place where all physics folders meet. Programs that embed Courant start
// here.
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "contact/contact.hpp"
#include "elements/beam/beams.hpp"
#include "elements/discrete/discrete.hpp"
#include "elements/shell/shells.hpp"
#include "elements/solid/solids.hpp"
#include "keyword/deck.hpp"
#include "keyword/deck_record.hpp"
#include "loads/loads.hpp"
#include "model/conditions/relaxation.hpp"
#include "model/model.hpp"
#include "output/sample.hpp"
#include "output/summary.hpp"
#include "rigid/rigid.hpp"
#include "sph/boundaries/injection.hpp"
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
  /// Everything the histories print at the present time.
  Sample sample(const std::string& dt_controlled_by);
  /// Adds the forces on walls that do not move to nodes and segments, until the next step.
  void show_wall_forces();

  const DeckRecord& record() const { return record_; }  ///< the deck as it was read
  /// How the deck, and once its state is loaded what was made of it, differs from that of the run before, a
  /// line for each difference.
  const std::vector<std::string>& changes() const { return changes_; }
  const Deck& deck() const { return deck_; }     ///< without nodes, elements and text
  const Model& model() const { return model_; }  ///< without nodes and particles: the world holds them
  World& world() { return world_; }
  const World& world() const { return world_; }
  Clock& clock() { return clock_; }
  const SphSettings& sph() const { return sph_; }
  bool has_particles() const { return neighbours_ != nullptr; }
  const Neighbours& neighbours() const { return *neighbours_; }  ///< where there are particles
  const std::vector<PartMaterial>& materials() const { return materials_; }
  /// Of solids, of shells that deform and of beams, by index into the model's parts; null where a part has
  /// neither.
  const std::shared_ptr<StrengthLaw>& law_of_elements(Index part) const {
    const auto k = static_cast<std::size_t>(part);
    return solids_[k].law ? solids_[k].law : shells_[k].law ? shells_[k].law : beams_[k].law;
  }
  /// Of compression waves in elements at the start; 0: such a part has no law.
  /// [L/T]
  Real sound_speed_of_elements(Index part) const {
    const auto k = static_cast<std::size_t>(part);
    if (k >= solids_.size() || !law_of_elements(part)) return 0;
    return solids_[k].law ? solids_[k].sound_speed() : law_of_elements(part)->sound_speed();
  }
  const std::vector<std::shared_ptr<Contact>>& contacts() const { return contacts_; }
  const RigidBodies* bodies() const { return bodies_.get(); }
  const Injections& injections() const { return injections_; }
  /// Why a run cannot go on until `end`: particles of inlets were made, and formulas of curves taken, up to
  /// ENDTIM. Empty where it can. [T]
  std::string why_not_until(Real end) const;
  PassTimer& timer() { return timer_; }
  double read_seconds() const { return read_seconds_; }  ///< for deck and set-up: the first rows of timer()
  /// What the deck asks for in front of the run: another simulation of it, of RunPhase::relaxation, from
  /// which this one starts. app/relaxation.hpp.
  const Relaxation& relaxation() const { return relaxation_; }
  void slow_down(Real factor);    ///< all velocities times a factor
  void slow_bodies(Real factor);  ///< those of rigid bodies, without their nodes
  /// Takes the state of a relaxation: time begins with 0, velocities are those of the deck's start.
  void start_from(Simulation& relaxed);
  Guard& guard() { return *guard_; }  ///< looks every Guard::interval steps, and when told to
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
  void build_parts(Diagnostics& diagnostics);
  void add_tied_contacts(Diagnostics& diagnostics);
  void add_inner_faces(const std::vector<std::shared_ptr<Erosion>>& eroding);
  void release_tables();
  void note_read_seconds(double reading, double building);
  void add_passes(Diagnostics& diagnostics);
  void add_neighbours(Diagnostics& diagnostics);
  void add_particle_passes(Diagnostics& diagnostics);
  /// Of a deck without particles.
  void report_what_needs_particles(Diagnostics& diagnostics);
  void add_node_passes(Diagnostics& diagnostics);
  void add_contacts_of_nodes(Diagnostics& diagnostics);
  RigidWallPenalty wall_penalty();
  Real bulk_modulus(Index part) const;
  void add_rotations();
  void add_springs(Diagnostics& diagnostics);
  bool moves_all_by_bodies() const;
  void hold_massless_nodes(Diagnostics& diagnostics);
  void add_loads(const Points& points, const BodyAcceleration& acceleration);
  void add_ghosts(Real h, Diagnostics& diagnostics);
  void add_prescribed_motions(Diagnostics& diagnostics);
  void add_bodies();
  std::vector<PassNote> outputs(bool wanted) const;
  Ranges reference_of_parts() const;
  Real rest_energy() const;

  Deck deck_;
  DeckRecord record_;
  std::vector<std::string> changes_;
  Model model_;
  World world_;
  Clock clock_;
  SphSettings sph_;
  Injections injections_;
  std::vector<PartMaterial> materials_;
  std::vector<NodalLoad> nodal_loads_;
  std::vector<Damping> damping_;
  std::vector<SolidPart> solids_;           ///< by part of the model
  std::vector<ShellPart> shells_;           ///< the same, of shells that deform
  std::vector<BeamPart> beams_;             ///< the same
  std::vector<SpringPart> springs_;         ///< until their passes are added
  std::shared_ptr<Neighbours> neighbours_;  ///< null: no particles
  std::shared_ptr<Relocation> mirrors_;     ///< null: none
  std::vector<std::shared_ptr<Contact>> contacts_;
  std::shared_ptr<RigidBodies> bodies_;
  std::vector<GhostPlane> planes_;
  std::vector<PassNote> left_out_;
  Relaxation relaxation_;
  StepRules rules_;
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
  std::vector<std::string> params;                   ///< NAME=VALUE, for the command that goes on
  Id load_case = 0;                                  ///< of a deck with several, for the same; 0: none
  std::function<void(const std::string&)> print;     ///< lines of messag
  std::function<void(const std::string&)> progress;  ///< one status line, about once a second
  const std::atomic<bool>* stop = nullptr;           ///< set by a signal: end cleanly after this step
  bool dump_at_end = true;                           ///< a restart file when the run has ended or is stopped
  bool choose_threads = false;                       ///< as many as are quickest, else those that are set
  bool keyboard = false;                             ///< sense switches may be typed
  Simulation* relaxing = nullptr;                    ///< in front of the run, where the deck asks for that
  Restart* restart = nullptr;                        ///< what the run goes on from; emptied on the way
};

/// Runs to the end and writes all results. Throws OutputError where the folder cannot be written at the
/// start; later failures end the run with `termination: error` in the summary.
Summary run(Simulation& simulation, const std::string& deck_path, const RunOptions& options);

}  // namespace courant
