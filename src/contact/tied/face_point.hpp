#pragma once
// Where a tied node is beside a face, and how forces there act on the corners.
#include <array>
#include <span>

#include "contact/nodes/face.hpp"

namespace courant {

/// A position that goes with a face: x = sum_i N_i x_i + gap n, n the unit normal of the bilinear face at
/// that point. If the face moves as a rigid body, so does the point, for any gap.
struct FacePoint {
  std::array<Index, 4> node{};  ///< corners, indices into World::nodes
  int corners = 4;
  std::array<Real, 4> N{};             ///< shape functions at the point, which sum to 1 [-]
  std::array<Real, 4> by_s{}, by_t{};  ///< their change along the two directions of the map [-]
  Real gap = 0;                        ///< along the normal [L]
};

FacePoint face_point(const ContactFace& face, const Projection& at, Real gap);

/// The position now. `x`: of World::nodes [L]
Vec place_of(const FacePoint& point, const Field<Real>& x);
/// The unit normal of the face there. [-]
Vec normal_of(const FacePoint& point, const Field<Real>& x);
/// Its velocity where the corners have velocities v.
Vec velocity_of(const FacePoint& point, const Field<Real>& x, const Field<Real>& v);
/// The part of each corner in that: velocity = sum_e B_e v_e.
std::array<Matrix, 4> rates_of(const FacePoint& point, const Field<Real>& x);
/// Where the point is once its corners are at x after a step dt with the velocities v, and the velocity that
/// took it there.
struct PointStep {
  Vec x = Vec::Zero(), v = Vec::Zero();
};
PointStep step_of(const FacePoint& point, std::span<const Vec> x, std::span<const Vec> v, Real dt);
/// What a force at the point is on each corner: it does the same work in any motion of the corners, so that
/// the sums of forces and of moments are the same, too. [ML/T2]
std::array<Vec, 4> on_corners(const FacePoint& point, const Field<Real>& x, const Vec& force);
/// For each corner at least the velocity of the point where the corner moves by 1. [-]
std::array<Real, 4> largest_shares(const FacePoint& point, const Field<Real>& x);
/// Of a mass at the point, for each corner: not below 0, and 1 in sum. [-]
std::array<Real, 4> mass_shares(const FacePoint& point);

}  // namespace courant
