#include "hal/boards/stm32f405/robot_board.hpp"

#include "hal/boards/stm32f405/wiring.hpp"

namespace whisker::hal::stm32f405 {

RobotBoard::RobotBoard(const RangerKind& kind, const mcu::MotorParams& left, const mcu::MotorParams& right,
                       const GyroParams& gyro, Facing facing) noexcept
    : tof_(kind, bus_, node_.troubles()),
      gyro_(gyro, facing, bus_, node_.troubles()),
      has_gyro_(gyro.fitted == Fitted::yes),
      infrared_(mcu::kGp2y0a21, mcu::kGp2y0a21PeriodMs, wiring::kInfraredChannel, adc_),
      beams_(tof_, infrared_),
      wheels_(left, right, motors_, encoders_, node_.ticker()) {}

void RobotBoard::start() noexcept {
  node_.start();
  motors_.start(node_.clocks());
  encoders_.start();
  bus_.start(node_.clocks(), node_.troubles());
  adc_.start(node_.clocks(), node_.troubles());
  node_.watch();
  const uint32_t now = node_.now_ms();
  tof_.start(now);
  gyro_.start(now);
  infrared_.start(now);
}

void RobotBoard::poll(const Status& status, const char* calibration) noexcept {
  const uint32_t now = node_.now_ms();
  node_.can().poll(now);
  tof_.poll(now);
  if (has_gyro_) gyro_.poll(now);
  infrared_.poll(now);
  switches_.poll(now);
  button_.poll(now);
  node_.report(status, calibration);
}

}  // namespace whisker::hal::stm32f405
