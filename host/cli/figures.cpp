#include <atomic>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "host/cli/exit_status.hpp"
#include "host/cli/figures.hpp"
#include "host/cli/options.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/run/run_log.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/campaign/mission.hpp"
#include "host/lab/campaign/worlds.hpp"
#include "host/lab/report/figures.hpp"
#include "host/lab/report/run_svg.hpp"
#include "host/lab/report/table_svg.hpp"

namespace whisker::cli {
namespace {

/// A run of the boundary planner in each class of worlds: docs/navigation.md.
struct ClassPicture {
  const char* file;
  worlds::Kind kind;
  worlds::Options options;
};

constexpr ClassPicture kClassPictures[] = {
    {"boundary_15_discs.svg", worlds::Kind::discs, {6, 15, false, false}},
    {"boundary_30_discs.svg", worlds::Kind::discs, {8, {}, false, false}},
    {"boundary_50_discs.svg", worlds::Kind::discs, {26, 50, false, false}},
    {"boundary_75_discs.svg", worlds::Kind::discs, {14, 75, true, false}},
    {"boundary_u_trap.svg", worlds::Kind::u_trap, {8, {}, false, false}},
    {"boundary_spiral.svg", worlds::Kind::spiral, {4, {}, false, false}},
    {"boundary_maze.svg", worlds::Kind::maze, {1, {}, false, false}},
    {"boundary_rooms.svg", worlds::Kind::rooms, {4, {}, false, false}},
    {"boundary_poles.svg", worlds::Kind::poles, {4, {}, false, false}},
    {"boundary_enclosed.svg", worlds::Kind::enclosed, {1, {}, false, false}},
};

/// The map planner beside the boundary planner in one world of a class: the first one, with seeds from 1,
/// whose goal both reach and in which the boundary planner's path ratio exceeds its median in the class; for
/// `enclosed` the first one that both report as unreachable.
struct MapPicturePair {
  const char* name;  ///< map_NAME.svg, map_NAME_boundary.svg
  worlds::Kind kind;
  worlds::Options options;  ///< without the seed
  double boundary_median;   ///< as in docs/campaign.md
};

constexpr MapPicturePair kMapPictures[] = {
    {"30_discs", worlds::Kind::discs, {}, 1.060},
    {"50_discs", worlds::Kind::discs, {1, 50, false, false}, 1.358},
    {"75_discs", worlds::Kind::discs, {1, 75, true, false}, 1.533},
    {"u_trap", worlds::Kind::u_trap, {}, 1.497},
    {"spiral", worlds::Kind::spiral, {}, 1.393},
    {"maze", worlds::Kind::maze, {}, 1.506},
    {"rooms", worlds::Kind::rooms, {}, 2.667},
    {"enclosed", worlds::Kind::enclosed, {}, 0},
};

RunLog driven(const Scenario& scenario, PlannerKind planner) {
  RunLog log({scenario, planner, scenario.seed});
  RunOptions options;
  options.planner = planner;
  log.watch(options);
  log.end(run(scenario, options));
  return log;
}

void draw(const RunLog& log, const std::string& svg_file, const report::RunPicture& picture = {}) {
  files::write(svg_file, report::run_svg(log, picture));
  fmt::print("{}\n", svg_file);
}

void draw_class(const ClassPicture& c, const std::string& folder) {
  report::RunPicture picture;
  picture.subtitle = fmt::format("whisker campaign {} --planner boundary --replay {}",
                                 campaign::arguments(c.kind, c.options), c.options.seed);
  picture.path_tolerance = 2e-3;
  draw(driven(worlds::generate(c.kind, c.options), PlannerKind::boundary),
       fmt::format("{}/{}", folder, c.file), picture);
}

bool shows_the_difference(const MapPicturePair& pair, const campaign::Mission& mission) {
  const std::atomic<bool> never{false};
  const auto row_of = [&](PlannerKind planner) {
    campaign::Row row = campaign::drive(mission.scenario, planner, never);
    row.world = mission.world;
    return row;
  };
  const campaign::Row boundary = row_of(PlannerKind::boundary);
  if (!campaign::succeeded(boundary) || campaign::ratio(boundary).value_or(1) <= pair.boundary_median)
    return false;
  return campaign::succeeded(row_of(PlannerKind::map));
}

void draw_pair(const MapPicturePair& pair, const std::string& folder) {
  constexpr std::uint64_t kSeeds = 200;
  for (std::uint64_t i = 0; i < kSeeds; ++i) {
    const campaign::Mission mission = campaign::mission(campaign::Generated{pair.kind, pair.options}, i);
    if (!shows_the_difference(pair, mission)) continue;
    const RunLog boundary = driven(mission.scenario, PlannerKind::boundary);
    const RunLog map = driven(mission.scenario, PlannerKind::map);
    report::RunPicture picture;
    picture.path_tolerance = 2e-3;
    picture.legend = false;
    picture.beside = &map.ticks().records;
    picture.subtitle = fmt::format("boundary planner: whisker campaign {} --planner boundary --replay {}",
                                   mission.world, mission.seed);
    draw(boundary, fmt::format("{}/map_{}_boundary.svg", folder, pair.name), picture);
    picture.beside = &boundary.ticks().records;
    picture.subtitle = fmt::format("map planner, 2048 bytes: whisker campaign {} --planner map --replay {}",
                                   mission.world, mission.seed);
    draw(map, fmt::format("{}/map_{}.svg", folder, pair.name), picture);
    return;
  }
  throw std::runtime_error(
      fmt::format("{}: no seed up to {} shows how the planners differ", pair.name, kSeeds));
}

/// The scenarios at build time.
constexpr std::pair<const char*, const char*> kScenarios[] = {
#include <figure_scenarios.inc>
};

Scenario scenario(const FiguresOptions& o, const std::string& name) {
  if (!o.scenarios.empty()) return load_scenario(fmt::format("{}/{}", o.scenarios, name));
  for (const auto& [known, text] : kScenarios) {
    if (name == known) return parse_scenario(text, name);
  }
  throw std::logic_error("no scenario " + name);
}

}  // namespace

int draw_figures(const FiguresOptions& o) {
  if (!std::filesystem::is_directory(o.out)) throw UsageError(fmt::format("{}: no such folder", o.out));
  const Scenario figure8 = scenario(o, "figure8_u_trap.toml");
  const Scenario figure9 = scenario(o, "figure9_discs.toml");
  const Scenario figure10 = scenario(o, "figure10_discs.toml");
  const report::FuzzyPicture picture = controller_picture();
  auto drawn = report::thesis_figures(picture);
  drawn.emplace_back("response.svg", report::table_svg(picture));
  for (const auto& [file, svg] : drawn) {
    const std::string path = fmt::format("{}/{}", o.out, file);
    files::write(path, svg);
    fmt::print("{}\n", path);
  }
  draw(driven(figure8, PlannerKind::thesis), o.out + "/figure8.svg");
  draw(driven(figure9, PlannerKind::thesis), o.out + "/figure9.svg");
  draw(driven(figure10, PlannerKind::thesis), o.out + "/figure10.svg");
  for (const ClassPicture& c : kClassPictures) draw_class(c, o.out);
  for (const MapPicturePair& pair : kMapPictures) draw_pair(pair, o.out);
  return 0;
}

}  // namespace whisker::cli
