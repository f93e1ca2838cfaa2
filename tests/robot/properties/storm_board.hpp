/// A board that alternates between correct phases and wrong readings, refusals, frozen values and jumps.
#pragma once

#include <cstdint>

#include "firmware/params.hpp"
#include "hal/drive.hpp"
#include "hal/rangefinders.hpp"
#include "tests/robot/properties/bits.hpp"

namespace whisker::test {

class StormBoard final : public hal::Rangefinders, public hal::Drive {
 public:
  /// fury 0: always correct; otherwise about one phase in `fury + 1` is correct.
  StormBoard(Bits bits, const Params& params, int fury);

  /// One control period passes.
  void pass();
  bool refused() const { return refused_; }  ///< the last command

  bool read(hal::RangeReadings& out) noexcept override;
  bool read(hal::EncoderCounts& out) noexcept override;
  bool command(hal::WheelSpeeds speeds) noexcept override;

 private:
  enum class Ranges { steady, noisy, frozen, absurd, refusing };
  enum class Wheels { obey, stand, run_on, absurd, refusing, silent };

  void begin_spell();
  void measure();

  Bits bits_;
  const Params& params_;
  int fury_;
  Ranges ranges_ = Ranges::steady;
  Wheels wheels_ = Wheels::obey;
  int spell_ = 0;  // ticks left
  int until_measurement_ = 0;
  int distance_mm_[hal::kBeams] = {0, 0, 0};
  hal::RangeReadings shown_{};
  hal::WheelSpeeds command_{};
  std::int64_t way_um_[2] = {0, 0};
  bool refused_ = false;
};

}  // namespace whisker::test
