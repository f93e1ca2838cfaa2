// Cost of encoding and decoding CAN frames, over all messages with varied content: one line each, with the
// minimum, mean and maximum instructions.
#include "firmware/can/codec.hpp"
#include "firmware/apps/work.hpp"

using namespace whisker;

namespace {

constexpr int kContents = 200;  // per message

images::Work writing;
images::Work reading;

template <class M>
[[gnu::noinline]] void write(const M& message, hal::CanFrame& frame) noexcept {
  frame = can::encode(message, 9, 7);
}

/// The same steps as in a node: CRC, counter, values.
template <class M>
[[gnu::noinline]] bool read(const hal::CanFrame& frame, can::AliveReceiver& alive, M& message) noexcept {
  uint8_t lost = 0;
  return frame.data[0] == can::crc_of(frame.id, frame.data, frame.size) &&
         alive.judge(can::counter_of(frame), lost) == can::Arrival::in_turn && can::decode(frame, message);
}

template <class F>
uint32_t spent(const F& call) noexcept {
  hal::Meter& meter = hal::board().meter;
  const uint32_t from = meter.stamp();
  call();
  return meter.between(from, meter.stamp());
}

uint32_t random() noexcept {
  static uint32_t state = 1;
  return state = state * 1664525 + 1013904223;
}

/// All zeros, all ones, then random content.
uint64_t content(int i) noexcept {
  return i < 2 ? uint64_t{0} - static_cast<uint64_t>(i) : uint64_t{random()} << 32 | random() >> 16;
}

template <class M>
void measure(const M&) noexcept {
  constexpr const can::Message& kMessage = can::message_of(M::kKind);
  can::AliveReceiver alive;
  for (int i = 0; i < kContents; ++i) {
    constexpr uint64_t kHead = 0xFFFF;
    const auto counter = static_cast<uint8_t>(i % can::kAliveModulus);
    hal::CanFrame frame =
        can::sealed(content(i) & ~kHead, can::id_of(kMessage.function, 9), kMessage.size, counter);
    M message;
    reading.add(spent([&] { read(frame, alive, message); }));
    writing.add(spent([&] { write(message, frame); }));
  }
}

}  // namespace

int main() {
  can::for_each_message([](const can::Message&, const auto& message) { measure(message); });
  measure(can::MissionValue{});
  const uint32_t own = hal::overhead(hal::board().meter);
  images::print_work("write", writing, own);
  images::print_work("read", reading, own);
  return 0;
}
