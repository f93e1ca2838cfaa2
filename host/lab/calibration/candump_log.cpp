#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "firmware/can/codec.hpp"
#include "firmware/can/headers.hpp"
#include "firmware/can/input_set.hpp"
#include "firmware/localization/odometry.hpp"
#include "host/harness/hil/candump.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/lab/calibration/log.hpp"
#include "host/lab/calibration/sample.hpp"

namespace whisker::calibration {
namespace {

using can::MessageKind;

/// The input sets of a base, taken from its frames.
class Listener {
 public:
  Listener(const Params& params, int robot) : robot_(robot), collector_(params) {
    odometry_.configure(params);
    odometry_.place({});
  }

  void on_frame(const hal::CanFrame& frame) {
    MessageKind kind = MessageKind::e_stop;
    if (!can::kind_of(frame.id, kind) || kind == MessageKind::e_stop) return;
    const auto node = static_cast<std::uint8_t>(frame.id & 0x0F);
    const int robot = node - can::kBaseOffset;
    const bool whole = frame.size == can::head_of(kind).size &&
                       frame.data[0] == can::crc_of(frame.id, frame.data, frame.size);
    if (robot < 1 || !whole || !can::may_send(can::Party::base, kind)) return;
    if (robot_ == 0) robot_ = robot;
    if (robot == robot_) take(kind, frame);
  }

  const Sweep& sweep() const { return collector_.sweep(); }

 private:
  void take(MessageKind kind, const hal::CanFrame& frame) {
    switch (kind) {
      case MessageKind::range_left: return range<MessageKind::range_left>(hal::kLeft, frame);
      case MessageKind::range_front: return range<MessageKind::range_front>(hal::kFront, frame);
      case MessageKind::range_right: return range<MessageKind::range_right>(hal::kRight, frame);
      case MessageKind::wheel_state: return input<can::WheelState>(frame);
      case MessageKind::gyro: return input<can::GyroState>(frame);
      case MessageKind::fix: return input<can::FixValue>(frame);
      case MessageKind::sync: return input<can::Sync>(frame);
      default: break;
    }
  }

  template <MessageKind kKind>
  void range(int beam, const hal::CanFrame& frame) {
    can::Range<kKind> m;
    if (!can::decode(frame, m) || !can::InputSets::sound(m.reading)) return;
    sets_.on_frame(beam, m.reading, m.tick, m.bump);
    step();
  }

  template <class M>
  void input(const hal::CanFrame& frame) {
    M m;
    if (!can::decode(frame, m)) return;
    sets_.on_frame(m);
    step();
  }

  void step() {
    if (!sets_.complete()) return;
    const can::InputSet set = sets_.set();
    if (!set.counts_valid || (begun_ && set.tick == tick_)) return;
    // Between two missions the ticks may jump, and the counts go on.
    if (!begun_ || set.tick - tick_ > kLongestGap) {
      if (!begun_) first_ = set.tick;
      if (begun_) offset_ += tick_ + 1 - set.tick;
    }
    const std::uint32_t ahead = begun_ ? set.tick + offset_ - last_ : 1;
    begun_ = true;
    tick_ = set.tick;
    last_ = set.tick + offset_;
    localization::CountStep counts;
    odometry_.update(set.counts, Duration::from_raw(static_cast<std::int32_t>(ahead * set.period_ms)),
                     counts);
    const double t_s = static_cast<double>(last_ - first_) * set.period_ms * 1e-3;
    collector_.add(t_s, odometry_.pose(), set.ranges);
  }

  static constexpr std::uint32_t kLongestGap = 1000;  // ticks

  int robot_;
  can::InputSets sets_;
  localization::Odometry odometry_;
  Collector collector_;
  bool begun_ = false;
  std::uint32_t first_ = 0, tick_ = 0, last_ = 0, offset_ = 0;
};

}  // namespace

Log read_candump(std::istream& in, const std::string& name, const Params& params, int robot) {
  Listener listener(params, robot);
  hil::LogReader reader(in, name);
  hil::LogFrame entry;
  while (reader.next(entry)) listener.on_frame(entry.frame);
  if (listener.sweep()[0].empty()) {
    throw InputError(name, 1, 1,
                     robot == 0 ? std::string("no input sets of a robot's base")
                                : fmt::format("no input sets of the base of robot {}", robot));
  }
  return {listener.sweep(), 0};
}

Log read_log(const std::string& file, const Params& params, int robot) {
  std::ifstream in(file);
  if (!in) throw InputError(file, 1, 1, fmt::format("cannot open the file: {}", std::strerror(errno)));
  LineReader lines(in, file);
  if (!lines.next()) throw InputError(file, 1, 1, "the file is empty");
  const bool candump = hil::parse_log_line(lines.line()) || lines.line().substr(0, 1) == "(";
  in.clear();
  in.seekg(0);
  return candump ? read_candump(in, file, params, robot) : read_trace(in, file, params);
}

}  // namespace whisker::calibration
