#include "tests/safety/adversary.hpp"

#include "host/scenario/contact.hpp"
#include "host/worlds/generate.hpp"
#include "host/worlds/scale.hpp"

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

struct Class {
  worlds::Kind kind;
  int discs;
  bool box;
};
constexpr Class kClasses[] = {{worlds::Kind::discs, 15, false}, {worlds::Kind::discs, 30, false},
                              {worlds::Kind::discs, 50, false}, {worlds::Kind::discs, 75, true},
                              {worlds::Kind::u_trap, 0, false}, {worlds::Kind::spiral, 0, false},
                              {worlds::Kind::maze, 0, false},   {worlds::Kind::rooms, 0, false},
                              {worlds::Kind::poles, 0, false},  {worlds::Kind::enclosed, 0, false}};

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

Scenario thick_of_it(worlds::Random& random, bool noise, const Params& robot) {
  const Class& c = kClasses[random.index(10)];
  worlds::Options options;
  options.seed = random.bits() >> 2;
  options.noise = noise;
  options.box = c.box;
  if (c.discs != 0) options.discs = c.discs;
  Scenario s = worlds::generate(c.kind, options);
  const double radius_m = robot.body.radius.raw() * 1e-6, size = radius_m / 0.09;
  worlds::scale_lengths(s, size);
  s.robot = robot;
  const double placed_m = rim_sweep(robot).radius.raw() * 1e-6;
  for (int i = 0; i < 200; ++i) {
    const sim::Vec2 at{s.start.at.x + random.uniform(-0.5, 3) * size,
                       s.start.at.y + random.uniform(-0.5, 3) * size};
    const double gap = nearest_obstacle(s, at).distance_m - placed_m;
    if (gap < 0.001 * size || gap > 0.3 * size) continue;
    s.start.at = at;
    break;
  }
  s.start.heading = random.uniform(-3.14, 3.14);
  s.seed = random.bits();
  return s;
}

}  // namespace whisker::test
