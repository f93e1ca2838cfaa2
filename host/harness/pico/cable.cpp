#include "host/harness/pico/cable.hpp"

#include "firmware/can/param_server.hpp"
#include "firmware/params/words.hpp"
#include "host/harness/hil/overheard.hpp"

namespace whisker::pico {
namespace {

constexpr std::uint8_t kRobot = 1;
constexpr std::uint64_t kAgain_us = 200000;
/// For an answer.
constexpr std::uint64_t kPatience_us = 3000000;
/// The robot keeps the parameters and rests again.
constexpr std::uint64_t kRest_us = 400000;

}  // namespace

std::size_t Bytes::take(std::uint8_t* to, std::size_t room) noexcept {
  std::size_t taken = 0;
  for (; taken < room && !in_.empty(); ++taken) {
    to[taken] = in_.front();
    in_.pop_front();
  }
  return taken;
}

std::size_t Bytes::offer(const std::uint8_t* from, std::size_t count) noexcept {
  out_.append(reinterpret_cast<const char*>(from), count);
  return count;
}

Cable::Cable(const Params& params, PlannerKind planner, const planning::Goal& goal)
    : params_(params),
      planner_(planner),
      goal_(goal),
      tap_(line_, [this](const hal::CanFrame& frame) { hear(frame); }),
      orders_(tap_, kRobot) {}

std::string Cable::step(std::uint64_t now_us, const std::string& came) {
  now_us_ = now_us;
  // What is said to a robot that still starts gets lost.
  speaks_ = speaks_ || !came.empty();
  if (!speaks_) return {};
  bytes_.arrive(came);
  hal::CanPort& port = orders_.port();
  port.poll(static_cast<std::uint32_t>(now_us / 1000));
  for (hal::CanFrame frame; port.receive(frame);) {
    // The queue holds only some of what a millisecond brings.
    port.poll(static_cast<std::uint32_t>(now_us / 1000));
  }
  if (shadow_) followed_ = shadow_->follow();
  if (!listens_) act();
  port.poll(static_cast<std::uint32_t>(now_us / 1000));
  return bytes_.leave();
}

void Cable::hear(const hal::CanFrame& frame) {
  ++frames_;
  if (shadow_) shadow_->hear(frame, now_us_);
  const auto sender = hil::sender_of(frame);
  if (!sender || !sender->whole || sender->robot != kRobot) return;
  const bool of_base = sender->party == can::Party::base;
  switch (sender->kind) {
    case can::MessageKind::heartbeat:
      hil::with<can::Heartbeat>(frame, [&](const auto& m) { (of_base ? base_ : controller_) = m; });
      break;
    case can::MessageKind::nav_status:
      hil::with<can::NavStatus>(frame, [&](const auto& m) { status_ = m; });
      if (shadow_) ++answers_;
      break;
    case can::MessageKind::wheel_command:
      hil::with<can::WheelCommand>(frame, [&](const auto& m) { command_ = m; });
      break;
    case can::MessageKind::param_reply:
      hil::with<can::ParamReply>(frame, [&](const auto& m) {
        if (m.to_operator != 0) reply_ = m;
      });
      break;
    default: break;
  }
}

bool Cable::runs() const {
  return controller_.state == can::NodeState::running && base_.state == can::NodeState::running;
}

template <class M>
void Cable::send(const M& message) {
  tap_.send(can::encode(message, kRobot, alive_.next()), can::kEventLife_ms);
}

void Cable::enter(Phase phase) {
  phase_ = phase;
  since_us_ = now_us_;
  asked_us_.reset();
  reply_.reset();
}

void Cable::give_up(const std::string& why) {
  trouble_ = why;
  enter(Phase::gave_up);
}

bool Cable::asked(const can::ParamRequest& request) {
  const std::string what = request.action == can::ParamAction::commit
                               ? "the parameters"
                               : "parameter " + std::to_string(request.index);
  if (reply_ && reply_->index == request.index && reply_->status != can::ParamStatus::busy) {
    if (reply_->status == can::ParamStatus::ok) return true;
    give_up(what + ": " + can::kParamStatusWords[static_cast<int>(reply_->status)]);
  } else if (now_us_ - since_us_ > kPatience_us) {
    give_up(what + ": no answer");
  } else if (!asked_us_ || now_us_ - *asked_us_ >= kAgain_us) {
    asked_us_ = now_us_;
    send(request);
  }
  return false;
}

void Cable::act() {
  switch (phase_) {
    case Phase::waits:
      if (!runs()) {
        since_us_ = now_us_;
      } else if (now_us_ - since_us_ > kRest_us) {
        // From here on, the frames say all that a core on this computer needs.
        shadow_.emplace(kRobot, planner_);
        enter(Phase::sends);
      }
      return;
    case Phase::sends:
      for (std::uint32_t raw = 0; index_ < kParams; ++index_) {
        if (!can::read_param(params_, index_, raw)) continue;
        if (!asked({can::ParamAction::write, index_, raw})) return;
        enter(Phase::sends);
      }
      return enter(Phase::commits);
    case Phase::commits:
      if (asked({can::ParamAction::commit, can::kCommitIndex, 0})) enter(Phase::rests);
      return;
    case Phase::rests:
      if (!runs()) since_us_ = now_us_;
      if (now_us_ - since_us_ < kRest_us) return;
      orders_.begin();
      return enter(Phase::orders);
    case Phase::orders:
      if (!orders_.answered(can::Order::start, goal_, now_us_)) {
        if (now_us_ - since_us_ > kPatience_us) give_up("the goal: no answer");
        return;
      }
      if (!orders_.accepted()) return give_up("the goal is refused");
      ordered_us_ = now_us_;
      return enter(Phase::drives);
    case Phase::drives:
    case Phase::gave_up: return;
  }
}

}  // namespace whisker::pico
