/// Any bytes as a rule file of each format: the result is a rule base whose inference runs, or a one-line
/// error.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "host/lab/rules/inference.hpp"
#include "host/lab/rules/read.hpp"

namespace {

void require(bool holds, std::string_view what, const std::string& text) {
  if (holds) return;
  std::cerr << what << ":\n" << text << "\n";
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr const char* kNames[] = {"fuzz.fis", "fuzz.fll", "fuzz.fcl", "fuzz.toml"};
  const std::string name = kNames[data[0] % 4];
  const std::string text(data + 1, data + size);
  whisker::rules::RuleBase base;
  try {
    base = whisker::rules::parse_rules(text, name);
  } catch (const whisker::InputError& error) {
    const std::string message = error.what();
    require(message.rfind(name + ":", 0) == 0, "the message does not begin with FILE:", message);
    require(message.find('\n') == std::string::npos, "the message has more than one line", message);
    return 0;
  }
  if (base.rules.size() > 64) return 0;
  const whisker::rules::Inference inference(base);
  std::vector<double> middle;
  for (const whisker::rules::Input& input : base.inputs) middle.push_back((input.low + input.high) / 2);
  for (const whisker::rules::Answer& answer : inference(middle))
    require(std::isfinite(answer.value), "an answer is not finite", text);
  return 0;
}
