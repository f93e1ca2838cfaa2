#include "host/lab/page/guard_recording.hpp"

#include "host/lab/guard/trace.hpp"
#include "host/lab/page/json.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::page {
namespace {

constexpr std::int64_t kMicroUnits = 1000000;

TickRecord record_of(const guard::Moment& m) {
  TickRecord r;
  r.t_s = m.t_s;
  r.x_m = m.pose.at.x;
  r.y_m = m.pose.at.y;
  r.heading_rad = m.pose.heading;
  r.ranges = m.ranges;
  r.v_left_mps = m.v_left_mps;
  r.v_right_mps = m.v_right_mps;
  r.command = m.command;
  r.inside = m.status != nullptr;
  if (m.status == nullptr) return r;
  r.est_x_m = report::metres(m.status->pose.at.x);
  r.est_y_m = report::metres(m.status->pose.at.y);
  r.est_heading_rad = report::radians(m.status->pose.heading);
  if (m.status->sigma_known) r.sigma = m.status->sigma;
  return r;
}

Json guard_data(const GuardSetting& s) {
  Json reasons = Json::array();
  for (int i = 0; i < kGuardReasons; ++i) reasons.push_back(name(static_cast<GuardReason>(i)));
  const GuardParams& guard = s.scenario.robot.guard;
  const sim::Pose& start = s.scenario.start;
  return {{"guarded", s.guarded},
          {"operator", s.hand},
          {"nods", guard.nods == Fitted::yes},
          {"assist", guard.assist == Fitted::yes},
          {"vouched_m", s.vouched_m},
          {"command_timeout_s", static_cast<double>(guard.command_timeout.raw()) * 1e-3},
          {"put_down", {start.at.x, start.at.y, start.heading}},
          {"reasons", reasons}};
}

}  // namespace

void GuardRecording::add(const guard::Moment& m) {
  const TickRecord record = record_of(m);
  const GuardStatus* const s = m.status;
  log_.add({record, s != nullptr ? s->health : Health{}, m.grid});
  if (s != nullptr) {
    grants_.push_back({s->asked, s->forward, s->turning, s->reason});
  } else {
    constexpr Q14 kAll = Q14::ratio(1, 1);
    grants_.push_back({guard::velocity(m.asked), kAll, kAll, GuardReason::clear});
  }
}

StoredRun GuardRecording::stored(const guard::Result& result) const {
  Columns columns;
  add_ticks(columns, log_.ticks(), Detail::full);
  constexpr Order kSteady = Order::differences;
  columns.add("asked_v_mps", kSteady, kMicroUnits,
              column([](const Grant& g) { return g.asked.forward.raw(); }));
  columns.add("asked_omega_radps", kSteady, kMicroUnits,
              column([](const Grant& g) { return g.asked.turning.raw(); }));
  columns.add("granted_v", kSteady, Q14::kOne, column([](const Grant& g) { return g.forward.raw(); }));
  columns.add("granted_omega", kSteady, Q14::kOne, column([](const Grant& g) { return g.turning.raw(); }));
  columns.add("reason", kSteady, 1, column([](const Grant& g) { return static_cast<int>(g.reason); }));
  Packed data = packed(columns);
  Json json = setting_data(log_.setting());
  json["guard"] = guard_data(setting_);
  json["detail"] = "full";
  json["result"] = Json::parse(guard::result_json(result));
  json["edges"] = Json::array();
  json["columns"] = std::move(data.list);
  return {text_of(json), std::move(data.data)};
}

}  // namespace whisker::page
