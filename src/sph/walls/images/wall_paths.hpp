#pragma once
// Paths between particles beside walls: straight, hidden or reflected.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sph/walls/images/wall_sub_domain.hpp"
#include "sph/walls/wall_surface.hpp"

namespace courant {

/// A path from particle j to particle i that walls change.
struct WallPath {
  Index i = 0, j = 0;
  /// Reflected share of a reflected path; of a straight path, minus its hidden share. [-]
  Real weight = 0;
  Vec d = Vec::Zero();               ///< x_i less the position of the image of j [L]
  Matrix turn = Matrix::Identity();  ///< maps directions at j to directions at the image
  Vec by_i = Vec::Zero(),
      by_j = Vec::Zero();   ///< derivatives of the share with respect to the positions of i and j [1/L]
  Vec drift = Vec::Zero();  ///< velocity of the image if j is at rest [L/T]
  std::array<signed char, 4> by{-1, -1, -1, -1};  ///< the reflecting sheets, in order
  bool moves = false;                             ///< any of them moves
  bool across = false;  ///< of a straight path: its ends are on different sides of the plane of a wall
  Index derivatives = 0, derivatives_end = 0;  ///< range of derivatives with respect to walls
};

/// Derivative of a quantity with respect to the position of a rigid piece of wall: `force` times the
/// displacement of the wall at `at`, plus the difference of normal displacements at `at + lever` and `at`.
/// With opposite sign it is the force of an energy on the wall. [X/L], `lever` times that
struct WallDerivative {
  Index face = 0;
  Vec at = Vec::Zero(), force = Vec::Zero(), lever = Vec::Zero();
};

/// A sub-domain whose walls may end within sight.
struct OpenSubDomain {
  WallSubDomain closed;                   ///< without ends
  WallSubDomain open;                     ///< with ends
  bool known = true;                      ///< `open` has all ends
  std::vector<std::pair<Vec, Vec>> ends;  ///< edges
  /// Whether x is in front of all walls and farther than `within` from their ends.
  bool holds_open(const Vec& x, Real within) const;
  /// Whether x is in front of all walls and farther than `sight` from all edges.
  bool holds(const Vec& x, Real sight) const;
};

/// Walls are mirrors of finite extent. Particle i interacts with the image of j behind a wall if the
/// straight line from i to the image crosses that wall; the reverse path of j does, too. Images of images
/// fill corners if the path meets each wall in order. Particles on different sides of a wall do not
/// interact. In every direction, particle i thus has water as far as its kernel reaches, for any number of
/// walls, at their ends and on both sides.
///
/// Where a wall ends, or the next wall turns away from the water, the share of a path that passes the edge
/// changes smoothly from one to zero over a width, half of it on each side: otherwise particles would
/// appear and vanish in one step. The share that a wall no longer reflects is the share that it no longer
/// hides.
///
/// Walls may move as rigid bodies: `take_along` sets their current position and `update` that of sheets.
/// The derivatives with respect to wall positions (`WallDerivative`) vanish for a common rigid motion of
/// all, so the forces conserve linear and angular momentum.
class WallPaths {
 public:
  /// Axis-aligned box.
  struct Box {
    Vec low, high;
    bool meets(const Box& other) const {
      return other.low[0] <= high[0] && other.low[1] <= high[1] && other.low[2] <= high[2] &&
             low[0] <= other.high[0] && low[1] <= other.high[1] && low[2] <= other.high[2];
    }
  };
  /// A border of a sheet: an edge of one face, or of several in a line.
  struct Border {
    Index face = 0;
    int edge = 0;
    Index last_face = 0;  ///< of several: the face at `to`
    int last_edge = 0;
    Vec from = Vec::Zero(), to = Vec::Zero();
    bool is_within(const Box& b) const { return b.meets({from.cwiseMin(to), from.cwiseMax(to)}); }
  };
  /// A flat piece of wall. `endless`: the only one in sight, without borders.
  struct Sheet {
    Vec n = Vec::Zero();
    Real offset = 0;
    Index plane = 0;
    bool endless = false;
    Index face = 0;   ///< one of its faces
    Index body = -1;  ///< the body that they follow; -1: fixed
    std::vector<Index> faces;
    std::vector<Border> edges;  ///< free borders of these faces in the plane
    /// Bits of sheets of the same body with all faces on the negative (or positive) side of this one: a
    /// path from the other side cannot meet them next.
    std::uint64_t under = 0, over = 0;
    Vec middle = Vec::Zero();  ///< of its faces when they were looked for, of which none is farther than
    Real half = std::numeric_limits<Real>::infinity();  ///< this [L]
    Vec low = Vec::Constant(-half), high = -low;        ///< about its faces where they are [L]
    Real height(const Vec& x) const { return n.dot(x) - offset; }
    Vec image(const Vec& x) const { return x - 2 * height(x) * n; }
    Matrix turn() const { return Matrix::Identity() - 2 * n * n.transpose(); }
    /// `from`: height of the start of the path over the sheet [L].
    bool turns_away(std::size_t other, Real from) const {
      return other < 64 && (((from > 0 ? under : over) >> other) & 1) != 0;
    }
    /// Lower bound of the length of a path from x to the sheet; from the sheet to another one. [L]
    Real off(const Vec& x) const {
      return std::max(std::abs(height(x)), (low - x).cwiseMax(x - high).cwiseMax(0).norm());
    }
    Real off(const Sheet& other) const {
      const Real apart =
          body == other.body ? std::max((middle - other.middle).norm() - half - other.half, Real(0)) : 0;
      return std::max(apart, (low - other.high).cwiseMax(other.low - high).cwiseMax(0).norm());
    }
    bool is_within(const Box& b) const { return b.meets({low, high}); }
  };
  using Sheets = std::vector<Sheet>;
  /// Width of edge transitions over particle spacing; chosen by trials at steps and blocks.
  static constexpr Real usual_width = 1.2;

  /// `width`: about one particle spacing; the surface must reach farther than the kernel by this [L].
  WallPaths(const WallSurface& surface, int dim, Real width);
  WallPaths(const WallPaths& other);
  WallPaths& operator=(const WallPaths&) = delete;
  ~WallPaths() = default;

  /// Distance of x from the segment from a to b. [L]
  static Real distance_to(const Vec& x, const Vec& a, const Vec& b);
  /// Sheets that may reflect paths from x.
  Sheets seen_from(const Vec& x) const;
  /// Sheets within a distance of x [L], with faces and borders.
  Sheets sheets_around(const Vec& x, Real within) const;
  /// Sub-domains of positions no farther than `half` from the centre, with the range `reach`, from the
  /// sheets in that range. [L]
  std::vector<OpenSubDomain> sub_domains_about(const Sheets& sheets, const Vec& centre, Real half,
                                               Real reach) const;
  /// The sub-domain of x without ends in sight, or with ends, but not within half of the width of x; null:
  /// none.
  std::unique_ptr<WallSubDomain> closed_sub_domain_about(const Sheets& sheets, const Vec& x,
                                                         Real sight) const;
  std::unique_ptr<WallSubDomain> open_sub_domain_about(const Sheets& sheets, const Vec& x, Real sight) const;
  /// The edge, if it is all within `sight` and half of the width of x. [L]
  std::optional<WallEdge> edge_about(const Sheets& sheets, const Vec& x, Real sight) const;
  /// An isolated edge of a moving body, by indices of its sheets and borders.
  struct LoneEdge {
    int walls = 0;
    std::array<std::size_t, 2> sheet{}, edge{};
    std::array<Real, 2> side{};  ///< -1: the normal away from the other wall is opposite to that of the sheet
  };
  /// The same for a moving body, and its current position and velocity.
  std::optional<LoneEdge> moving_edge_about(const Sheets& sheets, const Vec& x, Real sight) const;
  WallEdge current(const LoneEdge& edge, const Sheets& sheets) const;
  /// A face of the moving sheet, if that is all within `sight` and half of the width of x, without
  /// borders; else -1. [L]
  Index moving_flat_about(const Sheets& sheets, const Vec& x, Real sight) const;
  /// Set of sheets, one bit each; sheets from index 63 share the last bit.
  using SheetSet = std::uint64_t;
  static SheetSet bit(std::size_t k) { return SheetSet(1) << std::min<std::size_t>(k, 63); }
  static bool has(SheetSet set, std::size_t k) { return (set & bit(k)) != 0; }
  class Viewpoint;
  /// Prepares the search for paths from x within `reach` [L]. The sheets must not change while the result
  /// is in use.
  void look_from(const Sheets& sheets, const Vec& x, Real reach, Viewpoint& to) const;
  /// Appends the paths from particle i at the viewpoint to j at y that walls change.
  void add(Viewpoint& from, Index i, Index j, const Vec& y, std::vector<WallPath>& to,
           std::vector<WallDerivative>* derivatives = nullptr) const;
  /// The same for one pair.
  void add(const Sheets& sheets, Index i, const Vec& x, Index j, const Vec& y, Real reach,
           std::vector<WallPath>& to, std::vector<WallDerivative>* derivatives = nullptr) const;

  /// Sets moving walls to their position `back` ago, by their velocity over the last step. [T]
  void take_along(const World& world, Real back);
  void update(Sheets& sheets) const;
  bool any_moves() const { return any_moves_; }
  /// The face of a sheet at q, or the nearest one.
  Index face_at(const Sheet& sheet, const Vec& q) const;
  /// Velocity of the body of a face at x [L/T].
  Vec velocity(Index face, const Vec& x) const {
    return motions_.empty() ? Vec(Vec::Zero()) : motions_[face].at(x);
  }
  const WallSurface::Face& face(Index f) const { return faces_[f]; }
  /// Offset of positions for visibility tests (included in `WallDerivative::at`). [L]
  Vec shift() const { return put_aside(Vec::Zero()); }
  /// Further offset for a particle and its own images. [L]
  Vec shift_of_itself() const { return aside_again_ - aside_; }
  /// Moves a reflected path to the current wall positions, without its share. The path of a particle to
  /// itself is averaged over both directions, so that no force along the wall remains.
  void bring(const Sheets& sheets, const Vec& x, const Vec& y, WallPath& path) const;
  /// The points where a reflected path meets its walls, in order, and their faces; returns their number.
  struct Crossing {
    Index face = 0;
    Vec at = Vec::Zero();  ///< put aside, as `WallDerivative::at`
  };
  int crossings(const Sheets& sheets, const WallPath& path, const Vec& x, const Vec& y,
                std::array<Crossing, 4>& to) const;
  /// Appends the derivatives of a function of d alone, with the gradient `by_d`, with respect to the
  /// reflecting walls.
  void add_image_derivatives(const Sheets& sheets, const WallPath& path, const Vec& y, const Vec& by_d,
                             std::vector<WallDerivative>& to) const;

 private:
  /// Another face that meets an edge: for particles between both, the edge is not free.
  struct Corner {
    Vec n = Vec::Zero();  ///< of the other face
    Real here = 0;        ///< side of the other face on which this one lies
    Real there = 0;       ///< side of this face on which the other one lies
    Index other = 0;      ///< that face
    Real sign = 1;        ///< to that side across the edge
  };
  struct Edge {
    bool ends = false;  ///< no face goes on from here in the plane
    std::vector<Corner> corners;
    Vec middle = Vec::Zero();
    Real half = 0;  ///< of its length [L]
  };
  /// The point where a path meets a sheet.
  struct Meeting {
    bool crosses, inside;
    Vec at;
    Real share;
    Vec by_start, by_end;  ///< slopes of the share [1/L]
    const Sheet* edge_of;  ///< the sheet whose edge causes a partial share
    Vec on_edge;           ///< point on that edge
    static Meeting nowhere() {
      return {false, false, Vec::Zero(), 0, Vec::Zero(), Vec::Zero(), nullptr, Vec::Zero()};
    }
  };
  /// A path traced through its walls, for the derivatives of its share.
  struct Ray {
    std::array<const Sheet*, 4> by;
    std::array<Vec, 4> start, target;  ///< before each reflection
    std::array<Meeting, 4> met;        ///< with that wall
    std::array<Meeting, 5> hidden;     ///< before each wall, and at the end
    Vec end;
    int steps;
    bool bends;                        ///< an edge makes its share partial
    Ray() : steps(0), bends(false) {}  // the rest is set as the path is traced
    void step(const Sheet& sheet, const Vec& from, const Vec& to, const Meeting& m) {
      by[steps] = &sheet, start[steps] = from, target[steps] = to, met[steps++] = m;
    }
  };
  /// The reflecting sheets of a path, in order.
  class Sequence {
   public:
    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }
    const Sheet* operator[](std::size_t k) const { return sheets_[k]; }
    const Sheet* front() const { return sheets_[0]; }
    const Sheet* back() const { return sheets_[size_ - 1]; }
    const Sheet* const* begin() const { return sheets_.data(); }
    const Sheet* const* end() const { return sheets_.data() + size_; }
    void push_back(const Sheet* s) { sheets_[size_++] = s; }
    void pop_back() { --size_; }

   private:
    std::array<const Sheet*, 4> sheets_{};
    std::size_t size_ = 0;
  };
  /// A sequence of walls that may reflect a path from a start.
  struct Route {
    Sequence by;
    SheetSet walls = 0;                ///< as a set
    std::size_t last = 0;              ///< index of the last one
    Matrix turn = Matrix::Identity();  ///< as of WallPath
    Vec there = Vec::Zero();           ///< image of the start behind all of them
    Real until = 0, least = 0;         ///< `find_routes`
    Real side = 0;                     ///< side of the last wall on which the path ends
    Real front = 0;                    ///< distance of the start from the first wall [L]
  };
  /// A pair of particles whose paths are searched.
  struct Pair {
    const Viewpoint& from;
    Index i, j;
    Vec y;
    SheetSet candidates;  ///< sheets that may matter
    std::vector<WallPath>& to;
    std::vector<WallDerivative>* derivatives;
  };
  struct Walls;
  struct Ending {
    const Sheet* sheet;
    const Border* edge;
  };
  bool is_one_edge(const Ending& one, const Ending& other) const;
  std::optional<LoneEdge> lone_edge_about(const Sheets& sheets, const Vec& x, Real around, bool moves) const;
  void leave_out_hidden(Walls& box) const;
  bool rises_from(const Sheet& sheet, const Sheet& other, const Vec& x) const;
  bool is_orthogonal(const Walls& box, const Vec& centre, Real inside) const;
  void find_ends(const Walls& box, const Sheets& sheets, const Vec& centre, Real around,
                 OpenSubDomain& domain) const;
  Sheet sheet_of(Index face) const;
  Sheets sheets_of(const std::vector<Index>& faces) const;
  bool goes_on_in(const Sheet& sheet, Index face) const;
  Edge edge_of(Index face, int edge) const;
  void add_edge(Sheet& sheet, Index face, int edge) const;
  Border now(const Border& edge) const;
  bool is_free(Index face, int edge, const Vec& p) const;
  bool is_inside(const Sheet& sheet, const Vec& q) const;
  bool lies_in(const Vec& c, const Vec& d, const Sheet* sheet) const;
  bool turn_away(const Sheet& sheet, const Sheet& other, const Vec& x, const Vec& y) const;
  /// Box around a path, enlarged by the width of edges.
  Box box_about(const Vec& a, const Vec& b) const {
    const Vec near = Vec::Constant(std::max(0.5 * width_, 2 * overlap * surface_.reach()));
    return {a.cwiseMin(b) - near, a.cwiseMax(b) + near};
  }
  Meeting meet(const Sheet& sheet, const Box& about, const Vec& a, const Vec& b, const Vec& start,
               const Vec& x, const Vec& y, const Sheet* but = nullptr, const Sheet* and_but = nullptr) const;
  Meeting hidden(const Pair& pair, const Vec& a, const Vec& b, const Sheet* but = nullptr,
                 const Sheet* and_but = nullptr) const;
  Real follow(const Pair& pair, const Sequence& by, Vec target, Ray& ray) const;
  void find_slopes(const Ray& ray, WallPath& path, std::vector<WallDerivative>* derivatives) const;
  void find_routes(Viewpoint& from, Sequence& by, const Vec& there, Real until, Real least) const;
  bool may_end(const Viewpoint& from, const Route& route, const Vec& y) const;
  void add_straight(const Pair& pair) const;
  void add_path(const Pair& pair, const Route& route) const;
  void compare(Sheets& sheets) const;

  void find_corner(Index face, int edge, Corner& corner) const;
  void note_walls(const Sheets& sheets, const Sequence& by, Vec y, WallPath& path) const;
  Vec image(const Sheet& sheet, const Vec& x, Vec& velocity) const;
  Vec velocity_of(const Sheet& sheet, const Vec& x) const {
    return sheet.body < 0 ? Vec(Vec::Zero()) : velocity(sheet.face, x);
  }
  void add_derivative(const Sheet& sheet, const Vec& at, const Vec& by_image,
                      std::vector<WallDerivative>& to) const;
  void add_edge_derivative(const Meeting& m, Real times, std::vector<WallDerivative>& to) const;
  void add_start_derivative(const Ray& ray, int k, Vec by, std::vector<WallDerivative>& to) const;
  void add_target_derivative(const Ray& ray, int k, Vec by, std::vector<WallDerivative>& to) const;
  void add_hit_derivative(const Ray& ray, int k, const Vec& by, std::vector<WallDerivative>& to) const;
  void add_derivatives(const Ray& ray, Real share, std::vector<WallDerivative>& to) const;
  Vec put_aside(const Vec& x, bool again = false) const {
    return surface_.in_plane(x) + (again ? aside_again_ : aside_);
  }

  static constexpr Real touching =
      1e-3;  ///< of the reach: nearer points coincide, as decks round coordinates
  static constexpr Real orthogonal = 1e-6;  ///< cosine of the angle between walls of a sub-domain
  static constexpr Real overlap = 1e-4;     ///< of the reach: faces extend past their edges by this

  const WallSurface& surface_;
  int dim_;
  Real width_;
  Vec aside_, aside_again_;                 ///< offsets for visibility tests [L]
  std::vector<std::array<Edge, 4>> edges_;  ///< of each face
  bool any_moves_ = false;
  const WallSurface::Face* faces_;        ///< as in the surface, or `moved_`
  std::vector<WallSurface::Face> moved_;  ///< at their current position; empty: as in the surface
  std::vector<WallMotion> motions_;
  std::vector<std::pair<Vec, Vec>> boxes_;  ///< of faces at their current position; empty: as in the surface
};

/// A position from which paths start, with the sheets and routes in its range.
class WallPaths::Viewpoint {
 private:
  friend class WallPaths;
  const Sheets* sheets_ = nullptr;
  SheetSet candidates_ = 0;  ///< sheets that may matter
  Vec x_ = Vec::Zero();
  Real reach_ = 0;
  std::vector<Real> height_, off_;  ///< heights over sheets and distances from them
  std::vector<Real> height_there_;  ///< heights of the other particle
  std::vector<Route> routes_;
};

inline void WallPaths::add(const Sheets& sheets, Index i, const Vec& x, Index j, const Vec& y, Real reach,
                           std::vector<WallPath>& to, std::vector<WallDerivative>* derivatives) const {
  Viewpoint from;
  look_from(sheets, x, reach, from);
  add(from, i, j, y, to, derivatives);
}

}  // namespace courant
