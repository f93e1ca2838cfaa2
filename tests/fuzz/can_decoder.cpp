/// Any bytes as frames: encode() restores every frame that decode() accepts.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "firmware/can/codec.hpp"

namespace {

using namespace whisker::can;

template <class M>
void try_as(whisker::hal::CanFrame frame) {
  const Message& message = message_of(M::kKind);
  frame.id = id_of(message.function, 1);
  frame.size = message.size;
  M m;
  if (!decode(frame, m)) return;
  const whisker::hal::CanFrame again = encode(m, 1, counter_of(frame));
  std::uint64_t carried = 0;
  for (std::uint8_t i = 0; i < message.count; ++i) {
    const Signal& s = message.signals[i];
    if (s.part <= 0) carried |= Packer::mask(s) << s.start;
  }
  M second;
  if (!decode(again, second)) std::abort();
  if (((bits_of(frame) ^ bits_of(again)) & carried & ~UINT64_C(0xFFF)) != 0 && message.count > 0 &&
      M::kKind != MessageKind::mission && M::kKind != MessageKind::info_request) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size != 8) return 0;
  whisker::hal::CanFrame frame{};
  std::memcpy(frame.data, data, 8);
  for_each_message([&](const Message&, auto message) { try_as<decltype(message)>(frame); });
  try_as<MissionValue>(frame);
  return 0;
}
