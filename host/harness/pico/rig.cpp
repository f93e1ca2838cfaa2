// The rig of a board that runs in an emulator: the world, the wheels, and the other end of its cable. Each
// line of standard input is a millisecond: the duties of both motors, -32767 to 32767, and the bytes that the
// board has sent, in hexadecimal digits, or -. It is answered by a line: the counts of both encoders; of each
// rangefinder distance in mm, status and sequence number; the pressed switches; sum and number of the gyro's
// samples; the speeds of both wheels in um/s; 1 after a contact; words of the robot; and the bytes for the
// board. A line `end` is answered by the verdict.
//
//   whisker_rig WORLD [--robot FILE] [--seed N] [--full-speed MPS] [--listen]
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "firmware/health.hpp"
#include "firmware/planning/default_planner.hpp"
#include "host/harness/pico/cable.hpp"
#include "host/harness/run/pilot.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/sim/plant.hpp"

namespace whisker::pico {
namespace {

struct Options {
  std::string world;
  std::string robot;
  std::optional<std::uint64_t> seed;
  double full_speed_mps = 0.4;
  bool listens = false;
};

Options options_of(const std::vector<std::string>& words) {
  Options o;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = [&]() -> const std::string& {
      if (i + 1 == words.size()) throw std::runtime_error(words[i] + ": no value");
      return words[++i];
    };
    if (words[i] == "--robot") {
      o.robot = value();
    } else if (words[i] == "--seed") {
      o.seed = std::stoull(value());
    } else if (words[i] == "--full-speed") {
      o.full_speed_mps = std::stod(value());
    } else if (words[i] == "--listen") {
      o.listens = true;
    } else if (o.world.empty() && words[i].rfind("--", 0) != 0) {
      o.world = words[i];
    } else {
      throw std::runtime_error(words[i] + "?");
    }
  }
  if (o.world.empty()) throw std::runtime_error("no world");
  return o;
}

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
  const double c = std::cos(scenario.start.heading), s = std::sin(scenario.start.heading);
  Goal goal = scenario.goal;
  goal.at = {c * way.x + s * way.y, c * way.y - s * way.x};
  return fixed_goal(goal);
}

std::string from_hex(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2)
    bytes.push_back(static_cast<char>(std::stoi(text.substr(i, 2), nullptr, 16)));
  return bytes;
}

std::string to_hex(const std::string& bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  if (bytes.empty()) return "-";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return text;
}

class Rig {
 public:
  explicit Rig(const Options& o)
      : options_(o),
        scenario_(load_scenario(o.world, o.robot)),
        world_(scenario_),
        plant_(world_.view(), body_of(scenario_, o.full_speed_mps), noise_spec(scenario_.noise),
               o.seed.value_or(scenario_.seed), scenario_.start),
        cable_(scenario_.robot, kDefaultPlanner, goal_of(scenario_)) {
    if (o.listens) cable_.listen_only();
  }

  std::string step(int left, int right, const std::string& came) {
    plant_.command({speed(left), speed(right)});
    plant_.advance();
    now_us_ += 1000;
    const std::string goes = cable_.step(now_us_, came);
    return answer(goes);
  }

  nlohmann::json verdict() const {
    const can::NavStatus& status = cable_.status();
    const sim::Vec2 left = scenario_.goal.at - plant_.pose().at;
    return {{"outcome", can::kOutcomeWords[static_cast<int>(status.outcome)]},
            {"state", planning::name(status.state)},
            {"why", planning::name(status.why)},
            {"fault", name(static_cast<Fault>(status.fault))},
            {"controller", can::kNodeStateWords[static_cast<int>(cable_.controller().state)]},
            {"base", can::kNodeStateWords[static_cast<int>(cable_.base().state)]},
            {"time_s", static_cast<double>(now_us_) * 1e-6},
            {"drive_s", cable_.ordered() ? static_cast<double>(now_us_ - cable_.ordered_us()) * 1e-6 : 0.0},
            {"path_m", plant_.path_length()},
            {"distance_m", std::hypot(left.x, left.y)},
            {"contact", plant_.in_contact()},
            {"clearance_m", std::fmin(plant_.min_clearance(), 1e3)},
            {"bumps", plant_.bumps()},
            {"turned_by_gyro", by_gyro()},
            {"answers", cable_.answers()},
            {"frames", cable_.frames()},
            {"difference", cable_.difference()}};
  }

 private:
  bool by_gyro() const {
    const Status* const inside = cable_.inside();
    return inside != nullptr && inside->heading_source == localization::HeadingSource::gyro;
  }

  std::int16_t speed(int duty) const {
    const double tenths = duty / 32767.0 * options_.full_speed_mps * 1e4;
    return static_cast<std::int16_t>(std::lround(tenths));
  }

  std::string answer(const std::string& goes) const {
    const hal::EncoderCounts counts = plant_.encoders();
    const hal::RangeReadings ranges = plant_.ranges();
    std::string line = std::to_string(counts.left) + " " + std::to_string(counts.right);
    for (const hal::RangeReading& r : ranges.beam) {
      line += " " + std::to_string(r.mm) + " " + std::to_string(static_cast<int>(r.status)) + " " +
              std::to_string(r.sequence);
    }
    const hal::GyroReading gyro = plant_.gyro();
    line += " " + std::to_string(plant_.bumper().pressed) + " " + std::to_string(gyro.sum) + " " +
            std::to_string(gyro.samples);
    line += " " + std::to_string(std::lround(plant_.v_left() * 1e6)) + " " +
            std::to_string(std::lround(plant_.v_right() * 1e6)) + (plant_.in_contact() ? " 1" : " 0");
    const can::NavStatus& status = cable_.status();
    line += std::string(" ") + (cable_.ordered() ? "ordered" : "waits") + " " +
            can::kOutcomeWords[static_cast<int>(status.outcome)] + " " +
            name(static_cast<Fault>(status.fault)) + " " +
            can::kNodeStateWords[static_cast<int>(cable_.base().state)];
    return line + " " + to_hex(goes);
  }

  const Options options_;
  const Scenario scenario_;
  const SimWorld world_;
  sim::Plant plant_;
  Cable cable_;
  std::uint64_t now_us_ = 0;
};

int run(const Options& options) {
  Rig rig(options);
  for (std::string word; std::cin >> word;) {
    if (word == "end") {
      std::cout << rig.verdict().dump() << std::endl;
      continue;
    }
    const int left = std::stoi(word);
    int right = 0;
    std::string came;
    std::cin >> right >> came;
    std::cout << rig.step(left, right, came == "-" ? "" : from_hex(came)) << std::endl;
  }
  return 0;
}

}  // namespace
}  // namespace whisker::pico

int main(int argc, char** argv) {
  try {
    return whisker::pico::run(whisker::pico::options_of({argv + 1, argv + argc}));
  } catch (const std::exception& e) {
    std::cerr << "whisker_rig: " << e.what() << "\n";
    return 2;
  }
}
