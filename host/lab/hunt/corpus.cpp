#include "host/lab/hunt/corpus.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/math/work.hpp"

namespace whisker::hunt {
namespace {

constexpr std::size_t kMost = 400;
constexpr double kNear = 0.3;  // radii
constexpr int kPicks = 4;      // of which the nearest is changed
// Niches of the most work in a tick.
constexpr std::string_view kDear = "-dear";

std::string file_name(std::string niche) {
  std::replace_if(
      niche.begin(), niche.end(), [](char c) { return c == '/' || c == ' '; }, '-');
  return niche;
}

bool is_dear(std::string_view niche) {
  return niche.size() > kDear.size() && niche.substr(niche.size() - kDear.size()) == kDear;
}

/// To a violation of what the niche is for.
double closeness(const std::string& niche, const Outcome& outcome) {
  return is_dear(niche) ? 1 - static_cast<double>(outcome.work) / Work::kMost : outcome.closeness;
}

}  // namespace

Corpus::Corpus(std::string folder) : folder_(std::move(folder)) {
  if (folder_.empty()) return;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  // How near they came is not in the files: a new drive decides.
  for (const auto& file : files) kept_.insert({file.stem().string(), {load_case(file.string()), kNear}});
}

std::string Corpus::niche(const std::string& kind, const Outcome& outcome) const {
  for (const std::string& state : outcome.states) {
    if (states_.count(state) == 0 && kept_.size() < kMost) return file_name("state-" + state);
  }
  std::string name = file_name(kind);
  for (;; name += kDear) {
    const auto found = kept_.find(name);
    const bool known = found != kept_.end();
    const double least = known ? found->second.closeness : kNear;
    if ((known || kept_.size() < kMost) && closeness(name, outcome) < least) return name;
    if (is_dear(name)) return "";
  }
}

void Corpus::keep(const std::string& niche, const Case& c, const Outcome& outcome) {
  states_.insert(outcome.states.begin(), outcome.states.end());
  const auto other = kept_.find(niche);
  // Another job may have found a nearer one meanwhile.
  const double near = closeness(niche, outcome);
  if (other != kept_.end() && other->second.closeness <= near) return;
  kept_.insert_or_assign(niche, Kept{c, near});
  if (!folder_.empty()) save(c, folder_ + "/" + niche);
}

Corpus::Pick Corpus::pick(Dice& dice) const {
  const auto draw = [&] { return std::next(kept_.begin(), dice.index(static_cast<int>(kept_.size()))); };
  auto best = draw();
  for (int i = 1; i < kPicks; ++i) {
    const auto other = draw();
    if (other->second.closeness < best->second.closeness) best = other;
  }
  return {best->first, best->second.c};
}

}  // namespace whisker::hunt
