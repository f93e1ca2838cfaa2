#include "host/lab/rules/mirrored_rules.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "firmware/fuzzy/rules.hpp"
#include "host/lab/rules/read.hpp"

namespace whisker::rules {
namespace {

using Names = std::array<const char*, kTerms>;
constexpr Names kDistanceNames{"VS", "S", "M", "B", "VB"};
constexpr Names kBiasNames{"RVB", "RB", "CE", "LB", "LVB"};
constexpr Names kTurnNames{"TRVB", "TRB", "Z", "TLB", "TLVB"};
constexpr Names kStepNames{"VS", "S", "M", "B", "VB"};
constexpr double kQ7 = 128, kQ14 = 16384;  // raw units in 1

/// The shortest decimal with the same raw value.
double readable(double value) {
  const double raw = std::round(value * kQ14);
  for (double scale = 1; scale < 1e5; scale *= 10) {
    const double x = std::round(value * scale) / scale;
    if (std::round(x * kQ14) == raw) return x;
  }
  return value;
}

template <std::size_t N>
int term_of(const std::array<Q14, N>& terms, Q14 value) {
  int term = 0;
  while (terms[static_cast<std::size_t>(term)] != value) ++term;
  return term;
}

/// The five centres of an input, or the five values of an output.
using Five = std::array<double, kTerms>;

class Reader {
 public:
  explicit Reader(const RuleBase& base) : base_(base) {}

  MirroredRules run() {
    const std::string_view file = base_.file;
    if (file.size() < 5 || file.substr(file.size() - 5) != ".toml")
      fail(base_, {}, "a search starts from a rule file in TOML");
    if (base_.inputs.size() != 2 || base_.inputs[0].name != "D" || base_.inputs[1].name != "R")
      fail(base_, base_.inputs[0].place, "a search starts from the inputs D and R, in this order");
    const Output& turn = output("SA");
    const Output& step = output("SD");
    rules_.distance = centres(base_.inputs[0]);
    rules_.bias = upper_half(centres(base_.inputs[1]), base_.inputs[1]);
    rules_.turn = upper_half(values(turn), turn);
    rules_.step = values(step);
    if (!(rules_.turn[0] > 0 && rules_.turn[1] > rules_.turn[0]))
      fail(base_, turn.place, "a search starts from terms of SA that ascend");
    for (std::size_t d = 0; d < kTerms; ++d) row(d);
    return rules_;
  }

 private:
  const Output& output(std::string_view name) const {
    if (base_.outputs.size() == 2)
      for (const Output& one : base_.outputs)
        if (one.name == name) return one;
    fail(base_, base_.outputs[0].place, "a search starts from the outputs SA and SD");
  }

  template <class Variable>
  void need_five(const Variable& v) const {
    if (v.terms.size() != kTerms)
      fail(base_, v.place,
           fmt::format("a search starts from five terms of '{}', not {}", v.name, v.terms.size()));
  }

  /// The terms are triangles, with shoulders at the ends.
  Five centres(const Input& in) const {
    need_five(in);
    Five all{};
    for (std::size_t t = 0; t < kTerms; ++t)
      for (const Vertex& v : in.terms[t].set.vertices)
        if (v.y == 1) all[t] = v.x;
    return all;
  }

  Five values(const Output& out) const {
    need_five(out);
    Five all{};
    for (std::size_t t = 0; t < kTerms; ++t) all[t] = readable(out.terms[t].constant);
    return all;
  }

  template <class Variable>
  std::array<double, 2> upper_half(const Five& all, const Variable& v) const {
    if (all[0] != -all[4] || all[1] != -all[3] || all[2] != 0)
      fail(base_, v.place,
           fmt::format("a search starts from terms of '{}' that mirror each other about 0", v.name));
    return {all[3], all[4]};
  }

  /// The term of this output at a place of the picture.
  int term(std::size_t d, std::size_t r, const char* name) const {
    for (const Conclusion& c : base_.rules[d * kTerms + r].conclusions)
      if (base_.outputs[c.output].name == name) return static_cast<int>(c.term);
    return 0;
  }

  void row(std::size_t d) {
    for (std::size_t r = 0; r <= 2; ++r) {
      const std::size_t mirrored = kTerms - 1 - r;
      const int turn = term(d, r, "SA") - 2, step = term(d, r, "SD");
      if (term(d, mirrored, "SA") - 2 != -turn || term(d, mirrored, "SD") != step)
        fail(base_, base_.rules[d * kTerms].place, "a search starts from rules that are mirrored in R");
      if (r < 2) rules_.turns[d][r] = turn;
      rules_.steps[d][r] = step;
    }
  }

  const RuleBase& base_;
  MirroredRules rules_;
};

std::string terms_text(const Names& names, const Five& values) {
  std::string text;
  for (std::size_t t = 0; t < kTerms; ++t)
    text += fmt::format("{}[\"{}\", {}]", t == 0 ? "" : ", ", names[t], values[t]);
  return text;
}

Five mirrored(const std::array<double, 2>& upper) { return {-upper[1], -upper[0], 0.0, upper[0], upper[1]}; }

/// One row of a picture; the terms stand below each other.
std::string row_text(const Names& names, const std::array<int, kTerms>& terms, const char* distance) {
  std::string text = "  [";
  for (std::size_t r = 0; r < kTerms; ++r) {
    const std::string word =
        fmt::format("\"{}\"{}", names[static_cast<std::size_t>(terms[r])], r + 1 < kTerms ? "," : "");
    text += r + 1 < kTerms ? fmt::format("{:<8}", word) : word;
  }
  return fmt::format("{:<46}# {}\n", text + "],", distance);
}

constexpr double kFirstCentre = fuzzy::kDistanceLow / 128.0, kLastCentre = fuzzy::kDistanceHigh / 128.0;
constexpr double kOuterBias = fuzzy::kBiasHigh / 128.0;

/// False: it would leave [low, high].
template <class T>
bool move(T& x, T by, T low, T high) {
  if (x + by < low || x + by > high) return false;
  x += by;
  return true;
}

}  // namespace

MirroredRules core_rules() {
  namespace turn_terms = fuzzy::turn_terms;
  namespace step_terms = fuzzy::step_terms;
  const std::array turns{turn_terms::TRVB, turn_terms::TRB, turn_terms::Z, turn_terms::TLB, turn_terms::TLVB};
  const std::array steps{step_terms::VS, step_terms::S, step_terms::M, step_terms::B, step_terms::VB};
  const auto value = [](Q14 q) { return readable(q.raw() / kQ14); };
  MirroredRules rules;
  for (std::size_t d = 0; d < kTerms; ++d) {
    rules.distance[d] = fuzzy::kDistanceCentres[d] / kQ7;
    rules.step[d] = value(steps[d]);
    for (std::size_t r = 0; r < 2; ++r) rules.turns[d][r] = term_of(turns, fuzzy::kRules.turn[d][r]) - 2;
    for (std::size_t r = 0; r < 3; ++r) rules.steps[d][r] = term_of(steps, fuzzy::kRules.step[d][r]);
  }
  rules.bias = {fuzzy::kBiasCentres[3] / kQ7, fuzzy::kBiasCentres[4] / kQ7};
  rules.turn = {value(turns[3]), value(turns[4])};
  return rules;
}

MirroredRules mirrored_rules(const RuleBase& base) { return Reader(base).run(); }

std::string to_toml(const MirroredRules& rules, const std::string& name, const std::string& comment) {
  std::string text;
  for (std::size_t from = 0; from < comment.size();) {
    const std::size_t end = std::min(comment.find('\n', from), comment.size());
    text += fmt::format("# {}\n", comment.substr(from, end - from));
    from = end + 1;
  }
  const auto variable = [&](const char* kind, const char* word, const char* meaning) {
    text += fmt::format("\n[[{}]]\nname = \"{}\"{:>{}}# {}\n", kind, word, "",
                        22 - std::string_view(word).size(), meaning);
  };
  text += fmt::format("name = \"{}\"\n", name);
  variable("input", "D", "distance ahead");
  text += fmt::format("range = [0, 10]\nterms = [{}]\nraw_per_unit = 128\n",
                      terms_text(kDistanceNames, rules.distance));
  variable("input", "R", "right minus left distance");
  text += fmt::format("range = [-8, 8]\nterms = [{}]\nraw_per_unit = 128\n",
                      terms_text(kBiasNames, mirrored(rules.bias)));
  variable("output", "SA", "turn factor; positive: left");
  text += fmt::format("terms = [{}]\nraw_per_unit = 16384\nrules = [\n",
                      terms_text(kTurnNames, mirrored(rules.turn)));
  const std::string head = fmt::format("{:<46}# D\n", "  # R: RVB  RB      CE      LB      LVB");
  text += head;
  for (std::size_t d = 0; d < kTerms; ++d) {
    const auto& t = rules.turns[d];
    text += row_text(kTurnNames, {2 + t[0], 2 + t[1], 2, 2 - t[1], 2 - t[0]}, kDistanceNames[d]);
  }
  text += "]\n";
  variable("output", "SD", "step factor");
  text += fmt::format("terms = [{}]\nraw_per_unit = 16384\nrules = [\n", terms_text(kStepNames, rules.step));
  text += head;
  for (std::size_t d = 0; d < kTerms; ++d) {
    const auto& s = rules.steps[d];
    text += row_text(kStepNames, {s[0], s[1], s[2], s[1], s[0]}, kDistanceNames[d]);
  }
  return text + "]\n";
}

std::optional<Response> admitted(const MirroredRules& rules) {
  Response r = response(parse_rules(to_toml(rules, "candidate", ""), "candidate.toml"), {});
  const auto [slowest, fastest] = std::minmax_element(rules.step.begin(), rules.step.end());
  const double turn_span = 2 * rules.turn[1], step_span = *fastest - *slowest;
  if (r.turn_error > kMostLookUpError * turn_span || r.step_error > kMostLookUpError * step_span)
    return std::nullopt;
  return r;
}

MirroredRules Mutation::operator()(MirroredRules rules) {
  std::size_t changes = 1;
  while (changes < 5 && below(2) == 0) ++changes;
  while (changes > 0)
    if (change(rules)) --changes;
  return rules;
}

// One draw a statement: the order in which a call evaluates its arguments is the compiler's.
bool Mutation::change(MirroredRules& rules) {
  if (steps_ && below(4) == 0) return change_step(rules);
  const std::size_t what = below(8);
  if (what >= 5) return change_centre(rules);
  const std::size_t row = below(kTerms);
  const std::size_t column = below(2);
  const int by = sign();
  if (what < 3) return move(rules.turns[row][column], by, -2, 2);
  bool moved = false;
  for (std::size_t d = 0; d < kTerms; ++d)
    for (std::size_t r = 0; r < 2; ++r)
      if (what == 3 ? d == row : r == column) moved |= move(rules.turns[d][r], by, -2, 2);
  return moved;
}

bool Mutation::change_step(MirroredRules& rules) {
  const std::size_t row = below(kTerms);
  const std::size_t column = below(4);  // 3: the whole row
  const int by = sign();
  bool moved = false;
  for (std::size_t r = 0; r < 3; ++r)
    if (column == 3 || r == column) moved |= move(rules.steps[row][r], by, 0, static_cast<int>(kTerms) - 1);
  return moved;
}

bool Mutation::change_centre(MirroredRules& rules) {
  const std::size_t what = below(4);
  const std::size_t term = below(kTerms);
  const int by = sign();
  const double part = by * static_cast<double>(1 + below(4)) / 4;  // of 1
  auto& d = rules.distance;
  if (what < 2) {
    const double low = term == 0 ? kFirstCentre : d[term - 1] + kLeastGap;
    const double high = term + 1 == kTerms ? kLastCentre : d[term + 1] - kLeastGap;
    return move(d[term], part, low, high);
  }
  const bool outer = term % 2 == 0;
  if (what == 2) {
    auto& [inner_bias, outer_bias] = rules.bias;
    return outer ? move(outer_bias, part, inner_bias + kLeastGap, kOuterBias)
                 : move(inner_bias, part, kLeastGap, outer_bias - kLeastGap);
  }
  auto& [little, much] = rules.turn;
  return outer ? move(much, part / 4, little + kLeastTurnGap, kGreatestTurn)
               : move(little, part / 4, kLeastTurnGap, much - kLeastTurnGap);
}

}  // namespace whisker::rules
