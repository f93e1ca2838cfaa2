/// \file Forward declarations of CLI11, whose header has 10,000 lines.
#pragma once

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI
