#include "tests/campaign/rows.hpp"

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace whisker::campaign {
namespace {

std::string random_text(worlds::Random& random) {
  static const std::string kLetters = "az09 _-/.,\"'\xC3\xA4";
  std::string text;
  for (int i = random.index(8); i > 0; --i) {
    text += kLetters[static_cast<std::size_t>(random.index(static_cast<int>(kLetters.size())))];
  }
  return text;
}

double random_amount(worlds::Random& random) {
  const double scale[] = {0, 1e-6, 1, 1e3, 1e6};
  return rounded(random.uniform(0, 1) * scale[random.index(5)]);
}

}  // namespace

Row random_row(worlds::Random& random) {
  constexpr Verdict kVerdicts[] = {Verdict::reached, Verdict::off_goal, Verdict::unreachable,
                                   Verdict::gave_up, Verdict::contact,  Verdict::fault};
  Row r;
  r.seed = random.bits() >> (1 + random.index(60));
  r.verdict = kVerdicts[random.index(6)];
  r.time_s = random_amount(random);
  r.path_m = random_amount(random);
  r.turned_rad = random_amount(random);
  r.stops = random.bits() >> random.index(64);
  r.flips = random.bits() >> random.index(64);
  r.looks = random.bits() >> random.index(64);
  r.min_clearance_m = rounded(random.uniform(-0.1, 0.1));
  r.final_distance_m = random_amount(random);
  r.estimate_error_m = random_amount(random);
  if (random.chance(0.7)) r.believed_distance_m = random_amount(random);
  r.at_goal = says_reached(r.verdict) ? r.verdict == Verdict::reached : random.chance(0.5);
  if (random.chance(0.7)) r.shortest_m = random_amount(random);
  r.ticks = random.bits() >> random.index(64);
  r.hash = random.bits();
  r.detail = random_text(random);
  r.planner = random_text(random);
  r.robot = random_text(random);
  r.world = random_text(random);
  r.missions = random.bits() >> random.index(64);
  r.mission = r.missions / 2;
  return r;
}

Folder::Folder() {
  std::string name = std::filesystem::temp_directory_path() / "whisker-campaign-XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for the test");
  path_ = name;
}

Folder::~Folder() { std::filesystem::remove_all(path_); }

std::string Folder::file(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace whisker::campaign
