#include "host/chip/chip_pilot.hpp"

#include <string>

#include "host/chip/messages.hpp"
#include "host/chip/process.hpp"
#include "host/run/fix_source.hpp"
#include "host/run/spec.hpp"

namespace whisker::chip {
namespace {

Status status_of(const link::Answer& a) {
  Status s;
  s.command = a.command;
  s.pose = {{Length::from_raw(a.pose.x), Length::from_raw(a.pose.y)}, Angle::from_raw(a.pose.heading)};
  s.health.fault = static_cast<Fault>(a.fault);
  planning::Decision& d = s.decision;
  d.manoeuvre.kind = static_cast<planning::ManoeuvreKind>(a.manoeuvre);
  d.mode = static_cast<planning::Mode>(a.mode);
  d.why = static_cast<planning::Why>(a.why);
  d.outcome = static_cast<planning::Outcome>(a.outcome);
  d.danger_count = a.danger_count;
  d.looked = a.looked != 0;
  d.inputs = {Q7::from_raw(a.distance), Q7::from_raw(a.bias)};
  d.response = {Q14::from_raw(a.turn), Q14::from_raw(a.step), {a.cell_distance, a.cell_bias}};
  for (int i = 0; i < hal::kBeams; ++i) {
    s.echoes.beam[i] = {Length::from_raw(a.echo[i]), static_cast<perception::Validity>(a.validity[i])};
  }
  return s;
}

/// Checks values from another program that are used as indices.
bool sound(const link::Answer& a) {
  return a.mode < planning::kModes && a.why < planning::kWhys &&
         a.outcome <= static_cast<std::uint8_t>(planning::Outcome::gave_up) && a.fault < kFaults;
}

class ChipPilot final : public Pilot {
 public:
  ChipPilot(const std::string& command, const Scenario& scenario, PlannerKind planner, sim::Plant& plant)
      : plant_(plant), fixes_(scenario), process_(command) {
    say([](Bytes& to) { append(to, link::Name::hello); });
    const auto greeting = hear<link::Greeting>();
    if (greeting.version != link::kVersion) throw ChipError(command + ": speaks another version");
    if (planner.map_bytes > greeting.most_map_bytes) {
      throw NoRoom(command + ": has room for " + std::to_string(greeting.most_map_bytes) +
                   " bytes of map, not " + std::to_string(planner.map_bytes));
    }
    say([&](Bytes& to) {
      append_params(to, scenario.robot);
      append_begin(to, planner, fixed_pose(scenario.start));
      append_goal(to, fixed_goal(scenario.goal));
    });
  }

  ~ChipPilot() override {
    try {
      say([](Bytes& to) { append(to, link::Name::end); });
      hear<link::Total>();
    } catch (const ChipError&) {
      // The chip has ended already.
    }
  }

  const Status& tick(Time now) override {
    say([&](Bytes& to) { append_tick(to, plant_, now); });
    const auto answer = hear<link::Answer>();
    if (!sound(answer)) throw ChipError("the chip's answer makes no sense");
    if (const auto fix = fixes_.take(plant_)) correct(*fix);
    status_ = status_of(answer);
    status_.health.fix_jumps = fix_.jumps;
    status_.health.fixes_refused = fix_.refused;
    plant_.command(status_.command);
    return status_;
  }

 private:
  void correct(const localization::UncertainPose& fix) {
    say([&](Bytes& to) { append_fix(to, fix); });
    fix_ = hear<link::Verdict>();
  }
  template <class F>
  void say(const F& words) {
    Bytes bytes;
    words(bytes);
    process_.write(bytes.data(), bytes.size());
  }
  template <class M>
  M hear() {
    std::uint8_t bytes[link::size_of<M>()];
    process_.read(bytes, sizeof bytes);
    return link::decode<M>(bytes);
  }

  sim::Plant& plant_;
  FixSource fixes_;
  link::Verdict fix_;  // of the last fix
  Process process_;
  Status status_;
};

}  // namespace

MakePilot chip_pilot(const std::string& command) {
  return [command](const Scenario& scenario, PlannerKind planner, sim::Plant& plant) {
    return std::make_unique<ChipPilot>(command, scenario, planner, plant);
  };
}

}  // namespace whisker::chip
