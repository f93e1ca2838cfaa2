#include "hal/can_remote/remote_board.hpp"

namespace whisker::can_remote {
namespace {

/// `from`, and at most `most` of the shorter way to `to` on the counter's circle.
uint32_t stepped(uint32_t from, uint32_t to, uint32_t most) noexcept {
  const uint32_t forward = (to - from) % hal::kEncoderModulus;
  const uint32_t backward = (from - to) % hal::kEncoderModulus;
  if (forward <= most || backward <= most) return to;
  return (forward < backward ? from + most : from - most) % hal::kEncoderModulus;
}

}  // namespace

hal::EncoderCounts RemoteBoard::nearer(const hal::EncoderCounts& from,
                                       const hal::EncoderCounts& to) noexcept {
  const hal::EncoderCounts next{stepped(from.left, to.left, most_), stepped(from.right, to.right, most_)};
  const bool there = next.left == to.left && next.right == to.right;
  catching_up_ = !there && ++pieces_ < kMostPieces;
  return catching_up_ ? next : to;
}

}  // namespace whisker::can_remote
