#include "host/harness/hil/operator_orders.hpp"

#include "firmware/can/codec.hpp"
#include "host/harness/hil/overheard.hpp"

namespace whisker::hil {

OperatorOrders::OperatorOrders(hal::CanPort& port, std::uint8_t robot)
    : tap_(port, [this](const hal::CanFrame& frame) { on_frame(frame); }), robot_(robot) {}

void OperatorOrders::on_frame(const hal::CanFrame& frame) {
  const std::optional<Sender> from = sender_of(frame);
  if (!from || from->kind != can::MessageKind::mission_reply || from->robot != robot_ || !from->whole) return;
  with<can::MissionReply>(frame, [this](const auto& m) {
    if (m.to_operator != 0 && m.mission == number_) answer_ = m.status;
  });
}

void OperatorOrders::begin() {
  ++number_;
  answer_.reset();
  sent_us_.reset();
}

template <class M>
void OperatorOrders::send(const M& message) {
  tap_.send(can::encode(message, robot_, alive_.next()), can::kEventLife_ms);
}

bool OperatorOrders::answered(can::Order order, const planning::Goal& goal, std::uint64_t now_us) {
  if (answer_ && *answer_ != can::MissionStatus::incomplete) return true;
  if (sent_us_ && now_us - *sent_us_ < std::uint64_t{can::kOrderRepeat_ms} * 1000) return false;
  sent_us_ = now_us;
  const can::MissionValues values = can::values_of({{}, goal});
  for (int i = 0; i < can::kMissionValues; ++i)
    send(can::MissionValue{static_cast<can::MissionPart>(i + 1), number_, values.of[i]});
  send(can::MissionOrder{can::MissionPart::order, number_, order, can::digest_of(values)});
  return false;
}

}  // namespace whisker::hil
