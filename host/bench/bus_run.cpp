#include "host/bench/bus_run.hpp"

#include <utility>

#include "firmware/can/codec.hpp"

namespace whisker::bench {
namespace {

using can::MessageKind;

/// After frames that were missed, the wheels may have rolled farther than in one period.
constexpr std::uint32_t kLongestPause_ms = 1000;

}  // namespace

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
