/// What a controller that calibrates has found and kept. The form is that of messages.hpp.
#pragma once

#include <stdint.h>

#include "firmware/calibration/values.hpp"
#include "firmware/can/message_kind.hpp"
#include "firmware/can/signals.hpp"
#include "firmware/planning/calibration/trouble.hpp"
#include "firmware/storage/slots.hpp"

namespace whisker::can {

// clang-format off
// {name, start, length, signed, min, max, factor, unit, about, part, word}

struct CalibrationReport {
  static constexpr MessageKind kKind = MessageKind::calibration;
  static constexpr int32_t kMostValue = (INT32_C(1) << 22) - 1, kMostSigma = (1 << 13) - 1;
  calibration::Quantity quantity = calibration::Quantity::gyro_scale;
  planning::Trouble trouble = planning::Trouble::not_finished;
  storage::Stored stored = storage::Stored::nothing;
  uint8_t mission = 0;
  uint32_t value = 0;
  uint16_t sigma = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Quantity", 12, 2, false, 0, calibration::kQuantities - 1, "1", "", "the parameter", kAlways, word_of<calibration::Quantity, calibration::kQuantities>}, m.quantity);
    f({"Trouble", 14, 4, false, 0, planning::kTroubles - 1, "1", "", "of the last calibration: why it has no result, or none", kAlways, word_of<planning::Trouble, planning::kTroubles>}, m.trouble);
    f({"Stored", 18, 3, false, 0, storage::kStoreds - 1, "1", "", "result of the last save, or of the load at the start", kAlways, word_of<storage::Stored, storage::kStoreds>}, m.stored);
    f({"Mission", 21, 8, false, 0, kMost8, "1", "", "the last order that was accepted"}, m.mission);
    f({"Value", 29, 22, false, 0, kMostValue, "1", "", "raw value of the parameter; 0: not measured"}, m.value);
    f({"Sigma", 51, 13, false, 0, kMostSigma, "0.000001", "", "its standard deviation, relative; saturates"}, m.sigma);
  }
};
// clang-format on

}  // namespace whisker::can
