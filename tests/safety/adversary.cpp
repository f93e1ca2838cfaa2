#include "tests/safety/adversary.hpp"

namespace whisker::test {
namespace {

/// -1 to 1: the sign of the turn.
int towards_nearest(const planning::View& view) {
  const perception::Echo* const b = view.moving_scan.beam;
  if (b[hal::kFront].distance <= b[hal::kLeft].distance &&
      b[hal::kFront].distance <= b[hal::kRight].distance) {
    return 0;
  }
  return b[hal::kLeft].distance < b[hal::kRight].distance ? 1 : -1;
}

// Of the survey, which turns to both sides, so that there is clear ground: for the reference robot 4.8 s, and
// rims at 65 of at most 210 mm/s.
constexpr double kSurveyTurn_rad = 4.8 * 3;
constexpr Q14 kSurveyRate = Q14::ratio(65, 210);

}  // namespace

Adversary::Adversary(std::uint64_t seed, const Params& robot)
    : random_(seed),
      full_speed_(robot.wheels.max_speed),
      radius_(robot.body.radius),
      survey_(turn_rate(robot) * (robot.body.track / 2) * kSurveyRate),
      survey_ticks_(
          static_cast<int>(kSurveyTurn_rad * 1e9 / turn_rate(robot).raw() / robot.safety.period.raw())) {}

void Adversary::plot(const planning::View& view) {
  constexpr planning::ManoeuvreKind kKinds[] = {
      planning::ManoeuvreKind::cruise, planning::ManoeuvreKind::cruise, planning::ManoeuvreKind::drive,
      planning::ManoeuvreKind::drive,  planning::ManoeuvreKind::turn,   planning::ManoeuvreKind::stop,
      planning::ManoeuvreKind::keep};
  rest_ = 1 + random_.index(random_.chance(0.2) ? 10 : 150);
  keeps_ = random_.chance(0.5);
  fickle_ = random_.chance(0.1);
  plot_ = static_cast<Plot>(random_.index(5));
  wish_ = {};
  wish_.kind = kKinds[random_.index(7)];
  constexpr int kForward[] = {300, 300, 300, 150, 20, 2, 1, -300};
  wish_.forward = speed(kForward[random_.index(8)] * (random_.chance(0.1) ? 300 : 1000));
  wish_.turning = random_.chance(0.4) ? Speed{} : draw(300);
  wish_.heading = random_.chance(0.5) ? view.pose.heading : draw_angle();
  if (random_.chance(0.15)) {
    plot_ = Plot::survey;
    wish_.kind = planning::ManoeuvreKind::cruise;
    rest_ = survey_ticks_;
    keeps_ = fickle_ = false;
  }
  wish_.length = radius_ / 90 * random_.index(random_.chance(0.3) ? 50 : 3000);
}

void Adversary::change_cruise(const planning::View& view) {
  switch (plot_) {
    case Plot::steady: break;
    case Plot::nearest: wish_.turning = speed(60000) * towards_nearest(view); break;
    case Plot::zigzag: wish_.turning = -wish_.turning; break;
    case Plot::shake: wish_.forward = -wish_.forward; break;
    case Plot::noise:
      wish_.forward = draw(500);
      wish_.turning = draw(500);
      break;
    case Plot::survey:
      wish_.forward = {};
      wish_.turning = rest_ > survey_ticks_ * 3 / 4 || rest_ < survey_ticks_ / 4 ? survey_ : -survey_;
      break;
  }
}

planning::Decision Adversary::step(const planning::View& view) noexcept {
  planning::Decision d;
  d.outcome = planning::Outcome::running;
  const bool anew = fickle_ ? random_.chance(0.8) : rest_ <= 0;
  --rest_;
  if (anew) {
    const int rest = rest_;
    plot(view);
    if (fickle_ && rest > 0) rest_ = rest;
  } else if (keeps_) {
    return d;
  } else if (wish_.kind == planning::ManoeuvreKind::cruise) {
    change_cruise(view);
  }
  d.manoeuvre = wish_;
  return d;
}

}  // namespace whisker::test
