/// One robot of the playground, whoever drives it. Its world may change while it drives.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/health.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/perception/local_grid.hpp"
#include "host/harness/run/map_picture.hpp"
#include "host/harness/run/record.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/geometry.hpp"
#include "host/harness/sim/plant.hpp"

namespace whisker::play {

class SimulatedRobot {
 public:
  virtual ~SimulatedRobot() = default;

  /// Runs up to this number of ticks; fewer if the drive is over.
  virtual void advance(int ticks) = 0;
  /// Adopts obstacles and goal of this scenario; start, noise, seed and time limit stay.
  virtual void change(const Scenario& scenario) = 0;

  virtual TickRecord record() const = 0;
  /// The verdict is valid only if it is over.
  virtual RunResult result() const = 0;
  virtual bool over() const = 0;
  virtual Fault fault() const = 0;
  /// Null: it has none now.
  virtual const perception::LocalGrid* local_grid() const = 0;
  /// Its pose in the frame of the local grid.
  virtual Pose grid_pose() const = 0;
  virtual const Params& params() const = 0;
  /// The planner's map; none without one.
  virtual const std::optional<MapPicture>& map() const = 0;
  virtual std::int32_t map_bytes() const = 0;

  /// A place on the path, and the class of the path up to it.
  struct Passed {
    sim::Vec2 at;
    int kind;
  };
  /// The path so far: consecutive places are at least 5 mm apart unless the class changed.
  const std::vector<Passed>& way() const { return way_; }

 protected:
  SimulatedRobot() = default;
  SimulatedRobot(const SimulatedRobot&) = delete;
  SimulatedRobot& operator=(const SimulatedRobot&) = delete;

  void note(sim::Vec2 at, int kind);

 private:
  std::vector<Passed> way_;
};

/// What a robot that takes `origin` for its own believes, in the world.
sim::Pose in_world(const sim::Pose& origin, const Pose& believed);

void add_estimate(const sim::Pose& believed, TickRecord& record);

/// Where the drive has led; verdict, time and hash are those of its driver.
RunResult way_of(const sim::Plant& plant, const Scenario& scenario, std::uint64_t ticks);

}  // namespace whisker::play
