#include "host/cli/rules_output.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "host/cli/provenance.hpp"
#include "host/cli/version.hpp"
#include "host/rules/findings.hpp"

namespace whisker::cli {
namespace {

using Json = nlohmann::ordered_json;
using rules::Compiled;
using rules::percent;

double spacing(const Compiled& c, std::size_t part) {
  return (1 << c.table.axes[part].shift) / c.surface.domain.parts[part].axis.per_unit;
}

const char* symmetry_name(bool odd) { return odd ? "antisymmetric" : "symmetric"; }

Json inputs_json(const Compiled& c) {
  Json all = Json::array();
  for (std::size_t p = 0; p < c.surface.domain.parts.size(); ++p) {
    const rules::Domain::Part& part = c.surface.domain.parts[p];
    const rules::Axis& axis = part.axis;
    all.push_back({{"name", c.base.inputs[axis.input].name},
                   {"low", axis.value(axis.low)},
                   {"high", axis.value(axis.high)},
                   {"origin", axis.origin},
                   {"raw_per_unit", axis.per_unit},
                   {"raw_low", axis.low},
                   {"raw_high", axis.high},
                   {"table_raw_low", part.from},
                   {"table_raw_high", part.to},
                   {"nodes", c.table.axes[p].nodes()},
                   {"raw_spacing", 1 << c.table.axes[p].shift},
                   {"spacing", spacing(c, p)}});
  }
  return all;
}

Json at_json(const Compiled& c, const std::int32_t* raw) {
  Json at;
  for (std::size_t p = 0; p < c.surface.domain.parts.size(); ++p) {
    const rules::Axis& axis = c.surface.domain.parts[p].axis;
    at[c.base.inputs[axis.input].name] = axis.value(raw[p]);
  }
  return at;
}

Json outputs_json(const Compiled& c) {
  Json all = Json::array();
  for (std::size_t o = 0; o < c.base.outputs.size(); ++o) {
    Json symmetries = Json::array();
    for (const rules::Symmetry& s : c.symmetries) {
      if (s.output != o || s.broken_by != 0) continue;
      symmetries.push_back({{"input", c.base.inputs[c.surface.domain.parts[s.part].axis.input].name},
                            {"kind", symmetry_name(s.odd)}});
    }
    double silent = 0;
    for (const rules::Gap& gap : c.gaps)
      if (gap.output == o) silent = gap.share;
    const rules::Error& e = c.errors[o];
    all.push_back(
        {{"name", c.base.outputs[o].name},
         {"span", c.spans[o]},
         {"origin", c.table.scales[o].origin},
         {"raw_per_unit", c.table.scales[o].per_unit},
         {"max_error", e.greatest},
         {"max_error_percent", percent(c, o, e.greatest)},
         {"max_error_at", at_json(c, e.at)},
         {"max_error_raw_at", Json(std::vector<std::int32_t>(e.at, e.at + c.surface.domain.parts.size()))},
         {"rms_error", e.rms},
         {"rms_error_percent", percent(c, o, e.rms)},
         {"input_rounding_percent", percent(c, o, rules::rounding_effect(c, o))},
         {"no_rule_share", silent},
         {"symmetries", symmetries}});
  }
  return all;
}

}  // namespace

void print_table(std::FILE* out, const Compiled& c) {
  const std::size_t parts = c.surface.domain.parts.size();
  fmt::print(out, "{}: {} rules, {} representable inputs\n", c.base.name.empty() ? c.base.file : c.base.name,
             c.base.rules.size(), c.surface.inputs);
  fmt::print(out, "table: ");
  for (std::size_t p = 0; p < parts; ++p)
    fmt::print(out, "{}{}", p == 0 ? "" : " x ", c.table.axes[p].nodes());
  fmt::print(out, " nodes, {} bytes\n", c.table.bytes());
  for (std::size_t p = 0; p < parts; ++p) {
    const rules::Domain::Part& part = c.surface.domain.parts[p];
    fmt::print(out, "input {}: {:g} to {:g} in raw units of {:g}; nodes {:g} apart from {:g} to {:g}\n",
               c.base.inputs[part.axis.input].name, part.axis.value(part.axis.low),
               part.axis.value(part.axis.high), 1 / part.axis.per_unit, spacing(c, p),
               part.axis.value(part.from), part.axis.value(part.to));
  }
  for (std::size_t o = 0; o < c.base.outputs.size(); ++o) {
    const rules::Error& e = c.errors[o];
    fmt::print(out,
               "output {}: span {:.6g}, raw unit {:g}; error at most {:.4g} % of the span ({:.3g}), at {}; "
               "rms {:.2g} %\n",
               c.base.outputs[o].name, c.spans[o], 1 / c.table.scales[o].per_unit, percent(c, o, e.greatest),
               e.greatest, rules::where(c, e.at), percent(c, o, e.rms));
    for (const rules::Symmetry& s : c.symmetries) {
      if (s.output != o || s.broken_by != 0) continue;
      fmt::print(out, "  {} in {}\n", symmetry_name(s.odd),
                 c.base.inputs[c.surface.domain.parts[s.part].axis.input].name);
    }
  }
  for (const rules::Finding& f : rules::findings(c)) fmt::print(out, "warning: {}\n", f.text);
}

void print_rule_base(std::FILE* out, const rules::RuleBase& base) {
  const auto terms = [out](const std::vector<rules::Term>& all) {
    for (std::size_t t = 0; t < all.size(); ++t) fmt::print(out, "{}{}", t == 0 ? ": " : ", ", all[t].name);
    fmt::print(out, "\n");
  };
  fmt::print(out, "{}: {} rules\n", base.name.empty() ? base.file : base.name, base.rules.size());
  for (const rules::Input& v : base.inputs) {
    fmt::print(out, "input {}, {:g} to {:g}", v.name, v.low, v.high);
    terms(v.terms);
  }
  for (const rules::Output& v : base.outputs) {
    fmt::print(out, "output {}, {:g} to {:g}", v.name, v.low, v.high);
    terms(v.terms);
  }
}

std::string table_json(const Compiled& c) {
  Json never = Json::array();
  for (const std::size_t r : c.never)
    never.push_back({{"rule", r + 1}, {"line", c.base.rules[r].place.line}});
  Json warnings = Json::array();
  for (const rules::Finding& f : rules::findings(c))
    warnings.push_back({{"kind", rules::name(f.kind)}, {"text", f.text}});
  const Json json = {
      {"name", c.base.name},      {"rules", c.base.rules.size()}, {"representable_inputs", c.surface.inputs},
      {"bytes", c.table.bytes()}, {"inputs", inputs_json(c)},     {"outputs", outputs_json(c)},
      {"never_fire", never},      {"warnings", warnings},         {"schema", kSchema},
      {"version", version()}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace whisker::cli
