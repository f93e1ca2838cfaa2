#include "tests/report/controller.hpp"

#include <algorithm>

namespace whisker::testing {
namespace {

using report::FuzzyPicture;
using report::Rule;
using report::Term;
using report::Variable;

constexpr int kTurn[5][5] = {
    {4, 4, 2, 0, 0}, {4, 3, 2, 1, 0}, {3, 3, 2, 1, 1}, {3, 2, 2, 2, 1}, {2, 2, 2, 2, 2}};
constexpr int kStep[5][5] = {
    {0, 0, 0, 0, 0}, {0, 1, 1, 1, 0}, {1, 2, 2, 2, 1}, {2, 3, 3, 3, 2}, {3, 4, 4, 4, 3}};

double membership(const std::vector<Term>& terms, std::size_t i, double x) {
  const double c = terms[i].centre;
  if (x <= c) return i == 0 ? 1.0 : std::max(0.0, 1 - (c - x) / (c - terms[i - 1].centre));
  return i + 1 == terms.size() ? 1.0 : std::max(0.0, 1 - (x - c) / (terms[i + 1].centre - c));
}

double infer(const Variable& d, const Variable& r, const std::vector<std::vector<Rule>>& rules, double d_at,
             double r_at) {
  double sum = 0;
  double weights = 0;
  for (std::size_t i = 0; i < d.terms.size(); ++i) {
    for (std::size_t j = 0; j < r.terms.size(); ++j) {
      const double w = std::min(membership(d.terms, i, d_at), membership(r.terms, j, r_at));
      sum += w * rules[i][j].value;
      weights += w;
    }
  }
  return sum / weights;
}

std::vector<std::vector<Rule>> rules(const int (&table)[5][5], const Variable& output) {
  std::vector<std::vector<Rule>> all;
  for (const auto& row : table) {
    all.emplace_back();
    for (const int term : row) {
      const Term& t = output.terms[static_cast<std::size_t>(term)];
      all.back().push_back({t.name, t.centre});
    }
  }
  return all;
}

}  // namespace

FuzzyPicture thesis_picture() {
  FuzzyPicture p;
  p.d = {"D", "distance ahead", 0, 10, {{"VS", 1}, {"S", 3}, {"M", 5}, {"B", 7}, {"VB", 9}}};
  p.r = {"R",
         "right distance - left distance (positive: nearer on the left)",
         -8,
         8,
         {{"RVB", -7}, {"RB", -4}, {"CE", 0}, {"LB", 4}, {"LVB", 7}}};
  p.sa = {"SA",
          "turn factor (positive: to the left)",
          -1.5,
          1.5,
          {{"TRVB", -1.5}, {"TRB", -0.75}, {"Z", 0}, {"TLB", 0.75}, {"TLVB", 1.5}}};
  p.sd = {"SD", "step factor", 0, 2, {{"VS", 0.3}, {"S", 0.6}, {"M", 1.0}, {"B", 1.4}, {"VB", 1.7}}};
  p.turn = rules(kTurn, p.sa);
  p.step = rules(kStep, p.sd);
  p.sa_at = [d = p.d, r = p.r, t = p.turn](double x, double y) { return infer(d, r, t, x, y); };
  p.sd_at = [d = p.d, r = p.r, t = p.step](double x, double y) { return infer(d, r, t, x, y); };
  p.source = "exact inference";
  return p;
}

}  // namespace whisker::testing
