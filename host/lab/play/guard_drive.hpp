/// A robot of the playground that the user drives, behind the guard or without it.
#pragma once

#include <memory>

#include "host/harness/run/sim_world.hpp"
#include "host/lab/guard/guarded_body.hpp"
#include "host/lab/play/simulated_robot.hpp"

namespace whisker::play {

class GuardDrive final : public SimulatedRobot {
 public:
  /// Which parts are on.
  struct Switches {
    bool guarded = true, nods = true, assist = true;
  };
  /// Stands at the scenario's start. The table is that of the assist; it must outlive the drive, and its
  /// changes take effect at once. Until the first change() or set(), the commands equal those of
  /// `whisker guard` for the same asked velocities.
  GuardDrive(const Scenario& scenario, const Switches& switches, const fuzzy::Bilinear::Table& table);

  /// The asked velocity from the next tick on; it is given again every tick.
  void command(const guard::Twist& twist) { twist_ = twist; }
  /// The body stops first, as before; then a new guard takes over where it stands.
  void set(const Switches& switches);
  const Switches& switches() const { return switches_; }
  const guard::GuardedBody& body() const { return body_; }

  void advance(int ticks) override;
  void change(const Scenario& scenario) override;
  TickRecord record() const override;
  RunResult result() const override;
  /// A contact, or a fault once the body stands.
  bool over() const override { return body_.plant().in_contact() || (body_.faulted() && body_.stands()); }
  Fault fault() const override;
  const perception::LocalGrid* local_grid() const override { return body_.local_grid(); }
  Pose grid_pose() const override;
  const Params& params() const override { return scenario_.robot; }
  const std::optional<MapPicture>& map() const override { return no_map_; }
  std::int32_t map_bytes() const override { return 0; }

 private:
  guard::Wiring wiring() const;
  int reason() const;

  Scenario scenario_;
  const fuzzy::Bilinear::Table& table_;
  std::unique_ptr<SimWorld> world_;
  sim::WorldView view_;
  Switches switches_;
  guard::GuardedBody body_;
  guard::Twist twist_;
  bool rewires_ = false;
  std::uint64_t ticks_ = 0;
  std::optional<MapPicture> no_map_;
};

}  // namespace whisker::play
