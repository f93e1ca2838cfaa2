/// \file The names of CLI11 that this folder's headers take and give, without its 10,000 lines.
#pragma once

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI
