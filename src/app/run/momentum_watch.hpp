#pragma once
// Whether momentum stays where nothing outside acts.
#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "output/sample.hpp"
#include "rigid/bodies/rigid.hpp"
#include "state/restartable.hpp"

namespace courant {

/// Looks when histories are written. `maxima` of the world get `momentum_change_share`: the largest change of
/// total momentum since the start, of the largest sum of the momenta of parts; 0 where it is round-off of
/// what moves.
class MomentumWatch : public Pass, public Restartable {
 public:
  /// `free`: nothing outside acts; else it looks at nothing, but is there for restarts that change that.
  explicit MomentumWatch(bool free) : free_(free) {}
  std::string name() const override { return "total momentum"; }
  void look(const Sample& sample, World& world);
  void keep(Archive& archive) override;

 private:
  bool free_, began_ = false;
  Real mass_ = 0, most_ = 0;  ///< of the start; largest sum of the momenta of parts
  Real change_ = 0;           ///< largest so far
  Vec first_ = Vec::Zero();
};

}  // namespace courant
