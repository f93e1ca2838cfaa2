#include "host/lab/tools/table_text.hpp"

#include <cstdio>

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/fuzzy/generate.hpp"

namespace whisker::tools {
namespace {

using fuzzy::Bilinear;

std::string formatted(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string node_text(const Bilinear::Node& node) {
  char text[32];
  std::snprintf(text, sizeof text, "{%6d,%6d},", node.turn, node.step);
  return text;
}

std::string bias_axis() {
  std::string line = "    //  R =";
  for (int r = 0; r < Bilinear::kBiasNodes; ++r) {
    const int raw = fuzzy::kBiasLow + r * Bilinear::kBiasSpacing;
    line += formatted(r == 0 ? " %6.2f" : " %15.2f", raw / 128.0);
  }
  return line + "\n";
}

std::string row_text(const Bilinear::Table& table, int d) {
  std::string line = "    {";
  for (const Bilinear::Node& node : table.node[d]) line += node_text(node);
  line.back() = '}';
  const int raw = fuzzy::kDistanceLow + d * Bilinear::kDistanceSpacing;
  return line + ",  // D = " + formatted("%.2f", raw / 128.0) + "\n";
}

}  // namespace

std::string response_table_text(const fuzzy::RuleBase& rules) {
  Bilinear::Table table;
  fuzzy::generate<Bilinear>(rules, table);
  std::string text =
      "/// The exact answers of firmware/fuzzy/rules.hpp at the nodes of the look-up: {SA, SD}, raw Q14.\n"
      "/// Written by whisker_generate_table; edit the rules, not this file.\n"
      "#pragma once\n\n"
      "#include \"firmware/fuzzy/bilinear.hpp\"\n\n"
      "namespace whisker::fuzzy {\n\n"
      "// clang-format off\n"
      "inline constexpr Bilinear::Table kResponseTable = {{\n";
  text += bias_axis();
  for (int d = 0; d < Bilinear::kDistanceNodes; ++d) text += row_text(table, d);
  return text + "}};\n// clang-format on\n\n}  // namespace whisker::fuzzy\n";
}

}  // namespace whisker::tools
