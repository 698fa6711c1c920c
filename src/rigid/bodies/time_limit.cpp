#include "rigid/bodies/time_limit.hpp"

#include <fmt/format.h>

namespace courant {

namespace {

class BodyTimeLimit : public TimeLimit {
 public:
  BodyTimeLimit(std::shared_ptr<const RigidBodies> bodies, Real endtim)
      : bodies_(std::move(bodies)), longest_(endtim / 1000) {}
  std::string name() const override { return "rigid bodies (step)"; }
  bool rings() const override { return false; }
  Limit limit(const World&, const Clock&) override {
    constexpr Real most_angle = 0.01;
    Limit out{longest_, "rigid bodies: ENDTIM / 1000"};
    for (const RigidBody& b : bodies_->bodies())
      if (const Real dt = most_angle / b.omega.norm(); dt < out.dt)
        out = {dt, fmt::format("turning of rigid body {}", b.part)};
    return out;
  }

 private:
  std::shared_ptr<const RigidBodies> bodies_;
  Real longest_;
};

}  // namespace

std::shared_ptr<TimeLimit> make_body_time_limit(std::shared_ptr<const RigidBodies> bodies, Real endtim) {
  return std::make_shared<BodyTimeLimit>(std::move(bodies), endtim);
}

}  // namespace courant
