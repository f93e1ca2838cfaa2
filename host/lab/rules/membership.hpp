/// Membership functions of every supported format, with the values of its definition.
#pragma once

#include <string>
#include <vector>

namespace whisker::rules {

enum class Shape {
  polyline,            ///< vertices; `left` and `right` beyond them
  gauss,               ///< sigma left, centre left, sigma right, centre right: 1 between the centres
  bell,                ///< width, slope, centre
  sigmoid,             ///< slope, centre
  sigmoid_difference,  ///< slope, centre, slope, centre: absolute difference
  sigmoid_product,     ///< slope, centre, slope, centre
  s_curve,             ///< foot, shoulder
  z_curve,             ///< shoulder, foot
  pi_curve,            ///< foot, shoulder, shoulder, foot: product of an S and a Z curve
  cosine,              ///< centre, width
  spike,               ///< centre, width
  concave,             ///< inflection, end
};

struct Vertex {
  double x;
  double y;
};

struct Membership {
  Shape shape = Shape::polyline;
  std::vector<double> p;
  std::vector<Vertex> vertices;  ///< of a polyline, by ascending x; two at one x make a step
  double left = 0;
  double right = 0;
  double height = 1;  ///< factor of all values

  /// At a step: the larger value.
  double operator()(double x) const;
  /// Where its formula changes or its slope jumps; finite values, in any order.
  std::vector<double> breaks() const;
  /// A polynomial of degree 1 between its breaks.
  bool linear_pieces() const { return shape == Shape::polyline; }
};

/// a < b < c or one of them equal; a = -infinity and c = infinity make shoulders.
Membership triangle(double a, double b, double c);
Membership trapezoid(double a, double b, double c, double d);
/// 0 before `from`, 1 after `to`; falls if to < from.
Membership ramp(double from, double to);
/// Vertices by ascending x; the outer values continue.
Membership points(std::vector<Vertex> vertices);
/// A curve of another shape with its parameters. An S, Z or pi curve of width 0 becomes a step.
Membership curve(Shape shape, std::vector<double> p);

}  // namespace whisker::rules
