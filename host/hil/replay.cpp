#include "host/hil/replay.hpp"

#include <array>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "firmware/apps/can/remote_robot.hpp"
#include "firmware/apps/pil_link/command_hash.hpp"
#include "firmware/can/codec.hpp"
#include "firmware/can/headers.hpp"
#include "firmware/can/mission.hpp"
#include "firmware/can/param_server.hpp"
#include "host/hil/candump.hpp"
#include "host/hil/planners.hpp"

namespace whisker::hil {
namespace {

using can::MessageKind;

class Replay {
 public:
  explicit Replay(const ReplayOptions& options)
      : options_(options),
        planners_(options.planner),
        pilot_(std::make_unique<can_app::RemoteRobot>(planners_)) {
    result_.robot = options.robot;
  }

  void on_frame(const hal::CanFrame& frame, std::uint64_t line) {
    line_ = line;
    MessageKind kind = MessageKind::e_stop;
    if (frame.extended || frame.remote || !can::kind_of(frame.id, kind) || kind == MessageKind::e_stop)
      return;
    const auto node = static_cast<std::uint8_t>(frame.id & 0x0F);
    const can::Party party = node >= can::kBaseOffset ? can::Party::base : can::Party::controller;
    const int robot = party == can::Party::base ? node - can::kBaseOffset : node;
    if (robot == 0 || !can::may_send(party, kind)) return;
    const bool whole = frame.size == can::head_of(kind).size &&
                       frame.data[0] == can::crc_of(frame.id, frame.data, frame.size);
    if (result_.robot == 0 && whole) result_.robot = robot;
    if (robot != result_.robot) return;
    ++(whole ? result_.frames : result_.damaged);
    if (whole) execute(kind, frame);
  }

  ReplayResult result() const {
    ReplayResult out = result_;
    out.hash = hash_.value();
    return out;
  }

 private:
  static constexpr std::size_t kKept = 256;  // complete input sets: more than the delay of any command

  void execute(MessageKind kind, const hal::CanFrame& frame) {
    switch (kind) {
      case MessageKind::range_left: return on_range<MessageKind::range_left>(hal::kLeft, frame);
      case MessageKind::range_front: return on_range<MessageKind::range_front>(hal::kFront, frame);
      case MessageKind::range_right: return on_range<MessageKind::range_right>(hal::kRight, frame);
      case MessageKind::wheel_state:
        return with<can::WheelState>(frame, [&](const auto& m) { sets_.on_frame(m), keep(); });
      case MessageKind::gyro:
        return with<can::GyroState>(frame, [&](const auto& m) { sets_.on_frame(m), keep(); });
      case MessageKind::fix:
        return with<can::FixValue>(frame, [&](const auto& m) { sets_.on_frame(m), keep(); });
      case MessageKind::sync:
        return with<can::Sync>(frame, [&](const auto& m) { sets_.on_frame(m), keep(); });
      case MessageKind::mission: return on_mission(frame);
      case MessageKind::mission_reply:
        return with<can::MissionReply>(frame, [&](const auto& m) { accept(m); });
      case MessageKind::param_request:
        return with<can::ParamRequest>(frame, [&](const auto& m) { request_ = m; });
      case MessageKind::param_reply: return with<can::ParamReply>(frame, [&](const auto& m) { settle(m); });
      case MessageKind::wheel_command:
        return with<can::WheelCommand>(frame, [&](const auto& m) { compare(m, can::counter_of(frame)); });
      case MessageKind::nav_status: return with<can::NavStatus>(frame, [&](const auto& m) { compare(m); });
      case MessageKind::heartbeat:
        return with<can::Heartbeat>(frame, [&](const auto& m) { watch(frame.id, m); });
      default: break;
    }
  }

  template <class M, class F>
  void with(const hal::CanFrame& frame, const F& use) {
    M m;
    if (can::decode(frame, m)) use(m);
  }

  template <MessageKind kKind>
  void on_range(int beam, const hal::CanFrame& frame) {
    with<can::Range<kKind>>(frame, [&](auto m) {
      if (can::InputSets::sound(m.reading)) sets_.on_frame(beam, m.reading, m.tick, m.bump), keep();
    });
  }

  void keep() {
    if (!sets_.complete()) return;
    const can::InputSet set = sets_.set();
    kept_[set.tick % kKept] = set;
  }

  void on_mission(const hal::CanFrame& frame) {
    can::MissionValue part;
    if (!can::decode(frame, part)) return;
    if (part.part != can::MissionPart::order) return parts_.on_frame(part);
    with<can::MissionOrder>(frame, [&](const auto& m) { order_ = m; });
  }

  void accept(const can::MissionReply& reply) {
    if (reply.status != can::MissionStatus::accepted || !order_ || reply.mission != order_->mission) return;
    can::Mission mission;
    if (reply.mission == accepted_ || !parts_.complete(*order_) ||
        !can::mission_of(parts_.values(), mission)) {
      return;
    }
    accepted_ = reply.mission;
    pilot_->execute(order_->order, mission, params_);
    if (order_->order == can::Order::start) {
      ++result_.missions;
      if (options_.begins) options_.begins(mission, params_);
    }
    braked_ = order_->order == can::Order::resume;
    stepped_ = false;
    for (auto& set : kept_) set.reset();
    sets_.forget();
  }

  void settle(const can::ParamReply& reply) {
    if (!request_ || reply.index != request_->index) return;
    bool committed = false;
    server_.answer(*request_, reply.status == can::ParamStatus::busy, committed);
    if (committed) params_ = server_.staged();
  }

  void watch(std::uint32_t id, const can::Heartbeat& beat) {
    std::optional<std::uint16_t>& boot = boots_[(id & 0x0F) >= can::kBaseOffset ? 0 : 1];
    if (boot && *boot != beat.boot) accepted_ = -1;
    boot = beat.boot;
  }

  const can::InputSet* kept(std::uint16_t tick16) const {
    const auto& set = kept_[tick16 % kKept];
    return set && static_cast<std::uint16_t>(set->tick) == tick16 ? &*set : nullptr;
  }

  /// Steps on the input set of this tick, unless done already. False if that is impossible.
  bool reach(std::uint16_t tick16) {
    if (stepped_ && tick16 == tick16_) return true;
    const can::InputSet* const set = kept(tick16);
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
      if (const can::InputSet* set = kept(static_cast<std::uint16_t>(tick16_ + 1))) {
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
        const hal::WheelSpeeds& now = status_.command;
        if (now.left != recorded.speeds.left || now.right != recorded.speeds.right) {
          differ(fmt::format("tick {}: recorded {} {}, the core says {} {} (0.1 mm/s)", recorded.tick,
                             recorded.speeds.left, recorded.speeds.right, now.left, now.right));
        }
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
      differ(fmt::format("tick {}: recorded {} ({}), the core says {} ({})", recorded.tick,
                         planning::name(recorded.state), planning::name(recorded.why),
                         planning::name(now.state), planning::name(now.why)));
    }
  }

  void differ(const std::string& what) {
    if (result_.difference.empty()) result_.difference = fmt::format("line {}: {}", line_, what);
  }

  const ReplayOptions& options_;
  RecordingPlanners planners_;
  std::unique_ptr<can_app::RemoteRobot> pilot_;
  ReplayResult result_;
  link::CommandHash hash_;
  std::uint64_t line_ = 0;

  can::InputSets sets_;
  std::array<std::optional<can::InputSet>, kKept> kept_;
  can::MissionParts parts_;
  std::optional<can::MissionOrder> order_;
  int accepted_ = -1;
  can::ParamServer server_;
  Params params_;
  std::optional<can::ParamRequest> request_;
  std::array<std::optional<std::uint16_t>, 2> boots_;

  Status status_;
  bool stepped_ = false;
  bool braked_ = false;
  std::uint16_t tick16_ = 0;
  std::uint8_t counter_ = 0;
};

}  // namespace

ReplayResult replay(std::istream& log, const ReplayOptions& options) {
  Replay replay(options);
  std::string line;
  std::uint64_t cut = 0;
  for (std::uint64_t number = 1; std::getline(log, line); ++number) {
    if (line.empty()) continue;
    if (const auto entry = parse_log_line(line)) {
      replay.on_frame(entry->frame, number);
      continue;
    }
    const bool unfinished = log.eof() && line.front() == '(';
    if (!unfinished) {
      throw std::runtime_error(fmt::format("line {}: not a frame as candump -L writes it", number));
    }
    cut = number;
  }
  ReplayResult result = replay.result();
  result.cut = cut;
  return result;
}

}  // namespace whisker::hil
