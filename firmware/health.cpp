#include "firmware/health.hpp"

namespace whisker {

const char* name(Fault fault) noexcept {
  switch (fault) {
    case Fault::none: return "none";
    case Fault::invalid_params: return "invalid_params";
    case Fault::clock_jump: return "clock_jump";
    case Fault::range_lost: return "range_lost";
    case Fault::drive_refused: return "drive_refused";
    case Fault::encoder_jump: return "encoder_jump";
    case Fault::wheels_stalled: return "wheels_stalled";
    case Fault::range_unsteady: return "range_unsteady";
    case Fault::no_progress: return "no_progress";
    case Fault::pose_out_of_range: return "pose_out_of_range";
    case Fault::wheel_runaway: return "wheel_runaway";
    case Fault::bumper_lost: return "bumper_lost";
    case Fault::bumper_stuck: return "bumper_stuck";
    case Fault::range_untrusted: return "range_untrusted";
  }
  return "?";
}

const char* name(RangeLevel level) noexcept {
  switch (level) {
    case RangeLevel::trusted: return "trusted";
    case RangeLevel::doubtful: return "doubtful";
    case RangeLevel::untrusted: return "untrusted";
  }
  return "?";
}

}  // namespace whisker
