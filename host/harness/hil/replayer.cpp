#include "host/harness/hil/replayer.hpp"

#include <array>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "firmware/apps/can/remote_robot.hpp"
#include "firmware/apps/command_hash.hpp"
#include "firmware/can/codec.hpp"
#include "host/harness/hil/guard_replay.hpp"
#include "host/harness/hil/overheard.hpp"
#include "host/harness/hil/planners.hpp"

namespace whisker::hil {
namespace {

using can::MessageKind;

}  // namespace

class Replayer::Inside {
 public:
  explicit Inside(const ReplayOptions& options)
      : options_(options),
        rules_(std::make_shared<HostRules>(options.planner)),
        planners_(options.planner, rules_.get()),
        pilot_(std::make_unique<can_app::RemoteRobot>(planners_)) {
    result_.robot = options.robot;
  }

  void replays_a_guard() { result_.guard = true; }

  void on_frame(const hal::CanFrame& frame, std::uint64_t time_us, std::uint64_t line) {
    line_ = line;
    const std::optional<Sender> sender = sender_of(frame);
    if (!sender) return hear_operator(frame, time_us);
    if (result_.robot == 0 && sender->whole) result_.robot = sender->robot;
    if (sender->robot != result_.robot) return;
    ++(sender->whole ? result_.frames : result_.damaged);
    if (sender->whole) execute(sender->kind, frame);
  }

  const std::string& difference() const { return result_.difference; }
  const RecordingPlanners& planners() const { return planners_; }

  ReplayResult result() {
    step_guard(nullptr);
    ReplayResult out = result_;
    out.hash = hash_.value();
    out.planner = rules_->kind();
    out.rules = rules_;
    return out;
  }

 private:
  void execute(MessageKind kind, const hal::CanFrame& frame) {
    if (kind == MessageKind::guard_status) {
      result_.guard = true;
      return with<can::GuardReport>(frame, [&](const auto& m) {
        if (GuardReplay::of_a_step(m)) step_guard(&m);
      });
    }
    if (result_.guard && kind == MessageKind::nav_status) return;
    if (result_.guard && kind == MessageKind::wheel_command) {
      return with<can::WheelCommand>(frame, [&](const auto& m) { answer_guard(m); });
    }
    switch (kind) {
      case MessageKind::wheel_command:
        return with<can::WheelCommand>(frame, [&](const auto& m) { compare(m, can::counter_of(frame)); });
      case MessageKind::nav_status: return with<can::NavStatus>(frame, [&](const auto& m) { compare(m); });
      case MessageKind::heartbeat:
        return with<can::Heartbeat>(frame, [&](const auto& m) { watch(frame.id, m); });
      case MessageKind::rules_part:
        return with<can::RulesPart>(frame, [&](const auto& m) {
          if (can::RulesServer* const rules = rules_->server()) rules->take(m);
        });
      case MessageKind::rules_order:
        return with<can::RulesOrder>(frame, [&](const auto& m) { rules_order_ = m; });
      case MessageKind::rules_reply: return with<can::RulesReply>(frame, [&](const auto& m) { follow(m); });
      default: overheard_.on_frame(kind, frame);
    }
  }

  void accept(can::Requester who, can::Order order, const can::Mission& mission) {
    if (who != can::Requester::base) return accept_operator(order, mission.goal);
    if (calibrates(order)) {
      throw std::runtime_error(
          "the log has a calibration: what the controller kept before is not in it, so it cannot be "
          "replayed");
    }
    // The log may lack the GuardStatus of the last answer before the order.
    step_guard(nullptr);
    pilot_->execute(order, mission, overheard_.params());
    guard_.execute(order, overheard_.params());
    if (order == can::Order::start) {
      ++result_.missions;
      if (options_.begins) options_.begins(mission, overheard_.params());
    }
    braked_ = order == can::Order::resume;
    stepped_ = false;
  }

  /// The pose is not in the log: it is the estimate of the last step.
  void accept_operator(can::Order order, const planning::Goal& goal) {
    if (!pilot_->ready()) return;
    const bool anew = order == can::Order::start;
    if (anew) ++result_.missions;
    if (anew && options_.begins) options_.begins({status_.pose, goal}, overheard_.params());
    pilot_->execute_operator(order, goal, overheard_.params());
  }

  void hear_operator(const hal::CanFrame& frame, std::uint64_t time_us) {
    const std::optional<OperatorFrame> said = operator_frame(frame);
    if (!said || said->robot != result_.robot || !said->whole) return;
    const auto hear = [this](const auto& m) { guard_.on_frame(m); };
    if (said->kind == MessageKind::velocity) with<can::VelocityCommand>(frame, hear);
    if (said->kind == MessageKind::vouch) with<can::VouchRequest>(frame, hear);
    overheard_.on_operator(said->kind, frame, time_us);
  }

  /// In lockstep an answer is repeated. Another one means that the log lacks the GuardStatus of the last.
  void answer_guard(const can::WheelCommand& answer) {
    const bool drives = answer.mode == can::DriveMode::drive;
    if (drives && stepped_ && answer.tick == tick16_) return;
    if (drives && guard_.waits() && answer.tick == waits_for_) return;
    step_guard(nullptr);
    guard_.on_frame(answer);
    waits_for_ = answer.tick;
  }

  /// told: null if the log lacks it.
  void step_guard(const can::GuardReport* told) {
    const std::optional<GuardReplay::Answer> answer = guard_.take();
    if (!answer) return;
    const can::InputSet* const set = overheard_.set_of(answer->command.tick);
    if (set == nullptr || !guard_.ready()) {
      ++result_.unknown;
      return;
    }
    const GuardReplay::Step step = guard_.step(*set, *answer, told);
    stepped_ = true;
    tick16_ = answer->command.tick;
    ++result_.steps;
    ++result_.compared;
    if (told == nullptr) ++result_.missing;
    hash_.add(step.command);
    differ(step.difference);
  }

  /// The controller has executed an order: what it drives with is in the log.
  void follow(const can::RulesReply& reply) {
    if (reply.status != can::RulesStatus::activated || !rules_order_ || rules_order_->upload != reply.upload)
      return;
    if (can::RulesServer* const rules = rules_->server()) rules->execute(*rules_order_);
    rules_order_.reset();
  }

  void watch(std::uint32_t id, const can::Heartbeat& beat) {
    std::optional<std::uint16_t>& boot = boots_[(id & 0x0F) >= can::kBaseOffset ? 0 : 1];
    if (boot && *boot != beat.boot) overheard_.restarted();
    boot = beat.boot;
  }

  /// Steps on the input set of this tick, unless done already. False if that is impossible.
  bool reach(std::uint16_t tick16) {
    if (stepped_ && tick16 == tick16_) return true;
    const can::InputSet* const set = overheard_.set_of(tick16);
    if (set == nullptr || !pilot_->ready()) {
      ++result_.unknown;
      return false;
    }
    step(*set);
    return true;
  }

  void step(const can::InputSet& set) {
    status_ = pilot_->step(set, braked_);
    braked_ = false;
    stepped_ = true;
    tick16_ = static_cast<std::uint16_t>(set.tick);
    ++result_.steps;
    hash_.add(status_.command);
    if (options_.stepped) options_.stepped(set, status_, planners_.local_grid(), planners_.guide());
  }

  /// Answers missing from the log leave a gap in the counters; the core made these steps, so repeat them.
  void fill_gap(std::uint16_t to, std::uint8_t counter) {
    const int lost = (counter + 2 * can::kAliveModulus - counter_ - 1) % can::kAliveModulus;
    const auto between = static_cast<std::uint16_t>(to - tick16_ - 1);
    if (!stepped_ || lost == 0 || between != lost) return;
    for (int i = 0; i < lost; ++i) {
      if (const can::InputSet* set = overheard_.set_of(static_cast<std::uint16_t>(tick16_ + 1))) {
        step(*set);
        ++result_.missing;
      }
    }
  }

  void compare(const can::WheelCommand& recorded, std::uint8_t counter) {
    if (recorded.mode == can::DriveMode::drive) {
      if (!stepped_ || recorded.tick != tick16_) fill_gap(recorded.tick, counter);
      if (reach(recorded.tick)) {
        ++result_.compared;
        differ(difference_of(recorded, "core", status_.command));
      }
    } else {
      braked_ = true;
    }
    counter_ = counter;
  }

  void compare(const can::NavStatus& recorded) {
    if (!reach(recorded.tick)) return;
    ++result_.compared;
    can::NavStatus now = can_app::nav_status(status_);
    now.tick = recorded.tick;
    if (can::bits_of(can::encode(now, 0, 0)) != can::bits_of(can::encode(recorded, 0, 0))) {
      const auto words = [](const can::NavStatus& s) {
        return std::string(planning::name(s.state)) + " (" + planning::name(s.why) + ")";
      };
      differ("tick " + std::to_string(recorded.tick) + ": recorded " + words(recorded) + ", the core says " +
             words(now));
    }
  }

  void differ(const std::string& what) {
    if (what.empty() || !result_.difference.empty()) return;
    result_.difference = line_ == 0 ? what : "line " + std::to_string(line_) + ": " + what;
  }

  const ReplayOptions& options_;
  std::shared_ptr<HostRules> rules_;
  RecordingPlanners planners_;
  std::unique_ptr<can_app::RemoteRobot> pilot_;
  GuardReplay guard_;
  ReplayResult result_;
  CommandHash hash_;
  std::uint64_t line_ = 0;  // 0: not from a log

  std::optional<can::RulesOrder> rules_order_;  // not answered
  Overheard overheard_{Params{}, [this](auto who, auto order, const auto& m) { accept(who, order, m); }};
  std::array<std::optional<std::uint16_t>, 2> boots_;

  Status status_;
  bool stepped_ = false;
  bool braked_ = false;
  std::uint16_t tick16_ = 0;
  std::uint16_t waits_for_ = 0;  // tick of the guard's answer
  std::uint8_t counter_ = 0;
};

Replayer::Replayer(const ReplayOptions& options) : inside_(std::make_unique<Inside>(options)) {}
Replayer::~Replayer() = default;
void Replayer::replays_a_guard() { inside_->replays_a_guard(); }
void Replayer::on_frame(const hal::CanFrame& frame, std::uint64_t time_us, std::uint64_t line) {
  inside_->on_frame(frame, time_us, line);
}
const std::string& Replayer::difference() const { return inside_->difference(); }
const perception::LocalGrid* Replayer::local_grid() const { return inside_->planners().local_grid(); }
const RecordingGuide* Replayer::guide() const { return inside_->planners().guide(); }
ReplayResult Replayer::result() { return inside_->result(); }

Shadow::Shadow(int robot, PlannerKind planner) {
  options_.robot = robot;
  options_.planner = planner;
  options_.stepped = [this](const can::InputSet&, const Status& status, const perception::LocalGrid*,
                            const RecordingGuide*) {
    status_ = status;
    stepped_ = true;
  };
  replayer_.emplace(options_);
}

void Shadow::hear(const hal::CanFrame& frame, std::uint64_t time_us) { heard_.push_back({frame, time_us}); }

bool Shadow::follow() {
  for (const Heard& heard : heard_) replayer_->on_frame(heard.frame, heard.time_us, 0);
  heard_.clear();
  return stepped_;
}

const std::string& Shadow::difference() const { return replayer_->difference(); }

}  // namespace whisker::hil
