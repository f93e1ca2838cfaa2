#include "host/lab/rules/page.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/lab/report/axes.hpp"
#include "host/lab/report/colour.hpp"
#include "host/lab/report/svg.hpp"
#include "host/lab/rules/findings.hpp"
#include "host/lab/rules/page_template.hpp"
#include "host/lab/rules/response.hpp"
#include "host/lab/rules/rule_text.hpp"

namespace whisker::rules {
namespace {

using report::PathData;
using report::Plot;
using report::Point;
using report::Svg;

constexpr double kWidth = 400;
constexpr double kSetHeight = 110;
constexpr double kMapHeight = 400;
constexpr double kRow = 200;     ///< of the memberships
constexpr double kMapRow = 500;  ///< of the surfaces
constexpr double kColumn = 540;
constexpr int kCells = 100;
constexpr int kLevels = 33;  // odd, so that zero has its own level in the middle of a diverging scale

/// Distinct in hue for colour-blind eyes; neighbours also differ in dashes for grey print.
constexpr const char* kColours[] = {"#225aa0", "#c2690a", "#00795c", "#a0337a", "#3a3a3a"};

struct Range {
  double low;
  double high;
};

Range span_over(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low < *high ? Range{*low, *high} : Range{*low - 1, *high + 1};
}

/// One variable: each set as a curve, each crisp term as a line at its constant.
void draw_sets(Svg& svg, Point corner, const std::string& name, Range range, const std::vector<Term>& terms) {
  const Plot plot{corner, kWidth, kSetHeight, {range.low, range.high}, {0, 1}};
  svg.rect(plot.corner, plot.width, plot.height, R"(class="ground" fill="#fff")");
  draw_plot_axes(svg, plot, name, "membership", 8, 2);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const std::string stroke =
        fmt::format(R"(class="set set-{}" fill="none" stroke="{}" stroke-width="1.8" stroke-dasharray="{}")",
                    t % 5, kColours[t % 5], t % 2 == 0 ? "none" : "7 3");
    double peak = terms[t].constant;
    if (terms[t].crisp) {
      const double x = std::min(std::max(peak, range.low), range.high);
      svg.line(plot.page(x, 0), plot.page(x, 1), stroke);
    } else {
      PathData data;
      double most = -1;
      for (int i = 0; i <= 400; ++i) {
        const double x = range.low + (range.high - range.low) * i / 400;
        const double y = terms[t].set(x);
        if (y > most) most = y, peak = x;
        i == 0 ? data.move(plot.page(x, y)) : data.line(plot.page(x, y));
      }
      svg.path(data, stroke);
    }
    const Point at = plot.page(std::min(std::max(peak, range.low), range.high), 1);
    svg.text({at.x, at.y - 4 - (t % 2 == 0 ? 0 : 10)}, report::shortened(terms[t].name, 12),
             fmt::format(R"(class="set set-{}" text-anchor="middle" font-size="9" fill="{}")", t % 5,
                         kColours[t % 5]));
  }
}

/// An output over one input.
void draw_line(Svg& svg, Point corner, const RuleBase& base, const Surface& s, std::size_t o) {
  const Domain::Part& part = s.domain.parts[0];
  const Range y = span_over(s.values[o]);
  const Plot plot{
      corner, kWidth, kMapHeight, {part.axis.value(part.from), part.axis.value(part.to)}, {y.low, y.high}};
  draw_plot_axes(svg, plot, base.inputs[part.axis.input].name, base.outputs[o].name, 8, 8);
  PathData data;
  for (std::int32_t i = 0; i < part.count(); ++i) {
    const Point p = plot.page(part.axis.value(part.from + i), s.values[o][static_cast<std::size_t>(i)]);
    i == 0 ? data.move(p) : data.line(p);
  }
  svg.path(data, R"(class="set set-0" fill="none" stroke="#225aa0" stroke-width="1.8")");
}

/// The core's response table is drawn as `whisker table` and the replay page draw it: the distance upward,
/// and the bias to the left, so that the left side means nearer on the left.
bool is_response(const RuleBase& base, const Domain& domain) {
  const ResponseNames names;
  const auto axis = [&](std::size_t part) { return base.inputs[domain.parts[part].axis.input].name; };
  return axis(0) == names.distance && axis(1) == names.bias;
}

/// An output over two inputs: the first to the right, the second upward.
void draw_map(Svg& svg, Point corner, const RuleBase& base, const Surface& s, std::size_t o) {
  const bool turned = is_response(base, s.domain);
  const Domain::Part& across = s.domain.parts[turned ? 1 : 0];
  const Domain::Part& up = s.domain.parts[turned ? 0 : 1];
  const Input& x = base.inputs[across.axis.input];
  const Input& y = base.inputs[up.axis.input];
  const Plot plot{
      corner, kWidth, kMapHeight, {turned ? x.high : x.low, turned ? x.low : x.high}, {y.low, y.high}};
  const Range span = span_over(s.values[o]);
  const bool is_signed = base.outputs[o].low == -base.outputs[o].high;
  const double most = std::max(-span.low, span.high);
  const Range range = is_signed ? Range{-most, most} : span;
  const report::ColourScale scale = is_signed ? report::ColourScale::diverging(range.low, range.high)
                                              : report::ColourScale::sequential(range.low, range.high);
  const auto index = [](const Domain::Part& part, const report::Range& shown, int cell) {
    const double value = shown.min + (shown.max - shown.min) * (cell + 0.5) / kCells;
    const double raw = std::round((value - part.axis.origin) * part.axis.per_unit);
    return static_cast<std::size_t>(std::clamp<double>(raw, part.from, part.to) - part.from);
  };
  std::vector<PathData> levels(kLevels);
  const double w = kWidth / kCells;
  const double h = kMapHeight / kCells;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const std::size_t column = index(across, plot.x, i), row = index(up, plot.y, j);
      const auto columns = static_cast<std::size_t>(s.domain.columns());
      const double value = s.values[o][turned ? row * columns + column : column * columns + row];
      const double share = (value - range.low) / (range.high - range.low);
      const auto level = static_cast<std::size_t>(std::min(std::max(share * kLevels, 0.0), kLevels - 1.0));
      levels[level].box({corner.x + i * w, corner.y + kMapHeight - (j + 1) * h}, w, h);
    }
  }
  svg.open(fmt::format(R"(class="{}")", is_signed ? "diverging" : "sequential"));
  svg.open(R"(shape-rendering="crispEdges")");
  for (std::size_t l = 0; l < kLevels; ++l) {
    const double share = (static_cast<double>(l) + 0.5) / kLevels;
    if (levels[l].empty()) continue;
    svg.path(levels[l], fmt::format(R"(data-k="{:.3f}" fill="{}")", share,
                                    scale.at(range.low + (range.high - range.low) * share)));
  }
  svg.close();
  draw_plot_axes(svg, plot, x.name, y.name, 8, 8);
  draw_colour_bar(svg, {corner.x + kWidth + 14, corner.y}, 14, kMapHeight, scale, 5);
  svg.close();
}

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

std::string picture(const RuleBase& base, const Surface& surface) {
  const std::size_t rows = std::max(base.inputs.size(), base.outputs.size());
  const double top = 84;
  const double maps = top + kRow * static_cast<double>(rows);
  const double width = kColumn * static_cast<double>(std::max<std::size_t>(2, base.outputs.size())) + 40;
  const std::string title = base.name.empty() ? base.file : base.name;
  Svg svg(width, maps + kMapRow + 20, title);
  svg.text({20, 30}, report::shortened(title, 80), R"(font-size="17" font-weight="bold")");
  const auto row = [&](std::size_t i) { return top + kRow * static_cast<double>(i); };
  for (std::size_t i = 0; i < base.inputs.size(); ++i) {
    const Input& v = base.inputs[i];
    draw_sets(svg, {70, row(i)}, v.name, {v.low, v.high}, v.terms);
  }
  for (std::size_t o = 0; o < base.outputs.size(); ++o) {
    const Output& v = base.outputs[o];
    draw_sets(svg, {70 + kColumn, row(o)}, v.name, {v.low, v.high}, v.terms);
    const Point corner{70 + kColumn * static_cast<double>(o), maps + 30};
    svg.text({corner.x, corner.y - 12}, report::shortened(v.name, 60),
             R"(font-size="14" font-weight="bold")");
    surface.domain.parts.size() > 1 ? draw_map(svg, corner, base, surface, o)
                                    : draw_line(svg, corner, base, surface, o);
  }
  return std::move(svg).finish();
}

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
