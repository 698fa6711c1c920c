#pragma once
// A hydraulic jump against theory. Source of the measures: Jonsson, Jonsen, Andreasson, Lundstrom and
// Hellstrom, "Smoothed Particle Hydrodynamics Modelling of Hydraulic Jumps", J. Appl. Math. Phys. (2016);
// equation numbers from there.
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "post/recipe.hpp"

namespace courant {

Real froude(Real v1, Real d1, Real g);  ///< v1 / sqrt(g d1)
/// Belanger's conjugate depth d2 = d1/2 (sqrt(1 + 8 Fr1^2) - 1), eq. 1. v1: [L/T], d1: [L], g: [L/T2] -> [L]
Real belanger_depth(Real v1, Real d1, Real g);
/// Length of the roller over d1, eq. 2, for 2 < Fr1 < 16. Source there: Hager, Bremen and Kawagoshi (1990).
Real roller_length_over_d1(Real Fr1);
/// Largest mean velocity over v1 at a distance (x - x1) / d1 from the toe, eq. 3. Source there: Chanson
/// (2010).
Real velocity_decay(Real distance_over_d1);
/// Largest standard deviation of the surface over d1, eq. 4. Source there: Murzyn and Chanson (2009).
Real largest_deviation_over_d1(Real Fr1);
/// Strouhal number f d1 / v1 of the surface's fluctuations, eq. 5, for 2.4 < Fr1 < 6.5. Source there:
/// Chachereau and Chanson (2011).
Real surface_strouhal(Real Fr1);
/// A = sqrt(sum d^2 / sum d_theory^2), eq. 19; 1 is agreement. depth: (N) [L]; NaN for N = 0.
Real agreement_A(std::span<const Real> depth, Real theory);
/// P = sqrt(sum (d - d_theory)^2 / sum d_theory^2), eq. 20; 0 is agreement. depth: (N) [L]; NaN for N = 0.
Real agreement_P(std::span<const Real> depth, Real theory);

/// What was measured at each state. shape of all: (states)
struct JumpSeries {
  std::vector<Real> t;      ///< [T]
  std::vector<Real> depth;  ///< at the recipe's x [L]
  std::vector<Real> toe;    ///< most upstream x deeper than threshold d1, NaN: none [L]
  std::vector<Real> front;  ///< depth where the wave's arrival is timed [L]
};

struct IntervalResult {
  Interval interval;
  int states = 0;        ///< in the interval; 0: the results do not reach it
  bool complete = true;  ///< the results cover the whole interval
  Real A = 0, P = 0, mean_depth = 0;
  std::vector<PublishedRow>
      published;  ///< of that interval and of this case; of all cases if the case is unknown
};

struct JumpResult {
  Real Fr1 = 0, d2_theory = 0;
  std::string case_name;  ///< empty: unknown
  std::vector<IntervalResult> intervals;
  std::optional<Real> front_time;  ///< [T]
  /// When and where the toe stood furthest downstream: the jump has reached the weir and turns back [T], [L]
  std::optional<std::pair<Real, Real>> turn;
  JumpSeries series;
};

/// The case that a title names: the published case whose name stands in it, blanks and case of letters aside;
/// a digit may not follow ("d1/1" is not in "d1/10"). Empty if none.
std::string find_case(const std::string& title, const std::vector<PublishedRow>& published);

/// Statistics of a measured series. States belong to an interval with a slack of a quarter of their spacing,
/// because a state is written up to one time step early.
JumpResult evaluate_jump(const JumpRecipe& recipe, const std::string& case_name, JumpSeries series);

/// The table that users see, several lines.
std::string jump_text(const JumpRecipe& recipe, const JumpResult& result);

}  // namespace courant
