#pragma once
// Which equation of state a part has.
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "laws/eos/eos.hpp"
#include "model/model.hpp"

namespace courant {

/// The equations of state of a deck, each for the reference densities of materials. Parts with the same law
/// and the same density share one.
class PartEos {
 public:
  PartEos(const Deck& deck, const Model& model);
  /// Whether there is one for `part`; an error where not, once for all parts of a material that lack it.
  /// `what`: "particles", "solids".
  bool exists(const Deck& deck, const ModelPart& part, const char* what, Diagnostics& diagnostics) const;
  /// That of `part`, whose material has density `ro` and gives no pressure; null, and an error, where there
  /// is none or where it has no sound speed at the start. `what` as above. ro [M/L3]
  std::shared_ptr<EosLaw> find(const Deck& deck, const ModelPart& part, Real ro, const char* what,
                               Diagnostics& diagnostics);

 private:
  std::shared_ptr<EosLaw> at_density(Id id, const std::shared_ptr<EosLaw>& law, Real ro);
  std::map<Id, std::shared_ptr<EosLaw>> laws_;
  std::map<std::pair<Id, Real>, std::shared_ptr<EosLaw>> of_density_;
  const Model& model_;
  mutable std::set<std::tuple<Id, Id, std::string>> missing_;  ///< MID, EOSID and `what` that were reported
};

}  // namespace courant
