#include "firmware/planning/calibration/course_drive.hpp"

namespace whisker::planning {
namespace {

constexpr Angle kSide = 50_deg;
constexpr Length kProgress = 50_mm;
constexpr uint8_t kMostLooks = 4;

}  // namespace

void CourseDrive::begin(Vec from, Angle course, Length length) noexcept {
  from_ = from;
  course_ = course;
  length_ = length;
  last_ = Length{};
  turn_ = looks_ = 0;
  drives_ = false;
}

CourseDrive::Result CourseDrive::step(const View& view, Manoeuvre& manoeuvre) noexcept {
  if (!view.settled) return Result::driving;
  const Length way = along(view.pose.at - from_, course_);
  if (drives_) {
    if (!view.cut) return Result::done;
    drives_ = false;
    looks_ = way - last_ > kProgress ? uint8_t{1} : static_cast<uint8_t>(looks_ + 1);
    if (looks_ > kMostLooks) return Result::blocked;
    last_ = way;
    turn_ = 1;
  }
  if (turn_ == 0 || turn_ > 3) {
    turn_ = 0;
    drives_ = true;
    manoeuvre = {ManoeuvreKind::drive, course_, length_ - way, {}, {}};
    return Result::driving;
  }
  const Angle to = turn_ == 1 ? course_ + kSide : turn_ == 2 ? course_ - kSide : course_;
  manoeuvre = {ManoeuvreKind::turn, to, {}, {}, {}};
  ++turn_;
  return Result::driving;
}

}  // namespace whisker::planning
