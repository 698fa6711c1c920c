#include "elements/nodal_rotations.hpp"

#include "state/shared_fields.hpp"

namespace courant {

NodalRotations::NodalRotations(FieldSet& nodes)
    : angle(shared_fields::rotation.add(nodes)),
      speed(shared_fields::angular_velocity.add(nodes)),
      moment(shared_fields::moment.add(nodes)),
      inertia(shared_fields::rotary_inertia.add(nodes)),
      none(shared_fields::no_rotation.add(nodes)) {}

void start_rotations(const Model& model, const std::vector<Index>& node_of, World& world) {
  if (!shared_fields::rotary_inertia.find(world.nodes.fields)) return;
  const NodalRotations rotations(world.nodes.fields);
  for (Index n = 0; n < world.nodes.size(); ++n)
    rotations.none[n] = world.nodes.follow[n] != 0 || !(rotations.inertia[n] > 0);
  for (const auto& [node, omega] : model.angular_velocity)
    if (const Index n = node_of[static_cast<std::size_t>(node)]; n >= 0 && rotations.none[n] == 0)
      rotations.speed.set(n, omega);
}

}  // namespace courant
