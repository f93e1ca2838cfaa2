#include "firmware/planning/calibration/square_planner.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kRestAtStart = 500;  // ms
constexpr uint8_t kSteps = 8;

}  // namespace

void SquarePlanner::start(const View& view) noexcept {
  course_ = view.pose.heading;
  rested_ms_ = 0;
  step_ = 0;
  begin();
}

void SquarePlanner::advance(const View& view) noexcept {
  rested_ms_ += view.elapsed.raw();
  if (step_ % 2 == 1) {
    const CourseDrive::Result result = drive_.step(view, decision_.manoeuvre);
    if (result == CourseDrive::Result::blocked) return end(Trouble::blocked);
    if (result == CourseDrive::Result::driving) return;
    corner_ = corner_ + polar(course_, length_);
    course_ += quarter_;
    decision_.manoeuvre = {ManoeuvreKind::turn, course_, {}, {}, {}};
    report(Mode::facing, Why::none);
    ++step_;
    return;
  }
  if (!view.settled || rested_ms_ < kRestAtStart) return;
  if (step_ == kSteps) {
    const Vec off = view.pose.at - begin_.at;
    missed_ = {along(off, begin_.heading), -across(off, begin_.heading)};
    return end(Trouble::none);
  }
  if (step_ == 0) {
    begin_ = view.pose;
    corner_ = begin_.at;
  }
  drive_.begin(corner_, course_, length_);
  drive_.step(view, decision_.manoeuvre);
  report(Mode::stepping, Why::none);
  ++step_;
}

}  // namespace whisker::planning
