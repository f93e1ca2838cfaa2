#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "host/harness/pico/cable.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/plant.hpp"

namespace whisker::pico {

struct RigOptions {
  std::optional<std::uint64_t> seed;  ///< of the noise; none: that of the scenario
  double full_speed_mps = 0.4;        ///< of a wheel at full duty
  bool listens = false;               ///< gives neither parameters nor a goal
};

/// The rig of a board that runs in an emulator: the world, the wheels, and the other end of its cable.
class Rig {
 public:
  Rig(const Scenario& scenario, const RigOptions& options);
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// A millisecond. line: the duties of both motors, -32767 to 32767, and the bytes that the board has sent,
  /// in hexadecimal digits, or -. Returns the counts of both encoders; of each rangefinder distance in mm,
  /// status and sequence number; the pressed switches; sum and number of the gyro's samples; the speeds of
  /// both wheels in um/s; 1 after a contact; words of the robot; and the bytes for the board.
  std::string step(const std::string& line);
  /// A JSON object.
  std::string verdict() const;

  /// Adopts obstacles and goal of this scenario. The robot keeps its order.
  void change(const Scenario& scenario);

  const Scenario& scenario() const { return scenario_; }
  const sim::Plant& plant() const { return plant_; }
  const Cable& cable() const { return cable_; }

 private:
  std::int16_t speed(int duty) const;
  std::string answer(const std::string& goes) const;

  const double full_speed_mps_;
  Scenario scenario_;
  std::unique_ptr<SimWorld> world_;
  sim::WorldView view_;
  sim::Plant plant_;
  Cable cable_;
  std::uint64_t now_us_ = 0;
};

}  // namespace whisker::pico
