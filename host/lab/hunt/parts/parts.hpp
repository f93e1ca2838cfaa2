/// Parts of the core alone, under random inputs, each judged by a plain model of what its documents say.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/lab/hunt/dice.hpp"

namespace whisker::hunt {

/// Draws one case. Returns what is wrong in a few words without a comma; empty: nothing.
using JudgePart = std::string (*)(Dice& dice);

struct Part {
  const char* name;
  JudgePart judge;
};

const std::vector<Part>& parts();
/// Empty also if there is no such part.
std::string judge_part(const std::string& name, std::uint64_t seed);

// By folder of the core.
std::string judge_wavefront(Dice& dice);
std::string judge_map(Dice& dice);
std::string judge_map_window(Dice& dice);
std::string judge_raster(Dice& dice);
std::string judge_grid(Dice& dice);
std::string judge_grid_paths(Dice& dice);
std::string judge_grid_times(Dice& dice);
std::string judge_chains(Dice& dice);
std::string judge_readings(Dice& dice);
std::string judge_odometry(Dice& dice);
std::string judge_coasting(Dice& dice);
std::string judge_wheels(Dice& dice);
std::string judge_faults(Dice& dice);
std::string judge_manoeuvres(Dice& dice);
std::string judge_loops(Dice& dice);
std::string judge_guarded(Dice& dice);
std::string judge_broken_body(Dice& dice);
std::string judge_missions(Dice& dice);
std::string judge_planners(Dice& dice);
std::string judge_guide(Dice& dice);
std::string judge_senses(Dice& dice);
std::string judge_rules(Dice& dice);
std::string judge_base(Dice& dice);
std::string judge_reports_of_base(Dice& dice);
std::string judge_orders_of_controller(Dice& dice);
std::string judge_controller(Dice& dice);

}  // namespace whisker::hunt
