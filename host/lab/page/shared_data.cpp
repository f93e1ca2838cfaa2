#include <cmath>

#include "firmware/health.hpp"
#include "firmware/planning/state.hpp"
#include "host/harness/run/guidance.hpp"
#include "host/lab/page/json.hpp"
#include "host/lab/report/palette.hpp"

namespace whisker::page {
namespace {

/// Samples per unit of D and of R.
constexpr int kSamples = 4;

Json terms(const report::Variable& variable) {
  Json list = Json::array();
  for (const report::Term& term : variable.terms) list.push_back({term.name, term.centre});
  return list;
}

Json variable(const report::Variable& v) {
  return {{"symbol", v.symbol}, {"meaning", v.meaning}, {"min", v.min}, {"max", v.max}, {"terms", terms(v)}};
}

Json rules(const std::vector<std::vector<report::Rule>>& picture) {
  Json rows = Json::array();
  for (const auto& line : picture) {
    Json& row = rows.emplace_back(Json::array());
    for (const report::Rule& rule : line) row.push_back({rule.term, rule.value});
  }
  return rows;
}

/// Thousandths, by rows of ascending D, ascending R within a row.
Json surface(const Controller& c, const std::function<double(double, double)>& at) {
  Json samples = Json::array();
  const int rows = static_cast<int>(std::lround((c.d.max - c.d.min) * kSamples));
  const int columns = static_cast<int>(std::lround((c.r.max - c.r.min) * kSamples));
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const double value =
          at(c.d.min + static_cast<double>(i) / kSamples, c.r.min + static_cast<double>(j) / kSamples);
      samples.push_back(std::lround(value * 1000));
    }
  }
  return samples;
}

Json controller_data(const Controller& c) {
  return {{"d", variable(c.d)},
          {"r", variable(c.r)},
          {"sa", variable(c.sa)},
          {"sd", variable(c.sd)},
          {"turn", rules(c.turn)},
          {"step", rules(c.step)},
          {"samples_per_unit", kSamples},
          {"sa_thousandths", surface(c, c.sa_at)},
          {"sd_thousandths", surface(c, c.sd_at)},
          {"d_nodes", c.d_nodes},
          {"r_nodes", c.r_nodes},
          {"source", c.source}};
}

template <class T>
Json names(int count) {
  Json list = Json::array();
  for (int i = 0; i < count; ++i) list.push_back(planning::name(static_cast<T>(i)));
  return list;
}

}  // namespace

Json names_data() {
  Json faults = Json::array();
  for (int i = 0; i < kFaults; ++i) faults.push_back(name(static_cast<Fault>(i)));
  Json guides = Json::array();
  for (int i = 0; i < kGuidances; ++i) guides.push_back(name(static_cast<Guidance>(i)));
  Json doings = Json::array();
  for (const report::Look& look : report::kLooks)
    doings.push_back({{"name", look.name}, {"label", look.label}});
  return {{"modes", names<planning::Mode>(planning::kModes)},
          {"whys", names<planning::Why>(planning::kWhys)},
          {"faults", faults},
          {"guides", guides},
          {"doings", doings}};
}

Json shared_data(const Controller& controller) {
  Json data = names_data();
  data["controller"] = controller_data(controller);
  return data;
}

}  // namespace whisker::page
