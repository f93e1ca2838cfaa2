#include "host/lab/bench/bus_state.hpp"

#include <utility>

#include "firmware/can/codec.hpp"
#include "host/harness/hil/overheard.hpp"

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

using can::MessageKind;

/// After frames that were missed, the wheels may have rolled farther than in one period.
constexpr std::uint32_t kLongestPause_ms = 1000;

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

BusRun::BusRun(int robot, const Params& params, Listener listener)
    : robot_(robot),
      listener_(std::move(listener)),
      overheard_(params, [this](can::Requester who, can::Order order, const can::Mission& mission) {
        const bool of_base = who == can::Requester::base;
        if (of_base) tick16_.reset();
        if (order == can::Order::start) begin(of_base ? mission : from_here(mission.goal), true);
      }) {}

void BusRun::on_frame(const hal::CanFrame& frame) {
  const std::optional<hil::Sender> sender = hil::sender_of(frame);
  if (!sender) return on_operator(frame);
  if (sender->robot != robot_ || !sender->whole) return;
  switch (sender->kind) {
    case MessageKind::wheel_command:
      return hil::with<can::WheelCommand>(frame, [&](const auto& m) { command_ = m; });
    case MessageKind::nav_status:
      return hil::with<can::NavStatus>(frame, [&](const auto& m) { on_status(m); });
    default: overheard_.on_frame(sender->kind, frame);
  }
}

/// Without the time of a frame, an operator is the same one always: it numbers its orders.
void BusRun::on_operator(const hal::CanFrame& frame) {
  const std::optional<hil::OperatorFrame> said = hil::operator_frame(frame);
  if (said && said->robot == robot_ && said->whole) overheard_.on_operator(said->kind, frame, 0);
}

void BusRun::begin(const can::Mission& mission, bool heard) {
  begun_ = true;
  odometry_ = {};
  odometry_.configure(overheard_.params());
  odometry_.place(mission.start);
  if (listener_.begins) listener_.begins(mission, overheard_.params(), heard);
}

void BusRun::on_status(const can::NavStatus& told) {
  if (tick16_ == told.tick || !command_ || command_->tick != told.tick) return;
  const can::InputSet* const set = overheard_.set_of(told.tick);
  if (set == nullptr) return;
  if (!begun_) begin({}, false);
  const std::uint32_t passed = tick16_ ? (set->tick - tick_) * set->period_ms : kLongestPause_ms;
  localization::CountStep step;
  if (set->counts_valid) {
    odometry_.update(
        set->counts,
        Duration::from_raw(static_cast<std::int32_t>(passed < kLongestPause_ms ? passed : kLongestPause_ms)),
        step);
  }
  tick16_ = told.tick;
  tick_ = set->tick;
  Status status = hil::status_of(told);
  status.command = command_->speeds;
  status.pose = odometry_.pose();
  if (listener_.stepped) listener_.stepped(*set, status);
}

}  // namespace whisker::bench
