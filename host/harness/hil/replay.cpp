#include "host/harness/hil/replay.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "firmware/can/codec.hpp"
#include "firmware/can/headers.hpp"
#include "host/harness/hil/candump.hpp"
#include "host/harness/hil/overheard.hpp"

namespace whisker::hil {
namespace {

using can::MessageKind;

/// Of which node the log is. Its first GuardStatus may be missing, so this is known before the replay begins.
class Judge {
 public:
  explicit Judge(int robot) : robot_(robot) {}
  /// True: it is known.
  bool see(const hal::CanFrame& frame) {
    const std::optional<Sender> sender = sender_of(frame);
    if (!sender || !sender->whole) return false;
    if (robot_ == 0) robot_ = sender->robot;
    if (sender->robot != robot_) return false;
    guards_ = sender->kind == MessageKind::guard_status;
    return guards_ || (sender->kind == MessageKind::wheel_command && ++commands_ == kEnough);
  }
  bool guards() const { return guards_; }

 private:
  static constexpr int kEnough = 256;  // a guard node says more often that it is one

  int robot_;
  int commands_ = 0;
  bool guards_ = false;
};

}  // namespace

ReplayResult replay(std::istream& log, const std::string& name, const ReplayOptions& options) {
  Replayer replay(options);
  Judge judge(options.robot);
  std::vector<std::pair<LogFrame, std::uint64_t>> first;  // before it is judged
  bool judged = false;
  const auto begin = [&] {
    judged = true;
    if (judge.guards()) replay.replays_a_guard();
    for (const auto& [entry, number] : first) replay.on_frame(entry.frame, entry.time_us, number);
    first.clear();
  };
  LogReader reader(log, name);
  LogFrame entry;
  while (reader.next(entry)) {
    MessageKind kind = MessageKind::e_stop;
    if (!can::kind_of(entry.frame.id, kind)) {
      ++reader.skipped()["other"];
    } else if (judged) {
      replay.on_frame(entry.frame, entry.time_us, reader.line());
    } else {
      first.emplace_back(entry, reader.line());
      if (judge.see(entry.frame)) begin();
    }
  }
  if (!judged) begin();
  ReplayResult result = replay.result();
  result.cut = reader.cut();
  result.skipped = reader.skipped();
  return result;
}

}  // namespace whisker::hil
