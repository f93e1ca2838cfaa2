#include "host/harness/scenario/event.hpp"

#include "host/harness/scenario/param_list.hpp"

namespace whisker {

bool apply_param(const Event& event, Params& params) {
  Params changed = params;
  set_param(changed, event.param, event.raw);
  if (check(changed) != ParamFault::none) return false;
  params = changed;
  return true;
}

}  // namespace whisker
