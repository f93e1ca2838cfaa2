#pragma once

#include "hal/bumper.hpp"
#include "hal/drive.hpp"
#include "hal/gyro.hpp"
#include "hal/rangefinders.hpp"
#include "host/harness/sim/plant.hpp"

namespace whisker::hal {

/// The simulated robot as a board. It never refuses, except for a gyro that is not there or dead; tests wrap
/// it to add refusals.
class SimBoard final : public Rangefinders, public Drive, public Bumper, public Gyro {
 public:
  explicit SimBoard(sim::Plant& plant) noexcept : plant_(plant) {}

  bool read(RangeReadings& out) noexcept override {
    out = plant_.ranges();
    return true;
  }
  bool read(EncoderCounts& out) noexcept override {
    out = plant_.encoders();
    return true;
  }
  bool read(BumperReading& out) noexcept override {
    out = plant_.bumper();
    return true;
  }
  bool read(GyroReading& out) noexcept override {
    if (!plant_.gyro_answers()) return false;
    out = plant_.gyro();
    return true;
  }
  bool command(WheelSpeeds speeds) noexcept override {
    plant_.command(speeds);
    return true;
  }

 private:
  sim::Plant& plant_;
};

}  // namespace whisker::hal
