// The pose from counts, against arcs in double.
#include "firmware/localization/odometry.hpp"

#include <cmath>

#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using localization::CountStep;
using localization::Odometry;

constexpr std::uint32_t kMask = hal::kEncoderModulus - 1;

Params draw_wheels(Dice& dice) {
  Params p;
  p.wheels.counts_per_metre = static_cast<std::int32_t>(dice.log_uniform(500, 50000));
  p.body.track = micrometres(50000 + dice.index(450000));
  p.wheels.ratio = millionths(dice.chance(0.5) ? 1000000 : 900000 + dice.index(200001));
  p.wheels.max_speed = Speed::from_raw(1000 * (100 + dice.index(900)));
  return p;
}

std::string judge_arcs(Dice& dice) {
  const Params p = draw_wheels(dice);
  const double counts = p.wheels.counts_per_metre, track = metres(p.body.track);
  const double ratio = p.wheels.ratio.raw() / static_cast<double>(millionths(1000000).raw());
  const double skew = (ratio - 1) / (ratio + 1);
  Odometry odometry;
  odometry.configure(p);
  const Pose start = draw_pose(dice);
  odometry.place(start);
  double x = metres(start.at.x), y = metres(start.at.y), turned = 0, path = 0;
  auto left = static_cast<std::uint32_t>(dice.bits()) & kMask,
       right = static_cast<std::uint32_t>(dice.bits()) & kMask;
  CountStep step;
  if (!odometry.update({left, right}, 90_ms, step) || !(odometry.pose().at == start.at))
    return "the first counts move it";
  const int most =
      std::max(2, static_cast<int>(metres(Length::from_raw(p.wheels.max_speed.raw())) * counts * 0.05));
  int dl = 0, dr = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    if (tick % 40 == 0) {
      dl = dice.index(2 * most + 1) - most;
      dr = dice.index(2 * most + 1) - most;
    }
    left = (left + static_cast<std::uint32_t>(dl)) & kMask;
    right = (right + static_cast<std::uint32_t>(dr)) & kMask;
    if (!odometry.update({left, right}, 90_ms, step)) return "a jump that is none";
    if (step.left != dl || step.right != dr) return "other counts";
    const double sl = dl / counts * (1 - skew), sr = dr / counts * (1 + skew), turn = (sr - sl) / track;
    const double middle = radians(start.heading) + turned + turn / 2;
    x += (sl + sr) / 2 * std::cos(middle);
    y += (sl + sr) / 2 * std::sin(middle);
    turned += turn;
    path += std::fabs(sl + sr) / 2;
  }
  const Pose pose = odometry.pose();
  const double off = std::remainder(radians(pose.heading) - radians(start.heading) - turned, 2 * sim::kPi);
  const double wheel_turns = 2000.0 * most / counts / track;
  if (std::fabs(off) > 4e-6 + 4e-7 * wheel_turns) return "another heading";
  const double slack = 5e-6 + 1e-6 * path + path * (4e-6 + 4e-7 * wheel_turns);
  if (std::hypot(metres(pose.at.x) - x, metres(pose.at.y) - y) > slack) return "another place";
  const double travelled = odometry.travelled_um() * 1e-6;
  if (path < 4000 && std::fabs(travelled - path) > 2000 * 1.5e-6 + 1e-5 * path)
    return "another length of the way";
  return "";
}

/// By the turn of a gyro instead of the wheels', and the counts that turn the body.
std::string judge_turns(Dice& dice) {
  const Params p = draw_wheels(dice);
  const double counts = p.wheels.counts_per_metre, track = metres(p.body.track);
  const double ratio = p.wheels.ratio.raw() / static_cast<double>(millionths(1000000).raw());
  const double skew = (ratio - 1) / (ratio + 1);
  Odometry odometry;
  odometry.configure(p);
  odometry.place({});
  const CountStep step{dice.index(200) - 100, dice.index(200) - 100};
  const double due = step.right * (1 + skew) - step.left * (1 - skew);
  const std::int64_t difference = odometry.difference(step);
  if (std::fabs(static_cast<double>(difference) / 4096 - due) > 0.01) return "another difference of counts";
  const double turn = due / counts / track;
  if (std::fabs(std::remainder(radians(odometry.turn_of(difference)) - turn, 2 * sim::kPi)) >
      0.01 / counts / track + 1e-6) {
    return "another turn for a difference";
  }
  const double around = 2 * sim::kPi * track * counts;
  if (std::fabs(odometry.counts_per_turn() - around) > 1 + around * 1e-5) return "other counts per turn";
  const Angle by = Angle::turns(dice.index(40) - 20, 360);
  odometry.advance(step, by);
  const double way = (step.right * (1 + skew) + step.left * (1 - skew)) / 2 / counts, half = radians(by) / 2;
  const Pose pose = odometry.pose();
  if (pose.heading.raw() != by.raw()) return "the given turn is not taken";
  const double off =
      std::hypot(metres(pose.at.x) - way * std::cos(half), metres(pose.at.y) - way * std::sin(half));
  return off < 3e-6 + 1e-5 * std::fabs(way) ? "" : "a given turn leads elsewhere";
}

/// Faster than twice the full speed over the time and one period more.
std::string judge_jumps(Dice& dice) {
  const Params p = draw_wheels(dice);
  const int since_ms = 1 + dice.index(600);
  const double fastest = 2 * p.wheels.max_speed.raw() * 1e-6 * p.wheels.counts_per_metre;
  const double most = fastest * (since_ms + p.safety.period.raw()) * 1e-3 + 2;
  const int beyond = static_cast<int>(most * 1.02) + 3, within = static_cast<int>((most - 2) * 0.98) - 2;
  if (within < 0) return "";
  for (const bool jumps : {false, true}) {
    Odometry odometry;
    odometry.configure(p);
    odometry.place({});
    CountStep step;
    odometry.update({7, 7}, milliseconds(since_ms), step);
    const auto far = static_cast<std::uint32_t>(jumps ? beyond : within);
    const bool back = dice.chance(0.5), wheel = dice.chance(0.5);
    const std::uint32_t moved = (back ? 7U - far : 7U + far) & kMask;
    const hal::EncoderCounts now{wheel ? moved : 7, wheel ? 7 : moved};
    if (odometry.update(now, milliseconds(since_ms), step) == jumps) return "a jump is judged wrongly";
    if (jumps && !(odometry.pose().at == Vec{})) return "a jump moves the pose";
    const Vec before = odometry.pose().at;
    if (!odometry.update(now, milliseconds(since_ms), step) || !(odometry.pose().at == before))
      return "no new zero";
  }
  return "";
}

}  // namespace

std::string judge_odometry(Dice& dice) {
  for (int i = 0; i < 12; ++i) {
    for (const JudgePart judge : {judge_arcs, judge_turns, judge_jumps}) {
      std::string wrong = judge(dice);
      if (!wrong.empty()) return wrong;
    }
  }
  return "";
}

}  // namespace whisker::hunt
