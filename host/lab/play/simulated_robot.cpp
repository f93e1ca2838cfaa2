#include "host/lab/play/simulated_robot.hpp"

namespace whisker::play {
namespace {

constexpr double kNotedEvery = 0.005;  // m

}  // namespace

void SimulatedRobot::note(sim::Vec2 at, int kind) {
  if (way_.empty()) {
    way_.push_back({at, kind});
    return;
  }
  const sim::Vec2 step = at - way_.back().at;
  const double square = sim::dot(step, step);
  const bool far = square >= kNotedEvery * kNotedEvery;
  if (far || (square > 0 && kind != way_.back().kind)) way_.push_back({at, kind});
}

}  // namespace whisker::play
