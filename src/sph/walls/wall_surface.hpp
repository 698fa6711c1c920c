#pragma once
// The surface of shells at one moment, as points that each represent a piece of it.
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
  std::array<Real, 4> weight{};  ///< of the nodes of its segment, as they interpolate [-]
};

/// Whether any of its nodes can.
bool segment_moves(const World& world, Index segment);

/// Where walls may be seen from: cells about `reach` wide, and which of them particles are in.
class Lookouts {
 public:
  Lookouts(const Particles& p, Real reach, const std::vector<GhostPlane>& planes);
  /// Whether anything within the reach of this box, or of its image across a period, is there; true where
  /// that is not known.
  bool any_near(const Vec& low, const Vec& high) const;

 private:
  bool any_in(const Vec& low, const Vec& high) const;
  Real reach_, cell_ = 1;
  Vec low_ = Vec::Zero();
  std::array<Index, 3> cells_{0, 0, 0};
  std::vector<char> taken_;  ///< empty: anywhere
  std::vector<Vec> shifts_{Vec::Zero()};
};

/// Flat faces cut into pieces of about one size. In 2D a shell counts by its line in the plane of flow, once
/// however many shells it has across, and areas are lengths. Behind planes stands the image of what is in
/// front of them, and nothing else.
class WallSurface {
 public:
  /// `spacing`: of points [L]; `reach`: farthest that anything looks [L]. `from`: what nothing there can see
  /// is left out. `belts`: what moves along itself. `beyond`: so much farther `faces_around` may look [L].
  WallSurface(const World& world, const std::vector<Index>& segments, Real spacing, Real reach,
              std::vector<GhostPlane> planes = {}, const Lookouts* from = nullptr,
              const WallBelts* belts = nullptr, Real beyond = 0);

  Index faces() const { return static_cast<Index>(faces_.size()); }
  Index points() const { return static_cast<Index>(points_.size()); }
  Index segment_of(Index face) const { return faces_[face].segment; }
  /// A vector at the image of a face, as it is at the face itself.
  Vec from_image(Index face, const Vec& v) const { return faces_[face].from_image * v; }

  /// Where x sees one flat wall and none of its edges: a face of it; else -1. `nothing`: it sees no wall.
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

  /// Two bits for each of these planes: 0 in front of it, 1 behind, 2 behind the other one of a period.
  using Side = std::uint64_t;
  struct Face {
    std::array<Vec, 4> x, inward;            ///< corners; of the edge from each to the next, into the face
    std::array<Vec, 4> v;                    ///< of the segment's nodes
    std::array<Real, 4> along{};             ///< in 2D: 1 for nodes at the line's end, 0 at its begin
    Matrix from_image = Matrix::Identity();  ///< turns directions at an image back
    Vec n = Vec::Zero();
    Real offset = 0;
    int corners = 4;
    Index plane = 0, segment = 0;
    Side side = 0;        ///< where it counts
    Index body = -1;      ///< the part whose motion it follows; -1: it is held
    Index image_of = -1;  ///< the face whose image it is behind plane `behind`, on the side `way`
    int behind = 0;
    Side way = 0;
    int belt = -1;     ///< which it belongs to; -1: none
    WallMotion slide;  ///< of the moving surface, at factor 1
    /// Velocity of the moving surface along the face at x [L/T]; 0 without one. `factors`: by which moving
    /// surfaces go now.
    Vec slide_at(const std::vector<Real>& factors, const Vec& x) const {
      if (belt < 0) return Vec::Zero();
      const Vec u = slide.at(x);
      return factors[static_cast<std::size_t>(belt)] * (u - u.dot(n) * n);
    }
    void find_plane();  ///< n, offset and inward from the corners
    Face() { x.fill(Vec::Zero()), inward.fill(Vec::Zero()), v.fill(Vec::Zero()); }
  };
  const Face& face(Index f) const { return faces_[f]; }
  /// Where the faces, which look as those of `faces`, and their motions are: those that move, where the nodes
  /// were `back` ago by their velocity over the last step. Who looks for faces finds them where they were
  /// when the surface was made. [T]
  void take_along(std::vector<Face>& faces, std::vector<WallMotion>& motions, const World& world,
                  Real back) const;
  /// By which forces at x, in the plane of a face, are on the nodes of its segment: their sum and their
  /// moment are those at x, also past the edges.
  std::array<Real, 4> weights_of_nodes(const Face& face, const Vec& x) const;
  /// Faces that have points within the reach of x, ascending.
  std::vector<Index> faces_around(const Vec& x) const { return faces_around(x, reach_); }
  std::vector<Index> faces_around(const Vec& x, Real within) const;
  /// Faces among which is the one next to x, where any is within the reach; ascending.
  std::vector<Index> faces_next_to(const Vec& x) const;
  /// Whether q, in the plane of a face, is where that face or its image counts.
  bool is_at_face(Index f, const Vec& q) const;
  Real reach() const { return reach_; }
  Real spacing() const { return spacing_; }
  int dim() const { return dim_; }
  Vec in_plane(const Vec& x) const { return dim_ == 2 ? Vec(x[0], x[1], 0) : x; }

  /// Calls f(point, away) for each point nearer than the reach, and than `within`, that can be seen from x
  /// past other faces; `away` is the piece's area with its normal away from x.
  template <class F>
  void for_each_seen(const Vec& x, F&& f) const {
    for_each_seen(x, reach_, std::forward<F>(f));
  }
  template <class F>
  void for_each_seen(const Vec& x, Real within, F&& f) const {
    const Vec from = in_plane(x);
    show_seen(from, sight_from(from, within), std::forward<F>(f));
  }
  /// The same where these are all points that may matter, as `points_around` lists them.
  template <class F>
  void for_each_seen(const Vec& x, Real within, const std::vector<Index>& among, F&& f) const {
    const Vec from = in_plane(x);
    SightSearch search(*this, from, within);
    for (const Index q : among) search.look_at(q);
    show_seen(from, search.found(), std::forward<F>(f));
  }
  /// Ascending.
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
  /// What is alike to 1e-6 of the reach has one key.
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
  Vec place_behind(int plane, Side way, const Vec& x) const;
  Vec direction_behind(int plane, const Vec& v) const;
  WallMotion motion_behind(int plane, Side way, const WallMotion& motion) const;
  bool is_at(Side side, const Vec& x) const;
  void sort_into_cells();
  bool near(Index point, const Vec& x) const { return (at_[point] - x).squaredNorm() < reach_ * reach_; }
  int cells_around(const Vec& x, std::array<Index, 27>& cells) const;
  /// Faces of one plane that may be between a particle and what is on its other side.
  struct Screen {
    Index plane = 0;
    Vec n = Vec::Zero();
    Real offset = 0, height = 0;  ///< of the particle beside it [L]
    std::vector<Index> faces;
  };
  /// What may be seen from a position.
  struct Sight {
    std::vector<Index> points;
    std::vector<Screen> screens;  ///< none where all is in one plane
    Real doubt = 0;               ///< places so near to a plane may be on either side of one of its faces [L]
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
    Real within2_, around2_;  ///< of points, and of what may be before them [L2]
    std::vector<Index> faces_;
    Index plane_ = -1;
    bool corner_ = false;
    Sight out_;
  };
  Sight sight_from(const Vec& from, Real within) const;
  bool hidden(const WallPoint& point, const Vec& from, const Sight& sight) const;

  int dim_;
  Real reach_;
  Real farthest_;  ///< that faces are looked for [L]
  Real spacing_;   ///< pieces are no longer
  std::vector<GhostPlane> mirrors_and_periods_;
  std::vector<Face> faces_;
  std::set<Key> lines_;
  std::map<Key, Index> planes_;
  std::vector<WallPoint> points_;
  std::vector<Vec> at_;  ///< where they are, once more, close together
  Vec low_ = Vec::Zero();
  Real cell_ = 1;
  std::array<Index, 3> cells_{1, 1, 1};
  std::vector<Index> first_;  ///< points [first_[c], first_[c+1]) are in cell c
};

}  // namespace courant
