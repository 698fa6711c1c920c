#include "surfaces/face_forces.hpp"

#include <algorithm>

namespace courant {

namespace {

class ClearFaceForces : public Rate {
 public:
  std::string name() const override { return "clear contact forces"; }
  const FieldSet& over(const World& world) const override { return world.segments.fields; }
  void declare(const World& world, Accesses& a) const override { a.writes(*world.segments.contact_force); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (int k = 0; k < 3; ++k) {
      Real* force = world.segments.contact_force->data(k);
      std::fill(force + begin, force + end, 0.0);
    }
  }
};

}  // namespace

void add_clear_face_forces(World& world) {
  world.segments.keep_contact_force();
  if (world.passes.all<ClearFaceForces>().empty()) world.passes.add(std::make_shared<ClearFaceForces>());
}

}  // namespace courant
