#include "host/lab/rules/membership.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whisker::rules {
namespace {

double sigmoid(double x, double slope, double centre) { return 1 / (1 + std::exp(-slope * (x - centre))); }

double gauss_side(double x, double sigma, double centre) {
  const double t = (x - centre) / sigma;
  return std::exp(-t * t / 2);
}

double s_curve(double x, double foot, double shoulder) {
  if (x >= shoulder) return 1;
  if (x <= foot) return 0;
  const double t = (x - foot) / (shoulder - foot);
  return t <= 0.5 ? 2 * t * t : 1 - 2 * (1 - t) * (1 - t);
}

double z_curve(double x, double shoulder, double foot) {
  if (x <= shoulder) return 1;
  if (x >= foot) return 0;
  const double t = (x - shoulder) / (foot - shoulder);
  return t <= 0.5 ? 1 - 2 * t * t : 2 * (1 - t) * (1 - t);
}

double concave(double x, double inflection, double end) {
  if (inflection <= end) return x < end ? (end - inflection) / (2 * end - inflection - x) : 1;
  return x > end ? (inflection - end) / (inflection - 2 * end + x) : 1;
}

double polyline(const Membership& m, double x) {
  const std::vector<Vertex>& v = m.vertices;
  if (v.empty() || x < v.front().x) return m.left;
  if (x > v.back().x) return m.right;
  const auto above = [](double at, const Vertex& w) { return at < w.x; };
  const auto next = std::upper_bound(v.begin(), v.end(), x, above);
  double at = 0;
  for (auto w = next; w != v.begin() && std::prev(w)->x == x; --w) at = std::max(at, std::prev(w)->y);
  if (std::prev(next)->x == x) return at;
  const Vertex a = *std::prev(next);
  const Vertex b = *next;
  return a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x));
}

}  // namespace

double Membership::operator()(double x) const {
  switch (shape) {
    case Shape::polyline: return height * polyline(*this, x);
    case Shape::gauss:
      return height * (x < p[1] ? gauss_side(x, p[0], p[1]) : 1) * (x > p[3] ? gauss_side(x, p[2], p[3]) : 1);
    case Shape::bell: return height / (1 + std::pow(std::abs((x - p[2]) / p[0]), 2 * p[1]));
    case Shape::sigmoid: return height * sigmoid(x, p[0], p[1]);
    case Shape::sigmoid_difference: return height * std::abs(sigmoid(x, p[0], p[1]) - sigmoid(x, p[2], p[3]));
    case Shape::sigmoid_product: return height * sigmoid(x, p[0], p[1]) * sigmoid(x, p[2], p[3]);
    case Shape::s_curve: return height * s_curve(x, p[0], p[1]);
    case Shape::z_curve: return height * z_curve(x, p[0], p[1]);
    case Shape::pi_curve: return height * s_curve(x, p[0], p[1]) * z_curve(x, p[2], p[3]);
    case Shape::cosine:
      return std::abs(x - p[0]) > p[1] / 2 ? 0 : height * (1 + std::cos(2 * M_PI / p[1] * (x - p[0]))) / 2;
    case Shape::spike: return height * std::exp(-std::abs(10 / p[1] * (x - p[0])));
    case Shape::concave: return height * concave(x, p[0], p[1]);
  }
  return 0;
}

std::vector<double> Membership::breaks() const {
  switch (shape) {
    case Shape::polyline: {
      std::vector<double> all;
      for (const Vertex& v : vertices) all.push_back(v.x);
      return all;
    }
    case Shape::gauss: return {p[1], p[3]};
    case Shape::bell: return {p[2]};
    case Shape::sigmoid: return {p[1]};
    case Shape::sigmoid_difference:
      if (p[0] != p[2]) return {p[1], p[3], (p[0] * p[1] - p[2] * p[3]) / (p[0] - p[2])};
      return {p[1], p[3]};
    case Shape::sigmoid_product: return {p[1], p[3]};
    case Shape::s_curve:
    case Shape::z_curve: return {p[0], (p[0] + p[1]) / 2, p[1]};
    case Shape::pi_curve: return {p[0], (p[0] + p[1]) / 2, p[1], p[2], (p[2] + p[3]) / 2, p[3]};
    case Shape::cosine: return {p[0] - p[1] / 2, p[0], p[0] + p[1] / 2};
    case Shape::spike: return {p[0]};
    case Shape::concave: return {p[0], p[1]};
  }
  return {};
}

Membership triangle(double a, double b, double c) { return trapezoid(a, b, b, c); }

Membership trapezoid(double a, double b, double c, double d) {
  Membership m;
  if (std::isinf(a)) m.left = 1;
  if (std::isinf(d)) m.right = 1;
  if (std::isfinite(a) && a < b) m.vertices.push_back({a, 0});
  if (std::isfinite(b)) m.vertices.push_back({b, 1});
  if (std::isfinite(c) && c > b) m.vertices.push_back({c, 1});
  if (std::isfinite(d) && d > c) m.vertices.push_back({d, 0});
  return m;
}

Membership ramp(double from, double to) {
  Membership m;
  (from < to ? m.right : m.left) = 1;
  m.vertices = {{from, 0}, {to, 1}};
  if (to < from) std::swap(m.vertices[0], m.vertices[1]);
  return m;
}

Membership points(std::vector<Vertex> vertices) {
  Membership m;
  m.left = vertices.front().y;
  m.right = vertices.back().y;
  m.vertices = std::move(vertices);
  return m;
}

Membership curve(Shape shape, std::vector<double> p) {
  Membership m;
  if ((shape == Shape::s_curve || shape == Shape::z_curve) && p[0] == p[1]) {
    (shape == Shape::s_curve ? m.right : m.left) = 1;
    m.vertices = {{p[0], 1}};
    return m;
  }
  m.shape = shape;
  m.p = std::move(p);
  return m;
}

}  // namespace whisker::rules
