/// A core on this computer takes the steps of a controller, from the frames of its bus.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/can/input_set.hpp"
#include "firmware/can/mission.hpp"
#include "firmware/robot.hpp"
#include "hal/can_port.hpp"
#include "host/harness/hil/host_rules.hpp"
#include "host/harness/run/planners.hpp"

namespace whisker::hil {

struct ReplayOptions {
  int robot = 0;                          ///< 1..7; 0: the first one in the log
  PlannerKind planner = kDefaultPlanner;  ///< its table drives until a base of the log sends another one
  /// Called when the robot is placed at the start of a mission, and after each of its steps with the local
  /// grid passed to the planner and its global planner, or null. The arguments are valid during the call
  /// only.
  std::function<void(const can::Mission&, const Params&)> begins = nullptr;
  std::function<void(const can::InputSet&, const Status&, const perception::LocalGrid*,
                     const RecordingGuide*)>
      stepped = nullptr;
};

struct ReplayResult {
  int robot = 0;              ///< 0: the log has no robot
  bool guard = false;         ///< its controller is a guard node
  std::uint64_t frames = 0;   ///< valid frames of this robot
  std::uint64_t damaged = 0;  ///< of this robot, with a wrong length or CRC
  std::uint64_t missions = 0;
  std::uint64_t steps = 0;                       ///< of the core
  std::uint64_t compared = 0;                    ///< commands and states that the log contains
  std::uint64_t unknown = 0;                     ///< answers to sets that are incomplete in the log
  std::uint64_t missing = 0;                     ///< steps whose answers, or GuardStatus, are not in the log
  PlannerKind planner;                           ///< with the response table that drove last
  std::shared_ptr<HostRules> rules;              ///< owns that table
  std::uint64_t hash = 0;                        ///< FNV-1a 64 over the wheel commands of all steps
  std::string difference;                        ///< the first one, with its line; "": none
  std::uint64_t cut = 0;                         ///< as LogReader::cut()
  std::map<std::string, std::uint64_t> skipped;  ///< as LogReader::skipped(), and "other" identifiers
};

class Replayer {
 public:
  /// The options must outlive it.
  explicit Replayer(const ReplayOptions& options);
  ~Replayer();
  void replays_a_guard();
  /// Any frame on the bus, in this order. line: of the log, for messages; 0: there is none. Throws
  /// std::runtime_error for what cannot be replayed.
  void on_frame(const hal::CanFrame& frame, std::uint64_t time_us, std::uint64_t line);
  /// The first answer of the controller that this core would not have given; "": none.
  const std::string& difference() const;
  const perception::LocalGrid* local_grid() const;
  const RecordingGuide* guide() const;
  ReplayResult result();

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

/// A core that takes the steps of a controller on this computer, from the frames of its bus, and so knows
/// what the bus does not carry.
class Shadow {
 public:
  Shadow(int robot, PlannerKind planner);
  /// Any frame on the bus, in this order; it is only kept. time_us: of any clock.
  void hear(const hal::CanFrame& frame, std::uint64_t time_us);
  /// Takes the steps that the frames heard have the answers of. False: there was none yet.
  bool follow();
  /// The first answer of the controller that this core would not have given; "": none.
  const std::string& difference() const;

  /// Of the last step.
  const Status& status() const { return status_; }
  /// Of the core as it is: other parameters begin another one. Null before its first step.
  const perception::LocalGrid* local_grid() const { return replayer_->local_grid(); }
  const RecordingGuide* guide() const { return replayer_->guide(); }

 private:
  struct Heard {
    hal::CanFrame frame;
    std::uint64_t time_us;
  };

  ReplayOptions options_;
  std::optional<Replayer> replayer_;
  std::vector<Heard> heard_;
  Status status_;
  bool stepped_ = false;
};

}  // namespace whisker::hil
