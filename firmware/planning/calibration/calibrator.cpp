#include "firmware/planning/calibration/calibrator.hpp"

#include "firmware/calibration/tape.hpp"

namespace whisker::planning {

using calibration::Values;

Calibrator::Calibrator(hal::Storage& storage) noexcept
    : store_(storage),
      stored_(store_.load(values_)),
      spin_(params_),
      straight_(params_, StraightPlanner::kShortest, StraightPlanner::Way::there_and_back) {}

void Calibrator::begin(const Params& params, CalibrationPlanner& planner) noexcept {
  params_ = params;
  trouble_ = Trouble::not_finished;
  runs_ = &planner;
  along_tape_ = false;
  driven_ = {};
}

Planner& Calibrator::spin(const Params& params) noexcept {
  begin(params, spin_);
  return spin_;
}

Planner& Calibrator::straight(const Params& params, Length length) noexcept {
  begin(params, straight_);
  straight_.set_course(length, StraightPlanner::Way::there_and_back);
  return straight_;
}

Planner& Calibrator::tape(const Params& params, Length length) noexcept {
  begin(params, straight_);
  straight_.set_course(length, StraightPlanner::Way::there);
  along_tape_ = true;
  return straight_;
}

void Calibrator::begin_anew() noexcept { trouble_ = Trouble::not_finished; }

void Calibrator::abandon() noexcept {
  trouble_ = Trouble::not_finished;
  runs_ = nullptr;
  driven_ = {};
}

void Calibrator::finish() noexcept {
  if (runs_ == nullptr) return;
  const CalibrationPlanner& ended = *runs_;
  trouble_ = ended.trouble();
  if (trouble_ != Trouble::none) return;
  if (along_tape_) {
    driven_ = straight_.way();
    trouble_ = Trouble::not_finished;
    return;
  }
  Values all = values_;
  for (int i = 0; i < calibration::kQuantities; ++i) {
    if (ended.values().of[i].known()) all.of[i] = ended.values().of[i];
  }
  keep(all);
}

void Calibrator::take_tape(Length measured) noexcept {
  const calibration::Tape tape{driven_, measured};
  abandon();
  trouble_ = Trouble::no_drive;
  if (tape.driven == Length{}) return;
  trouble_ = Trouble::wrong_tape;
  Values all = values_;
  if (!calibration::take_tape(all, params_, tape)) return;
  trouble_ = Trouble::none;
  keep(all);
}

void Calibrator::keep(const Values& all) noexcept {
  // What the robot would refuse at its next start is not kept.
  Params checked = params_;
  if (calibration::apply(all, checked) != ParamFault::none) {
    trouble_ = Trouble::does_not_fit;
    return;
  }
  stored_ = store_.save(all);
  if (stored_ == calibration::Stored::ok) values_ = all;
}

void Calibrator::apply(Params& params) const noexcept { calibration::apply(values_, params); }

}  // namespace whisker::planning
