#include "host/lab/report/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "host/lab/report/colour.hpp"
#include "host/lab/report/table_svg.hpp"
#include "tests/report/controller.hpp"
#include "tests/report/xml.hpp"

namespace whisker::report {
namespace {

using testing::Element;
using testing::parse_xml;
using testing::thesis_picture;

/// The fill colour of the heat map at a point of the plane, from the rectangles of the file.
std::string colour_at(const Element& map, double r01, double d01) {
  const Element* frame = map.by_class("frame").at(0);
  const double x = frame->number("x") + r01 * frame->number("width");
  const double y = frame->number("y") + (1 - d01) * frame->number("height");
  std::string colour;
  for (const Element* level : map.by_class("cells").at(0)->by_name("path")) {
    double left = 0, top = 0, width = 0, height = 0;
    int read = 0;
    const char* at = level->attributes.at("d").c_str();
    while (std::sscanf(at, "M%lf %lfh%lfv%lfh%*fz%n", &left, &top, &width, &height, &read) == 4) {
      if (x >= left && x < left + width && y >= top && y < top + height) {
        EXPECT_EQ(colour, "") << "two rectangles at one place";
        colour = level->attributes.at("fill");
      }
      at += read;
    }
  }
  return colour;
}

TEST(TableSvg, paints_each_place_in_the_colour_of_its_value) {
  const FuzzyPicture picture = thesis_picture();
  const Element root = parse_xml(table_svg(picture));
  const ColourScale scale = ColourScale::diverging(-1.5, 1.5);
  const Element& map = *root.by_class("turn").at(0);
  for (double r01 = 0.03; r01 < 1; r01 += 0.11) {
    for (double d01 = 0.03; d01 < 1; d01 += 0.11) {
      const std::string colour = colour_at(map, r01, d01);
      ASSERT_EQ(colour.size(), 7U);
      const std::string exact = scale.at(picture.sa_at(10 * d01, 8 - 16 * r01));
      for (std::size_t c = 1; c < 7; c += 2)
        EXPECT_NEAR(std::stoi(colour.substr(c, 2), nullptr, 16), std::stoi(exact.substr(c, 2), nullptr, 16),
                    14)
            << r01 << " " << d01;
    }
  }
}

TEST(TableSvg, survives_a_response_that_is_not_a_number) {
  FuzzyPicture picture = thesis_picture();
  picture.sa_at = [](double, double) { return std::numeric_limits<double>::quiet_NaN(); };
  picture.sd_at = [](double, double) { return std::numeric_limits<double>::infinity(); };
  EXPECT_EQ(testing::odd_coordinate(parse_xml(table_svg(picture))), "");
  for (const auto& [name, svg] : thesis_figures(picture))
    EXPECT_EQ(testing::odd_coordinate(parse_xml(svg)), "") << name;
}

TEST(FuzzyPicture, that_does_not_fit_is_refused_by_name) {
  const auto refusal = [](auto&& spoil) {
    FuzzyPicture picture = thesis_picture();
    spoil(picture);
    try {
      table_svg(picture);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal([](FuzzyPicture& p) { p.turn[2].pop_back(); }), "the rules of SA are not 5 x 5");
  EXPECT_EQ(refusal([](FuzzyPicture& p) { p.step.pop_back(); }), "the rules of SD are not 5 x 5");
  EXPECT_EQ(refusal([](FuzzyPicture& p) { p.d.max = p.d.min; }), "D: the range is empty");
  EXPECT_EQ(refusal([](FuzzyPicture& p) { p.r.terms.resize(1); }), "R: fewer than two terms");
  EXPECT_EQ(refusal([](FuzzyPicture& p) { p.r.terms[2].centre = 5; }), "R: the centre of LB is out of order");
  EXPECT_EQ(refusal([](FuzzyPicture& p) { p.sd_at = nullptr; }), "a response function is missing");
  EXPECT_EQ(refusal([](FuzzyPicture&) {}), "");
}

TEST(ColourScale, runs_from_end_to_end_and_stays_there) {
  for (const ColourScale& scale : {ColourScale::diverging(-1, 1), ColourScale::sequential(-1, 1)}) {
    EXPECT_EQ(scale.at(-5), scale.at(-1));
    EXPECT_EQ(scale.at(5), scale.at(1));
    std::set<std::string> seen;
    for (int i = 0; i <= 40; ++i) seen.insert(scale.at(-1 + i / 20.0));
    EXPECT_EQ(seen.size(), 41U);
  }
}

/// Relative luminance of "#rgb" or "#rrggbb" (WCAG 2.1), 0 to 1.
double luminance(const std::string& colour) {
  const std::size_t digits = colour.size() / 3;
  const double weights[] = {0.2126, 0.7152, 0.0722};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int level = std::stoi(colour.substr(1 + i * digits, digits), nullptr, 16);
    const double c = level / (digits == 1 ? 15.0 : 255.0);
    sum += weights[i] * (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return sum;
}

double contrast(const std::string& a, const std::string& b) {
  const auto [dark, light] = std::minmax({luminance(a), luminance(b)});
  return (light + 0.05) / (dark + 0.05);
}

TEST(ColourScale, writes_in_an_ink_that_can_be_read) {
  EXPECT_STREQ(ColourScale::sequential(0, 2).ink(0), "#1a1a1a");
  EXPECT_STREQ(ColourScale::sequential(0, 2).ink(2), "#fff");
  for (const ColourScale& scale : {ColourScale::diverging(-1, 1), ColourScale::sequential(-1, 1)}) {
    for (int i = -20; i <= 20; ++i) {
      const double value = i / 20.0;
      EXPECT_GE(contrast(scale.at(value), scale.ink(value)), 3.5) << scale.at(value);
    }
  }
}

}  // namespace
}  // namespace whisker::report
