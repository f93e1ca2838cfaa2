#include "host/harness/sim/plant.hpp"

#include "host/harness/sim/bumper.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {
namespace {

constexpr double kSpeedRounding = 51e-6;       // m/s; a wheel is commanded in steps of 100e-6
constexpr double kPressGap = 4 * kContactGap;  // a touch is reported within 3 of it

double larger(double a, double b) { return a > b ? a : b; }
double seconds(int64_t us) { return static_cast<double>(us) * 1e-6; }

int64_t whole_period_us(double period_s) {
  const int64_t ms = whole_below(period_s * 1000 + 0.5);
  return 1000 * (ms > 1 ? ms : 1);
}

double limited(int16_t tenths, double max_speed) {
  const double v = tenths / 10000.0;
  return v > max_speed ? max_speed : v < -max_speed ? -max_speed : v;
}

}  // namespace

Plant::Plant(const WorldView& world, const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed,
             Pose start)
    : world_(&world),
      radius_(robot.radius),
      track_(robot.track),
      max_speed_(robot.max_speed),
      press_speed_(robot.bumper ? robot.press_speed : -1),
      period_us_(whole_period_us(robot.period_s)),
      step_us_(period_us_ % 2000 == 0 ? 2000 : 1000),
      wheel_(robot.motor_lag, robot.max_acceleration, seconds(step_us_)),
      encoders_(robot, noise, seed),
      slip_{{robot, noise, seed, 0}, {robot, noise, seed, 1}},
      gyro_(robot, noise, seed),
      has_gyro_(robot.gyro),
      gyro_dies_(robot.gyro_dies_s),
      sensors_(robot, noise, seed),
      pose_(start) {
  min_clearance_ = __builtin_huge_val();
  gap_now();
  sensors_.measure(world, start);
}

void Plant::command(hal::WheelSpeeds speeds) {
  target_left_ = limited(speeds.left, max_speed_);
  target_right_ = limited(speeds.right, max_speed_);
}

void Plant::advance() {
  // The owner may have moved an obstacle since the last period, even onto the body.
  double gap = gap_now();
  const bool near = gap - farthest_travel() <= larger(min_clearance_, kContactGap);
  const double step_s = seconds(step_us_);
  const double path_before = path_length_;
  double rolled_left = 0;
  double rolled_right = 0;

  for (const int64_t end_us = now_us_ + period_us_; now_us_ < end_us; now_us_ += step_us_) {
    Arc arc{pose_, 0, 0};
    double free_fraction = 1;
    if (!contact_) {
      const WheelStep left = wheel_.step(v_left_, target_left_);
      const WheelStep right = wheel_.step(v_right_, target_right_);
      const double ground_left = slip_[0].ground(v_left_, left, step_s);
      const double ground_right = slip_[1].ground(v_right_, right, step_s);
      v_left_ = left.speed;
      v_right_ = right.speed;
      arc.length = 0.5 * (ground_left + ground_right);
      arc.turn = (ground_right - ground_left) / track_;
      if (near) {
        const Sweep free = sweep(*world_, arc, time(), step_s, radius_, gap, min_clearance_);
        gap = free.clearance;
        min_clearance_ = free.least_clearance;
        free_fraction = free.fraction;
        if (free.contact && !press(along(arc, free_fraction))) touch(time() + free_fraction * step_s);
      }
      rolled_left += left.distance * free_fraction;
      rolled_right += right.distance * free_fraction;
      path_length_ += size_of(arc.length) * free_fraction;
      pose_ = along(arc, free_fraction);
    }
    if (has_gyro_) gyro_.turn(arc.turn * free_fraction, now_us_, now_us_ + step_us_);
    sense(arc, free_fraction);
  }
  encoders_.roll(rolled_left, rolled_right, path_length_ - path_before);
  if (pressed_ != 0) release();
}

bool Plant::press(const Pose& at) {
  if (size_of(v_left_ + v_right_) / 2 > press_speed_ + kSpeedRounding) return false;
  const uint8_t pressed = switch_pressed(*world_, at, radius_, kPressGap);
  if (pressed == 0) return false;
  if ((pressed_ & pressed) == 0) ++bumps_;
  pressed_ = static_cast<uint8_t>(pressed_ | pressed);
  v_left_ = v_right_ = 0;
  return true;
}

void Plant::release() {
  if (clearance(*world_, pose_.at, time(), radius_) > kReleaseGap) pressed_ = 0;
}

double Plant::gap_now() {
  const double gap = clearance(*world_, pose_.at, time(), radius_);
  if (gap < min_clearance_) min_clearance_ = gap;
  if (gap <= kContactGap && !contact_) touch(time());
  return gap;
}

double Plant::farthest_travel() const {
  const double left = larger(size_of(v_left_), size_of(target_left_));
  const double right = larger(size_of(v_right_), size_of(target_right_));
  return (0.5 * (left + right) + fastest_mover(*world_)) * seconds(period_us_);
}

void Plant::touch(double time) {
  contact_ = true;
  contact_time_ = time;
  if (min_clearance_ > 0) min_clearance_ = 0;
  v_left_ = v_right_ = 0;
}

void Plant::sense(const Arc& arc, double free_fraction) {
  while (sensors_.due_us() <= now_us_ + step_us_) {
    const double fraction = static_cast<double>(sensors_.due_us() - now_us_) / static_cast<double>(step_us_);
    sensors_.measure(*world_, fraction < free_fraction ? along(arc, fraction) : pose_);
  }
}

}  // namespace whisker::sim
