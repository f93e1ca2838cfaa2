#include "host/bench/bus_state.hpp"

#include "firmware/can/codec.hpp"
#include "host/hil/overheard.hpp"

namespace whisker::bench {
namespace {

template <class M>
void keep(const hal::CanFrame& frame, std::optional<M>& last) {
  M message;
  if (can::decode(frame, message)) last = message;
}

template <can::MessageKind kKind>
void keep_range(const hal::CanFrame& frame, std::optional<hal::RangeReading>& last) {
  can::Range<kKind> range;
  if (can::decode(frame, range) && can::InputSets::sound(range.reading)) last = range.reading;
}

}  // namespace

bool stands(const can::WheelCommand& command) {
  return command.mode == can::DriveMode::stop || (command.speeds.left == 0 && command.speeds.right == 0);
}

bool BusState::on_frame(const hal::CanFrame& frame, int robot) {
  const std::optional<hil::Sender> sender = hil::sender_of(frame);
  if (!sender || sender->robot != robot || !sender->whole) return false;
  ++frames;
  switch (sender->kind) {
    case can::MessageKind::nav_status: keep(frame, status); break;
    case can::MessageKind::wheel_command: keep(frame, command); break;
    case can::MessageKind::wheel_state: keep(frame, wheels); break;
    case can::MessageKind::range_left:
      keep_range<can::MessageKind::range_left>(frame, beams[hal::kLeft]);
      break;
    case can::MessageKind::range_front:
      keep_range<can::MessageKind::range_front>(frame, beams[hal::kFront]);
      break;
    case can::MessageKind::range_right:
      keep_range<can::MessageKind::range_right>(frame, beams[hal::kRight]);
      break;
    case can::MessageKind::range_trust: keep(frame, trust); break;
    case can::MessageKind::pose_sigma: keep(frame, sigma); break;
    case can::MessageKind::guard_status: keep(frame, guard); break;
    case can::MessageKind::sync: keep(frame, sync); break;
    default: break;
  }
  return true;
}

}  // namespace whisker::bench
