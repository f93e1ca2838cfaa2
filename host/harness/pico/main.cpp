// The rig as a program: it answers each line of standard input by a line, `end` by the verdict.
//
//   whisker_rig WORLD [--robot FILE] [--seed N] [--full-speed MPS] [--listen]
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "host/harness/pico/rig.hpp"
#include "host/harness/scenario/load.hpp"

namespace whisker::pico {
namespace {

struct Options {
  std::string world;
  std::string robot;
  RigOptions rig;
};

Options options_of(const std::vector<std::string>& words) {
  Options o;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = [&]() -> const std::string& {
      if (i + 1 == words.size()) throw std::runtime_error(words[i] + ": no value");
      return words[++i];
    };
    if (words[i] == "--robot") {
      o.robot = value();
    } else if (words[i] == "--seed") {
      o.rig.seed = std::stoull(value());
    } else if (words[i] == "--full-speed") {
      o.rig.full_speed_mps = std::stod(value());
    } else if (words[i] == "--listen") {
      o.rig.listens = true;
    } else if (o.world.empty() && words[i].rfind("--", 0) != 0) {
      o.world = words[i];
    } else {
      throw std::runtime_error(words[i] + "?");
    }
  }
  if (o.world.empty()) throw std::runtime_error("no world");
  return o;
}

int run(const Options& options) {
  Rig rig(load_scenario(options.world, options.robot), options.rig);
  for (std::string line; std::getline(std::cin, line);)
    std::cout << (line == "end" ? rig.verdict() : rig.step(line)) << std::endl;
  return 0;
}

}  // namespace
}  // namespace whisker::pico

int main(int argc, char** argv) {
  try {
    return whisker::pico::run(whisker::pico::options_of({argv + 1, argv + argc}));
  } catch (const std::exception& e) {
    std::cerr << "whisker_rig: " << e.what() << "\n";
    return 2;
  }
}
