#include "firmware/apps/pil_link/session.hpp"

namespace whisker::link {
namespace {

Pose pose(const Stand& s) noexcept {
  return {{Length::from_raw(s.x), Length::from_raw(s.y)}, Angle::from_raw(s.heading)};
}

uint32_t failures(const Health& h) noexcept {
  return h.range_refused + h.range_invalid + h.range_stale + h.range_stuck + h.range_out_of_range +
         h.drive_refused + h.encoder_refused + h.encoder_jumps + h.wheel_stalls + h.unsteady_looks +
         h.no_progress + h.pose_out_of_range + h.wheel_runaways + h.late_ticks + h.clock_jumps +
         h.bumper_refused + h.bumper_stuck + (kGyroBuilt ? h.gyro_lost + h.gyro_saturated : 0);
}

Answer answer_of(const Status& status) noexcept {
  const planning::Decision& d = status.decision;
  Answer a;
  a.command = status.command;
  a.mode = static_cast<uint8_t>(d.mode);
  a.why = static_cast<uint8_t>(d.why);
  a.outcome = static_cast<uint8_t>(d.outcome);
  a.fault = static_cast<uint8_t>(status.health.fault);
  a.danger_count = d.danger_count;
  a.looked = d.looked ? 1 : 0;
  a.manoeuvre = static_cast<uint8_t>(d.manoeuvre.kind);
  a.distance = d.inputs.distance.raw();
  a.bias = d.inputs.bias.raw();
  a.turn = d.response.turn.raw();
  a.step = d.response.step.raw();
  a.cell_distance = d.response.cell.distance;
  a.cell_bias = d.response.cell.bias;
  a.pose = {status.pose.at.x.raw(), status.pose.at.y.raw(), status.pose.heading.raw()};
  for (int i = 0; i < hal::kBeams; ++i) {
    a.validity[i] = static_cast<uint8_t>(status.echoes.beam[i].validity);
    a.echo[i] = status.echoes.beam[i].distance.raw();
  }
  a.failures = failures(status.health);
  return a;
}

}  // namespace

template <class M>
bool Session::on_frame(M& message) noexcept {
  static_assert(size_of<M>() <= sizeof buffer_);
  if (!on_frame(size_of<M>())) return false;
  message = decode<M>(buffer_);
  return true;
}

template <class M>
bool Session::say(const M& message) noexcept {
  static_assert(size_of<M>() <= sizeof buffer_);
  encode(message, buffer_);
  return stream_->write(buffer_, size_of<M>());
}

template <class F>
bool Session::correct(const F& fix) noexcept {
  const localization::PoseSigma sigma{Length::from_raw(fix.sigma_along), Length::from_raw(fix.sigma_across),
                                      Angle::from_raw(fix.sigma_heading)};
  const bool sound = fix.sigma_along >= 0 && fix.sigma_across >= 0 && sigma.heading.wrapped() >= 0;
  if (robot_ == nullptr || !sound) return false;
  const bool taken = robot_->correct(pose(fix.pose), sigma);
  const Health& health = robot_->status().health;
  return say(Verdict{static_cast<uint8_t>(taken ? 1 : 0), health.fix_jumps, health.fixes_refused});
}

int Session::run(hal::ByteStream& stream, hal::Meter& meter) noexcept {
  stream_ = &stream;
  meter_ = &meter;
  overhead_ = hal::overhead(meter);
  my_ = &room_for_affairs_.make<Affairs>();
  while (!ended_) {
    uint8_t name = 0;
    if (!stream_->read(&name, 1) || !execute(static_cast<Name>(name))) return 1;
  }
  return 0;
}

bool Session::execute(Name name) noexcept {
  switch (name) {
    case Name::hello: return say(Greeting{kVersion, 0, planning::kRoomForMap});
    case Name::params: {
      if (!on_frame(kParamsSize)) return false;
      decode_params(my_->params, buffer_);
      robot_ = nullptr;
      return true;
    }
    case Name::begin: {
      Begin what;
      return on_frame(what) && begin(what);
    }
    case Name::goal: {
      Target what;
      if (!on_frame(what) || robot_ == nullptr) return false;
      robot_->set_goal(
          {{Length::from_raw(what.x), Length::from_raw(what.y)}, Length::from_raw(what.tolerance)});
      return true;
    }
    case Name::place: {
      Stand what;
      if (!on_frame(what) || robot_ == nullptr) return false;
      robot_->place(pose(what));
      return true;
    }
    case Name::cancel:
      if (robot_ != nullptr) robot_->cancel();
      return robot_ != nullptr;
    case Name::reset:
      if (robot_ != nullptr) robot_->reset();
      return robot_ != nullptr;
    // An image without the code for a gyro and the bound of the pose does not know these.
    case Name::gyro:
      if constexpr (kGyroBuilt) {
        GyroSums what;
        if (!on_frame(what) || robot_ == nullptr) return false;
        my_->gyro->on_frame(what);
        return true;
      }
      return false;
    case Name::fix:
      if constexpr (kGyroBuilt) {
        Fix what;
        return on_frame(what) && correct(what);
      }
      return false;
    case Name::tick: {
      Tick what;
      return on_frame(what) && tick(what);
    }
    case Name::fuzzy: {
      Probe what;
      return on_frame(what) && probe(what);
    }
    case Name::end: ended_ = true; return say(Total{ticks_, my_->hash.value(), meter_->deepest_stack()});
  }
  return false;
}

bool Session::begin(const Begin& what) noexcept {
  const auto make = [this](auto type) -> planning::Planner* {
    if constexpr (type.kMapBytes <= planning::kRoomForMap) {
      using Type = typename decltype(type)::Type;
      return &planning::planner_in(room_for_planner_.make<Type>(my_->params, fuzzy::kDefaultTable));
    }
    return nullptr;
  };
  const auto planner = planning::with_planner<planning::Planner*>(what.planner, what.map_bytes, make);
  if (planner == nullptr) return false;
  hal::Gyro* const gyro = kGyroBuilt ? my_->gyro.operator->() : nullptr;
  if (kGyroBuilt) my_->gyro->forget();
  robot_ = &room_for_robot_.make<Robot>(my_->board, my_->board, *planner, my_->params, &my_->board, gyro);
  robot_->place(pose(what.stand));
  return true;
}

bool Session::tick(const Tick& what) noexcept {
  if (robot_ == nullptr) return false;
  my_->board.on_frame(what);
  const uint32_t before = meter_->stamp();
  const Status& status = robot_->tick(Time::from_raw(what.now_ms));
  const uint32_t after = meter_->stamp();
  if (kGyroBuilt) my_->gyro->forget();
  ++ticks_;
  my_->hash.add(status.command);
  Answer answer = answer_of(status);
  answer.work = meter_->between(before, after) - overhead_;
  return say(answer);
}

bool Session::probe(const Probe& what) noexcept {
  const fuzzy::Engine engine{fuzzy::kDefaultTable};
  const fuzzy::Response r = engine({Q7::from_raw(what.distance), Q7::from_raw(what.bias)});
  my_->hash.add(r.turn.raw());
  my_->hash.add(r.step.raw());
  return say(Reaction{r.turn.raw(), r.step.raw(), r.cell.distance, r.cell.bias});
}

}  // namespace whisker::link
