// A complete firmware: the parameters of the robot, and a loop. The functions declared here are yours.
#include "firmware/params/presets.hpp"
#include "firmware/simple_robot.hpp"

using namespace whisker;

uint32_t wait_for_next_10_ms();    // the time in ms
hal::EncoderCounts read_counts();  // hal/types.hpp says what the values mean
hal::RangeReadings read_rangefinders();
void set_wheel_speeds(hal::WheelSpeeds);  // a closed loop on each wheel, for example hal::Governor
void print(const char* words);

constexpr BodyParams kBody{75_mm, 30_mm, 110_mm};  // radius around the axle's centre, margin, track
constexpr WheelParams kWheels{250_mm_per_s, 1000_mm_per_s2, 3000_mrad_per_s, 50_ms, 3200};
constexpr Params kRobot = params_of(kBody, kWheels, vl53l1x(30_deg));

int main() {
  static SimpleRobot<kRobot> robot;
  robot.place({{0_m, 0_m}, 0_deg});
  robot.go_to({4_m, 1_m});
  for (;;) {
    const Time now = Time::from_raw(wait_for_next_10_ms());
    const Outputs out = robot.tick({now, read_counts(), read_rangefinders()});
    set_wheel_speeds(out.wheels);
    if (out.fault != Fault::none) print(name(out.fault));
  }
}
