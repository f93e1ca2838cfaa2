// Whisker's own rule files: terms as numbers, rules as a picture.
#include <fmt/format.h>

#include <cmath>

#include "host/harness/scenario/reader.hpp"
#include "host/lab/rules/read.hpp"

namespace whisker::rules {
namespace {

constexpr Limits kValue{-kGreatest, kGreatest};
constexpr Limits kRawPerUnit{1e-6, 1e6};

class TomlReader {
 public:
  explicit TomlReader(const Source& source)
      : source_(source),
        root_(parse_toml(source.text(), source.file())),
        top_(source.file(), root_, "", {"name", "input", "output"}) {}

  RuleBase run() {
    base_.file = source_.file();
    if (top_.has("name")) base_.name = top_.text("name");
    for (const TableReader& t : top_.tables("input", {"name", "range", "terms", "raw_per_unit"})) input(t);
    if (base_.inputs.empty()) source_.fail(Place{}, "the file has no [[input]]");
    if (base_.inputs.size() > 2)
      source_.fail(base_.inputs[2].place, "a rule file in TOML has at most two inputs");
    std::size_t i = 0;
    for (const TableReader& t : top_.tables("output", {"name", "terms", "rules", "raw_per_unit"}))
      output(t, i++);
    check(source_, base_);
    return std::move(base_);
  }

 private:
  [[noreturn]] void fail(const toml::node& at, std::string_view what) const {
    const toml::source_position p = at.source().begin;
    source_.fail(Place{std::max<std::size_t>(1, p.line), std::max<std::size_t>(1, p.column)}, what);
  }

  const toml::array& array(const toml::node* node, const toml::node& owner, std::string_view key) const {
    if (node == nullptr) fail(owner, fmt::format("'{}' is missing", key));
    if (!node->is_array()) fail(*node, fmt::format("'{}' must be an array", key));
    return *node->as_array();
  }

  double number(const toml::node& node) const {
    const std::optional<double> x = node.value<double>();
    if (!x || node.is_boolean()) fail(node, "a number is expected");
    if (!kValue.allow(*x)) fail(node, fmt::format("{} must be from -1e9 to 1e9", *x));
    return *x;
  }

  std::string text(const toml::node& node) const {
    if (!node.is_string()) fail(node, "a name in quotes is expected");
    return node.as_string()->get();
  }

  struct Centre {
    std::string name;
    double value;
    Place place;
  };

  /// [["near", 1.0], ["far", 9.0]]
  std::vector<Centre> terms(const toml::table& table) const {
    std::vector<Centre> all;
    const toml::array& list = array(table.get("terms"), table, "terms");
    if (list.empty() || list.size() > kMostTerms)
      fail(list, fmt::format("'terms' must have 1 to {} terms", kMostTerms));
    for (const toml::node& node : list) {
      const toml::array* const pair = node.as_array();
      if (pair == nullptr || pair->size() != 2) fail(node, "a term is [\"NAME\", CENTRE]");
      Centre c{
          text(*pair->get(0)), number(*pair->get(1)), {node.source().begin.line, node.source().begin.column}};
      for (const Centre& other : all)
        if (other.name == c.name) fail(node, fmt::format("a second term '{}'", c.name));
      all.push_back(c);
    }
    return all;
  }

  const toml::table& entry(const char* key, std::size_t index) const {
    return *root_.get(key)->as_array()->get(index)->as_table();
  }

  void raw_per_unit(const TableReader& t, std::optional<double>& out) const {
    if (t.has("raw_per_unit")) out = t.number("raw_per_unit", kRawPerUnit);
  }

  void input(const TableReader& t) {
    const toml::table& table = entry("input", base_.inputs.size());
    Input v;
    v.name = t.text("name");
    v.place = {t.line_of("name"), 1};
    const toml::array& range = array(table.get("range"), table, "range");
    if (range.size() != 2) fail(range, "'range' is two numbers");
    v.low = number(range[0]);
    v.high = number(range[1]);
    raw_per_unit(t, v.raw_per_unit);
    const std::vector<Centre> centres = terms(table);
    for (std::size_t i = 0; i < centres.size(); ++i) {
      if (i > 0 && centres[i].value <= centres[i - 1].value)
        source_.fail(centres[i].place, "the centres of an input must ascend");
      Term term;
      term.name = centres[i].name;
      term.place = centres[i].place;
      // Triangles between the neighbours' centres, shoulders outside.
      term.set = triangle(i == 0 ? -HUGE_VAL : centres[i - 1].value, centres[i].value,
                          i + 1 == centres.size() ? HUGE_VAL : centres[i + 1].value);
      v.terms.push_back(std::move(term));
    }
    for (const Input& other : base_.inputs)
      if (other.name == v.name) t.fail_at("name", fmt::format("a second input '{}'", v.name));
    base_.inputs.push_back(std::move(v));
  }

  void output(const TableReader& t, std::size_t index) {
    const toml::table& table = entry("output", index);
    Output v;
    v.name = t.text("name");
    v.place = {t.line_of("name"), 1};
    v.defuzzifier = Defuzzifier::weighted_average;
    v.silent_reason = "no rule covers it";
    raw_per_unit(t, v.raw_per_unit);
    v.low = HUGE_VAL;
    v.high = -HUGE_VAL;
    for (const Centre& c : terms(table)) {
      Term term;
      term.name = c.name;
      term.place = c.place;
      term.crisp = true;
      // As the core, which holds its centres in raw units.
      term.constant = v.raw_per_unit ? std::round(c.value * *v.raw_per_unit) / *v.raw_per_unit : c.value;
      v.low = std::min(v.low, c.value);
      v.high = std::max(v.high, c.value);
      v.terms.push_back(std::move(term));
    }
    if (v.low == v.high) v.high = v.low + 1;
    for (const Output& other : base_.outputs)
      if (other.name == v.name) t.fail_at("name", fmt::format("a second output '{}'", v.name));
    base_.outputs.push_back(std::move(v));
    picture(array(table.get("rules"), table, "rules"), base_.outputs.size() - 1);
  }

  /// Rows: terms of the first input; columns: terms of the second.
  void picture(const toml::array& rows, std::size_t output) {
    const std::size_t height = base_.inputs[0].terms.size();
    if (rows.size() != height)
      fail(rows,
           fmt::format("'rules' must have {} rows, one for each term of '{}'", height, base_.inputs[0].name));
    for (std::size_t r = 0; r < height; ++r) {
      if (base_.inputs.size() == 1) {
        rule(rows[r], {r}, output);
        continue;
      }
      const toml::array* const row = rows[r].as_array();
      const std::size_t width = base_.inputs[1].terms.size();
      if (row == nullptr || row->size() != width)
        fail(rows[r],
             fmt::format("a row must have {} terms, one for each term of '{}'", width, base_.inputs[1].name));
      for (std::size_t c = 0; c < width; ++c) rule((*row)[c], {r, c}, output);
    }
  }

  /// Each output adds a conclusion to the rule of its place in the picture.
  void rule(const toml::node& node, const std::vector<std::size_t>& terms, std::size_t output) {
    const std::string name = text(node);
    const std::vector<Term>& known = base_.outputs[output].terms;
    std::size_t term = 0;
    while (term < known.size() && known[term].name != name) ++term;
    if (term == known.size())
      fail(node, fmt::format("'{}' has no term '{}'", base_.outputs[output].name, name));
    if (output > 0) {
      const std::size_t width = terms.size() > 1 ? base_.inputs[1].terms.size() : 1;
      base_.rules[terms[0] * width + (terms.size() > 1 ? terms[1] : 0)].conclusions.push_back(
          {output, term, false});
      return;
    }
    Rule rule;
    rule.place = {node.source().begin.line, node.source().begin.column};
    for (std::size_t i = 0; i < terms.size(); ++i) {
      Step step;
      step.input = i;
      step.term = terms[i];
      rule.antecedent.push_back(step);
      if (i == 0) continue;
      Step both;
      both.kind = Step::Kind::conjunction;
      rule.antecedent.push_back(both);
    }
    rule.conclusions.push_back({output, term, false});
    base_.rules.push_back(std::move(rule));
  }

  const Source& source_;
  toml::table root_;
  TableReader top_;
  RuleBase base_;
};

}  // namespace

RuleBase read_toml(const Source& source) { return TomlReader(source).run(); }

}  // namespace whisker::rules
