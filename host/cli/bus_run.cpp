#include "host/cli/bus_run.hpp"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <utility>

#include <unistd.h>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "firmware/can/ids.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/harness/hil/candump.hpp"
#include "host/harness/hil/controller_loop.hpp"
#include "host/harness/hil/host_rules.hpp"
#include "host/harness/hil/precedence.hpp"
#include "host/harness/hil/tap.hpp"
#include "host/harness/hil/wall_clock.hpp"

namespace whisker::cli {
namespace {

/// "1.2.3" as the bytes of one number.
std::uint32_t version_number() {
  std::uint32_t number = 0, part = 0;
  for (const char* c = WHISKER_VERSION; *c != 0; ++c) {
    if (*c == '.') {
      number = (number | part) << 8;
      part = 0;
    } else {
      part = part * 10 + static_cast<std::uint32_t>(*c - '0');
    }
  }
  return number | part;
}

constexpr double kBackWithin_m = 1;

std::function<void(const std::string&)> speaker(const char* who, const BusChoice& bus) {
  return [who, name = bus.name, robot = bus.robot](const std::string& words) {
    fmt::print(stderr, "{} {} on {}: {}\n", who, robot, name, words);
  };
}

void run_before_others(const std::function<void(const std::string&)>& say) {
  const std::string forbidden = hil::take_precedence();
  if (!forbidden.empty()) say("ticks may be late, as it gets no real-time priority: " + forbidden);
}

void control_until(const BusChoice& bus, hil::ControllerOptions how, hil::Line& line) {
  hil::Recorder recorder(bus.record, bus.name);
  hil::Tap tap(line.port(), [&recorder](const hal::CanFrame& frame) { recorder.write(frame); });
  how.identity = bus.identity();
  bus::FaultPort port = lossy(tap, bus);
  if (bus.real_time) run_before_others(how.say);
  hil::control(port, line, how);
  recorder.close();
}

void control_until_interrupted(const BusChoice& bus, hil::ControllerOptions how, hil::Line& line) {
  const Interrupt interrupt;
  how.say = speaker(how.guard ? "guard" : "controller", bus);
  how.interrupted = [&interrupt] { return interrupt.noted(); };
  control_until(bus, std::move(how), line);
}

}  // namespace

void BusChoice::drive_with(PlannerKind planner) {
  rules = rules_digest(planner);
  table = hil::table_to_send(planner);
}

can::Identity BusChoice::identity() const {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const auto mixed = static_cast<std::uint32_t>(now.tv_nsec) ^ static_cast<std::uint32_t>(getpid()) * 40503U;
  return {static_cast<std::uint8_t>(robot), static_cast<std::uint16_t>(mixed ^ mixed >> 16),
          version_number()};
}

CLI::Option* add_bus(CLI::App& app, BusChoice& choice) {
  within(
      app.add_option("--node", choice.robot, "Number of the robot, 1 to 7: two robots on one bus need two"),
      "N", 1, static_cast<int>(can::kRobots));
  add_file(app, "--record", choice.record, "Write all frames as a candump log");
  amount(app.add_option("--drop", choice.drop_percent,
                        "Lose so many of the frames that are sent and received, at random"),
         "PERCENT", 100);
  return app
      .add_option("--can", choice.name,
                  "CAN interface, such as vcan0, or slcan:PATH for a serial\nline; it need not be there yet")
      ->type_name("IFACE");
}

bus::FaultPort lossy(hal::CanPort& port, const BusChoice& choice) {
  bus::Schedule faults;
  if (choice.drop_percent > 0) {
    bus::Fault loss{bus::FaultKind::loss};
    loss.chance = choice.drop_percent / 100;
    faults.push_back(loss);
  }
  return {port, std::move(faults), static_cast<std::uint64_t>(choice.robot)};
}

int drive_on_bus(const Scenario& world, RunOptions options, const RunOutputs& outputs, const BusChoice& bus,
                 hil::Line& line, LiveView* view, const std::function<void()>& check) {
  const Interrupt interrupt;
  hil::Recorder recorder(bus.record, bus.name);
  hil::Figures figures;
  hil::WallClock clock([&line] { return line.descriptor(); });
  std::optional<hil::Shadow> shadow;
  if (bus.beside) shadow.emplace(bus.robot, *bus.beside);
  hil::Tap tap(line.port(), [&](const hal::CanFrame& frame) {
    ++figures.frames;
    figures.bits += hil::bits_on_bus(frame);
    recorder.write(frame);
    if (shadow) shadow->hear(frame, clock.now_us());
  });
  bus::FaultPort port = lossy(tap, bus);
  hil::BusOptions how;
  how.identity = bus.identity();
  how.rules = bus.rules;
  how.table = bus.table;
  how.order = bus.order;
  how.shadow = shadow ? &*shadow : nullptr;
  Scenario scenario = world;
  if (calibrates(bus.order)) {
    // It ends where it began, or ahead, as well as the uncalibrated robot turns.
    how.goal = fixed_goal(world.goal);
    scenario.events.clear();
    const sim::Pose& start = world.start;
    const double away = std::hypot(world.goal.at.x - start.at.x, world.goal.at.y - start.at.y);
    const double ahead = bus.order == can::Order::tape ? away : 0;
    scenario.goal = {
        {start.at.x + ahead * std::cos(start.heading), start.at.y + ahead * std::sin(start.heading)},
        kBackWithin_m};
  }
  how.sync_mode = bus.real_time ? can::SyncMode::real_time : can::SyncMode::lockstep;
  how.say = [view, speak = speaker("plant", bus)](const std::string& words) {
    if (!words.empty()) speak(words);
    if (view != nullptr) view->feed().say(words);
  };
  how.bus_waits_for = [&line] { return line.waits_for(); };
  how.interrupted = [&] {
    if (check && !interrupt.noted()) check();
    return interrupt.noted();
  };
  if (bus.real_time) run_before_others(speaker("plant", bus));
  options.pilot = hil::bus_pilot(port, clock, how, figures);
  RunOutputs all = outputs;
  all.record = bus.record;
  all.inside = shadow.has_value();
  all.bus_json = [&figures] { return hil::figures_json(figures, kBitrate); };
  all.bus_words = [&figures] { return hil::figures_words(figures, kBitrate); };
  if (view != nullptr) {
    options.watch = [view](const Moment& moment) { view->feed().add(moment); };
    all.ended = [view](const RunResult& result) { view->feed().end(result); };
    view->start();
  }
  std::optional<int> status;
  while (!status) {
    if (view != nullptr) view->feed().begin(setting(scenario, options, all));
    try {
      status = drive_one(scenario, options, all);
      recorder.close();
    } catch (const hil::ControllerRestarted&) {
      how.say("the controller started anew, so the run begins again");
      figures = {};
    } catch (const hil::OtherRules& e) {
      throw UsageError(e.what());
    } catch (const hil::NoCalibration& e) {
      throw UsageError(e.what());
    } catch (const hil::Interrupted&) {
      throw Interrupted(recorder.keep());
    }
  }
  if (view != nullptr) view->stay(interrupt);
  if (figures.calibrated && figures.calibrated->stored != storage::Stored::ok && *status == 0) {
    fmt::print(stderr, "whisker: the controller did not keep the calibration: {}\n",
               name(figures.calibrated->stored));
    return kFault;
  }
  return *status;
}

void control_on_bus(const BusChoice& bus, PlannerKind planner, hil::Line& line, hal::Storage* storage,
                    planning::Calibrator* calibrator) {
  hil::ControllerOptions how;
  how.planner = planner;
  how.storage = storage;
  how.calibrator = calibrator;
  control_until_interrupted(bus, how, line);
}

void guard_on_bus(const BusChoice& bus, PlannerKind rules, double longest_command_s, hil::Line& line) {
  hil::ControllerOptions how;
  how.guard = true;
  how.planner = rules;
  how.assist = rules.table;
  how.longest_command = milliseconds(static_cast<std::int32_t>(std::lround(longest_command_s * 1000)));
  control_until_interrupted(bus, how, line);
}

bool control_mission_on_bus(const BusChoice& bus, can_app::PlannerMaker& planners, hil::Line& line,
                            const std::function<void(const std::string&)>& heard,
                            const std::function<bool()>& done) {
  const Interrupt interrupt;
  hil::ControllerOptions how;
  how.planners = &planners;
  const auto say = speaker("controller", bus);
  how.say = [&](const std::string& words) {
    say(words);
    heard(words);
  };
  how.interrupted = [&] { return interrupt.noted() || done(); };
  control_until(bus, how, line);
  return interrupt.noted();
}

}  // namespace whisker::cli
