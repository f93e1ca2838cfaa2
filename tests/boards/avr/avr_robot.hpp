#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "firmware/health.hpp"
#include "firmware/planning/planner.hpp"
#include "host/sim/plant.hpp"

struct avr_t;

namespace whisker::hal::atmega1284p {

/// The image of the ATmega328P's robot in a cycle-exact emulator, in a simulated world: pulse widths turn its
/// wheels, its encoders' edges, the echoes of its shots and its infrared voltages come from where it stands.
class AvrRobot {
 public:
  /// Throws std::runtime_error if the image cannot be loaded. The world must outlive it.
  AvrRobot(const std::string& image, const sim::WorldView& world);
  ~AvrRobot();
  AvrRobot(const AvrRobot&) = delete;
  AvrRobot& operator=(const AvrRobot&) = delete;

  void run(double seconds);
  template <class Done>
  bool run_until(double seconds, Done done) {
    for (const double end = plant_.time() + seconds; plant_.time() < end;) {
      run(0.02);
      if (done()) return true;
    }
    return false;
  }

  /// What the image shows.
  Fault fault() const;
  planning::Outcome outcome() const;
  int troubles() const;
  double duty(int wheel) const;  ///< -1..1 as the pins say
  const sim::Plant& plant() const { return plant_; }

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t worst_tick_cycles() const { return worst_tick_; }
  double longest_period_ms() const { return longest_period_ / 16000.0; }
  double shortest_period_ms() const { return shortest_period_ / 16000.0; }
  int static_ram() const { return static_ram_; }
  int deepest_stack() const;
  bool crashed() const { return crashed_; }

  // Faults.
  bool echo_dead[3] = {};
  bool echo_line_high = false;  ///< from now on
  bool encoder_dead[2] = {};
  bool infrared_only = false;  ///< the sonars see nothing, as with a wall that reflects them away

 private:
  struct Hooks;
  void slice();
  void move_on();
  void see();
  void turn(int wheel, int edges);
  void step_edges();
  void shot(int beam);
  void mark(std::uint8_t value);
  double distance(int beam, double half_cone_rad) const;

  const sim::WorldView& world_;
  sim::Plant plant_;
  avr_t* avr_ = nullptr;
  std::unique_ptr<Hooks> hooks_;
  int edges_left_[2] = {};
  int phase_[2] = {};
  EncoderCounts seen_{};
  std::uint64_t slices_ = 0;
  std::uint64_t ticks_ = 0;
  std::uint64_t began_ = 0;
  std::uint64_t worst_tick_ = 0;
  double longest_period_ = 0;
  double shortest_period_ = 1e18;
  int static_ram_ = 0;
  int lowest_stack_ = 0xFFFF;
  bool crashed_ = false;
};

}  // namespace whisker::hal::atmega1284p
