#pragma once
// The ways on which particles see each other beside walls: straight, hidden, or thrown back.
#include <cstdint>
#include <vector>

#include "sph/boundaries/wall_surface.hpp"

namespace courant {

/// How particle j acts on particle i because of walls.
struct WallPath {
  Index i = 0, j = 0;
  /// Share of the way that walls throw back; of a straight way, less than 0: what they hide of it. [-]
  Real weight = 0;
  Vec d = Vec::Zero();               ///< x_i less the place of the image of j [L]
  Vec shift = Vec::Zero();           ///< from j to its image [L]
  Matrix turn = Matrix::Identity();  ///< of directions at j, as they are at the image
};

/// Walls act as mirrors do, each piece as far as it goes: i meets the image of j in a wall where the straight
/// way from i to the image goes through that wall, and so does j, since the way back is the same. Images of
/// images fill corners, again where the way, thrown back by one wall after the other, meets each of them.
/// Particles that a wall stands between do not meet. So whatever direction i looks in, it sees water just as
/// far as its kernel reaches, at any number of walls, at their ends and on both sides of them.
///
/// Where a wall ends free, seen from the side that i stands on, it goes over from mirror to nothing within
/// one width of its edge, half of it in front: else particles would come and go at once.
class WallPaths {
 public:
  /// A flat piece of wall as somebody sees it; `endless`: nothing else, and none of its edges.
  struct Sheet {
    Vec n = Vec::Zero();
    Real offset = 0;
    Index plane = 0;
    bool endless = false;
    std::vector<Index> faces;
    Real height(const Vec& x) const { return n.dot(x) - offset; }
    Vec image(const Vec& x) const { return x - 2 * height(x) * n; }
  };
  using Sheets = std::vector<Sheet>;
  /// Over which a free edge goes over to nothing, of the spacing of particles; by trial at steps and blocks.
  static constexpr Real usual_width = 0.8;

  /// `width`: about one spacing of the particles; the surface must reach that much farther than the kernel
  /// [L]
  WallPaths(const WallSurface& surface, int dim, Real width);

  /// What may throw back ways from about x.
  Sheets seen_from(const Vec& x) const;
  /// Appends the ways from i to j that walls change; `reach`: how far the kernel does [L].
  void add(const Sheets& sheets, Index i, const Vec& x, Index j, const Vec& y, Real reach,
           std::vector<WallPath>& to) const;

 private:
  /// Sides of a face: 1 where its normal points, 2 behind.
  using Sides = std::uint8_t;
  bool goes_on_in(const Sheet& sheet, Index face) const;
  Sides open_sides(Index face, int edge) const;
  Real cover(const Sheet& sheet, const Vec& q, const Vec& way, Sides sides) const;
  bool is_clear(const Sheets& sheets, const Vec& a, const Vec& b, Index but_plane, Index and_plane) const;
  void add_straight(const Sheets& sheets, Index i, const Vec& x, Index j, const Vec& y,
                    std::vector<WallPath>& to) const;
  void add_thrown_back(const Sheets& sheets, std::vector<const Sheet*>& by, Index i, const Vec& x, Index j,
                       const Vec& y, Real reach, std::vector<WallPath>& to) const;
  Real share_of_way(const Sheets& sheets, const std::vector<const Sheet*>& by, const Vec& x, const Vec& y,
                    Vec target) const;

  const WallSurface& surface_;
  int dim_;
  Real width_;
  std::vector<std::array<Sides, 4>> open_;  ///< of each face: on which sides each edge is free
};

}  // namespace courant
