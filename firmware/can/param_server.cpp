#include "firmware/can/param_server.hpp"

#include "firmware/params/words.hpp"

namespace whisker::can {

bool read_param(const Params& params, uint8_t index, uint32_t& raw) noexcept {
  if (index >= kParams) return false;
  raw = raw_param(params, index);
  return true;
}

ParamStatus write_param(Params& params, uint8_t index, uint32_t raw) noexcept {
  if (index >= kParams) return ParamStatus::no_such;
  if (!in_own_range(index, raw)) return ParamStatus::out_of_range;
  set_raw_param(params, index, raw);
  return ParamStatus::ok;
}

ParamReply ParamServer::answer(const ParamRequest& request, bool busy, bool& committed) noexcept {
  committed = false;
  ParamReply reply;
  reply.index = request.index;
  if (request.action != ParamAction::read && busy) {
    reply.status = ParamStatus::busy;
  } else if (request.action == ParamAction::commit) {
    const ParamFault fault = check(staged_);
    reply.value = static_cast<uint32_t>(fault);
    committed = fault == ParamFault::none;
    reply.status = committed ? ParamStatus::ok : ParamStatus::inconsistent;
    return reply;
  } else if (request.action == ParamAction::write) {
    reply.status = write_param(staged_, request.index, request.value);
  }
  if (!read_param(staged_, request.index, reply.value) && reply.status == ParamStatus::ok) {
    reply.status = ParamStatus::no_such;
  }
  return reply;
}

}  // namespace whisker::can
