#include "host/harness/pico/rig.hpp"

#include <cmath>
#include <cstdlib>

#include "firmware/health.hpp"
#include "firmware/planning/default_planner.hpp"
#include "host/harness/run/pilot.hpp"
#include "host/harness/run/record.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/shapes.hpp"

namespace whisker::pico {
namespace {

constexpr char kDigits[] = "0123456789abcdef";

sim::RobotSpec body_of(const Scenario& scenario, double full_speed_mps) {
  sim::RobotSpec spec = robot_spec(scenario);
  spec.period_s = 0.001;
  spec.max_speed = full_speed_mps;
  if (scenario.robot.rangefinders.sonar == Fitted::yes) {
    // The board says when they measure.
    spec.rate_hz = 1000;
    spec.latency_s = 0;
  }
  return spec;
}

/// The goal as the robot sees it, which takes the place of its start as its origin.
planning::Goal goal_of(const Scenario& scenario) {
  const sim::Vec2 way = scenario.goal.at - scenario.start.at;
  const sim::SinCos at = sim::sin_cos(scenario.start.heading);
  Goal goal = scenario.goal;
  goal.at = {at.cos * way.x + at.sin * way.y, at.cos * way.y - at.sin * way.x};
  return fixed_goal(goal);
}

/// Of digits; nothing of "-".
std::string from_hex(const char* text) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::string bytes;
  for (; text[0] != '\0' && text[1] != '\0'; text += 2)
    bytes.push_back(static_cast<char>(digit(text[0]) << 4 | digit(text[1])));
  return bytes;
}

std::string to_hex(const std::string& bytes) {
  if (bytes.empty()) return "-";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return text;
}

/// With six digits behind the point.
std::string decimal(double x) {
  if (x < 0) return '-' + decimal(-x);
  constexpr std::int64_t kMillion = 1000000;
  const std::int64_t millionths = micrometres(x);
  return std::to_string(millionths / kMillion) + '.' +
         std::to_string(kMillion + millionths % kMillion).substr(1);
}

/// A JSON object, name by name. Texts need no escapes.
class Object {
 public:
  Object& text(const char* name, const std::string& value) { return add(name, '"' + value + '"'); }
  Object& number(const char* name, double value) { return add(name, decimal(value)); }
  Object& count(const char* name, std::uint64_t value) { return add(name, std::to_string(value)); }
  Object& boolean(const char* name, bool value) { return add(name, value ? "true" : "false"); }
  std::string whole() const { return text_ + '}'; }

 private:
  Object& add(const char* name, const std::string& value) {
    text_ += (text_.empty() ? "{\"" : ",\"") + std::string(name) + "\":" + value;
    return *this;
  }
  std::string text_;
};

const char* state_of(const can::Heartbeat& beat) {
  return can::kNodeStateWords[static_cast<int>(beat.state)];
}

}  // namespace

Rig::Rig(const Scenario& scenario, const RigOptions& options)
    : full_speed_mps_(options.full_speed_mps),
      scenario_(scenario),
      world_(std::make_unique<SimWorld>(scenario_)),
      view_(world_->view()),
      plant_(view_, body_of(scenario_, options.full_speed_mps), noise_spec(scenario_.noise),
             options.seed.value_or(scenario_.seed), scenario_.start),
      cable_(scenario_.robot, kDefaultPlanner, goal_of(scenario_)) {
  if (options.listens) cable_.listen_only();
}

std::string Rig::step(const std::string& line) {
  char* rest = nullptr;
  const int left = static_cast<int>(std::strtol(line.c_str(), &rest, 10));
  const int right = static_cast<int>(std::strtol(rest, &rest, 10));
  plant_.command({speed(left), speed(right)});
  plant_.advance();
  now_us_ += 1000;
  return answer(cable_.step(now_us_, from_hex(*rest == ' ' ? rest + 1 : rest)));
}

std::int16_t Rig::speed(int duty) const {
  const double tenths = duty / 32767.0 * full_speed_mps_ * 1e4;
  return static_cast<std::int16_t>(std::lround(tenths));
}

std::string Rig::answer(const std::string& goes) const {
  const hal::EncoderCounts counts = plant_.encoders();
  const hal::RangeReadings ranges = plant_.ranges();
  std::string line;
  const auto say = [&line](auto number) { line += std::to_string(number) + ' '; };
  say(counts.left);
  say(counts.right);
  for (const hal::RangeReading& r : ranges.beam) {
    say(r.mm);
    say(static_cast<int>(r.status));
    say(r.sequence);
  }
  const hal::GyroReading gyro = plant_.gyro();
  say(plant_.bumper().pressed);
  say(gyro.sum);
  say(gyro.samples);
  say(std::lround(plant_.v_left() * 1e6));
  say(std::lround(plant_.v_right() * 1e6));
  say(plant_.in_contact() ? 1 : 0);
  const can::NavStatus& status = cable_.status();
  for (const char* const word : {!cable_.trouble().empty() ? "refused"
                                 : cable_.ordered()        ? "ordered"
                                                           : "waits",
                                 can::kOutcomeWords[static_cast<int>(status.outcome)],
                                 name(static_cast<Fault>(status.fault)), state_of(cable_.base())})
    line += std::string(word) + ' ';
  return line + to_hex(goes);
}

std::string Rig::verdict() const {
  const can::NavStatus& status = cable_.status();
  const hil::Shadow* const shadow = cable_.shadow();
  const std::uint64_t driven_us = cable_.ordered() ? now_us_ - cable_.ordered_us() : 0;
  Object all;
  all.text("outcome", can::kOutcomeWords[static_cast<int>(status.outcome)])
      .text("state", planning::name(status.state))
      .text("why", planning::name(status.why))
      .text("fault", name(static_cast<Fault>(status.fault)))
      .text("controller", state_of(cable_.controller()))
      .text("base", state_of(cable_.base()))
      .number("time_s", static_cast<double>(now_us_) * 1e-6)
      .number("drive_s", static_cast<double>(driven_us) * 1e-6)
      .number("path_m", plant_.path_length())
      .number("distance_m", distance(scenario_.goal.at, plant_.pose().at))
      .boolean("contact", plant_.in_contact())
      .number("clearance_m", std::fmin(plant_.min_clearance(), kEmptyWorldClearance))
      .count("bumps", plant_.bumps())
      .boolean("turned_by_gyro",
               shadow != nullptr && shadow->status().heading_source == localization::HeadingSource::gyro)
      .count("answers", cable_.answers())
      .count("frames", cable_.frames())
      .text("difference", cable_.difference())
      .text("trouble", cable_.trouble());
  return all.whole();
}

void Rig::change(const Scenario& scenario) {
  adopt_world(scenario_, scenario);
  world_ = std::make_unique<SimWorld>(scenario_);
  view_ = world_->view();
}

}  // namespace whisker::pico
