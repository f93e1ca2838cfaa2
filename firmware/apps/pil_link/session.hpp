/// A robot whose sensors and wheels a companion simulates; firmware/apps/pil_link/message.hpp defines the
/// messages.
#pragma once

#include "firmware/apps/pil_link/bytes.hpp"
#include "firmware/apps/pil_link/command_hash.hpp"
#include "firmware/apps/pil_link/message.hpp"
#include "firmware/apps/pil_link/params.hpp"
#include "firmware/apps/pil_link/remote_board.hpp"
#include "firmware/apps/static_storage.hpp"
#include "firmware/part.hpp"
#include "firmware/planning/default_planner.hpp"
#include "firmware/planning/planners.hpp"
#include "firmware/robot.hpp"
#include "hal/byte_stream.hpp"
#include "hal/meter.hpp"

namespace whisker::link {

class Session {
 public:
  constexpr Session() noexcept = default;
  Session(const Session&) = delete;

  /// Answers until the companion ends the session. 0: it did; 1: early end or invalid stream. Call it once.
  int run(hal::ByteStream& stream, hal::Meter& meter) noexcept;

 private:
  struct Affairs {
    RemoteBoard board;
    Params params;
    CommandHash hash;
    Part<RemoteGyro, kGyroBuilt> gyro;
  };

  bool execute(Name name) noexcept;
  bool begin(const Begin& what) noexcept;
  // A template, so that an image that does not use it has no part of it.
  template <class F>
  bool correct(const F& fix) noexcept;
  bool tick(const Tick& what) noexcept;
  bool probe(const Probe& what) noexcept;
  bool on_frame(size_t count) noexcept { return stream_->read(buffer_, count); }
  template <class M>
  bool on_frame(M& message) noexcept;
  template <class M>
  bool say(const M& message) noexcept;

  hal::ByteStream* stream_ = nullptr;
  hal::Meter* meter_ = nullptr;
  uint32_t overhead_ = 0;
  Affairs* my_ = nullptr;
  Robot* robot_ = nullptr;
  StaticStorage<sizeof(Affairs)> room_for_affairs_;
  StaticStorage<planning::largest_planner(planning::kRoomForMap)> room_for_planner_;
  StaticStorage<sizeof(Robot)> room_for_robot_;
  uint32_t ticks_ = 0;
  bool ended_ = false;
  uint8_t buffer_[kParamsSize] = {};
};

}  // namespace whisker::link
