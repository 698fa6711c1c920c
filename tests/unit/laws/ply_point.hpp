#pragma once
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "laws/strength/strength.hpp"

namespace courant::test {

/// A point of a layer, in the directions of its material.
struct OnePoint {
  explicit OnePoint(std::shared_ptr<StrengthLaw> of) : law(std::move(of)) {
    for (const HistoryVariable& h : law->history()) names.push_back(h.name);
    history.assign(names.size(), 0);
  }
  /// Strains a, b, ab, bc, ca of the tensor more, in `steps`.
  void strain(Real a, Real b, Real ab, int steps = 1, Real bc = 0, Real ca = 0) {
    Real rate[6] = {a / steps, b / steps, 0, ab / steps, bc / steps, ca / steps}, c = 0, zz = 0;
    std::vector<Real*> kept;
    for (Real& h : history) kept.push_back(&h);
    PointBlock block;
    block.count = 1, block.dt = 1, block.sound_speed = &c, block.history = kept;
    for (std::size_t k = 0; k < 6; ++k) block.rate[k] = &rate[k], block.stress[k] = &stress[k];
    for (int n = 0; n < steps; ++n) law->update_in_plane_stress(block, &zz);
  }
  Real of(const std::string& name) const { return const_cast<OnePoint*>(this)->at(name); }
  Real& at(const std::string& name) {
    return history[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
  }
  std::shared_ptr<StrengthLaw> law;
  std::vector<std::string> names;
  std::vector<Real> history;
  Real stress[6] = {};
};

}  // namespace courant::test
