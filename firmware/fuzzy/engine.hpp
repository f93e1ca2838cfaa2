/// The fuzzy engine of the core and its default table: constant data in flash.
#pragma once

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/fuzzy/response_table.hpp"

namespace whisker::fuzzy {

using Engine = Bilinear;
inline constexpr const Engine::Table& kDefaultTable = kResponseTable;

}  // namespace whisker::fuzzy
