#pragma once
// The ways on which particles see each other beside walls: straight, hidden, or thrown back.
#include <utility>
#include <vector>

#include "sph/boundaries/wall_surface.hpp"

namespace courant {

/// How particle j acts on particle i because of walls.
struct WallPath {
  Index i = 0, j = 0;
  /// Share of the way that walls throw back; of a straight way, less than 0: what they hide of it. [-]
  Real weight = 0;
  Vec d = Vec::Zero();                         ///< x_i less the place of the image of j [L]
  Matrix turn = Matrix::Identity();            ///< of directions at j, as they are at the image
  Vec by_i = Vec::Zero(), by_j = Vec::Zero();  ///< how the share goes over with the places of i and j [1/L]
};

/// Walls act as mirrors do, each piece as far as it goes: i meets the image of j in a wall where the straight
/// way from i to the image goes through that wall, and so does j, since the way back is the same. Images of
/// images fill corners, again where the way, thrown back by one wall after the other, meets each of them.
/// Particles that a wall stands between do not meet. So whatever direction i looks in, it sees water just as
/// far as its kernel reaches, at any number of walls, at their ends and on both sides of them.
///
/// Where a wall ends, and where the next one turns away from the water, a way that passes the edge goes over
/// from thrown back (or hidden) to nothing within one width, half of it on each side, smoothly: else
/// particles would come and go at once. What the wall no longer throws back is what it no longer hides.
class WallPaths {
 public:
  /// A flat piece of wall as somebody sees it; `endless`: nothing else, and none of its edges.
  struct Sheet {
    Vec n = Vec::Zero();
    Real offset = 0;
    Index plane = 0;
    bool endless = false;
    std::vector<Index> faces;
    std::vector<std::pair<Index, int>> edges;  ///< of these faces, where nothing goes on in the plane
    Real height(const Vec& x) const { return n.dot(x) - offset; }
    Vec image(const Vec& x) const { return x - 2 * height(x) * n; }
    Matrix turn() const { return Matrix::Identity() - 2 * n * n.transpose(); }
  };
  using Sheets = std::vector<Sheet>;
  /// Over which a free edge goes over to nothing, of the spacing of particles; by trial at steps and blocks.
  static constexpr Real usual_width = 1.2;

  /// `width`: about one spacing of the particles; the surface must reach that much farther than the kernel
  /// [L]
  WallPaths(const WallSurface& surface, int dim, Real width);

  /// What may throw back ways from about x.
  Sheets seen_from(const Vec& x) const;
  /// Appends the ways from i to j that walls change; `reach`: how far the kernel does [L].
  void add(const Sheets& sheets, Index i, const Vec& x, Index j, const Vec& y, Real reach,
           std::vector<WallPath>& to) const;

 private:
  /// Where another face begins at an edge: the edge is none to who stands between both.
  struct Corner {
    Vec n = Vec::Zero();  ///< of the other face
    Real here = 0;        ///< side of the other face on which this one lies
    Real there = 0;       ///< side of this face on which the other one lies
  };
  struct Edge {
    bool ends = false;  ///< no face goes on from here in the plane
    std::vector<Corner> corners;
    Vec middle = Vec::Zero();
    Real half = 0;  ///< of its length [L]
  };
  /// Where on a sheet a way meets it.
  struct Meeting {
    bool crosses = false, inside = false;
    Vec at = Vec::Zero();
    Real share = 0;
    Vec by_start = Vec::Zero(), by_end = Vec::Zero();  ///< slopes of the share [1/L]
  };
  using Sequence = std::vector<const Sheet*>;
  bool goes_on_in(const Sheet& sheet, Index face) const;
  Edge edge_of(Index face, int edge) const;
  bool is_free(Index face, int edge, const Vec& p) const;
  bool is_inside(const Sheet& sheet, const Vec& q) const;
  bool lies_in(const Vec& c, const Vec& d, const Sheet* sheet) const;
  bool turn_away(const Sheet& sheet, const Sheet& other, const Vec& x, const Vec& y) const;
  Meeting meet(const Sheet& sheet, const Vec& a, const Vec& b, const Vec& start, const Vec& x, const Vec& y,
               const Sheet* but = nullptr, const Sheet* and_but = nullptr) const;
  Meeting hidden(const Sheets& sheets, const Vec& a, const Vec& b, const Vec& x, const Vec& y,
                 const Sheet* but = nullptr, const Sheet* and_but = nullptr) const;
  void follow(const Sheets& sheets, const Sequence& by, const Vec& x, const Vec& y, Vec target,
              WallPath& path) const;
  void add_straight(const Sheets& sheets, Index i, const Vec& x, Index j, const Vec& y,
                    std::vector<WallPath>& to) const;
  void add_thrown_back(const Sheets& sheets, Sequence& by, const Vec& x_there, Index i, const Vec& x, Index j,
                       const Vec& y, Real reach, std::vector<WallPath>& to) const;

  const WallSurface& surface_;
  int dim_;
  Real width_;
  std::vector<std::array<Edge, 4>> edges_;  ///< of each face
};

}  // namespace courant
