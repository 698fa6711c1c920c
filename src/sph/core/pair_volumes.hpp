#pragma once
// m/rho of particles as pair loops read it of neighbours.
#include "parallel/array.hpp"
#include "state/restartable.hpp"
#include "state/world.hpp"

namespace courant {

/// While threads work on the rates, density already changes: the loops of the rates read the volumes before
/// that, those of the forces the volumes after. With older ones in the forces, pressure would return less
/// work than it took, in proportion to the step.
class PairVolumes : public Material, public Refresh, public Restartable {
 public:
  explicit PairVolumes(World& world);
  std::string name() const override { return "sph volumes"; }
  void declare(const World& world, Accesses& a) const override;
  /// As the last step left them: what `current` gives before the laws of this one.
  const Resource& before() const { return before_; }
  /// Of this step: what `current` gives in the forces.
  const Resource& now() const { return now_; }
  /// Of the latest density all of which is known [L3]; shape: (particles and ghosts)
  const Real* current() const { return fields_[current_]->data(); }
  /// While a state is loaded, until `loaded`: as if those of the first particles were these.
  void pretend(const Array<Real>& volumes);
  /// Of the ghosts [first, last), at any time. [L3]
  void set_ghosts(Index first, Index last, Real volume);

  void block(World& world, const Clock&, Index begin, Index end) override;
  void finish(World&, const Clock&) override {
    note_access(now_);
    current_ = 1 - current_;
  }
  void refreshed(World& world, const Clock&, std::span<const Index>) override { fill(world); }
  void keep(Archive& archive) override { archive("current", current_); }
  void loaded(World& world) override { fill(world); }

 private:
  /// One of the two arrays: that which is the current one, or the other.
  class Turn : public Resource {
   public:
    Turn(const char* name, const PairVolumes& volumes, bool current)
        : Resource(name, "particles"), volumes_(volumes), current_(current) {}
    const FieldBase* field() const override {
      return volumes_.fields_[current_ ? volumes_.current_ : 1 - volumes_.current_];
    }

   private:
    const PairVolumes& volumes_;
    bool current_;
  };
  void fill(World& world);
  Turn before_{"volume before", *this, true}, now_{"volume", *this, true}, next_{"next volume", *this, false};
  Field<Real>* fields_[2];
  int current_ = 0;
};

}  // namespace courant
