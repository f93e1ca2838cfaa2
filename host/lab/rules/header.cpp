#include "host/lab/rules/header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "host/harness/scenario/text.hpp"
#include "host/lab/rules/findings.hpp"
#include "host/lab/rules/source.hpp"

namespace whisker::rules {
namespace {

/// Letters, digits and underscores only.
std::string identifier(std::string_view name) {
  std::string out;
  for (const char c : lower_case(name)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (plain) {
      out += c;
    } else if (!out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? "x" : out;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return text;
}

/// Different identifiers for different names.
std::vector<std::string> identifiers(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) {
    const std::string first = identifier(name);
    std::string id = first;
    for (int i = 2; std::find(all.begin(), all.end(), id) != all.end(); ++i)
      id = fmt::format("{}_{}", first, i);
    all.push_back(id);
  }
  return all;
}

/// Text of a user inside a comment.
std::string in_comment(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += (c >= 0 && c < ' ') || c == '\x7F' || c == '/' || c == '\\' || c == '?' ? '_' : c;
  return out;
}

class Writer {
 public:
  Writer(const Compiled& c, std::string_view path) : c_(c) {
    const std::string stem = identifier(std::filesystem::path(path).stem().string());
    prefix_ = stem.front() >= '0' && stem.front() <= '9' ? "rules_" + stem : stem;
    macro_ = upper(prefix_);
    std::vector<std::string> names;
    for (const Domain::Part& part : c.surface.domain.parts)
      names.push_back(c.base.inputs[part.axis.input].name);
    for (const Output& output : c.base.outputs) names.push_back(output.name);
    const std::vector<std::string> ids = identifiers(names);
    const auto inputs = static_cast<std::ptrdiff_t>(c.surface.domain.parts.size());
    inputs_.assign(ids.begin(), ids.begin() + inputs);
    outputs_.assign(ids.begin() + inputs, ids.end());
  }

  std::string run() {
    start();
    for (std::size_t i = 0; i < inputs_.size(); ++i) input(i);
    for (std::size_t o = 0; o < outputs_.size(); ++o) output(o);
    nodes();
    helpers();
    look_up();
    add("#endif\n");
    return out_;
  }

 private:
  template <class... Args>
  void add(std::string_view format, const Args&... args) {
    out_ += fmt::format(fmt::runtime(format), args...);
  }

  const GridAxis& axis(std::size_t i) const { return c_.table.axes[i]; }

  void start() {
    add("/* {}: {} rules as a table of ", in_comment(c_.base.name.empty() ? prefix_ : c_.base.name),
        c_.base.rules.size());
    for (std::size_t i = 0; i < inputs_.size(); ++i) add("{}{}", i == 0 ? "" : " x ", axis(i).nodes());
    add(" nodes, {} bytes. Written by `whisker rules compile`; edit the\n   rules, not this file.\n\n",
        c_.table.bytes());
    add("   Greatest error over every raw input, against inference in double precision:\n");
    for (std::size_t o = 0; o < outputs_.size(); ++o) {
      const double share = c_.spans[o] > 0 ? 100 * c_.errors[o].greatest / c_.spans[o] : 0;
      add("   {}: {:.3g} % of the span ({:.3g}), at {}\n", outputs_[o], share, c_.errors[o].greatest,
          in_comment(where(c_, c_.errors[o].at)));
    }
    add("*/\n#ifndef {0}_H\n#define {0}_H\n\n#include <stdint.h>\n\n", macro_);
  }

  void input(std::size_t i) {
    const Axis& a = c_.surface.domain.parts[i].axis;
    const std::string name = macro_ + "_" + upper(inputs_[i]);
    add("/* Input {}: value = origin + raw / per unit. */\n", inputs_[i]);
    add("#define {}_ORIGIN ({})\n#define {}_PER_UNIT {}\n", name, toml_number(a.origin), name,
        toml_number(a.per_unit));
    add("#define {}_LOW ({})\n#define {}_HIGH ({})\n", name, a.low, name, a.high);
    add("/* The table: it starts at this raw value, covers this span, and its nodes are 2^shift apart. */\n");
    add("#define {}_START ({})\n#define {}_SPAN {}\n#define {}_SHIFT {}\n\n", name, axis(i).low, name,
        axis(i).high - axis(i).low, name, axis(i).shift);
  }

  void output(std::size_t o) {
    const OutputScale& s = c_.table.scales[o];
    const std::string name = macro_ + "_" + upper(outputs_[o]);
    add("/* Output {}: value = origin + raw / per unit. */\n#define {}_ORIGIN ({})\n#define {}_PER_UNIT "
        "{}\n\n",
        outputs_[o], name, toml_number(s.origin), name, toml_number(s.per_unit));
  }

  std::int32_t columns() const { return inputs_.size() > 1 ? axis(1).nodes() : 1; }
  std::size_t row() const { return static_cast<std::size_t>(columns()) * outputs_.size(); }

  /// One line for each node of the first input.
  void nodes() {
    add("static const int16_t {}_nodes[{} * {}] = {{\n", prefix_, axis(0).nodes(), row());
    for (std::int32_t r = 0; r < axis(0).nodes(); ++r) {
      for (std::int32_t n = 0; n < columns(); ++n)
        for (std::size_t o = 0; o < outputs_.size(); ++o)
          add("{}{},", n == 0 && o == 0 ? "  " : "", c_.table.node(r, n, o));
      add("\n");
    }
    add("}};\n\n");
  }

  void helpers() {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      add("/* To the nearest raw unit, limited to the range; not-a-number becomes the lower end. */\n"
          "static inline int16_t {0}_{1}_raw(double value) {{\n"
          "  const double x = (value - {2}_ORIGIN) * {2}_PER_UNIT;\n"
          "  if (!(x > {2}_LOW)) return {2}_LOW;\n"
          "  if (x > {2}_HIGH) return {2}_HIGH;\n"
          "  return (int16_t)(x < 0.0 ? x - 0.5 : x + 0.5);\n}}\n\n",
          prefix_, inputs_[i], macro_ + "_" + upper(inputs_[i]));
    }
    for (std::size_t o = 0; o < outputs_.size(); ++o) {
      add("static inline double {0}_{1}_value(int16_t raw) {{ return {2}_ORIGIN + raw / {2}_PER_UNIT; }}\n\n",
          prefix_, outputs_[o], macro_ + "_" + upper(outputs_[o]));
    }
  }

  /// The cell's number and the offset in it. Up to 11 bits, a product replaces the comparison with zero.
  void place(std::size_t i) {
    const std::string name = macro_ + "_" + upper(inputs_[i]);
    add("  const int32_t x{0} = (int32_t)raw_{1} - {2}_START;\n"
        "  const int32_t y{0} = x{0} < 0 ? 0 : x{0};\n"
        "  const uint32_t u{0} = (uint32_t)(y{0} > {2}_SPAN ? {2}_SPAN : y{0});\n",
        i, inputs_[i], name);
    if (axis(i).high - axis(i).low < 2048) {
      add("  const uint32_t c{0} = (u{0} * 2047U) >> ({1}_SHIFT + 11);\n", i, name);
    } else {
      add("  const uint32_t c{0} = (u{0} - (u{0} > 0U ? 1U : 0U)) >> {1}_SHIFT;\n", i, name);
    }
    add("  const int32_t f{0} = (int32_t)(u{0} - (c{0} << {1}_SHIFT));\n", i, name);
  }

  void look_up() {
    const bool two = inputs_.size() > 1;
    add("/* Raw outputs. */\ntypedef struct {{\n");
    for (const std::string& o : outputs_) add("  int16_t raw_{};\n", o);
    add("}} {0}_outputs;\n\n", prefix_);
    add("/* Inputs beyond the range are limited to it. A node belongs to the cell below it; results are "
        "rounded to\n"
        "   nearest. */\nstatic inline {0}_outputs {0}_look_up(int16_t raw_{1}",
        prefix_, inputs_[0]);
    if (two) add(", int16_t raw_{}", inputs_[1]);
    add(") {{\n");
    place(0);
    if (two) place(1);
    const int bits = axis(0).shift + (two ? axis(1).shift : 0);
    if (two) {
      add("  const int32_t w3 = f0 * f1;\n  const int32_t w2 = f0 * {0} - w3;\n  const int32_t w1 = f1 * {1} "
          "- w3;\n"
          "  const int32_t w0 = {2} - w1 - w2 - w3;\n",
          1 << axis(1).shift, 1 << axis(0).shift, 1 << bits);
    } else {
      add("  const int32_t w0 = {} - f0;\n", 1 << bits);
    }
    const std::string column = two ? fmt::format(" + c1 * {}U", outputs_.size()) : "";
    add("  const int16_t* const n0 = &{0}_nodes[c0 * {1}U{2}];\n  const int16_t* const n1 = n0 + {1};\n",
        prefix_, row(), column);
    add("  {}_outputs out;\n", prefix_);
    for (std::size_t o = 0; o < outputs_.size(); ++o) sum(o, two, bits);
    add("  return out;\n}}\n\n");
  }

  void sum(std::size_t o, bool two, int bits) {
    if (two) {
      add("  const int32_t s{0} = w0 * n0[{0}] + w1 * n0[{1}] + w2 * n1[{0}] + w3 * n1[{1}];\n", o,
          o + outputs_.size());
    } else {
      add("  const int32_t s{0} = w0 * n0[{0}] + f0 * n1[{0}];\n", o);
    }
    const int half = bits == 0 ? 0 : 1 << (bits - 1);
    const bool odd = c_.table.scales[o].odd && bits > 0;
    add("  const uint32_t r{} = (uint32_t)s{} + {}U{};\n", o, o, odd ? half - 1 : half,
        odd ? fmt::format(" + (s{} < 0 ? 1U : 0U)", o) : "");
    add("  const int32_t b{0} = (int32_t)((r{0} >> {1}) & 0xFFFFU);\n"
        "  out.raw_{2} = (int16_t)(b{0} > 0x7FFF ? b{0} - 0x10000 : b{0});\n",
        o, bits, outputs_[o]);
  }

  const Compiled& c_;
  std::string prefix_;
  std::string macro_;
  std::vector<std::string> inputs_;
  std::vector<std::string> outputs_;
  std::string out_;
};

}  // namespace

std::string header(const Compiled& compiled, std::string_view path) { return Writer(compiled, path).run(); }

}  // namespace whisker::rules
