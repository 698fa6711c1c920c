#pragma once
// The ways on which particles see each other beside walls: straight, hidden, or reflected.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sph/walls/images/wall_room.hpp"
#include "sph/walls/wall_surface.hpp"

namespace courant {

/// How particle j acts on particle i because of walls.
struct WallPath {
  Index i = 0, j = 0;
  /// Share of the way that walls throw back; of a straight path, less than 0: what they hide of it. [-]
  Real weight = 0;
  Vec d = Vec::Zero();               ///< x_i less the position of the image of j [L]
  Matrix turn = Matrix::Identity();  ///< of directions at j, as they are at the image
  Vec by_i = Vec::Zero(),
      by_j = Vec::Zero();   ///< how the share goes over with the positions of i and j [1/L]
  Vec drift = Vec::Zero();  ///< velocity of the image where j rests [L/T]
  std::array<signed char, 4> by{-1, -1, -1, -1};  ///< the sheets that throw it back, in turn
  bool moves = false;                             ///< any of them does
  bool across = false;  ///< of a straight path: its ends are on different sides of the plane of a wall
  Index pulls = 0, pulls_end = 0;  ///< how the share goes over with the positions of walls
};

/// How something changes with the position of a rigid piece of wall: by `force` times the path of what moves
/// with it at `at`, and along the normal of the face by the difference of the ways at `at + lever` and `at`.
/// With the sign turned, the force on it that belongs to an energy. [X/L], `lever` times that
struct WallPull {
  Index face = 0;
  Vec at = Vec::Zero(), force = Vec::Zero(), lever = Vec::Zero();
};

/// A sub-domain for who does not see these edges, where something ends in front of its walls.
struct OpenRoom {
  WallRoom room;                          ///< without ends
  WallRoom open;                          ///< with these
  bool known = true;                      ///< `open` has them all
  std::vector<std::pair<Vec, Vec>> ends;  ///< edges
  /// Whether x is in front of all walls, and `within` off where they end.
  bool holds_open(const Vec& x, Real within) const;
  /// Whether x is in front of all walls, and farther than `sight` from any of the edges.
  bool holds(const Vec& x, Real sight) const;
};

/// Walls act as mirrors do, each piece as far as it goes: i meets the image of j in a wall where the straight
/// way from i to the image goes through that wall, and so does j, since the path back is the same. Images of
/// images fill corners, again where the path, reflected by one wall after the other, meets each of them.
/// Particles that a wall is between do not meet. So whatever direction i looks in, it sees water just as
/// far as its kernel reaches, at any number of walls, at their ends and on both sides of them.
///
/// Where a wall ends, and where the next one turns away from the water, a way that passes the edge goes over
/// from reflected (or hidden) to nothing within one width, half of it on each side, smoothly: else
/// particles would come and go at once. What the wall no longer throws back is what it no longer hides.
///
/// Walls may move as rigid bodies: `take_along` states where they are, and `place` brings sheets there. How a
/// way changes with positions then holds for those of walls, too (`WallPull`), such that nothing changes
/// where all goes along alike: forces by it keep momentum and its moment.
class WallPaths {
 public:
  /// Along the axes.
  struct Box {
    Vec low, high;
    bool meets(const Box& other) const {
      return other.low[0] <= high[0] && other.low[1] <= high[1] && other.low[2] <= high[2] &&
             low[0] <= other.high[0] && low[1] <= other.high[1] && low[2] <= other.high[2];
    }
  };
  /// An edge of a sheet, of one face or of several side by side.
  struct Brink {
    Index face = 0;
    int edge = 0;
    Index last_face = 0;  ///< where there are several, that of `to`
    int last_edge = 0;
    Vec from = Vec::Zero(), to = Vec::Zero();
    bool is_within(const Box& b) const { return b.meets({from.cwiseMin(to), from.cwiseMax(to)}); }
  };
  /// A flat piece of wall as it is seen; `endless`: nothing else, and none of its edges.
  struct Sheet {
    Vec n = Vec::Zero();
    Real offset = 0;
    Index plane = 0;
    bool endless = false;
    Index face = 0;   ///< one of them
    Index body = -1;  ///< which they all follow; -1: they are held
    std::vector<Index> faces;
    std::vector<Brink> edges;  ///< of these faces, where nothing goes on in the plane
    /// Of the sheets of the same body those, by number, all of whose faces lie on its negative, or positive,
    /// side: no way that comes from the other one goes there next.
    std::uint64_t under = 0, over = 0;
    Vec middle = Vec::Zero();  ///< of its faces when they were looked for, of which none is farther than
    Real half = std::numeric_limits<Real>::infinity();  ///< this [L]
    Vec low = Vec::Constant(-half), high = -low;        ///< about its faces where they are [L]
    Real height(const Vec& x) const { return n.dot(x) - offset; }
    Vec image(const Vec& x) const { return x - 2 * height(x) * n; }
    Matrix turn() const { return Matrix::Identity() - 2 * n * n.transpose(); }
    /// `from`: the height of where ways come from.
    bool turns_away(std::size_t other, Real from) const {
      return other < 64 && (((from > 0 ? under : over) >> other) & 1) != 0;
    }
    /// What a path from x to it is no shorter than; from it to another one. [L]
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
  /// Over which a free edge goes over to nothing, of the spacing of particles; by trial at steps and blocks.
  static constexpr Real usual_width = 1.2;

  /// `width`: about one spacing of the particles; the surface must reach that much farther than the kernel
  /// [L]
  WallPaths(const WallSurface& surface, int dim, Real width);
  WallPaths(const WallPaths& other);
  WallPaths& operator=(const WallPaths&) = delete;
  ~WallPaths() = default;

  /// How far x is from the path from a to b.
  static Real distance_to(const Vec& x, const Vec& a, const Vec& b);
  /// What may throw back ways from about x.
  Sheets seen_from(const Vec& x) const;
  /// All that is within a distance of x [L], each with its faces and edges.
  Sheets sheets_around(const Vec& x, Real within) const;
  /// The rooms that places may be in that are no farther than `half` from the centre, as far as `reach`
  /// from them, of the sheets that stand that far around. [L]
  std::vector<OpenRoom> rooms_about(const Sheets& sheets, const Vec& centre, Real half, Real reach) const;
  /// Of these, the sub-domain whose walls end nowhere in sight, or the one whose walls do, but not within
  /// half of the width of x; null: none.
  std::unique_ptr<WallRoom> closed_room_about(const Sheets& sheets, const Vec& x, Real sight) const;
  std::unique_ptr<WallRoom> open_room_about(const Sheets& sheets, const Vec& x, Real sight) const;
  /// The edge that is all that is within `sight` and half of the width about x; none: there is more. [L]
  std::optional<WallEdge> edge_about(const Sheets& sheets, const Vec& x, Real sight) const;
  /// An edge of a body that moves, by numbers of its sheets, and of their edges.
  struct LoneEdge {
    int walls = 0;
    std::array<std::size_t, 2> sheet{}, edge{};
    std::array<Real, 2>
        side{};  ///< -1: the normal away from the other wall is that of the sheet turned round
  };
  /// The same of a body that moves, and where such an edge is and how it goes now.
  std::optional<LoneEdge> moving_edge_about(const Sheets& sheets, const Vec& x, Real sight) const;
  WallEdge placed(const LoneEdge& edge, const Sheets& sheets) const;
  /// A face of the sheet that is all that is within `sight` and half of the width about x, without an
  /// edge there, if it moves; else -1. [L]
  Index moving_flat_about(const Sheets& sheets, const Vec& x, Real sight) const;
  /// Sheets by their numbers, one bit each; those behind the first 63 have the last one.
  using Some = std::uint64_t;
  static Some bit(std::size_t k) { return Some(1) << std::min<std::size_t>(k, 63); }
  static bool has(Some some, std::size_t k) { return (some & bit(k)) != 0; }
  class Standpoint;
  /// Looks from x, as far as the kernel reaches, at sheets, which must stay where they are while the
  /// result is in use [L].
  void stand(const Sheets& sheets, const Vec& x, Real reach, Standpoint& to) const;
  /// Appends the paths from particle i, that is there, to j at y, that walls change.
  void add(Standpoint& from, Index i, Index j, const Vec& y, std::vector<WallPath>& to,
           std::vector<WallPull>* pulls = nullptr) const;
  /// The same for one pair.
  void add(const Sheets& sheets, Index i, const Vec& x, Index j, const Vec& y, Real reach,
           std::vector<WallPath>& to, std::vector<WallPull>* pulls = nullptr) const;

  /// Where walls that move were `back` ago, by their velocity over the last step. [T]
  void take_along(const World& world, Real back);
  void place(Sheets& sheets) const;
  bool any_moves() const { return any_moves_; }
  /// The face of a sheet at q, or the one next to it.
  Index face_at(const Sheet& sheet, const Vec& q) const;
  /// Velocity of what moves with a face at x [L/T].
  Vec velocity(Index face, const Vec& x) const {
    return motions_.empty() ? Vec(Vec::Zero()) : motions_[face].at(x);
  }
  const WallSurface::Face& face(Index f) const { return faces_[f]; }
  /// So far aside places are looked at (`WallPull::at` with them). [L]
  Vec shift() const { return put_aside(Vec::Zero()); }
  /// How much farther aside a particle is looked at by itself. [L]
  Vec shift_of_itself() const { return aside_again_ - aside_; }
  /// Takes a way that a wall throws back to where its walls are placed now, but for its share. To oneself,
  /// too, it comes from both ends alike, so that no force is left along the wall.
  void bring(const Sheets& sheets, const Vec& x, const Vec& y, WallPath& path) const;
  /// Where a way that walls throw back meets them, in turn, and on which face; returns how many these are.
  struct Crossing {
    Index face = 0;
    Vec at = Vec::Zero();  ///< put aside, as `WallPull::at`
  };
  int crossings(const Sheets& sheets, const WallPath& path, const Vec& x, const Vec& y,
                std::array<Crossing, 4>& to) const;
  /// Appends what a function of d alone, with the slope `by_d`, changes by with the walls that throw the way
  /// back from y.
  void pull_images(const Sheets& sheets, const WallPath& path, const Vec& y, const Vec& by_d,
                   std::vector<WallPull>& to) const;

 private:
  /// Where another face begins at an edge: the edge is none to who is between both.
  struct Corner {
    Vec n = Vec::Zero();  ///< of the other face
    Real here = 0;        ///< side of the other face on which this one lies
    Real there = 0;       ///< side of this face on which the other one lies
    Index other = 0;      ///< that face
    Real way = 1;         ///< to that side across the edge
  };
  struct Edge {
    bool ends = false;  ///< no face goes on from here in the plane
    std::vector<Corner> corners;
    Vec middle = Vec::Zero();
    Real half = 0;  ///< of its length [L]
  };
  /// Where on a sheet a way meets it.
  struct Meeting {
    bool crosses, inside;
    Vec at;
    Real share;
    Vec by_start, by_end;  ///< slopes of the share [1/L]
    const Sheet* edge_of;  ///< the sheet whose edge makes it go over
    Vec on_edge;           ///< where there is one
    static Meeting nowhere() {
      return {false, false, Vec::Zero(), 0, Vec::Zero(), Vec::Zero(), nullptr, Vec::Zero()};
    }
  };
  /// How a way went, for whom its share depends on.
  struct Way {
    std::array<const Sheet*, 4> by;
    std::array<Vec, 4> start, target;  ///< before each wall turns the path back
    std::array<Meeting, 4> met;        ///< with that wall
    std::array<Meeting, 5> hidden;     ///< before each wall, and at the end
    Vec end;
    int steps;
    bool bends;                        ///< its share goes over at an edge
    Way() : steps(0), bends(false) {}  // the rest is set as far as the way goes
    void step(const Sheet& sheet, const Vec& from, const Vec& to, const Meeting& m) {
      by[steps] = &sheet, start[steps] = from, target[steps] = to, met[steps++] = m;
    }
  };
  /// Sheets that throw a path back, in turn.
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
  /// Walls that may throw a path back in turn, as far as that depends on where it starts.
  struct Route {
    Sequence by;
    Some walls = 0;                    ///< the same
    std::size_t last = 0;              ///< of them
    Matrix turn = Matrix::Identity();  ///< as of WallPath
    Vec there = Vec::Zero();           ///< where its start is seen behind all of them
    Real until = 0, least = 0;         ///< `find_routes`
    Real side = 0;                     ///< of the last wall, on which it ends
    Real front = 0;                    ///< what the start is off the first one [L]
  };
  /// Two particles between which ways are looked for.
  struct Pair {
    const Standpoint& from;
    Index i, j;
    Vec y;
    Some some;  ///< sheets that may matter
    std::vector<WallPath>& to;
    std::vector<WallPull>* pulls;
  };
  struct Walls;
  struct Ending {
    const Sheet* sheet;
    const Brink* edge;
  };
  bool is_one_edge(const Ending& one, const Ending& other) const;
  std::optional<LoneEdge> lone_edge_about(const Sheets& sheets, const Vec& x, Real around, bool moves) const;
  void leave_out_hidden(Walls& box) const;
  bool rises_from(const Sheet& sheet, const Sheet& other, const Vec& x) const;
  bool stands_upright(const Walls& box, const Vec& centre, Real inside) const;
  void find_ends(const Walls& box, const Sheets& sheets, const Vec& centre, Real around,
                 OpenRoom& room) const;
  Sheet sheet_of(Index face) const;
  Sheets sheets_of(const std::vector<Index>& faces) const;
  bool goes_on_in(const Sheet& sheet, Index face) const;
  Edge edge_of(Index face, int edge) const;
  void add_edge(Sheet& sheet, Index face, int edge) const;
  Brink now(const Brink& edge) const;
  bool is_free(Index face, int edge, const Vec& p) const;
  bool is_inside(const Sheet& sheet, const Vec& q) const;
  bool lies_in(const Vec& c, const Vec& d, const Sheet* sheet) const;
  bool turn_away(const Sheet& sheet, const Sheet& other, const Vec& x, const Vec& y) const;
  /// About a path, with what may pass edges there.
  Box box_about(const Vec& a, const Vec& b) const {
    const Vec near = Vec::Constant(std::max(0.5 * width_, 2 * overlap * surface_.reach()));
    return {a.cwiseMin(b) - near, a.cwiseMax(b) + near};
  }
  Meeting meet(const Sheet& sheet, const Box& about, const Vec& a, const Vec& b, const Vec& start,
               const Vec& x, const Vec& y, const Sheet* but = nullptr, const Sheet* and_but = nullptr) const;
  Meeting hidden(const Pair& pair, const Vec& a, const Vec& b, const Sheet* but = nullptr,
                 const Sheet* and_but = nullptr) const;
  Real follow(const Pair& pair, const Sequence& by, Vec target, Way& way) const;
  void find_slopes(const Way& way, WallPath& path, std::vector<WallPull>* pulls) const;
  void find_routes(Standpoint& from, Sequence& by, const Vec& there, Real until, Real least) const;
  bool may_end(const Standpoint& from, const Route& route, const Vec& y) const;
  void add_straight(const Pair& pair) const;
  void add_path(const Pair& pair, const Route& route) const;
  void compare(Sheets& sheets) const;

  void find_corner(Index face, int edge, Corner& corner) const;
  void note_walls(const Sheets& sheets, const Sequence& by, Vec y, WallPath& path) const;
  Vec image(const Sheet& sheet, const Vec& x, Vec& velocity) const;
  Vec velocity_of(const Sheet& sheet, const Vec& x) const {
    return sheet.body < 0 ? Vec(Vec::Zero()) : velocity(sheet.face, x);
  }
  void pull(const Sheet& sheet, const Vec& at, const Vec& by_image, std::vector<WallPull>& to) const;
  void pull_edge(const Meeting& m, Real times, std::vector<WallPull>& to) const;
  void pull_start(const Way& way, int k, Vec by, std::vector<WallPull>& to) const;
  void pull_target(const Way& way, int k, Vec by, std::vector<WallPull>& to) const;
  void pull_hit(const Way& way, int k, const Vec& by, std::vector<WallPull>& to) const;
  void pull_all(const Way& way, Real share, std::vector<WallPull>& to) const;
  Vec put_aside(const Vec& x, bool again = false) const {
    return surface_.in_plane(x) + (again ? aside_again_ : aside_);
  }

  static constexpr Real touching = 1e-3;  ///< of the reach: what is nearer is joined, as decks round places
  static constexpr Real upright = 1e-6;   ///< cosine of the angle between walls of a sub-domain
  static constexpr Real overlap = 1e-4;   ///< of the reach: so far faces go on past their edges

  const WallSurface& surface_;
  int dim_;
  Real width_;
  Vec aside_, aside_again_;                 ///< so far places are put aside [L]
  std::vector<std::array<Edge, 4>> edges_;  ///< of each face
  bool any_moves_ = false;
  const WallSurface::Face* faces_;        ///< as in the surface, or `moved_`
  std::vector<WallSurface::Face> moved_;  ///< where they are now; empty: as in the surface
  std::vector<WallMotion> motions_;
  std::vector<std::pair<Vec, Vec>> boxes_;  ///< about faces where they are now; none: as in the surface
};

/// Where somebody stands and looks from, and what may be seen from there.
class WallPaths::Standpoint {
 private:
  friend class WallPaths;
  const Sheets* sheets_ = nullptr;
  Some some_ = 0;  ///< sheets that may matter
  Vec x_ = Vec::Zero();
  Real reach_ = 0;
  std::vector<Real> height_, off_;  ///< over sheets and off them
  std::vector<Real> height_there_;  ///< of whom is looked at
  std::vector<Route> routes_;
};

inline void WallPaths::add(const Sheets& sheets, Index i, const Vec& x, Index j, const Vec& y, Real reach,
                           std::vector<WallPath>& to, std::vector<WallPull>* pulls) const {
  Standpoint from;
  stand(sheets, x, reach, from);
  add(from, i, j, y, to, pulls);
}

}  // namespace courant
