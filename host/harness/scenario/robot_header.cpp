#include "host/harness/scenario/robot_header.hpp"

#include <fmt/format.h>

#include <map>
#include <string_view>

#include "host/harness/scenario/param_list.hpp"

namespace whisker {
namespace {

/// Key -> field, read from firmware/params.hpp by CMake.
const std::map<std::string_view, std::string_view>& fields() {
  static const std::map<std::string_view, std::string_view> all = {
#include <param_fields.inc>
  };
  return all;
}

std::string value(const ParamEntry& e, std::string_view field) {
  if (e.word != nullptr) return fmt::format("static_cast<decltype({})>({})", field, e.raw);
  if (*e.unit.symbol == 0) return fmt::format("{}", e.raw);
  return fmt::format("{}::from_raw({})", e.type, e.raw);
}

/// Replaces backslashes and control characters, which could continue or end the comment.
std::string in_a_comment(std::string text) {
  for (char& c : text) {
    if (c == '\\' || (c >= 0 && c < ' ') || c == '\x7F') c = '?';
  }
  return text;
}

/// The second one is for the core as two files, Arduino's and PlatformIO's.
constexpr const char* kCore =
    "#if __has_include(\"firmware/params.hpp\")\n"
    "#include \"firmware/params.hpp\"\n"
    "#else\n"
    "#include \"whisker.hpp\"\n"
    "#endif\n";

}  // namespace

std::string robot_header(const Params& params, const std::string& source) {
  const std::vector<ParamEntry> reference = param_list(Params{});
  const std::vector<ParamEntry> chosen = param_list(params);
  std::string lines;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const ParamEntry& e = chosen[i];
    if (e.raw == reference[i].raw) continue;
    const std::string_view field = fields().at(e.key);
    lines += fmt::format("  {} = {};  // {} = {}\n", field, value(e, field), e.key, e.text());
  }
  return fmt::format(R"(// {}, written by `whisker robot check`: what differs from Whisker's reference robot.
#pragma once

{}
constexpr whisker::Params my_robot() noexcept {{
  using namespace whisker;
  Params p;
{}  return p;
}}
static_assert(whisker::check(my_robot()) == whisker::ParamFault::none, "the parameters do not fit together");
)",
                     in_a_comment(source), kCore, lines);
}

}  // namespace whisker
