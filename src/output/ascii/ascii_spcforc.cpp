#include <fmt/printf.h>

#include <algorithm>

#include "output/ascii/text_history.hpp"

namespace courant {

// By node, its force before its moment.
namespace {

/// One state of spcforc: the forces and moments that hold particles and nodes.
std::string spcforc_text(const Sample& s, Real /*first_potential*/) {
  using Kind = BoundaryForce::Kind;
  std::vector<const BoundaryForce*> reactions;
  for (const BoundaryForce& b : s.boundary_forces)
    if (b.kind == Kind::held_point || b.kind == Kind::held_rotation) reactions.push_back(&b);
  std::stable_sort(reactions.begin(), reactions.end(),
                   [](const BoundaryForce* a, const BoundaryForce* b) { return a->id < b->id; });
  std::string out = fmt::sprintf(" output at time =%14.5E\n", s.t);
  Vec total = Vec::Zero();
  for (const BoundaryForce* b : reactions) {
    const Vec& what = b->kind == Kind::held_rotation ? b->moment : b->force;
    out += fmt::sprintf(" node=%8d local x,y,z %s=%14.4E%14.4E%14.4E\n", b->id,
                        b->kind == Kind::held_rotation ? "moments" : "forces ", what.x(), what.y(), what.z());
    total += b->force;
  }
  return out + fmt::sprintf("             force resultants   =%14.4E%14.4E%14.4E\n", total.x(), total.y(),
                            total.z());
}

void spcforc_binout(const Sample& s, Real /*first_potential*/, HistoryNumbers& to) {
  using B = BoundaryForce;
  const std::vector<B> forces = boundary_forces_of(s, B::Kind::held_point),
                       moments = boundary_forces_of(s, B::Kind::held_rotation);
  HistoryRows(to, "", forces, &B::id)
      .fixed("force_ids", &B::id)
      .integer("ids", &B::id)  // particles may leave
      .vector("{}_force", &B::force);
  HistoryRows(to, "", moments, &B::id, "", "moment_ids").vector("{}_moment", &B::moment);
  Vec sum = Vec::Zero();
  for (const B& one : forces) sum += one.force;
  to.real("x_resultant", sum.x()), to.real("y_resultant", sum.y()), to.real("z_resultant", sum.z());
}

const RegisterTextHistory spcforc{{"spcforc", spcforc_text, spcforc_binout}};

}  // namespace

}  // namespace courant
