/// A robot of the playground that is driven by an emulated Raspberry Pi Pico.
#pragma once

#include <string>

#include "host/harness/pico/rig.hpp"
#include "host/lab/play/simulated_robot.hpp"

namespace whisker::play {

/// The robot of host/robots/pico.toml in this world.
Scenario with_pico(Scenario scenario);

class PicoRobot final : public SimulatedRobot {
 public:
  /// scenario: of with_pico().
  explicit PicoRobot(const Scenario& scenario);

  /// As pico::Rig::step().
  std::string step(const std::string& line);
  const pico::Rig& rig() const { return rig_; }

  /// Nothing: time passes with step().
  void advance(int) override {}
  void change(const Scenario& scenario) override { rig_.change(scenario); }

  TickRecord record() const override;
  RunResult result() const override;
  bool over() const override;
  Fault fault() const override { return static_cast<Fault>(rig_.cable().status().fault); }
  const perception::LocalGrid* local_grid() const override;
  Pose grid_pose() const override;
  const Params& params() const override { return rig_.scenario().robot; }
  const std::optional<MapPicture>& map() const override { return map_.last(); }
  std::int32_t map_bytes() const override { return kDefaultPlanner.map_bytes; }

 private:
  bool stands() const;

  pico::Rig rig_;
  MapWatch map_;
  bool ran_ = false;  // the mission
  std::uint64_t ms_ = 0;
};

}  // namespace whisker::play
