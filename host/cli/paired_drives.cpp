#include "host/cli/paired_drives.hpp"

#include <optional>
#include <string>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "host/campaign/mission.hpp"
#include "host/cli/campaign_options.hpp"
#include "host/cli/rules_choice.hpp"

namespace whisker::cli {
namespace {

using Json = nlohmann::ordered_json;
using campaign::Estimate;

std::string bounds(const std::optional<Estimate>& e, double scale, int digits, bool sign) {
  if (!e) return "-";
  const auto number = [&](double x) {
    return sign ? fmt::format("{:+.{}f}", scale * x, digits) : fmt::format("{:.{}f}", scale * x, digits);
  };
  if (!e->low || !e->high) return number(e->value);
  return fmt::format("{} [{}, {}]", number(e->value), number(*e->low), number(*e->high));
}

Json or_null(const std::optional<Estimate>& e) { return e ? estimate_json(*e) : Json(nullptr); }

Json side(const Estimate& success, std::uint64_t contacts, std::uint64_t alone) {
  return {{"success", estimate_json(success)}, {"contacts", contacts}, {"succeeds_alone", alone}};
}

}  // namespace

bool drive_pairs(std::uint64_t count, int jobs, const DriveSide& drive, std::vector<campaign::Pair>& pairs) {
  std::vector<double> jerks(2 * count);
  std::vector<campaign::Row> rows;
  const bool whole = make_many(
      2 * count, jobs,
      [&](std::uint64_t i, const std::atomic<bool>& stop) {
        return drive(i / 2, static_cast<int>(i % 2), jerks[i], stop);
      },
      [&](const campaign::Row& row) { rows.push_back(row); });
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2)
    pairs.push_back({rows[i], rows[i + 1], jerks[i], jerks[i + 1]});
  return whole;
}

campaign::Row drive_with_jerk(campaign::Mission mission, PlannerKind kind, double& jerk,
                              const std::atomic<bool>& stop) {
  bend_if_chosen(mission.scenario.robot, kind);
  campaign::JerkMeter meter;
  const auto note = [&](const TickRecord& r) { meter.add(r.t_s, (r.v_left_mps + r.v_right_mps) / 2); };
  campaign::Row row = campaign::drive(mission.scenario, kind, stop, campaign::kWayRadius, note);
  jerk = meter.rms();
  row.world = mission.world;
  return row;
}

void print_comparison(std::FILE* out, const campaign::Comparison& c) {
  fmt::print(out, "success, %        A {}, B {}; only A {}, only B {}\n", bounds(c.success_a, 100, 1, false),
             bounds(c.success_b, 100, 1, false), c.only_a, c.only_b);
  fmt::print(out, "contacts          A {}, B {}\n", c.contacts_a, c.contacts_b);
  fmt::print(out, "over the {} worlds that both reach, with 95 % bounds:\n", c.both);
  fmt::print(out, "time, B / A       {}\n", bounds(c.time, 1, 3, false));
  fmt::print(out, "path, B / A       {}\n", bounds(c.path, 1, 3, false));
  fmt::print(out, "jerk, B / A       {}\n", bounds(c.jerk, 1, 3, false));
  fmt::print(out, "stops per m, B-A  {}\n", bounds(c.stops, 1, 3, true));
  fmt::print(out, "flips per m, B-A  {}\n", bounds(c.flips, 1, 3, true));
  fmt::print(out, "clearance, B-A    {} mm\n", bounds(c.clearance, 1000, 2, true));
}

Json estimate_json(const Estimate& e) {
  const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  return {{"value", e.value}, {"low", number(e.low)}, {"high", number(e.high)}};
}

Json comparison_json(const campaign::Comparison& c) {
  return {{"worlds", c.worlds},
          {"both_reach", c.both},
          {"a", side(c.success_a, c.contacts_a, c.only_a)},
          {"b", side(c.success_b, c.contacts_b, c.only_b)},
          {"time_ratio", or_null(c.time)},
          {"path_ratio", or_null(c.path)},
          {"jerk_ratio", or_null(c.jerk)},
          {"stops_per_m_difference", or_null(c.stops)},
          {"flips_per_m_difference", or_null(c.flips)},
          {"clearance_m_difference", or_null(c.clearance)}};
}

std::string estimate_text(const Estimate& e, int digits) { return bounds(e, 1, digits, false); }

}  // namespace whisker::cli
