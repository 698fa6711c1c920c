#pragma once
// The data of the histories at one time. The time loop fills it; the writers only format.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "state/history_numbers.hpp"
#include "state/reports.hpp"
#include "state/world.hpp"

namespace courant {

struct PartSample {
  Id id = 0;
  std::string title;
  Real mass = 0;                                   ///< of active particles, or of the body [M]
  Real internal = 0, kinetic = 0;                  ///< [ML2/T2]
  Real hourglass = 0;                              ///< [ML2/T2]
  Real added_mass = 0;                             ///< by mass scaling, part of `mass` [M]
  Real eroded_internal = 0, eroded_hourglass = 0;  ///< of deleted elements [ML2/T2]
  Vec momentum = Vec::Zero();                      ///< [ML/T]
  Vec rigid_velocity = Vec::Zero();                ///< of the centre of mass [L/T]
};

struct ParticleSample {
  Id id = 0;
  bool active = true;
  Vec x = Vec::Zero();         ///< [L]
  Vec v = Vec::Zero();         ///< [L/T]
  Real p = 0, rho = 0, E = 0;  ///< [M/LT2], [M/L3], [M/LT2] per reference volume
  Id part = 0;
  Real h = 0;                 ///< [L]
  std::array<Real, 6> tau{};  ///< viscous stress xx yy zz xy yz zx [M/LT2]
  std::int64_t neighbours = 0;
};

/// A node of *DATABASE_HISTORY_NODE: of shells, an SPH particle, or an unused one.
struct NodeSample {
  Id id = 0;
  Vec displacement = Vec::Zero(), x = Vec::Zero();   ///< [L]
  Vec v = Vec::Zero(), a = Vec::Zero();              ///< [L/T], [L/T2]
  bool turns = false;                                ///< belongs to a rigid body, or to shells or beams
  Vec rotation = Vec::Zero();                        ///< of that body, or angles about the axes so far [-]
  Vec omega = Vec::Zero(), angular_a = Vec::Zero();  ///< [1/T], [1/T2]
};

/// The measurements of a gauge: the columns of its file and datasets behind the time.
struct GaugeLayout {
  struct Column {
    std::string name;
    std::string dimension;
    int components = 1;  ///< 1 or 3
  };
  std::string name{};  ///< of its file, and of its group in history.h5
  std::string title{};
  std::vector<Column> columns{};
};

/// Values of one gauge, in the order of its columns; NaN where there is nothing to measure.
struct GaugeSample {
  std::size_t gauge = 0;  ///< number of the gauge in the deck, from 0
  std::vector<Real> values{};
};

/// A state of a history that a file adds.
struct AddedSample {
  std::string text{};
  HistoryNumbers numbers{};
};

struct Sample {
  Real t = 0;  ///< [T]
  Real dt = 0;
  std::int64_t cycle = 0;
  std::string dt_set_by;       ///< as TimeLimit::Limit::who: "sph particle 17 of part 1"
  Real ns_per_zone_cycle = 0;  ///< wall time per particle and step [ns]
  EnergyLedger energy;
  Real mass = 0;               ///< active particles and bodies [M]
  Vec velocity = Vec::Zero();  ///< of the centre of that mass [L/T]
  std::vector<PartSample> parts;
  std::vector<InterfaceForce> interfaces;
  std::vector<Vec> impulses;  ///< of their forces on SURFA so far; empty: not asked for [ML/T]
  std::vector<RigidBodyReport> bodies;
  std::vector<RigidBodyMotion> body_motions;  ///< in the order of `bodies`
  std::vector<ParticleSample> particles;      ///< those of DATABASE_HISTORY_SPH, by id
  std::vector<NodeSample> nodes;              ///< those of DATABASE_HISTORY_NODE, by id
  std::vector<BoundaryForce> boundary_forces;
  std::vector<RigidWallForce> rigid_walls;
  std::vector<GaugeSample> gauges;  ///< those that are due
  std::vector<AddedSample> added;   ///< in the order of the registry
};

inline std::vector<BoundaryForce> boundary_forces_of(const Sample& sample, BoundaryForce::Kind kind) {
  std::vector<BoundaryForce> out;
  for (const BoundaryForce& one : sample.boundary_forces)
    if (one.kind == kind) out.push_back(one);
  return out;
}

}  // namespace courant
