#include "host/lab/tools/grid_report.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/fuzzy/generate.hpp"

namespace whisker::tools {
namespace {

using fuzzy::Inputs;
using fuzzy::Response;

template <class F>
void for_each_input(F&& f) {
  for (int d = fuzzy::kDistanceLow; d <= fuzzy::kDistanceHigh; ++d)
    for (int r = fuzzy::kBiasLow; r <= fuzzy::kBiasHigh; ++r)
      f(Inputs{Q7::from_raw(static_cast<std::int16_t>(d)), Q7::from_raw(static_cast<std::int16_t>(r))});
}

struct Largest {
  int turn = 0;
  int step = 0;
};

template <class Engine>
Largest largest_errors(const Engine& engine, const std::vector<Response>& exact) {
  Largest largest;
  std::size_t i = 0;
  for_each_input([&](Inputs in) {
    const Response a = engine(in);
    const Response& b = exact[i++];
    largest.turn = std::max(largest.turn, std::abs(a.turn.raw() - b.turn.raw()));
    largest.step = std::max(largest.step, std::abs(a.step.raw() - b.step.raw()));
  });
  return largest;
}

std::string row(const char* name, std::size_t nodes, std::size_t bytes, Largest e) {
  char text[128];
  std::snprintf(text, sizeof text, "| %s | %zu | %zu | %.4f | %.4f |\n", name, nodes, bytes,
                e.turn / double{Q14::kOne}, e.step / double{Q14::kOne});
  return text;
}

template <int kDistanceShift, int kBiasShift>
std::string grid_row(const fuzzy::RuleBase& rules, const std::vector<Response>& exact) {
  using Grid = fuzzy::BilinearGrid<kDistanceShift, kBiasShift>;
  const auto table = std::make_unique<typename Grid::Table>();
  fuzzy::generate<Grid>(rules, *table);
  char name[64];
  std::snprintf(name, sizeof name, "look-up %dx%d, spacing %.3f in D, %.3f in R", int{Grid::kDistanceNodes},
                int{Grid::kBiasNodes}, Grid::kDistanceSpacing / 128.0, Grid::kBiasSpacing / 128.0);
  return row(name, std::size_t{Grid::kDistanceNodes} * Grid::kBiasNodes, sizeof(typename Grid::Table),
             largest_errors(Grid{*table}, exact));
}

}  // namespace

std::string grid_report(const fuzzy::RuleBase& rules) {
  std::vector<Response> exact;
  const fuzzy::Exact reference{rules};
  for_each_input([&](Inputs in) { exact.push_back(reference(in)); });
  return "| engine | nodes | bytes | max error SA | max error SD |\n|---|---|---|---|---|\n" +
         grid_row<7, 7>(rules, exact) + grid_row<6, 6>(rules, exact) + grid_row<5, 6>(rules, exact) +
         grid_row<6, 5>(rules, exact) + grid_row<4, 6>(rules, exact) + grid_row<5, 5>(rules, exact) +
         grid_row<6, 4>(rules, exact) + grid_row<4, 5>(rules, exact) + grid_row<5, 4>(rules, exact) +
         grid_row<4, 4>(rules, exact);
}

}  // namespace whisker::tools
