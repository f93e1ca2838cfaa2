#include "firmware/can/param_server.hpp"

#include "firmware/params/words.hpp"

namespace whisker::can {

static_assert(kParams <= kCommitIndex);

namespace {
bool exists(uint8_t index) noexcept { return index < kParams && !is_derived(index); }
}  // namespace

bool read_param(const Params& params, uint8_t index, uint32_t& raw) noexcept {
  if (!exists(index)) return false;
  raw = raw_param(params, index);
  return true;
}

ParamStatus write_param(Params& params, uint8_t index, uint32_t raw) noexcept {
  if (!exists(index)) return ParamStatus::no_such;
  if (!in_own_range(index, raw)) return ParamStatus::out_of_range;
  set_raw_param(params, index, raw);
  return ParamStatus::ok;
}

ParamStatus ParamServer::commit(ParamReply& reply) noexcept {
  ParamFault fault = check(staged_);
  if (fault == ParamFault::none && !outlasts_hold(staged_)) fault = ParamFault::gap_below_period;
  reply.value = static_cast<uint32_t>(fault);
  if (fault != ParamFault::none) return ParamStatus::inconsistent;
  committed_ = staged_;
  stager_ = Requester::none;
  ++commits_;
  return ParamStatus::ok;
}

void ParamServer::drop(Requester who) noexcept {
  if (stager_ != who) return;
  staged_ = committed_;
  stager_ = Requester::none;
}

ParamReply ParamServer::answer(const ParamRequest& request, Requester who, bool busy) noexcept {
  ParamReply reply;
  reply.index = request.index;
  reply.to_operator = who == Requester::third_party ? 1 : 0;
  if (request.action != ParamAction::read && busy) {
    reply.status = ParamStatus::busy;
  } else if (request.action != ParamAction::read) {
    if (stager_ != who) drop(stager_);
    if (request.action == ParamAction::commit) {
      reply.status = commit(reply);
      return reply;
    }
    stager_ = who;
    reply.status = write_param(staged_, request.index, request.value);
  }
  if (!read_param(staged_, request.index, reply.value) && reply.status == ParamStatus::ok) {
    reply.status = ParamStatus::no_such;
  }
  return reply;
}

}  // namespace whisker::can
