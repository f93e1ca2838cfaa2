#include "host/rules/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "host/report/file.hpp"
#include "host/report/svg.hpp"
#include "host/rules/findings.hpp"
#include "host/rules/page_template.hpp"
#include "host/rules/picture.hpp"
#include "host/rules/rule_words.hpp"

namespace whisker::rules {
namespace {

using Json = nlohmann::ordered_json;
using report::escape;
using report::put;

/// What a look-up needs.
std::string table_data(const Compiled& c) {
  Json inputs = Json::array(), outputs = Json::array();
  for (std::size_t p = 0; p < c.surface.domain.parts.size(); ++p) {
    const Axis& axis = c.surface.domain.parts[p].axis;
    const GridAxis& grid = c.table.axes[p];
    inputs.push_back({{"name", c.base.inputs[axis.input].name},
                      {"origin", axis.origin},
                      {"per_unit", axis.per_unit},
                      {"low", axis.low},
                      {"high", axis.high},
                      {"grid_low", grid.low},
                      {"grid_high", grid.high},
                      {"shift", grid.shift},
                      {"nodes", grid.nodes()}});
  }
  for (std::size_t o = 0; o < c.base.outputs.size(); ++o) {
    const OutputScale& scale = c.table.scales[o];
    outputs.push_back({{"name", c.base.outputs[o].name},
                       {"origin", scale.origin},
                       {"per_unit", scale.per_unit},
                       {"odd", scale.odd},
                       {"error", c.errors[o].greatest}});
  }
  const Json data = {{"inputs", inputs}, {"outputs", outputs}, {"nodes", c.table.nodes}};
  return report::script_safe(data.dump(-1, ' ', true, Json::error_handler_t::replace));
}

std::string facts(const Compiled& c) {
  std::string rows;
  for (std::size_t o = 0; o < c.base.outputs.size(); ++o) {
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{:.6g}</td><td>{:.3g}</td><td>{:.3g} %</td><td>{}</td></tr>\n",
        escape(c.base.outputs[o].name), c.spans[o], c.errors[o].greatest, percent(c, o, c.errors[o].greatest),
        escape(where(c, c.errors[o].at)));
  }
  return rows;
}

std::string warnings(const Compiled& c) {
  std::string items;
  for (const Finding& finding : findings(c)) items += "<li>" + escape(finding.text) + "</li>\n";
  return items.empty() ? "<p>None.</p>" : "<ul>\n" + items + "</ul>";
}

template <class Variable>
std::string row(const char* kind, const Variable& v) {
  std::string terms;
  for (const Term& term : v.terms) terms += (terms.empty() ? "" : ", ") + term.name;
  return fmt::format("<tr><td>{}</td><th scope=\"row\">{}</th><td>{:g} to {:g}</td><td>{}</td></tr>\n", kind,
                     escape(v.name), v.low, v.high, escape(terms));
}

std::string variables(const RuleBase& base) {
  std::string rows;
  for (const Input& input : base.inputs) rows += row("input", input);
  for (const Output& output : base.outputs) rows += row("output", output);
  return rows;
}

std::string rule_list(const Compiled& c) {
  std::string items;
  for (std::size_t r = 0; r < c.base.rules.size(); ++r) {
    const bool fires = std::find(c.never.begin(), c.never.end(), r) == c.never.end();
    items += fmt::format("<li{}>{}{}</li>\n", fires ? "" : " class=\"never\"",
                         escape(words(c.base, c.base.rules[r])), fires ? "" : " (never fires)");
  }
  return items;
}

std::string size(const Compiled& c) {
  std::string text;
  for (const GridAxis& axis : c.table.axes)
    text += fmt::format("{}{}", text.empty() ? "" : " x ", axis.nodes());
  return fmt::format("{} rules, {} representable inputs; a table of {} nodes, {} bytes", c.base.rules.size(),
                     c.surface.inputs, text, c.table.bytes());
}

}  // namespace

std::string page(const Compiled& c) {
  std::string html;
  for (const std::string_view part : template_parts()) html += part;
  const std::string name = escape(c.base.name.empty() ? c.base.file : c.base.name);
  put(html, "<!--title-->", name);
  put(html, "<!--name-->", name);
  put(html, "<!--size-->", size(c));
  put(html, "<!--facts-->", facts(c));
  put(html, "<!--warnings-->", warnings(c));
  put(html, "<!--variables-->", variables(c.base));
  put(html, "<!--rules-->", rule_list(c));
  put(html, "<!--picture-->", picture(c.base, c.surface));
  put(html, "<!--data-->", table_data(c));
  return html;
}

}  // namespace whisker::rules
