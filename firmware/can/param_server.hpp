/// The parameters by index, in the order of for_each_param, as raw 32-bit values.
#pragma once

#include <stdint.h>

#include "firmware/can/messages.hpp"
#include "firmware/params.hpp"

namespace whisker::can {

/// False: no parameter has this index.
bool read_param(const Params& params, uint8_t index, uint32_t& raw) noexcept;
/// Refuses values outside the parameter's own range.
ParamStatus write_param(Params& params, uint8_t index, uint32_t raw) noexcept;

/// Answers requests on a staged set of parameters; a commit checks it as a whole.
class ParamServer {
 public:
  /// busy: the robot drives, and only reads are allowed. committed: this was a commit, and it succeeded.
  ParamReply answer(const ParamRequest& request, bool busy, bool& committed) noexcept;
  const Params& staged() const noexcept { return staged_; }
  void stage(const Params& params) noexcept { staged_ = params; }

 private:
  Params staged_;
};

}  // namespace whisker::can
