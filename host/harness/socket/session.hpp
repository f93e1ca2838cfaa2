/// One robot of the core, driven by the lines of a simulator.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "firmware/apps/command_hash.hpp"
#include "firmware/robot.hpp"
#include "host/harness/run/record.hpp"
#include "host/harness/socket/board.hpp"
#include "host/harness/socket/request.hpp"

namespace whisker::socket {

/// How it stands when the lines end.
struct SessionEnd {
  const char* outcome;  ///< of the last answer
  RunResult run;        ///< by the robot's own estimate; gave_up also while there is no verdict
};

class Session {
 public:
  /// defaults: what the first line does not say. version: of the program, for the greeting.
  Session(const Opening& defaults, std::string version);

  /// The answer to the next line, without its end. now_ms: the time of arrival, for lines without a time. A
  /// tick with the time of the last one repeats its answer, and so does the first line before the first tick:
  /// a lost datagram may be sent again. Throws ProtocolError with the number of the line.
  std::string answer(const std::string& line, std::uint32_t now_ms);

  /// None: there was no tick.
  std::optional<SessionEnd> result() const;
  std::uint64_t lines() const { return lines_; }

 private:
  std::string greet(const Opening& opening);
  std::string step(const Tick& tick, std::uint32_t now_ms);

  Opening defaults_;
  std::string version_;
  std::uint64_t lines_ = 0;

  // Of the robot, once the first line has been read.
  struct Core;
  std::shared_ptr<Core> core_;
  std::optional<std::uint32_t> last_ms_;
  std::string opening_;
  std::string last_answer_;
};

}  // namespace whisker::socket
