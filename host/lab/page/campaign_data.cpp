#include <algorithm>
#include <numeric>

#include "host/lab/campaign/failures.hpp"
#include "host/lab/campaign/summary.hpp"
#include "host/lab/page/json.hpp"
#include "host/lab/report/result.hpp"

namespace whisker::page {
namespace {

Json number(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

Json row_data(const campaign::Row& row) {
  return {row.seed,
          report::outcome(row.verdict),
          campaign::succeeded(row),
          row.time_s,
          row.path_m,
          number(row.shortest_m),
          number(campaign::ratio(row)),
          number(campaign::s_per_m(row)),
          row.min_clearance_m,
          row.estimate_error_m,
          row.detail,
          row.final_distance_m};
}

constexpr int kOffGoal = 3;

/// Smaller is more severe.
int severity(const campaign::Row& row) {
  if (row.verdict == Verdict::contact) return 0;
  if (row.verdict == Verdict::fault) return 1;
  if (!campaign::succeeded(row)) return 2;
  return row.verdict == Verdict::off_goal ? kOffGoal : kOffGoal + 1;
}

}  // namespace

Json campaign_data(const std::vector<campaign::Row>& rows) {
  Json list = Json::array();
  for (const campaign::Row& row : rows) list.push_back(row_data(row));
  const Json fields = {"seed",  "outcome", "success",   "time_s",         "path_m", "shortest_m",
                       "ratio", "s_per_m", "clearance", "estimate_error", "detail", "final_distance_m"};
  return {{"summary", Json::parse(campaign::summary_json(campaign::summarize(rows)))},
          {"fields", fields},
          {"rows", list}};
}

std::vector<std::size_t> worst(const std::vector<campaign::Row>& rows, std::size_t most) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const int first = severity(rows[a]), second = severity(rows[b]);
    if (first != second) return first < second;
    if (first == kOffGoal) return rows[a].final_distance_m > rows[b].final_distance_m;
    return campaign::ratio(rows[a]).value_or(0) > campaign::ratio(rows[b]).value_or(0);
  });
  order.resize(std::min(order.size(), most));
  return order;
}

}  // namespace whisker::page
