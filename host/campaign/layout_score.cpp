#include "host/campaign/layout_score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace whisker::campaign {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-6;  // deg

std::optional<double> median_pace(const Row* first, std::size_t count) {
  std::vector<double> paces;
  for (const Row* row = first; row != first + count; ++row) {
    paces.push_back(truly_there(*row) ? s_per_m(*row).value_or(kNever) : kNever);
  }
  std::sort(paces.begin(), paces.end());
  const double median = paces[(count - 1) / 2];
  return median == kNever ? std::nullopt : std::optional(median);
}

/// 2: every wall ahead is seen, with the margin; 1: without; 0: some are not.
int walls(const LayoutScore& s) {
  return s.margin_deg >= kIncidenceMargin - kRounding ? 2 : s.margin_deg >= -kRounding ? 1 : 0;
}
std::uint64_t failed(const LayoutScore& s) { return s.missions - s.reached; }
double pace(const LayoutScore& s) { return s.s_per_m.value_or(kNever); }

template <class Same>
std::uint64_t count(const std::vector<LayoutScore>& all, const Same& same) {
  return static_cast<std::uint64_t>(std::count_if(all.begin(), all.end(), same));
}

}  // namespace

LayoutScore score(const Layout& layout, const Sensor& sensor, const std::vector<Row>& rows) {
  LayoutScore s;
  s.layout = layout;
  s.needed_incidence_deg = needed_incidence_deg(layout.robot, sensor);
  s.margin_deg = seen_incidence_deg(layout.robot, sensor) - s.needed_incidence_deg;
  s.unseen = unseen_strip(layout.robot, sensor);
  s.missions = rows.size();
  for (const Row& row : rows) {
    s.reached += truly_there(row) ? 1U : 0U;
    s.contacts += row.verdict == Verdict::contact ? 1U : 0U;
  }
  s.success = share(s.reached, s.missions);
  s.contact = share(s.contacts, s.missions);
  s.s_per_m = median_pace(rows.data(), rows.size());
  const std::size_t each = rows.size() / kLayoutKinds;
  for (std::size_t k = 0; k < kLayoutKinds; ++k) {
    s.world_s_per_m[k] = median_pace(rows.data() + k * each, each);
  }
  return s;
}

void rank(std::vector<LayoutScore>& scores) {
  const auto key = [](const LayoutScore& s) {
    return std::tuple(-walls(s), s.contacts, failed(s), pace(s), s.layout.offset_m, s.layout.side_angle_deg);
  };
  std::sort(scores.begin(), scores.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
}

std::string reason(const std::vector<LayoutScore>& all) {
  const LayoutScore& best = all.front();
  const auto seen = [&](const LayoutScore& s) { return walls(s) == walls(best); };
  const auto untouched = [&](const LayoutScore& s) { return seen(s) && s.contacts == best.contacts; };
  const auto equal = [&](const LayoutScore& s) { return untouched(s) && s.reached == best.reached; };
  constexpr const char* kWalls[] = {"none sees every wall ahead, so that all {} are compared",
                                    "{} see every wall ahead, none of them with {} degrees to spare",
                                    "{} see every wall ahead with {} degrees to spare"};
  std::string text = fmt::format("of {} layouts, ", all.size()) +
                     fmt::format(fmt::runtime(kWalls[walls(best)]), count(all, seen), kIncidenceMargin);
  text +=
      fmt::format("; {} of these with the fewest contacts ({} in {} missions; 95 % bound {:.0f} %)",
                  count(all, untouched), best.contacts, best.missions, 100 * best.contact.high.value_or(1));
  text += fmt::format("; {} of these with the most goals reached ({} of {})", count(all, equal), best.reached,
                      best.missions);
  if (best.s_per_m) return text + fmt::format("; the fastest of these ({:.1f} s/m)", *best.s_per_m);
  return text + "; fewer than half of the missions reach their goal, so that no time is compared";
}

}  // namespace whisker::campaign
