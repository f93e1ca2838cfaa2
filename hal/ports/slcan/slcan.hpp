#pragma once

#include "hal/byte_line.hpp"
#include "hal/ports/can_queue.hpp"
#include "hal/ports/slcan/line.hpp"

namespace whisker::hal::slcan {

enum class Role : uint8_t {
  adapter,  ///< answers the commands of a computer, as a USB-CAN adapter does; open from the start
  host,     ///< sends those commands to an adapter, or to a node that acts as one
};

/// Counters saturate.
struct LineCounts {
  uint32_t bad_lines = 0;     ///< neither a frame nor a command or an answer: truncated, too long, or damaged
  uint32_t refusals = 0;      ///< host: number of times that the adapter answered with BELL
  uint32_t lost_answers = 0;  ///< adapter: answers without room
};

/// CAN frames as lines of text over a serial line. No heap; bytes stay in the line while the queue of
/// received frames is full. `sent` counts the lines that the ByteLine accepted.
///
/// The state is `starting` until the other end is connected and the channel is open. A host opens the channel
/// by itself. If the adapter refuses, the state becomes `off`; an adapter that stays silent counts as open,
/// because some never answer. The channel of an adapter is opened and closed by the other end.
class Slcan final : public CanPort {
 public:
  static constexpr uint32_t kSettleMs = 20;   ///< wait for answers of the adapter to earlier commands
  static constexpr uint32_t kAnswerMs = 100;  ///< wait for the adapter's answer to a command
  static constexpr char k500kbit = '6';  ///< LAWICEL's numbers: 0 is 10 kbit/s, 4 125, 5 250, 6 500, 8 1000

  Slcan(ByteLine& line, Role role, char speed = k500kbit) noexcept
      : line_(line), role_(role), speed_(speed) {}
  Slcan(const Slcan&) = delete;
  Slcan& operator=(const Slcan&) = delete;

  bool send(const CanFrame& frame, uint8_t lifetime_ms) noexcept override;
  bool receive(CanFrame& out) noexcept override;
  void poll(uint32_t now_ms) noexcept override;
  void restart() noexcept override;
  CanState state() const noexcept override { return state_; }
  const CanCounts& counts() const noexcept override { return counts_; }
  const LineCounts& line_counts() const noexcept { return line_counts_; }

 private:
  enum class Phase : uint8_t { apart, settling, setting_speed, opening, open, closed, refused };

  bool on_bus() const noexcept { return state_ == CanState::active || state_ == CanState::passive; }
  void begin() noexcept;
  void lose() noexcept;
  void enter(Phase phase, CanState state) noexcept;
  void see_time() noexcept;
  void fetch() noexcept;
  void see_line() noexcept;
  void see_frame() noexcept;
  void see_command() noexcept;
  void see_answer(bool accepted) noexcept;
  bool see_report() noexcept;
  void say(const char* text) noexcept;
  void flush() noexcept;

  ByteLine& line_;
  Role role_;
  char speed_;
  Phase phase_ = Phase::apart;
  CanState state_ = CanState::starting;
  uint32_t now_ms_ = 0;
  uint32_t since_ms_ = 0;
  CanOutbox outbox_;
  CanInbox inbox_;
  CanCounts counts_;
  LineCounts line_counts_;

  uint8_t in_[kLongestLine] = {};
  uint8_t in_size_ = 0;
  bool skip_ = false;  // to the end of a line that is too long

  uint8_t out_[kLongestLine + 1] = {};  // the line in transmission
  uint8_t out_size_ = 0;
  uint8_t out_done_ = 0;
  bool out_is_frame_ = false;
  char said_[32] = {};  // answers and commands that wait for the end of that line
  uint8_t said_size_ = 0;
};

}  // namespace whisker::hal::slcan
