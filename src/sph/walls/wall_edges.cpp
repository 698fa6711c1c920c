// Isolated edges.
#include <algorithm>
#include <cmath>

#include "search/neighbours.hpp"
#include "sph/walls/images/wall_images.hpp"

namespace courant {

/// Whether two walls meet there in a convex corner and enclose 90 degrees or more.
bool WallPaths::is_one_edge(const Ending& one, const Ending& other) const {
  const Real near = 1e-6 * surface_.reach();
  const Vec &a = one.edge->from, &b = one.edge->to, &c = other.edge->from, &d = other.edge->to;
  const Vec along = (b - a).normalized();
  if (along.cross(c - a).norm() > near || along.cross(d - a).norm() > near) return false;
  const Vec &into = face(one.edge->face).inward[one.edge->edge],
            &other_into = face(other.edge->face).inward[other.edge->edge];
  constexpr Real level_walls = 0.1;  // sine of the least angle between two walls
  return into.dot(other_into) < orthogonal && into.cross(other_into).norm() > level_walls;
}

/// All walls in range must be fixed, or belong to one moving body without images.
std::optional<WallPaths::LoneEdge> WallPaths::lone_edge_about(const Sheets& sheets, const Vec& x, Real around,
                                                              bool moves) const {
  std::vector<Ending> near;
  for (const Sheet& s : sheets) {
    if (!moves && s.body >= 0) return {};
    if (s.off(x) > around) continue;
    if (moves && (s.body < 0 || (!near.empty() && s.body != near[0].sheet->body))) return {};
    if (moves && std::any_of(s.faces.begin(), s.faces.end(), [&](Index f) { return face(f).image_of >= 0; }))
      return {};
    near.push_back({&s, nullptr});
    for (const Border& edge : s.edges) {
      if (distance_to(x, edge.from, edge.to) > around) continue;
      const bool goes_on = dim_ == 2 || std::min((edge.from - x).norm(), (edge.to - x).norm()) > around;
      if (near.back().edge || !goes_on) return {};
      near.back().edge = &edge;
    }
    if (!near.back().edge || near.size() > 2) return {};
  }
  if (near.empty() || (near.size() == 2 && !is_one_edge(near[0], near[1]))) return {};
  if (near.size() == 1 && !edges_[near[0].edge->face][near[0].edge->edge].corners.empty()) return {};
  LoneEdge out;
  bool in_front = near.size() == 1;
  for (const Ending& e : near) {
    const auto into = [&](const Ending& of) { return face(of.edge->face).inward[of.edge->edge]; };
    const bool turned = near.size() == 2 && e.sheet->n.dot(into(&e == &near[0] ? near[1] : near[0])) > 0;
    out.sheet[out.walls] = static_cast<std::size_t>(e.sheet - sheets.data());
    out.edge[out.walls] = static_cast<std::size_t>(e.edge - e.sheet->edges.data());
    out.side[out.walls++] = turned ? -1 : 1;
    in_front |= (turned ? -1 : 1) * e.sheet->n.dot(x - near[0].edge->from) > 0;
  }
  if (!in_front) return {};
  return out;
}

WallEdge WallPaths::current(const LoneEdge& edge, const Sheets& sheets) const {
  WallEdge out;
  out.walls = edge.walls;
  for (int k = 0; k < edge.walls; ++k) {
    const Sheet& s = sheets[edge.sheet[k]];
    const Border& brink = s.edges[edge.edge[k]];
    const Vec n = edge.side[k] * s.n, m = face(brink.face).inward[brink.edge];
    for (int c = 0; c < 3; ++c) out.n[k][c] = n[c], out.m[k][c] = m[c];
    if (k > 0) continue;
    for (int c = 0; c < 3; ++c) out.at[c] = brink.from[c];
    out.moves = s.body >= 0;
    if (!out.moves || motions_.empty()) continue;
    const Vec v = velocity(brink.face, brink.from), spin = motions_[brink.face].omega;
    for (int c = 0; c < 3; ++c) out.v[c] = v[c], out.spin[c] = spin[c];
  }
  return out;
}

std::optional<WallEdge> WallPaths::edge_about(const Sheets& sheets, const Vec& at, Real sight) const {
  const auto edge = lone_edge_about(sheets, surface_.in_plane(at), sight + 0.5 * width_, false);
  if (!edge) return {};
  return current(*edge, sheets);
}

std::optional<WallPaths::LoneEdge> WallPaths::moving_edge_about(const Sheets& sheets, const Vec& at,
                                                                Real sight) const {
  return lone_edge_about(sheets, surface_.in_plane(at), sight + 0.5 * width_, true);
}

void WallImages::find_moving_edge(const Particles& p, Index i) {
  const auto k = static_cast<std::size_t>(i);
  const Real sight = 2 * support_->sight_until_search(p, i) - kernel_->support * p.h[i];
  moving_edges_[k] = at_end().moving_edge_about(sheets_[k], p.x.vec(i), sight);
  if (!moving_edges_[k]) return;
  own_edges_[k].emplace();
  edges_[k] = &*own_edges_[k];
}

/// Updates moving edges to the middle of the step.
void WallImages::update_edges_in_middle(Index begin, Index end, Block& block) {
  block.has_moving_edges = false;
  for (Index i = begin; any_moves_ && i < end; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!moving_edges_[k]) continue;
    update_sheets(i, block);
    *own_edges_[k] = in_middle_->current(*moving_edges_[k], block.in_middle);
    block.has_moving_edges = true;
  }
  if (!block.has_moving_edges) return;
  block.edge_reactions.resize(block_size);
  block.edge_paths.resize(static_cast<std::size_t>(neighbours_->entries(begin / block_size)));
}

/// Updates moving edges to the end of the step.
void WallImages::update_edges_at_end(Index begin, Index end, const Block& block) {
  if (!block.has_moving_edges) return;
  for (Index i = begin; i < end; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (moving_edges_[k]) *own_edges_[k] = at_end().current(*moving_edges_[k], sheets_[k]);
  }
}

/// Adds the reactions of the loops to moving edges and their walls.
void WallImages::react_of_edges(const Particles& p, Index begin, Index end, Block& block) const {
  if (!block.has_moving_edges) return;
  for (Index i = begin; i < end; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!moving_edges_[at] || !in_sub_domain(i)) continue;
    const WallEdge& edge = *edges_[at];
    const WallEdgeReaction& derivative = block.edge_reactions[static_cast<std::size_t>(i - begin)];
    const auto vec = [](const Real(&of)[3]) { return Vec(of[0], of[1], of[2]); };
    const Vec x = surface().in_plane(p.x.vec(i)) + at_end().shift(), from = vec(edge.at),
              axis = vec(edge.n[0]).cross(vec(edge.m[0])),
              place = x - vec(edge.n[0]).dot(x - from) * vec(edge.n[0]) -
                      vec(edge.m[0]).dot(x - from) * vec(edge.m[0]);
    for (int k = 0; k < edge.walls; ++k) {
      const WallPaths::Sheet& sheet = sheets_[at][moving_edges_[at]->sheet[k]];
      const Vec n = vec(edge.n[k]), m = vec(edge.m[k]), foot = x - n.dot(x - from) * n;
      WallDerivative normal{
          .face = at_end().face_at(sheet, foot), .at = foot, .force = derivative.push[k] * n};
      normal.lever = derivative.inward[k] * m + derivative.along[k] * axis;
      if (at_end().face(normal.face).n.dot(n) < 0) normal.lever = -normal.lever;
      give(normal, 1, block);
      const Vec force = derivative.edge[k][0] * n + derivative.edge[k][1] * m,
                farther = (derivative.edge_along[k][0] * n + derivative.edge_along[k][1] * m) / p.h[i];
      const Index face = at_end().face_at(sheet, place);
      give({.face = face, .at = place, .force = force - farther}, 1, block);
      if (!farther.isZero()) give({.face = face, .at = place + p.h[i] * axis, .force = farther}, 1, block);
    }
  }
}

}  // namespace courant
