#pragma once
// The surface of shells at one time, as points that each represent a small area.
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "search/ghosts.hpp"
#include "sph/walls/wall_belts.hpp"
#include "state/world.hpp"

namespace courant {

struct WallPoint {
  Vec x = Vec::Zero();
  Vec area = Vec::Zero();  ///< of the piece, along the normal of its face [L^(dim-1)]
  Index face = 0;
  Vec v = Vec::Zero();           ///< [L/T]
  std::array<Real, 4> weight{};  ///< interpolation weights of the nodes of its segment [-]
};

/// Whether any node of the segment can move.
bool segment_moves(const World& world, Index segment);

/// Cells of about the size `reach` that contain particles: walls elsewhere are out of sight.
class OccupiedCells {
 public:
  OccupiedCells(const Particles& p, Real reach, const std::vector<GhostPlane>& planes);
  /// Whether a particle may be within the reach of this box or of its periodic image; true if unknown.
  bool any_near(const Vec& low, const Vec& high) const;

 private:
  bool any_in(const Vec& low, const Vec& high) const;
  Real reach_, cell_ = 1;
  Vec low_ = Vec::Zero();
  std::array<Index, 3> cells_{0, 0, 0};
  std::vector<char> taken_;  ///< empty: all cells
  std::vector<Vec> shifts_{Vec::Zero()};
};

/// Flat faces divided into pieces of similar size. In 2D a shell is its line in the plane of flow, counted
/// once for any number of shells across, and areas are lengths. Behind symmetry and periodic planes are
/// images of the faces.
class WallSurface {
 public:
  /// `spacing`: of points [L]; `reach`: greatest range of queries [L]. `from`: faces out of sight of it
  /// are omitted. `belts`: moving surfaces. `beyond`: additional range of `faces_around` [L].
  WallSurface(const World& world, const std::vector<Index>& segments, Real spacing, Real reach,
              std::vector<GhostPlane> planes = {}, const OccupiedCells* from = nullptr,
              const WallBelts* belts = nullptr, Real beyond = 0);

  Index faces() const { return static_cast<Index>(faces_.size()); }
  Index points() const { return static_cast<Index>(points_.size()); }
  Index segment_of(Index face) const { return faces_[face].segment; }
  /// Maps a vector at the image of a face to the face itself.
  Vec from_image(Index face, const Vec& v) const { return faces_[face].from_image * v; }

  /// `flat`: the face if one flat wall without edges is all that is in sight of x, else -1. `nothing`: no
  /// wall in sight.
  struct View {
    bool nothing = true;
    Index flat = -1;
  };
  View view_from(const Vec& x) const;
  /// Distance of x from the plane of a face, and the plane's normal away from x.
  Real distance(Index face, const Vec& x) const { return std::abs(height(face, x)); }
  Vec away(Index face, const Vec& x) const {
    return height(face, x) < 0 ? faces_[face].n : Vec(-faces_[face].n);
  }

  /// Two bits per plane: 0 in front of it, 1 behind, 2 behind the other plane of a period.
  using Side = std::uint64_t;
  struct Face {
    std::array<Vec, 4> x, inward;  ///< corners; inward normals of the edges from each corner to the next
    std::array<Vec, 4> v;          ///< of the segment's nodes
    std::array<Real, 4> along{};   ///< in 2D: 1 for nodes at the end of the line, 0 at its start
    Matrix from_image = Matrix::Identity();  ///< maps directions at an image to the original
    Vec n = Vec::Zero();
    Real offset = 0;
    int corners = 4;
    Index plane = 0, segment = 0;
    Side side = 0;        ///< where the face is valid
    Index body = -1;      ///< the part whose motion it follows; -1: fixed
    Index image_of = -1;  ///< the face whose image it is behind plane `behind`, on side `image_side`
    int behind = 0;
    Side image_side = 0;
    int belt = -1;     ///< which it belongs to; -1: none
    WallMotion slide;  ///< of the moving surface, at factor 1
    /// Velocity of the moving surface along the face at x [L/T]; 0 without one. `factors`: current factors
    /// of moving surfaces.
    Vec slide_at(const std::vector<Real>& factors, const Vec& x) const {
      if (belt < 0) return Vec::Zero();
      const Vec u = slide.at(x);
      return factors[static_cast<std::size_t>(belt)] * (u - u.dot(n) * n);
    }
    void find_plane();  ///< n, offset and inward from the corners
    Face() { x.fill(Vec::Zero()), inward.fill(Vec::Zero()), v.fill(Vec::Zero()); }
  };
  const Face& face(Index f) const { return faces_[f]; }
  /// Current faces and motions, in the layout of `faces`: nodes `back` ago by their velocity over the last
  /// step. Searches for faces use the positions at the time of construction. [T]
  void take_along(std::vector<Face>& faces, std::vector<WallMotion>& motions, const World& world,
                  Real back) const;
  /// Weights that distribute a force at x, in the plane of a face, over the nodes of its segment with the
  /// same sum and moment, also past the edges.
  std::array<Real, 4> weights_of_nodes(const Face& face, const Vec& x) const;
  /// Faces that have points within the reach of x, ascending.
  std::vector<Index> faces_around(const Vec& x) const { return faces_around(x, reach_); }
  std::vector<Index> faces_around(const Vec& x, Real within) const;
  /// Faces that include the nearest one to x, if any is within the reach; ascending.
  std::vector<Index> faces_next_to(const Vec& x) const;
  /// Whether the face or its image is valid at q, a point in its plane.
  bool is_at_face(Index f, const Vec& q) const;
  Real reach() const { return reach_; }
  Real spacing() const { return spacing_; }
  int dim() const { return dim_; }
  Vec in_plane(const Vec& x) const { return dim_ == 2 ? Vec(x[0], x[1], 0) : x; }

  /// Calls f(point, away) for each point within the reach and `within` that is visible from x; `away` is
  /// the area vector that points away from x.
  template <class F>
  void for_each_seen(const Vec& x, F&& f) const {
    for_each_seen(x, reach_, std::forward<F>(f));
  }
  template <class F>
  void for_each_seen(const Vec& x, Real within, F&& f) const {
    const Vec from = in_plane(x);
    show_seen(from, sight_from(from, within), std::forward<F>(f));
  }
  /// The same with a list of candidates from `points_around`.
  template <class F>
  void for_each_seen(const Vec& x, Real within, const std::vector<Index>& among, F&& f) const {
    const Vec from = in_plane(x);
    SightSearch search(*this, from, within);
    for (const Index q : among) search.look_at(q);
    show_seen(from, search.found(), std::forward<F>(f));
  }
  /// Points within a distance of x, ascending.
  std::vector<Index> points_around(const Vec& x, Real within) const;

 private:
  struct Sight;
  template <class F>
  void show_seen(const Vec& from, const Sight& sight, F&& f) const {
    for (const Index q : sight.points) {
      const WallPoint& point = points_[q];
      if (hidden(point, from, sight)) continue;
      f(point, point.area.dot(point.x - from) < 0 ? Vec(-point.area) : point.area);
    }
  }
  /// Key of values that are equal to 1e-6 of the reach.
  using Key = std::array<std::int64_t, 6>;
  Key key(const Vec& a, const Vec& b) const;

  Real height(Index face, const Vec& x) const { return faces_[face].n.dot(x) - faces_[face].offset; }
  void add_line(const Nodes& nodes, const std::array<Index, 4>& node, Face face);
  void add_point(const Face& face, Index index, const Vec& x, const Vec& area,
                 const std::array<Real, 4>& weight);
  void add_face(Face face);
  void cut(Index face, Real spacing);
  Real share_in_front(const Vec& x, const Vec& along, const Vec& across) const;
  void add_images(int plane);
  Vec position_behind(int plane, Side side, const Vec& x) const;
  Vec direction_behind(int plane, const Vec& v) const;
  WallMotion motion_behind(int plane, Side side, const WallMotion& motion) const;
  bool is_at(Side side, const Vec& x) const;
  void sort_into_cells();
  bool near(Index point, const Vec& x) const { return (at_[point] - x).squaredNorm() < reach_ * reach_; }
  int cells_around(const Vec& x, std::array<Index, 27>& cells) const;
  /// Faces of one plane that may be between a particle and points on the other side.
  struct Screen {
    Index plane = 0;
    Vec n = Vec::Zero();
    Real offset = 0, height = 0;  ///< of the particle beside it [L]
    std::vector<Index> faces;
  };
  /// Points that may be visible from a position.
  struct Sight {
    std::vector<Index> points;
    std::vector<Screen> screens;  ///< empty if all is in one plane
    Real doubt = 0;               ///< nearer to a plane, a position may be on either side of a face [L]
  };
  class SightSearch {
   public:
    SightSearch(const WallSurface& surface, const Vec& from, Real within);
    void look_at(Index point) {
      const Real r2 = (surface_.at_[static_cast<std::size_t>(point)] - from_).squaredNorm();
      if (r2 < around2_) take(point, r2);
    }
    Sight found();

   private:
    void take(Index point, Real r2);
    const WallSurface& surface_;
    Vec from_;
    Real within2_, around2_;  ///< of points, and of faces in front of them [L2]
    std::vector<Index> faces_;
    Index plane_ = -1;
    bool corner_ = false;
    Sight out_;
  };
  Sight sight_from(const Vec& from, Real within) const;
  bool hidden(const WallPoint& point, const Vec& from, const Sight& sight) const;

  int dim_;
  Real reach_;
  Real farthest_;  ///< range of `faces_around` [L]
  Real spacing_;   ///< greatest length of a piece [L]
  std::vector<GhostPlane> mirrors_and_periods_;
  std::vector<Face> faces_;
  std::set<Key> lines_;
  std::map<Key, Index> planes_;
  std::vector<WallPoint> points_;
  std::vector<Vec> at_;  ///< their positions, contiguous
  Vec low_ = Vec::Zero();
  Real cell_ = 1;
  std::array<Index, 3> cells_{1, 1, 1};
  std::vector<Index> first_;  ///< points [first_[c], first_[c+1]) are in cell c
};

}  // namespace courant
