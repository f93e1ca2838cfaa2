#include "tests/rules/random_base.hpp"

#include <cstdio>
#include <random>
#include <vector>

namespace whisker::test {
namespace {

class Writer {
 public:
  explicit Writer(std::uint64_t seed) : random_(seed) {}

  std::string run() {
    const int inputs = 1 + chance(0.8);
    const int outputs = 1 + chance(0.3);
    const bool weighted = chance(0.3);
    std::string text = "Engine: random\n";
    for (int i = 0; i < inputs; ++i) text += input(i);
    for (int o = 0; o < outputs; ++o) text += output(o, inputs, weighted);
    return text + block(inputs, outputs);
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  bool chance(double p) { return uniform(0, 1) < p; }
  double uniform(double a, double b) {
    return a + (b - a) * static_cast<double>(random_() >> 11) / 9007199254740992.0;
  }
  std::string pick(const std::vector<std::string>& all) {
    return all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
  }
  static std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6f", x);
    return text;
  }
  static std::string name(const char* head, int i) { return head + std::to_string(i); }

  std::string range(double& low, double& high) {
    low = chance(0.5) ? 0 : uniform(-20, 5);
    high = low + uniform(0.5, 30);
    return "  enabled: true\n  range: " + number(low) + " " + number(high) + "\n  lock-range: false\n";
  }

  /// A set about the i-th of n places. A term's neighbours always overlap it.
  std::string shape(double low, double high, int i, int n) {
    const double gap = (high - low) / (n - 1);
    const double c = low + gap * i;
    const double w = gap * uniform(0.7, 1.3);
    switch (below(12)) {
      case 0: return "Gaussian " + number(c) + " " + number(w / 2);
      case 1: return "Bell " + number(c) + " " + number(w / 2) + " " + number(uniform(1, 4));
      case 2:
        return "PiShape " + number(c - w) + " " + number(c - w / 8) + " " + number(c + w / 8) + " " +
               number(c + w);
      case 3:
        return "Trapezoid " + number(c - w) + " " + number(c - w / 4) + " " + number(c + w / 4) + " " +
               number(c + w);
      case 4:
        return "SigmoidProduct " + number(c - w / 2) + " " + number(8 / w) + " " + number(-8 / w) + " " +
               number(c + w / 2);
      case 5:
        return "GaussianProduct " + number(c) + " " + number(w / 2) + " " + number(c + w / 4) + " " +
               number(w / 3);
      case 6: return "Cosine " + number(c) + " " + number(2 * w);
      case 7:
        return "SigmoidDifference " + number(c - w / 2) + " " + number(9 / w) + " " + number(9 / w) + " " +
               number(c + w / 2);
      default: return "Triangle " + number(c - w) + " " + number(c) + " " + number(c + w);
    }
  }

  std::string input(int i) {
    double low = 0, high = 0;
    std::string text = "InputVariable: " + name("in", i) + "\n" + range(low, high);
    terms_.push_back(2 + below(4));
    for (int t = 0; t < terms_.back(); ++t)
      text += "  term: " + name("t", t) + " " + shape(low, high, t, terms_.back()) + "\n";
    return text;
  }

  std::string output(int o, int inputs, bool weighted) {
    double low = 0, high = 0;
    std::string text = "OutputVariable: " + name("out", o) + "\n" + range(low, high);
    const int n = 2 + below(4);
    out_terms_.push_back(n);
    const std::string aggregation =
        pick({"Maximum", "Maximum", "AlgebraicSum", "UnboundedSum", "BoundedSum", "EinsteinSum"});
    text += "  aggregation: " + (weighted ? std::string("none") : aggregation) + "\n  defuzzifier: ";
    text += weighted ? pick({"WeightedAverage TakagiSugeno", "WeightedSum TakagiSugeno"})
                     : pick({"Centroid 100", "Centroid 100", "Centroid 100", "Bisector 100"});
    text += "\n  default: " + number((low + high) / 2) + "\n  lock-previous: false\n";
    for (int t = 0; t < n; ++t) {
      text += "  term: " + name("t", t) + " ";
      if (!weighted) {
        text += shape(low, high, t, n);
      } else if (chance(0.5)) {
        text += "Constant " + number(uniform(low, high));
      } else {
        text += "Linear";
        for (int i = 0; i < inputs; ++i) text += " " + number(uniform(-1, 1));
        text += " " + number(uniform(low, high));
      }
      text += "\n";
    }
    return text;
  }

  std::string proposition(int i) {
    const std::string hedge =
        chance(0.1) ? pick({"not ", "very ", "somewhat ", "extremely ", "seldom "}) : "";
    return name("in", i) + " is " + hedge + name("t", below(terms_[static_cast<std::size_t>(i)]));
  }

  std::string block(int inputs, int outputs) {
    std::string text =
        "RuleBlock: all\n  enabled: true\n  conjunction: " +
        pick({"Minimum", "AlgebraicProduct", "EinsteinProduct", "HamacherProduct", "BoundedDifference"}) +
        "\n  disjunction: " + pick({"Maximum", "AlgebraicSum", "BoundedSum", "HamacherSum"}) +
        "\n  implication: " + pick({"Minimum", "AlgebraicProduct"}) + "\n  activation: General\n";
    const int rules = 3 + below(15);
    for (int r = 0; r < rules; ++r) {
      text += "  rule: if " + proposition(0);
      if (inputs > 1 && chance(0.85)) text += (chance(0.8) ? " and " : " or ") + proposition(1);
      text += " then ";
      for (int o = 0; o < outputs; ++o)
        text += (o == 0 ? "" : " and ") + name("out", o) + " is " +
                name("t", below(out_terms_[static_cast<std::size_t>(o)]));
      if (chance(0.2)) text += " with " + number(uniform(0.1, 1));
      text += "\n";
    }
    return text;
  }

  std::mt19937_64 random_;
  std::vector<int> terms_;
  std::vector<int> out_terms_;
};

}  // namespace

std::string random_fll(std::uint64_t seed) { return Writer(seed).run(); }

}  // namespace whisker::test
