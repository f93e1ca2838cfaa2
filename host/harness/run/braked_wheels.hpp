#pragma once

#include "host/harness/sim/sim_board.hpp"

namespace whisker {

/// The simulated wheels. Once they have braked without the core, they refuse its next command, as a node of
/// the bus does, so that it starts again from standstill.
class BrakedWheels final : public hal::Drive {
 public:
  explicit BrakedWheels(hal::SimBoard& board) : board_(board) {}
  bool read(hal::EncoderCounts& out) noexcept override { return board_.read(out); }
  bool command(hal::WheelSpeeds speeds) noexcept override {
    const bool refused = refuses_;
    refuses_ = false;
    return board_.command(refused ? hal::WheelSpeeds{} : speeds) && !refused;
  }
  void refuse() { refuses_ = true; }

 private:
  hal::SimBoard& board_;
  bool refuses_ = false;
};

}  // namespace whisker
