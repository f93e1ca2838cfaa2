#pragma once

#include <cstdint>

#include "firmware/can/messages.hpp"

namespace whisker::hil {

/// A request for a parameter, repeated until a reply is there that answers it.
class ParamQuestion {
 public:
  /// again_us: between repetitions.
  ParamQuestion(const can::ParamRequest& request, std::uint64_t again_us)
      : request_(request), again_us_(again_us) {}

  /// Call it after each poll of the asker, which has request(ParamRequest) and replied(ParamReply&).
  /// answers: whether a reply with the right index does. True: reply() is it.
  template <class Asker, class F>
  bool poll(Asker& asker, std::uint64_t now_us, const F& answers) {
    if (asked_ && asker.replied(reply_) && reply_.index == request_.index && answers(reply_)) return true;
    if (!asked_ || now_us - asked_us_ >= again_us_) {
      asker.request(request_);
      asked_ = true;
      asked_us_ = now_us;
    }
    return false;
  }
  const can::ParamReply& reply() const { return reply_; }

 private:
  const can::ParamRequest request_;
  const std::uint64_t again_us_;
  can::ParamReply reply_;
  std::uint64_t asked_us_ = 0;
  bool asked_ = false;
};

}  // namespace whisker::hil
