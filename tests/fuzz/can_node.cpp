/// Any frames at any times, some with a valid CRC and counter: the wheels turn only while the base runs, no
/// velocity counts before the operator is armed, and every frame is accounted for.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "firmware/can/base_node.hpp"
#include "firmware/can/controller_node.hpp"
#include "firmware/can/table_hash.hpp"
#include "host/harness/bus/memory_bus.hpp"

namespace {

using namespace whisker;
using namespace whisker::can;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Takes the bytes of the input in order; zeros after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  bool ended() const { return at_ == end_; }
  std::uint8_t next() { return at_ < end_ ? *at_++ : std::uint8_t{0}; }

 private:
  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

std::uint32_t accounted(const BusHealth& h) {
  return h.accepted + h.foreign + h.malformed + h.crc + h.repeated + h.out_of_sequence + h.out_of_range +
         h.unmatched + h.duplicates + h.e_stops;
}

class Bench {
 public:
  Bench() { controller_.accept_operator_orders(); }
  void step(Bytes& bytes) {
    const std::uint8_t what = bytes.next();
    if (what < 64) {
      pass(what);
    } else if (what < 80) {
      base_.give(static_cast<Order>(what % 3), {{}, {{}, 1_m}}, static_cast<SyncMode>(what & 1));
    } else if (what < 88) {
      greet(what);
    } else {
      send(what, bytes);
    }
  }
  void check() const {
    require(accounted(base_.health()) == base_port_.counts().received);
    require(accounted(controller_.health()) == controller_port_.counts().received);
  }

 private:
  /// Sealed as by the other node, so that the fuzzer need not find a valid CRC.
  void greet(std::uint8_t what) {
    const std::uint8_t node = (what & 1) != 0 ? 1 : 9;
    Heartbeat beat;
    beat.boot = what >> 1;
    inject(encode(beat, node, next(MessageKind::heartbeat)));
    inject(encode(Info{InfoPart::table_hash, beat.boot, kTableHash}, node, next(MessageKind::info)));
  }
  void send(std::uint8_t what, Bytes& bytes) {
    hal::CanFrame frame{};
    const auto kind = static_cast<MessageKind>(bytes.next() % kKinds);
    frame.id = id_of(message_of(kind).function, what & 0x0F);
    frame.size = message_of(kind).size;
    frame.extended = what > 250;
    frame.remote = what > 245 && what <= 250;
    for (std::uint8_t& byte : frame.data) byte = bytes.next();
    if (what < 200) {
      frame.data[1] = static_cast<std::uint8_t>((frame.data[1] & 0xF0) | next(kind));
      frame.data[0] = crc_of(frame.id, frame.data, frame.size);
    } else if (what < 210) {
      frame.size = static_cast<std::uint8_t>(what % 9);
    }
    inject(frame);
  }
  std::uint8_t next(MessageKind kind) { return alive_[static_cast<int>(kind)].next(); }
  void inject(const hal::CanFrame& frame) {
    third_.send(frame, 100);
    pass(1);
  }
  void pass(int ms) {
    for (int i = 0; i < ms; ++i) {
      third_.poll(++now_);
      controller_.poll(now_);
      Order order = Order::cancel;
      Mission mission;
      if (controller_.take_operator_order(order, mission.goal)) require(!calibrates(order));
      if (controller_.take_order(order, mission)) inbox_.disarm();
      VelocityCommand velocity;
      std::uint32_t age_ms = 0;
      if (inbox_.take(velocity, now_, age_ms)) require(inbox_.armed());
      VouchRequest vouch;
      if (inbox_.take(vouch)) require(vouch.radius_mm > 0);
      InputSet set;
      if (controller_.take_set(set)) controller_.answer({1000, -1000}, {});
      base_.poll(now_);
      if (now_ % 10 != 0) continue;
      base_.send_set({++tick_, 10, {}, {}, true},
                     base_.lockstep() ? SyncMode::lockstep : SyncMode::real_time);
      const hal::WheelSpeeds before = speeds_;
      speeds_ = base_.control();
      const bool slower = std::abs(speeds_.left) <= std::max(std::abs(before.left) - 100, 0) ||
                          std::abs(speeds_.right) <= std::max(std::abs(before.right) - 100, 0);
      require(base_.state() == NodeState::running || slower);
    }
    hal::CanFrame frame{};
    while (third_.receive(frame)) {
    }
  }

  bus::MemoryBus wire_;
  bus::MemoryPort& base_port_ = wire_.attach();
  bus::MemoryPort& controller_port_ = wire_.attach();
  bus::MemoryPort& third_ = wire_.attach();
  BaseNode base_{base_port_, {1, 500, 0}, 100};
  OperatorInbox inbox_;
  ControllerNode controller_{controller_port_, {1, 600, 0}, nullptr, &inbox_};
  AliveSender alive_[kKinds];
  hal::WheelSpeeds speeds_{};
  std::uint32_t now_ = 0;
  std::uint32_t tick_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, std::min<std::size_t>(size, 2000));
  Bench bench;
  while (!bytes.ended()) bench.step(bytes);
  bench.check();
  return 0;
}
