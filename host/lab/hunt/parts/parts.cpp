#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {

const std::vector<Part>& parts() {
  static const std::vector<Part> all = {
      {"wavefront", judge_wavefront},
      {"map", judge_map},
      {"window", judge_map_window},
      {"raster", judge_raster},
      {"grid", judge_grid},
      {"paths", judge_grid_paths},
      {"ground", judge_grid_times},
      {"chains", judge_chains},
      {"readings", judge_readings},
      {"odometry", judge_odometry},
      {"coasting", judge_coasting},
      {"wheels", judge_wheels},
      {"faults", judge_faults},
      {"manoeuvres", judge_manoeuvres},
      {"loops", judge_loops},
      {"base", judge_base},
      {"controller", judge_controller},
      {"guarded", judge_guarded},
      {"missions", judge_missions},
      {"planners", judge_planners},
      {"guide", judge_guide},
      {"senses", judge_senses},
      {"rules", judge_rules},
      {"broken", judge_broken_body},
      {"reports", judge_reports_of_base},
      {"orders", judge_orders_of_controller},
  };
  return all;
}

std::string judge_part(const std::string& name, std::uint64_t seed) {
  for (const Part& part : parts()) {
    if (part.name != name) continue;
    Dice dice(seed);
    return part.judge(dice);
  }
  return "";
}

}  // namespace whisker::hunt
