#include "host/harness/scenario/write.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/events.hpp"
#include "host/harness/scenario/noise.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/sensor_text.hpp"
#include "host/harness/scenario/text.hpp"

namespace whisker {
namespace {

std::string pair(sim::Vec2 p) { return fmt::format("[{}, {}]", toml_number(p.x), toml_number(p.y)); }

std::string list(const std::vector<sim::Vec2>& points) {
  std::string out = "[";
  for (const sim::Vec2 p : points) out += (out.size() == 1 ? "" : ", ") + pair(p);
  return out + "]";
}

/// The shortest decimal in degrees that reads back as this heading, or the nearest possible.
std::string degrees(double heading) {
  const double exact = heading / kRadPerDeg;
  for (const double candidate : {exact, std::nextafter(exact, -1e9), std::nextafter(exact, 1e9)}) {
    for (int digits = 1; digits <= 17; ++digits) {
      const double rounded = std::strtod(fmt::format("{:.{}g}", candidate, digits).c_str(), nullptr);
      if (rounded * kRadPerDeg == heading) return toml_number(rounded);
    }
  }
  return toml_number(exact);
}

std::string places(const Scenario& s) {
  std::string out =
      fmt::format("\n[start]\nx_m = {}\ny_m = {}\n", toml_number(s.start.at.x), toml_number(s.start.at.y));
  if (s.start.heading == bearing(s.start.at, s.goal.at)) {
    out += "# heading_deg: towards the goal\n";
  } else {
    out += fmt::format("heading_deg = {}\n", degrees(s.start.heading));
  }
  out += fmt::format("\n[goal]\nx_m = {}\ny_m = {}\ntolerance_m = {}\n", toml_number(s.goal.at.x),
                     toml_number(s.goal.at.y), toml_number(s.goal.tolerance_m));
  if (s.bounds) {
    out += fmt::format("\n[bounds]  # solid outer wall\nmin = {}\nmax = {}\n", pair(s.bounds->min),
                       pair(s.bounds->max));
  }
  return out;
}

std::string obstacles(const Scenario& s) {
  std::string out;
  for (const sim::Disc& d : s.discs) {
    out += fmt::format("\n[[disc]]\ncenter = {}\nradius_m = {}\n", pair(d.center), toml_number(d.radius));
  }
  for (const auto& points : s.polygons)
    out += fmt::format("\n[[polygon]]  # solid\npoints = {}\n", list(points));
  for (const auto& points : s.walls) {
    out += fmt::format("\n[[wall]]  # zero thickness\npoints = {}\n", list(points));
  }
  for (const Mover& m : s.movers) {
    out +=
        fmt::format("\n[[mover]]  # there and back along its path\ncenter = {}\nradius_m = {}\npath = {}\n",
                    pair(m.center), toml_number(m.radius_m), list(m.path));
    out += fmt::format("speed_mps = {}\n", toml_number(m.speed_mps));
  }
  return out;
}

std::string noise(const Noise& n) {
  const std::string lines = noise_toml(n);
  return lines.empty() ? lines : "\n[noise]\n" + lines;
}

}  // namespace

std::string to_toml(const Scenario& s) {
  const std::string robot = robot_toml(s.robot);
  return fmt::format("name = {}\nseed = {}  # of the noise\ntime_limit_s = {}\n", toml_string(s.name), s.seed,
                     toml_number(s.time_limit_s)) +
         places(s) + obstacles(s) + noise(s.noise) + sensor_toml(s.sensor) +
         (robot.empty() ? robot : "\n[robot]  # what differs from the reference robot\n" + robot) +
         events_toml(s.events);
}

}  // namespace whisker
