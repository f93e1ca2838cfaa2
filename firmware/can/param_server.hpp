/// The parameters by index, in the order of for_each_param, as raw 32-bit values.
#pragma once

#include <stdint.h>

#include "firmware/can/limits.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/params.hpp"

namespace whisker::can {

/// The index of a commit: no parameter has it, so its reply is not taken for that of a write.
constexpr uint8_t kCommitIndex = 255;

/// The base holds a command for no longer than the robot assumes between two ticks.
constexpr bool outlasts_hold(const Params& params) noexcept {
  return longest_gap(params) >= milliseconds(kCommandLate_ms) + params.safety.period;
}

/// False: no parameter has this index, or the robot derives it.
bool read_param(const Params& params, uint8_t index, uint32_t& raw) noexcept;
/// Calls use(index, raw) for every parameter.
template <class F>
void each_param(const Params& params, const F& use) {
  uint32_t raw = 0;
  for (uint8_t i = 0; i < kCommitIndex; ++i) {
    if (read_param(params, i, raw)) use(i, raw);
  }
}
/// Refuses values outside the parameter's own range.
ParamStatus write_param(Params& params, uint8_t index, uint32_t raw) noexcept;

/// Who requests; of staged values: who staged them.
enum class Requester : uint8_t { none, base, third_party };

/// Answers requests on a staged set of parameters; a commit checks it as a whole. What one has staged and not
/// committed is void when another one stages.
class ParamServer {
 public:
  /// busy: only reads are allowed.
  ParamReply answer(const ParamRequest& request, Requester who, bool busy) noexcept;
  const Params& committed() const noexcept { return committed_; }
  /// Both the committed and the staged ones.
  void set(const Params& params) noexcept { committed_ = staged_ = params; }
  Requester stager() const noexcept { return stager_; }
  /// Number of accepted commits, modulo 2^32.
  uint32_t commits() const noexcept { return commits_; }
  /// Drops what `who` has staged and not committed.
  void drop(Requester who) noexcept;

 private:
  ParamStatus commit(ParamReply& reply) noexcept;

  Params staged_;
  Params committed_;
  Requester stager_ = Requester::none;
  uint32_t commits_ = 0;
};

}  // namespace whisker::can
