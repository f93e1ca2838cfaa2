#include "host/lab/rules/response.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "host/lab/rules/inference.hpp"
#include "host/lab/rules/surface.hpp"
#include "host/lab/rules/table.hpp"

namespace whisker::rules {
namespace {

using fuzzy::Bilinear;

constexpr double kInputUnits = 128;
constexpr double kOutputUnits = 16384;
/// What scale() of firmware/fuzzy/scale.hpp can return, raw.
constexpr std::int32_t kFarthest = 1280;
constexpr std::int32_t kMostBias = 1024;

template <class Named>
std::size_t find(const RuleBase& base, const std::vector<Named>& all, const std::string& name,
                 const char* kind) {
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == name) return i;
  std::string names;
  for (const Named& one : all) names += (names.empty() ? "" : ", ") + one.name;
  fail(base, {}, fmt::format("no {} '{}' to drive with; the file has {}", kind, name, names));
}

Domain::Part part(const RuleBase& base, std::size_t input, std::int32_t low, std::int32_t high) {
  const Input& in = base.inputs[input];
  if (in.low > low / kInputUnits || in.high < high / kInputUnits) {
    fail(base, in.place,
         fmt::format("'{}' is from {:g} to {:g}; to drive with it, it must cover {:g} to {:g}", in.name,
                     in.low, in.high, low / kInputUnits, high / kInputUnits));
  }
  return {{input, 0, kInputUnits, low, high}, low, high};
}

void check_answers(const RuleBase& base, const Surface& surface, std::size_t output) {
  const Output& out = base.outputs[output];
  const auto& values = surface.values[output];
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (surface.silent[output][i] != 0 && out.silent == Silent::undefined) {
      fail(base, out.place,
           fmt::format("'{}' has no answer where no rule fires: {}; give it a default", out.name,
                       out.silent_reason));
    }
    const double raw = values[i] * kOutputUnits;
    if (!(std::abs(raw) <= INT16_MAX + 0.4)) {
      fail(
          base, out.place,
          fmt::format("'{}' reaches {:g}; to drive with it, it must stay from -2 to 2", out.name, values[i]));
    }
  }
}

bool mirrored(const Bilinear::Table& table) {
  for (const auto& row : table.node) {
    for (int r = 0; r < Bilinear::kBiasNodes; ++r) {
      const Bilinear::Node& one = row[r];
      const Bilinear::Node& other = row[Bilinear::kBiasNodes - 1 - r];
      if (one.turn != -other.turn || one.step != other.step) return false;
    }
  }
  return true;
}

/// Asks the core's look-up for every input.
void measure(const Surface& surface, Response& response) {
  const Bilinear look_up(response.table);
  const auto columns = static_cast<std::size_t>(surface.domain.columns());
  for (std::int32_t d = 0; d <= kFarthest; ++d) {
    for (std::int32_t r = -kMostBias; r <= kMostBias; ++r) {
      const fuzzy::Inputs at{Q7::from_raw(static_cast<std::int16_t>(d)),
                             Q7::from_raw(static_cast<std::int16_t>(r))};
      const fuzzy::Response found = look_up(at);
      const std::size_t i = static_cast<std::size_t>(d) * columns + static_cast<std::size_t>(r + kMostBias);
      const auto differs = [&](std::size_t o, Q14 value) {
        return std::abs(value.raw() / kOutputUnits - surface.values[o][i]);
      };
      response.turn_error = std::max(response.turn_error, differs(0, found.turn));
      response.step_error = std::max(response.step_error, differs(1, found.step));
    }
  }
}

}  // namespace

ResponseNames response_names(const std::vector<std::string>& changes) {
  ResponseNames names;
  const struct {
    const char* core;
    std::string& name;
  } known[] = {{"D", names.distance}, {"R", names.bias}, {"SA", names.turn}, {"SD", names.step}};
  for (const std::string& change : changes) {
    const std::size_t equals = change.find('=');
    bool found = false;
    for (const auto& k : known) {
      if (equals == std::string::npos || change.substr(0, equals) != k.core) continue;
      k.name = change.substr(equals + 1);
      found = !k.name.empty();
    }
    if (!found)
      throw std::invalid_argument(fmt::format("'{}' must be D=NAME, R=NAME, SA=NAME or SD=NAME", change));
  }
  return names;
}

Response response(const RuleBase& base, const ResponseNames& names) {
  const std::size_t distance = find(base, base.inputs, names.distance, "input");
  const std::size_t bias = find(base, base.inputs, names.bias, "input");
  const std::size_t outputs[] = {find(base, base.outputs, names.turn, "output"),
                                 find(base, base.outputs, names.step, "output")};
  if (distance == bias || outputs[0] == outputs[1])
    throw std::invalid_argument(fmt::format("{}: one variable stands for two of the core's", base.file));
  for (std::size_t i = 0; i < base.inputs.size(); ++i) {
    if (i == distance || i == bias) continue;
    fail(base, base.inputs[i].place,
         fmt::format("input '{}' is neither D nor R of the core", base.inputs[i].name));
  }

  const Inference inference(base);
  Domain domain;
  domain.parts = {part(base, distance, 0, kFarthest), part(base, bias, -kMostBias, kMostBias)};
  domain.inputs.assign(base.inputs.size(), 0.0);
  Surface surface = make_surface(base, inference, domain);
  for (const std::size_t o : outputs) check_answers(base, surface, o);
  surface.values = {std::move(surface.values[outputs[0]]), std::move(surface.values[outputs[1]])};

  Response result;
  const auto columns = static_cast<std::size_t>(domain.columns());
  for (int d = 0; d < Bilinear::kDistanceNodes; ++d) {
    for (int r = 0; r < Bilinear::kBiasNodes; ++r) {
      const auto row = static_cast<std::size_t>(fuzzy::kDistanceLow + d * Bilinear::kDistanceSpacing);
      const auto column = static_cast<std::size_t>(fuzzy::kBiasLow + r * Bilinear::kBiasSpacing + kMostBias);
      const auto raw = [&](std::size_t o) {
        return nearest_raw(surface.values[o][row * columns + column] * kOutputUnits);
      };
      result.table.node[d][r] = {raw(0), raw(1)};
    }
  }
  measure(surface, result);
  result.symmetric = mirrored(result.table);
  return result;
}

}  // namespace whisker::rules
