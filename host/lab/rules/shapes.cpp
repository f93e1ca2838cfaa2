#include "host/lab/rules/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace whisker::rules {
namespace {

/// A membership function of a format: where each parameter of Membership stands among the file's.
struct Form {
  const char* name;
  const char* kind;
  std::size_t count;
  int order[4];
};

// clang-format off
constexpr Form kFis[] = {
  {"trimf", "triangle", 3, {0, 1, 2}},        {"trapmf", "trapezoid", 4, {0, 1, 2, 3}},
  {"gaussmf", "gauss", 2, {0, 1, 0, 1}},      {"gauss2mf", "gauss", 4, {0, 1, 2, 3}},
  {"gbellmf", "bell", 3, {0, 1, 2}},          {"sigmf", "sigmoid", 2, {0, 1}},
  {"dsigmf", "difference", 4, {0, 1, 2, 3}},  {"psigmf", "product", 4, {0, 1, 2, 3}},
  {"zmf", "z", 2, {0, 1}},                    {"smf", "s", 2, {0, 1}},
  {"pimf", "pi", 4, {0, 1, 2, 3}},            {"linsmf", "ramp", 2, {0, 1}},
  {"linzmf", "ramp", 2, {1, 0}},              {"rampmf", "ramp", 2, {0, 1}},
  {"rectmf", "rectangle", 2, {0, 1}},         {"concavemf", "concave", 2, {0, 1}},
  {"cosinemf", "cosine", 2, {0, 1}},          {"spikemf", "spike", 2, {0, 1}},
};
constexpr Form kFll[] = {
  {"Triangle", "triangle", 3, {0, 1, 2}},     {"Trapezoid", "trapezoid", 4, {0, 1, 2, 3}},
  {"Gaussian", "gauss", 2, {1, 0, 1, 0}},     {"GaussianProduct", "gauss", 4, {1, 0, 3, 2}},
  {"Bell", "bell", 3, {1, 2, 0}},             {"Sigmoid", "sigmoid", 2, {1, 0}},
  {"SigmoidDifference", "difference", 4, {1, 0, 2, 3}}, {"SigmoidProduct", "product", 4, {1, 0, 2, 3}},
  {"ZShape", "z", 2, {0, 1}},                 {"SShape", "s", 2, {0, 1}},
  {"PiShape", "pi", 4, {0, 1, 2, 3}},         {"Ramp", "ramp", 2, {0, 1}},
  {"Rectangle", "rectangle", 2, {0, 1}},      {"Concave", "concave", 2, {0, 1}},
  {"Cosine", "cosine", 2, {0, 1}},            {"Spike", "spike", 2, {0, 1}},
  {"Binary", "binary", 2, {0, 1}},
};
// clang-format on

void require(bool holds, const Source& source, const Word& at, const char* what) {
  if (!holds) source.fail(at, what);
}

bool ascending(const std::vector<double>& p) { return std::is_sorted(p.begin(), p.end()); }

Membership gauss(const Source& source, const Word& at, const std::vector<double>& p) {
  require(p[0] > 0 && p[2] > 0, source, at, "the standard deviation of a Gaussian must be above zero");
  return curve(Shape::gauss, p);
}

Membership straight(const Source& source, const Word& at, const std::string& kind,
                    const std::vector<double>& p) {
  if (kind == "triangle" || kind == "trapezoid") {
    require(ascending(p), source, at, "the corners must ascend");
    return kind == "triangle" ? triangle(p[0], p[1], p[2]) : trapezoid(p[0], p[1], p[2], p[3]);
  }
  if (kind == "ramp") {
    require(p[0] != p[1], source, at, "a ramp needs two different ends");
    return ramp(p[0], p[1]);
  }
  if (kind == "rectangle") {
    require(ascending(p), source, at, "the ends must ascend");
    return trapezoid(p[0], p[0], p[1], p[1]);
  }
  require(p[0] != p[1], source, at, "a binary set needs a direction other than its start");
  Membership m;
  m.vertices = {{p[0], 1}};
  (p[1] > p[0] ? m.right : m.left) = 1;
  return m;
}

Membership build(const Source& source, const Word& at, const std::string& kind,
                 const std::vector<double>& p) {
  if (kind == "gauss") return gauss(source, at, p);
  if (kind == "bell") {
    require(p[0] != 0, source, at, "the width of a bell must not be zero");
    require(p[1] > 0, source, at, "the slope of a bell must be above zero");
    return curve(Shape::bell, p);
  }
  if (kind == "sigmoid") return curve(Shape::sigmoid, p);
  if (kind == "difference") return curve(Shape::sigmoid_difference, p);
  if (kind == "product") return curve(Shape::sigmoid_product, p);
  if (kind == "z" || kind == "s") {
    require(ascending(p), source, at, "the ends must ascend");
    return curve(kind == "z" ? Shape::z_curve : Shape::s_curve, p);
  }
  if (kind == "pi") {
    require(p[0] < p[1] && p[2] < p[3], source, at, "a pi curve needs ascending feet and shoulders");
    return curve(Shape::pi_curve, p);
  }
  if (kind == "concave") {
    require(p[0] != p[1], source, at, "a concave set needs two different ends");
    return curve(Shape::concave, p);
  }
  if (kind == "cosine" || kind == "spike") {
    require(p[1] > 0, source, at, "the width must be above zero");
    return curve(kind == "cosine" ? Shape::cosine : Shape::spike, p);
  }
  return straight(source, at, kind, p);
}

/// Infinite corners make shoulders, and the direction of a binary set may be infinite; other shapes have no
/// use for infinity.
std::vector<double> numbers(const Source& source, const Form& form, const std::vector<Word>& words) {
  std::vector<double> all;
  const bool corners = std::strcmp(form.kind, "triangle") == 0 || std::strcmp(form.kind, "trapezoid") == 0;
  for (std::size_t i = 0; i < form.count; ++i) {
    const bool end = i == 0 || i + 1 == form.count;
    const bool direction = i == 1 && std::strcmp(form.kind, "binary") == 0;
    all.push_back((corners && end) || direction ? source.number_or_infinity(words[i])
                                                : source.number(words[i]));
  }
  if (corners && (all.front() == HUGE_VAL || all.back() == -HUGE_VAL))
    source.fail(words.front(), "the corners must ascend");
  std::vector<double> ordered;
  const bool doubled = std::strcmp(form.kind, "gauss") == 0;
  for (std::size_t i = 0; i < (doubled ? 4 : form.count); ++i)
    ordered.push_back(all[static_cast<std::size_t>(form.order[i])]);
  return ordered;
}

template <std::size_t N>
const Form& form_of(const Source& source, const Word& type, const Form (&forms)[N]) {
  std::vector<std::string_view> names{"constant", "linear"};
  for (const Form& form : forms) names.emplace_back(form.name);
  for (const Form& form : forms)
    if (lower_case(type.text) == lower_case(form.name)) return form;
  source.index_of(type, names, "membership function");
  source.fail(type, fmt::format("'{}' is not possible here", type.text));
}

void check_count(const Source& source, const Word& type, std::size_t found, std::size_t wanted) {
  if (found < wanted)
    source.fail(type, fmt::format("'{}' needs {} parameters, but has {}", type.text, wanted, found));
}

void warn_of_more(const Source& source, const Word& type, const std::vector<Word>& words,
                  std::size_t wanted) {
  if (words.size() <= wanted) return;
  source.warn(words[wanted],
              fmt::format("'{}' has {} parameters; those after them are not read", type.text, wanted));
}

void read_crisp(const Source& source, const Word& type, const std::vector<Word>& words, long inputs,
                bool linear, Term& out) {
  if (inputs < 0) source.fail(type, fmt::format("'{}' is for outputs only", type.text));
  const std::size_t wanted = linear ? static_cast<std::size_t>(inputs) + 1 : 1;
  check_count(source, type, words.size(), wanted);
  warn_of_more(source, type, words, wanted);
  out.crisp = true;
  for (std::size_t i = 0; i + 1 < wanted; ++i) out.coefficients.push_back(source.number(words[i]));
  out.constant = source.number(words[wanted - 1]);
}

/// Pairs of x and y.
Membership read_points(const Source& source, const Word& type, const std::vector<Word>& words) {
  std::vector<Vertex> vertices;
  if (words.size() < 2) source.fail(type, "a discrete set needs at least one point");
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
    vertices.push_back({source.number(words[i]), source.number(words[i + 1])});
    if (i > 0 && vertices[vertices.size() - 2].x > vertices.back().x)
      source.fail(words[i], "the points must ascend in x");
    if (vertices.back().y < 0 || vertices.back().y > 1)
      source.fail(words[i + 1], "a degree must be from 0 to 1");
  }
  return points(std::move(vertices));
}

double height(const Source& source, const Word& word) {
  const double h = source.number(word);
  if (!(h > 0 && h <= 1)) source.fail(word, "the height of a set must be above 0 and at most 1");
  return h;
}

}  // namespace

void read_fis_shape(const Source& source, const Word& type, const std::vector<Word>& words, long inputs,
                    Term& out) {
  if (type == "constant" || type == "linear") {
    read_crisp(source, type, words, inputs, type == "linear", out);
    return;
  }
  if (type == "discretemf") {
    if (words.size() % 2 != 0) source.fail(type, "a discrete set needs pairs of numbers");
    out.set = read_points(source, type, words);
    return;
  }
  const Form& form = form_of(source, type, kFis);
  check_count(source, type, words.size(), form.count);
  // MATLAB pads lists with zeros.
  const auto padding = [&](const Word& word) { return source.number(word) == 0; };
  if (!std::all_of(words.begin() + static_cast<std::ptrdiff_t>(form.count), words.end(), padding))
    warn_of_more(source, type, words, form.count);
  out.set = build(source, type, form.kind, numbers(source, form, words));
}

void read_fll_shape(const Source& source, const Word& type, const std::vector<Word>& words, long inputs,
                    Term& out) {
  if (type == "Constant" || type == "Linear") {
    read_crisp(source, type, words, inputs, type == "Linear", out);
    return;
  }
  if (type == "Discrete") {
    out.set = read_points(source, type, words);
    if (words.size() % 2 != 0) out.set.height = height(source, words.back());
    return;
  }
  if (type == "Function") source.fail(type, "a function of text cannot be compiled");
  const Form& form = form_of(source, type, kFll);
  check_count(source, type, words.size(), form.count);
  if (words.size() > form.count + 1)
    source.fail(words[form.count + 1],
                fmt::format("'{}' has only {} parameters and a height", type.text, form.count));
  out.set = build(source, type, form.kind, numbers(source, form, words));
  if (words.size() > form.count) out.set.height = height(source, words.back());
}

}  // namespace whisker::rules
