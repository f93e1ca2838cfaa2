/// A robot whose companion plays its sensors and its wheels; hal/link/message.hpp has the words.
#pragma once

#include "firmware/nav/default_planner.hpp"
#include "firmware/nav/thesis.hpp"
#include "firmware/robot.hpp"
#include "hal/byte_stream.hpp"
#include "hal/link/bytes.hpp"
#include "hal/link/command_hash.hpp"
#include "hal/link/message.hpp"
#include "hal/link/params.hpp"
#include "hal/link/remote_board.hpp"
#include "hal/meter.hpp"
#include "hal/room.hpp"

namespace whisker::link {

/// What the largest planner takes.
template <int kMapBytes>
constexpr size_t kPlannerSize = sizeof(nav::TableMap<kMapBytes>);
template <>
inline constexpr size_t kPlannerSize<0> = sizeof(nav::TableSkirt) > sizeof(nav::ThesisPlanner)
                                              ? sizeof(nav::TableSkirt)
                                              : sizeof(nav::ThesisPlanner);

class Session {
 public:
  constexpr Session() noexcept = default;
  Session(const Session&) = delete;

  /// Answers until the companion ends it. 0: it did; 1: the stream ended without it, or made no sense. Once.
  int run(hal::ByteStream& stream, hal::Meter& meter) noexcept;

 private:
  struct Affairs {
    RemoteBoard board;
    Params params;
    CommandHash hash;
  };

  bool obey(Name name) noexcept;
  bool begin(const Begin& what) noexcept;
  nav::Planner* make_map(uint16_t bytes) noexcept;
  bool tick(const Tick& what) noexcept;
  bool probe(const Probe& what) noexcept;
  bool hear(size_t count) noexcept { return stream_->read(buffer_, count); }
  template <class M>
  bool hear(M& message) noexcept;
  template <class M>
  bool say(const M& message) noexcept;

  hal::ByteStream* stream_ = nullptr;
  hal::Meter* meter_ = nullptr;
  uint32_t overhead_ = 0;
  Affairs* my_ = nullptr;
  Robot* robot_ = nullptr;
  hal::Room<sizeof(Affairs)> room_for_affairs_;
  hal::Room<kPlannerSize<nav::kRoomForMap>> room_for_planner_;
  hal::Room<sizeof(Robot)> room_for_robot_;
  uint32_t ticks_ = 0;
  bool ended_ = false;
  uint8_t buffer_[params_size()] = {};
};

}  // namespace whisker::link
