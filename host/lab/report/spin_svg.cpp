#include "host/lab/report/spin_svg.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "host/lab/report/axes.hpp"

namespace whisker::report {
namespace {

constexpr double kSpinLeft = 64, kSpinWidth = 620, kSpinTop = 92, kSpinHeight = 110, kSpinStep = 168;
constexpr const char* kFirstTurn = R"(fill="none" stroke="#225aa0" stroke-width="1.6")";
constexpr const char* kBefore = R"(fill="none" stroke="#b9b9b5" stroke-width="2.6" stroke-linecap="round")";
constexpr const char* kAfter = R"(fill="none" stroke="#c2690a" stroke-width="3.2" stroke-linecap="round")";

bool within(double x, Range range) { return x >= range.min && x <= range.max; }

PathData dots(const Plot& plot, const std::vector<Sighting>& seen, double back_deg) {
  PathData data;
  for (const Sighting& s : seen) {
    const double at = s.at_deg - back_deg;
    if (within(at, plot.x)) data.dot(plot.page(at, std::min(s.m, plot.y.max)));
  }
  return data;
}

void draw_beam(Svg& svg, const Plot& plot, const SpinPicture::Beam& beam, double offset_deg) {
  svg.rect(plot.corner, plot.width, plot.height, R"(fill="#fff")");
  PathData line;
  for (const Sighting& s : beam.first) {
    if (!within(s.at_deg, plot.x)) continue;
    const Point at = plot.page(s.at_deg, std::min(s.m, plot.y.max));
    if (line.empty()) {
      line.move(at);
    } else {
      line.line(at);
    }
  }
  svg.path(dots(plot, beam.last, 0), kBefore);
  svg.path(line, kFirstTurn);
  svg.path(dots(plot, beam.last, offset_deg), kAfter);
  draw_plot_axes(svg, plot, "heading of the body / deg", beam.name + " / m", 9, 3);
}

void draw_legend(Svg& svg) {
  const auto entry = [&](double x, const char* attributes, const char* text, bool line) {
    PathData mark;
    if (line) {
      mark.move({x, 58}).line({x + 22, 58});
    } else {
      mark.dot({x + 4, 58}).dot({x + 11, 58}).dot({x + 18, 58});
    }
    svg.path(mark, attributes);
    svg.text({x + 28, 62}, text, R"(font-size="12")");
  };
  entry(kSpinLeft, kFirstTurn, "first turn", true);
  entry(kSpinLeft + 130, kBefore, "last turn, by the robot's heading", false);
  entry(kSpinLeft + 370, kAfter, "last turn, moved by the match", false);
}

}  // namespace

std::string spin_svg(const SpinPicture& p) {
  const double beams = static_cast<double>(p.beams.size());
  Svg svg(kSpinLeft + kSpinWidth + 26, kSpinTop + kSpinStep * (beams + 1) + 10, p.title);
  svg.text({20, 30}, p.title, R"(font-size="15" font-weight="bold")");
  draw_legend(svg);
  double top = kSpinTop;
  for (const SpinPicture::Beam& beam : p.beams) {
    draw_beam(svg, {{kSpinLeft, top}, kSpinWidth, kSpinHeight, {0, 360}, {0, p.range_m}}, beam, p.offset_deg);
    top += kSpinStep;
  }
  const double most =
      p.mismatch_mm.empty() ? 1 : *std::max_element(p.mismatch_mm.begin(), p.mismatch_mm.end());
  const Plot plot{{kSpinLeft, top},
                  kSpinWidth,
                  kSpinHeight,
                  {-p.window_deg, p.window_deg},
                  {0, std::max(most, 1.0) * 1.1}};
  svg.rect(plot.corner, plot.width, plot.height, R"(fill="#fff")");
  PathData curve;
  for (std::size_t i = 0; i < p.mismatch_mm.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(p.mismatch_mm.size() - 1);
    const Point at = plot.page(p.window_deg * (2 * share - 1), p.mismatch_mm[i]);
    if (i == 0) {
      curve.move(at);
    } else {
      curve.line(at);
    }
  }
  svg.path(curve, kFirstTurn);
  svg.line(plot.page(p.offset_deg, 0), plot.page(p.offset_deg, plot.y.max),
           R"(stroke="#c2690a" stroke-width="1.6" stroke-dasharray="5 3")");
  const Point label = plot.page(p.offset_deg, plot.y.max * 0.12);
  const bool at_left = p.offset_deg > 0;
  svg.text({label.x + (at_left ? -8 : 8), label.y}, fmt::format("{:+.3f} deg", p.offset_deg),
           fmt::format(R"(font-size="12" fill="#8a4a06" text-anchor="{}")", at_left ? "end" : "start"));
  draw_plot_axes(svg, plot, "offset of the last turn / deg", "mismatch / mm", 9, 3);
  return std::move(svg).finish();
}

}  // namespace whisker::report
