// docs/guard.md shows this file.
#include "firmware/guard.hpp"
#include "hal/clock.hpp"

namespace {

using namespace whisker::literals;

constexpr whisker::Params params() {
  whisker::Params p;
  p.body.radius = 90_mm;
  p.body.track = 140_mm;
  p.guard.command_timeout = 250_ms;
  return p;
}
constexpr whisker::Params kParams = params();
static_assert(whisker::check(kParams) == whisker::ParamFault::none, "the guard would refuse them");

}  // namespace

// The sensors, the wheels and the clock of the board: hal/rangefinders.hpp, hal/drive.hpp, hal/clock.hpp.
// next_command() is true if a command has come: m/s and rad/s, as in a ROS geometry_msgs/Twist.
void guard_forever(whisker::hal::Rangefinders& ranges, whisker::hal::Drive& wheels,
                   whisker::hal::Clock& clock, bool (*next_command)(int32_t& um_per_s, int32_t& urad_per_s),
                   void (*tell)(const char* reason)) {
  static whisker::Guard guard{ranges, wheels, kParams};
  guard.vouch(350_mm);  // whoever switches it on has looked
  for (auto last = whisker::Time::from_raw(clock.now_ms());;) {
    const auto now = whisker::Time::from_raw(clock.now_ms());
    if (now - last < kParams.safety.period) continue;
    last = now;
    int32_t forward = 0, turning = 0;
    if (next_command(forward, turning)) {
      guard.command({whisker::Speed::from_raw(forward), whisker::AngularRate::from_raw(turning)}, now);
    }
    tell(whisker::name(guard.tick(now).reason));
  }
}
