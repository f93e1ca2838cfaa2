#include "host/lab/report/run_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <string>

#include "host/lab/report/palette.hpp"
#include "host/lab/report/run_svg.hpp"
#include "tests/report/script.hpp"
#include "tests/report/xml.hpp"

namespace whisker::report {
namespace {

using planning::CellState;
using testing::Element;

MapPicture random_map(unsigned seed) {
  std::mt19937 random(seed);
  MapPicture picture;
  picture.corner = {-10, -5};
  picture.columns = 32;
  picture.rows = 20;
  picture.cell_m = 0.1;
  picture.cells.resize(32 * 20);
  for (CellState& state : picture.cells) state = static_cast<CellState>(random() % 4);
  picture.way = {{4, 4}, {5, 5}, {6, 5}};
  return picture;
}

Element drawn(const std::vector<TickRecord>& records, const MapPicture* map) {
  const Scenario scenario = testing::garden();
  RunLog log = testing::log_of(scenario, records, testing::result_of(Verdict::gave_up, scenario, records));
  if (map != nullptr) log.note(*map);
  return testing::parse_xml(run_svg(log));
}

std::vector<TickRecord> garden_run() { return testing::garden_run(testing::garden()); }

/// The area that the boxes "Mx yhWvHh-Wz" cover.
std::vector<int> covered(const std::string& path, const MapPicture& map) {
  std::vector<int> count(map.cells.size());
  int x = 0, y = 0, width = 0, height = 0, back = 0, used = 0;
  const char* at = path.c_str();
  while (std::sscanf(at, "M%d %dh%dv%dh%dz%n", &x, &y, &width, &height, &back, &used) == 5) {
    EXPECT_EQ(back, -width);
    for (int j = y; j < y + height; ++j)
      for (int i = x; i < x + width; ++i) ++count.at(static_cast<std::size_t>(j * map.columns + i));
    at += used;
  }
  EXPECT_EQ(*at, '\0') << path;
  return count;
}

TEST(RunMap, covers_each_cell_with_its_own_colour_once) {
  const MapPicture map = random_map(3);
  const Element root = drawn(garden_run(), &map);
  for (const MapLook& look : kMapLooks) {
    const auto found = root.by_class(look.name);
    ASSERT_EQ(found.size(), 1U) << look.name;
    const std::vector<int> count = covered(found[0]->attributes.at("d"), map);
    for (std::size_t i = 0; i < count.size(); ++i)
      ASSERT_EQ(count[i], map.cells[i] == look.state) << look.name;
  }
}

TEST(RunMap, lies_where_the_robot_believes_it_to_lie) {
  auto records = garden_run();
  TickRecord& last = records.back();
  last.x_m = 2;
  last.y_m = 1;
  last.est_x_m = 1.9;
  last.est_y_m = 1;
  last.heading_rad = last.est_heading_rad = 0.5;
  const auto corner = [&] {
    const MapPicture map = random_map(1);
    const std::string text = drawn(records, &map).by_class("map").at(0)->attributes.at("transform");
    double a = 0, b = 0, c = 0, d = 0, x = 0, y = 0;
    EXPECT_EQ(std::sscanf(text.c_str(), "matrix(%lf %lf %lf %lf %lf %lf)", &a, &b, &c, &d, &x, &y), 6);
    return std::vector<double>{a, b, x, y};
  };
  const auto drifted = corner();
  EXPECT_NEAR(drifted[1], 0, 1e-9);
  last.est_x_m = 2;
  const auto exact = corner();
  EXPECT_DOUBLE_EQ(drifted[0], exact[0]);
  // 0.1 m is one cell.
  EXPECT_NEAR(drifted[2] - exact[2], exact[0], 0.01);
  last.heading_rad += 0.1;
  EXPECT_LT(corner()[1], -0.01) << "turned counter-clockwise, it rises to the right";
}

}  // namespace
}  // namespace whisker::report
