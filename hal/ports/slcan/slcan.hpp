#pragma once

#include "hal/byte_line.hpp"
#include "hal/ports/can_queue.hpp"
#include "hal/ports/slcan/line.hpp"

namespace whisker::hal::slcan {

enum class Role : uint8_t {
  adapter,  ///< answers the commands of a computer, as a USB-CAN adapter does; open from the start
  host,     ///< gives those commands to an adapter, and to nodes that pretend to be one
};

/// Each stops at its maximum.
struct LineCounts {
  uint32_t bad_lines = 0;     ///< neither a frame nor a command or an answer: cut, too long, or mutilated
  uint32_t refusals = 0;      ///< host: times the adapter answered with BELL
  uint32_t lost_answers = 0;  ///< adapter: answers for which there was no room
};

/// CAN frames as lines of text over a serial line. No heap; bytes wait in the line while the queue of
/// received frames is full. `sent` counts the lines that the ByteLine took.
///
/// The state is `starting` while the line has no other end, and until the channel is open. A host opens it by
/// itself as soon as there is another end; an adapter that refuses makes it `off`, one that stays silent
/// counts as open, as some never answer. An adapter's channel is closed and opened by the other end.
class Slcan final : public CanPort {
 public:
  static constexpr uint32_t kSettleMs = 20;   ///< for what an adapter says to what it was told before
  static constexpr uint32_t kAnswerMs = 100;  ///< for an adapter's answer to a command
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

  uint8_t out_[kLongestLine + 1] = {};  // the line that is being sent
  uint8_t out_size_ = 0;
  uint8_t out_done_ = 0;
  bool out_is_frame_ = false;
  char said_[32] = {};  // answers and commands that wait for the end of that line
  uint8_t said_size_ = 0;
};

}  // namespace whisker::hal::slcan
