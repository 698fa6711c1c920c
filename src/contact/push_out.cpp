#include "contact/push_out.hpp"

#include <algorithm>
#include <cmath>

namespace courant {
namespace {

constexpr Real most_opposed = -0.9;

void share_two(Push& a, Push& b) {
  const Real c = std::clamp(a.n.dot(b.n), most_opposed, 1.0);
  a.share = b.share = 0;
  if (b.depth <= c * a.depth) {
    a.share = std::max(a.depth, 0.0);
  } else if (a.depth <= c * b.depth) {
    b.share = std::max(b.depth, 0.0);
  } else {
    a.share = (a.depth - c * b.depth) / (1 - c * c);
    b.share = (b.depth - c * a.depth) / (1 - c * c);
  }
}

void share_many(Pushes& p) {
  const int n = p.count;
  Real G[Pushes::capacity][Pushes::capacity], largest = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) G[i][j] = std::max(p.at[i].n.dot(p.at[j].n), most_opposed);
    p.at[i].share = 0;
    largest = std::max(largest, p.at[i].depth);
  }
  for (int sweep = 0; sweep < 200;
       ++sweep) {  // projected Gauss-Seidel; one or two sweeps for perpendicular walls
    Real change = 0;
    for (int i = 0; i < n; ++i) {
      Real s = p.at[i].depth;
      for (int j = 0; j < n; ++j)
        if (j != i) s -= G[i][j] * p.at[j].share;
      s = std::max(s, 0.0);
      change = std::max(change, std::abs(s - p.at[i].share));
      p.at[i].share = s;
    }
    if (change <= 1e-13 * largest) break;
  }
}

}  // namespace

Vec share_pushes(Pushes& p) {
  if (p.count == 1)
    p.at[0].share = std::max(p.at[0].depth, 0.0);
  else if (p.count == 2)
    share_two(p.at[0], p.at[1]);
  else
    share_many(p);
  return way_out(p);
}

Vec way_out(const Pushes& p) {
  Vec u = Vec::Zero();
  for (int i = 0; i < p.count; ++i) u += p.at[i].share * p.at[i].n;
  return u;
}

}  // namespace courant
