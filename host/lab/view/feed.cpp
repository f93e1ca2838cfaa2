#include "host/lab/view/feed.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include <fmt/core.h>

#include "host/lab/page/json.hpp"
#include "host/lab/report/result.hpp"

namespace whisker::view {
namespace {

// Maximum ticks copied at once, because the simulation may wait for the copy.
constexpr std::size_t kWhole = 256;

// Maximum reports of those at a time, so that a long run does not take too much memory or time at once.
constexpr std::size_t kMostParts = 16;

using page::Json;
using Edges = std::vector<report::EncounterFinder::Found>;

std::string new_name() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

/// The boundaries as known after the first `ticks` ticks.
Edges as_of(std::size_t ticks, Edges edges) {
  const auto later = [ticks](const std::optional<std::size_t>& tick) { return tick && *tick >= ticks; };
  while (!edges.empty() && edges.back().hit >= ticks) edges.pop_back();
  for (auto& edge : edges) {
    if (later(edge.turned)) edge.turned.reset();
    if (!later(edge.left)) continue;
    edge.left.reset();
    edge.end = report::Encounter::End::none;
  }
  return edges;
}

}  // namespace

void Feed::begin(const RunSetting& setting) {
  const std::string json = page::text_of(page::setting_data(setting));
  const std::scoped_lock lock(mutex_);
  run_ = new_name();
  setting_ = json;
  last_.emplace(setting);
  whole_.clear();
  count_ = 0;
  edges_ = {};
  words_.clear();
  ++notes_;
}

void Feed::add(const Moment& moment) {
  const std::scoped_lock lock(mutex_);
  last_->add(moment);
  edges_.add(moment.record);
  if (++count_ % kWhole == 0) whole_.push_back(std::make_shared<const Ticks>(last_->take()));
}

void Feed::say(const std::string& words) {
  const std::scoped_lock lock(mutex_);
  words_ = words;
  ++notes_;
}

void Feed::end(const RunResult& result) {
  const std::string json = report::result_json(result);
  const std::scoped_lock lock(mutex_);
  result_ = json;
  closed_ = true;
  ++notes_;
}

void Feed::close() {
  const std::scoped_lock lock(mutex_);
  if (closed_) return;
  closed_ = true;
  ++notes_;
}

bool Feed::reported(const Place& place) const {
  return place.run == run_ && place.next == count_ && place.notes == notes_;
}

bool Feed::over(const Place& place) const {
  const std::scoped_lock lock(mutex_);
  return closed_ && reported(place);
}

std::optional<std::string> Feed::news(Place& place) const {
  Json json;
  std::string setting, result;
  Edges edges;
  std::vector<std::shared_ptr<const Ticks>> parts;
  Ticks last;
  std::size_t from = 0;
  {
    const std::scoped_lock lock(mutex_);
    if (run_.empty() || reported(place)) return std::nullopt;
    if (place.run != run_ || place.next > count_) {
      setting = setting_;
      place.next = 0;
    }
    from = place.next;
    const std::size_t part = std::min(from / kWhole, whole_.size());
    const bool all = whole_.size() - part <= kMostParts;
    const std::size_t end = all ? whole_.size() : part + kMostParts;
    parts.assign(whole_.begin() + static_cast<std::ptrdiff_t>(part),
                 whole_.begin() + static_cast<std::ptrdiff_t>(end));
    if (all) last = last_->ticks();
    const std::size_t next = all ? count_ : end * kWhole;
    edges = as_of(next, edges_.found());
    if (all) result = result_;
    json = {{"run", run_}, {"from", from}, {"says", words_}, {"ended", all && closed_}};
    place = {run_, next, notes_};
  }
  Ticks ticks;
  std::size_t first = from / kWhole * kWhole;
  for (const auto& part : parts) {
    ticks.append(*part, from > first ? from - first : 0, first);
    first += kWhole;
  }
  ticks.append(last, from > first ? from - first : 0, first);
  if (!setting.empty()) json["setting"] = Json::parse(setting);
  page::Packed columns = page::packed(ticks);
  json["columns"] = std::move(columns.list);
  json["data"] = std::move(columns.data);
  json["edges"] = page::edges_data(edges);
  json["result"] = result.empty() ? Json(nullptr) : Json::parse(result);
  return page::text_of(json);
}

}  // namespace whisker::view
