#pragma once
// How the flow of an inlet changes in time, and what *COURANT_INFLOW prescribes over its height.
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "sph/outlets/free_surface.hpp"

namespace courant {

struct Injection;

/// Factor on the velocity of an inlet over time, 1 without a curve; and when how much has come in by it.
class InletRate {
 public:
  InletRate() = default;
  /// `curve`: piecewise linear over time, nowhere < 0.
  explicit InletRate(Curve curve) : curve_(std::move(curve)) {}
  bool steady() const { return curve_.abscissa.empty(); }
  Id curve() const { return curve_.id; }

  Real operator()(Real t) const { return steady() ? 1 : curve_(t); }
  /// When its integral over time from `begin` on reaches `sum` > 0 [T]; infinity: never.
  Real time_of(Real sum, Real begin) const;
  /// The smallest and the largest it takes.
  Real least() const;
  Real most() const;

 private:
  Curve curve_{};
};

/// What *COURANT_INFLOW adds to the inlets of its part: surface and profile. Refuses what does not fit them.
void read_inflows(const Deck& deck, const Model& model, std::vector<Injection>& inlets,
                  Diagnostics& diagnostics);

}  // namespace courant
