#include "host/lab/hunt/corpus.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

namespace whisker::hunt {
namespace {

constexpr std::size_t kMost = 400;
constexpr double kNear = 0.3;  // radii
constexpr int kPicks = 4;      // of which the nearest is changed

std::string file_name(std::string niche) {
  std::replace_if(
      niche.begin(), niche.end(), [](char c) { return c == '/' || c == ' '; }, '-');
  return niche;
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
  if (outcome.closeness > kNear) return "";
  const auto found = kept_.find(file_name(kind));
  if (found == kept_.end()) return kept_.size() < kMost ? file_name(kind) : "";
  return outcome.closeness < found->second.closeness ? found->first : "";
}

void Corpus::keep(const std::string& niche, const Case& c, const Outcome& outcome) {
  states_.insert(outcome.states.begin(), outcome.states.end());
  const auto other = kept_.find(niche);
  // Another job may have found a nearer one meanwhile.
  if (other != kept_.end() && other->second.closeness <= outcome.closeness) return;
  kept_.insert_or_assign(niche, Kept{c, outcome.closeness});
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
