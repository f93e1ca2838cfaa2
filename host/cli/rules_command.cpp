#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/scenario/text.hpp"
#include "host/lab/rules/compile.hpp"
#include "host/lab/rules/findings.hpp"
#include "host/lab/rules/header.hpp"
#include "host/lab/rules/page.hpp"

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

/// The table for people: axes, bytes, errors, warnings.
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

/// Variables with their terms, and the number of rules.
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

/// What print_table() prints, as one JSON object.
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

struct CompileOptions {
  std::string file;
  std::string tolerance;
  std::string most_bytes;
  std::string nodes;
  std::vector<std::string> fixed;
  std::string header;
  std::string svg;
  std::string steps;
  bool json = false;
};

struct ShowOptions {
  std::string file;
  std::vector<std::string> fixed;
  std::string svg;
  std::string html;
  std::vector<std::string> inputs;
};

bool parse_finite(std::string_view text, double& out) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, out);
  return error == std::errc{} && stop == end && std::isfinite(out);
}

/// "1%" or "1": per cent.
double tolerance(const std::string& text) {
  std::string_view number = text;
  if (!number.empty() && number.back() == '%') number.remove_suffix(1);
  double percent = 0;
  if (!parse_finite(number, percent) || !(percent > 0 && percent <= 100))
    throw UsageError(fmt::format("--tolerance: '{}' must be a percentage above 0 and at most 100", text));
  return percent / 100;
}

std::vector<std::int32_t> nodes(const std::string& text) {
  std::vector<std::int32_t> all;
  std::size_t from = 0;
  while (from <= text.size()) {
    const std::size_t end = std::min(text.find('x', from), text.size());
    double n = 0;
    if (!parse_finite({text.data() + from, end - from}, n) || n < 2 || n > 40000 || n != std::floor(n))
      throw UsageError(fmt::format("--nodes: '{}' must be N or NxM", text));
    all.push_back(static_cast<std::int32_t>(n));
    from = end + 1;
  }
  return all;
}

/// "service=5", from the option or argument `of`.
std::vector<rules::Fixed> assigned(const rules::RuleBase& base, const std::vector<std::string>& texts,
                                   std::string_view of) {
  std::vector<rules::Fixed> all;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const std::string name = text.substr(0, equals);
    rules::Fixed one{base.inputs.size(), 0};
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < base.inputs.size(); ++i) {
      names.push_back(base.inputs[i].name);
      if (base.inputs[i].name == name) one.input = i;
    }
    if (equals == std::string::npos || !parse_finite(std::string_view(text).substr(equals + 1), one.value))
      throw UsageError(fmt::format("{}: '{}' must be INPUT=VALUE", of, text));
    if (one.input == base.inputs.size())
      throw UsageError(fmt::format("{}: no input '{}'{}", of, name, did_you_mean(name, names)));
    const rules::Input& input = base.inputs[one.input];
    if (one.value < input.low || one.value > input.high)
      throw UsageError(fmt::format("{}: '{}' must be from {} to {}", of, name, input.low, input.high));
    for (const rules::Fixed& other : all)
      if (other.input == one.input) throw UsageError(fmt::format("{}: '{}' is given twice", of, name));
    all.push_back(one);
  }
  return all;
}

std::vector<rules::Fixed> fixed(const rules::RuleBase& base, const std::vector<std::string>& texts) {
  return assigned(base, texts, "--fix");
}

int execute_rules_compile(const CompileOptions& o) {
  check_outputs({o.header, o.svg}, {o.file}, o.json);
  rules::Options options;
  if (!o.tolerance.empty()) options.demand.tolerance = tolerance(o.tolerance);
  if (!o.most_bytes.empty()) options.demand.most_bytes = std::stoul(o.most_bytes);
  if (!o.nodes.empty()) options.demand.nodes = nodes(o.nodes);
  if (!o.steps.empty()) options.fewest_steps = std::stoi(o.steps);
  rules::RuleBase base = load_rules(o.file);
  options.fixed = fixed(base, o.fixed);
  const rules::Compiled compiled = rules::compile(std::move(base), options);
  if (!o.header.empty()) files::write(o.header, rules::header(compiled, o.header));
  if (!o.svg.empty()) files::write(o.svg, rules::picture(compiled.base, compiled.surface));
  if (o.json) {
    fmt::print("{}\n", table_json(compiled));
  } else {
    std::FILE* const out = words_beside({o.header, o.svg});
    print_table(out, compiled);
    if (!o.header.empty()) fmt::print(out, "header: {}\n", o.header);
    if (!o.svg.empty()) fmt::print(out, "picture: {}\n", o.svg);
  }
  return 0;
}

int execute_rules_show(const ShowOptions& o) {
  check_outputs({o.svg, o.html}, {o.file});
  const rules::RuleBase base = load_rules(o.file);
  std::FILE* const out = words_beside({o.svg, o.html});
  if (!o.html.empty()) {
    rules::Options options;
    options.fixed = fixed(base, o.fixed);
    const rules::Compiled compiled = rules::compile(base, options);
    files::write(o.html, rules::page(compiled));
    if (!o.svg.empty()) files::write(o.svg, rules::picture(base, compiled.surface));
  } else {
    const rules::Inference inference(base);
    const rules::Domain domain =
        rules::make_domain(base, inference, fixed(base, o.fixed), rules::kFewestSteps);
    if (!o.svg.empty())
      files::write(o.svg, rules::picture(base, rules::make_surface(base, inference, domain)));
  }
  print_rule_base(out, base);
  if (!o.svg.empty()) fmt::print(out, "picture: {}\n", o.svg);
  if (!o.html.empty()) fmt::print(out, "page: {}\n", o.html);
  return 0;
}

int evaluate(const ShowOptions& o) {
  if (!o.svg.empty() || !o.html.empty() || !o.fixed.empty())
    throw UsageError("rules show: INPUT=VALUE goes with no other option");
  const rules::RuleBase base = load_rules(o.file);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values(base.inputs.size(), kNone);
  for (const rules::Fixed& one : assigned(base, o.inputs, "evaluate")) values[one.input] = one.value;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isnan(values[i]))
      throw UsageError(fmt::format("evaluate: input '{}' needs a value", base.inputs[i].name));
  const std::vector<rules::Answer> answers = rules::Inference(base)(values);
  for (std::size_t i = 0; i < answers.size(); ++i)
    fmt::print("{} = {:.12g}{}\n", base.outputs[i].name, answers[i].value,
               answers[i].fired ? "" : " (no rule fires)");
  return 0;
}

constexpr const char* kRulesStatus = R"(
Exit status of rules: 0 done, 2 bad input or usage, 1 anything else.)";

void add_fix(CLI::App& cmd, std::vector<std::string>& fixed) {
  cmd.add_option("--fix", fixed, "Hold an input at a value: INPUT=VALUE; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
}

void add_show(CLI::App& rules, int& status) {
  CLI::App* cmd = rules.add_subcommand(
      "show", "List variables and rules, draw memberships and surface, or answer one input");
  const auto o = std::make_shared<ShowOptions>();
  add_file(*cmd, "FILE", o->file, "Rule base: .fis, .fll, .fcl or .toml")->required();
  cmd->add_option("INPUT=VALUE", o->inputs, "Print only the exact answers there: the value of each input");
  add_fix(*cmd, o->fixed);
  add_file(*cmd, "--svg", o->svg, "Draw the memberships and the exact answers");
  add_file(*cmd, "--html", o->html, "Write a page: picture, rules, warnings, and the table for 1% to ask");
  cmd->footer(kRulesStatus);
  cmd->callback([o, &status] { status = o->inputs.empty() ? execute_rules_show(*o) : evaluate(*o); });
}

void add_compile(CLI::App& rules, int& status) {
  CLI::App* cmd =
      rules.add_subcommand("compile", "Make the smallest integer table with a proven error bound");
  const auto o = std::make_shared<CompileOptions>();
  add_file(*cmd, "FILE", o->file, "Rule base: .fis, .fll, .fcl or .toml")->required();
  add_name(*cmd, "--tolerance", o->tolerance, "Greatest error, per cent of each output's span (default 1%)");
  add_name(*cmd, "--max-bytes", o->most_bytes, "The best table within this size instead")
      ->transform(whole_number(std::uint64_t{1} << 24))
      ->excludes("--tolerance");
  add_name(*cmd, "--nodes", o->nodes, "The table with exactly this many nodes, N or NxM, instead")
      ->excludes("--tolerance")
      ->excludes("--max-bytes");
  add_fix(*cmd, o->fixed);
  add_name(*cmd, "--steps", o->steps, "Fewest raw units over the range of an input (default 1024)")
      ->transform(whole_number(8192));
  add_file(*cmd, "--header", o->header, "Write table and look-up as a header for C99 and C++17");
  add_file(*cmd, "--svg", o->svg, "Draw the memberships and the exact answers");
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->footer(kRulesStatus);
  cmd->callback([o, &status] { status = execute_rules_compile(*o); });
}

}  // namespace

void add_rules(CLI::App& app, int& status) {
  CLI::App* rules = app.add_subcommand("rules", "Compile a fuzzy rule base to an integer table");
  rules->require_subcommand(1);
  add_compile(*rules, status);
  add_show(*rules, status);
  add_rules_compare(*rules, status);
}

}  // namespace whisker::cli
