#pragma once
#include <map>
#include <memory>

#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// How the ends of a spring or damper moved. Of torsional ones stretches are angles [-].
struct SpringMotion {
  Real stretch = 0;  ///< > 0: longer than at rest [L]
  Real rate = 0;     ///< of the last half step [L/T]
  Real change = 0;   ///< of the stretch, over the last step [L]
  Real dt = 0;       ///< of the last step [T]
};

/// Its results; of torsional ones forces are moments [ML2/T2].
struct SpringAnswer {
  Real force = 0;      ///< > 0: tension between the ends [ML/T2]
  Real stiffness = 0;  ///< largest slope over stretches nearby, for the step [M/T2]
  Real damping = 0;    ///< largest slope over rates nearby [M/T]
};

class SpringLaw {
 public:
  virtual ~SpringLaw() = default;
  static constexpr int numbers = 2;  ///< that laws keep from step to step, 0 at the start
  virtual SpringAnswer answer(const SpringMotion& motion, Real* state) const = 0;
};

/// By the id of the material: *MAT_SPRING_ELASTIC, *MAT_DAMPER_VISCOUS, *MAT_SPRING_ELASTOPLASTIC,
/// *MAT_SPRING_NONLINEAR_ELASTIC, *MAT_DAMPER_NONLINEAR_VISCOUS, *MAT_SPRING_MAXWELL, *MAT_SPRING_INELASTIC.
/// Curves that are missing, or jump, are
/// errors.
std::map<Id, std::shared_ptr<SpringLaw>> find_spring_laws(const Deck& deck, const Model& model,
                                                          Diagnostics& diagnostics);
/// Their keywords, for messages.
const char* spring_keywords();

}  // namespace courant
