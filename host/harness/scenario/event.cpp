#include "host/harness/scenario/event.hpp"

#include "firmware/params/words.hpp"

namespace whisker {

bool apply_param(const Event& event, Params& params) {
  Params changed = params;
  set_raw_param(changed, static_cast<std::uint8_t>(event.param), static_cast<std::uint32_t>(event.raw));
  if (check(changed) != ParamFault::none) return false;
  params = changed;
  return true;
}

}  // namespace whisker
