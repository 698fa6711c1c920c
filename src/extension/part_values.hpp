#pragma once
// Values that builders of one folder pass to those of folders that must not include it.
#include <optional>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// Filled once ModelPart::rigid and ::null are set.
struct PartKinds {};

/// Stiffness and mass of *MAT_RIGID, for shells and contact.
struct RigidMaterial {
  Real ro = 0;  ///< density [M/L3]
  Real E = 0;   ///< Young's modulus [M/LT2]
  Real pr = 0;  ///< Poisson ratio [-]
  Real bulk_modulus() const { return E / (3 * (1 - 2 * pr)); }
};
struct RigidParts {
  std::vector<std::optional<RigidMaterial>> of_part{};  ///< nothing: the material is another one
};

/// Bulk modulus of the material of each part, times SSF of *PART_CONTACT; 0: none. [M/LT2]
struct BulkModuli {
  std::vector<Real> of_part{};
  Real operator()(Index part) const { return of_part[static_cast<std::size_t>(part)]; }
};

/// Nodes of the world besides those of its elements, indices into Model::nodes.
struct MoreNodes {
  std::vector<Index> nodes{};
};

/// Whether a contact includes faces exposed by deleted elements.
struct InnerFaces {
  bool wanted = false;
};

/// Whether anything of the deck can move.
struct Movers {
  bool any = false;
};

/// Nodes whose mass is not part of that of their body, indices into World::nodes.
struct UnweighedNodes {
  std::vector<Index> nodes{};
};

/// Fraction of the step of elements that constraints allow. [-]
struct StepShare {
  Real value = 1;
};

/// Filled by constraints of nodes on other nodes.
struct TiedNodes {};

/// Whether mass scaling adds mass in the run.
struct MassGrowth {
  bool in_run = false;
};

/// Rules of particles for their contact.
struct ParticleContactRules {
  bool particles = false;              ///< there are some
  bool skip_inactive = false;          ///< ICONT
  bool thickness_from_volume = false;  ///< ITHK
  Real reach_margin = 0;               ///< motion of particles between two searches [L]
};

/// Filled when particles have their pressures and equations of state.
struct ParticlePressures {};

/// Filled by the passes of particles, and of bodies.
struct FlowPasses {};
struct BodyPasses {
  bool move = false;  ///< some body can
};

/// Filled by additions, which may bring element groups.
struct Additions {};

/// m c^2 of everything: far above all energies of a scene, and known before anything moves. [ML2/T2]
struct RestEnergy {
  Real value = 0;
};

}  // namespace courant
