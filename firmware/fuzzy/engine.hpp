/// The fuzzy engine selected by the build, and its default table: constant data in flash.
#pragma once

#ifdef WHISKER_ENGINE_ANY
#error "a source of the core that asks for the engine belongs to engine_sources in firmware/CMakeLists.txt"
#endif

#ifdef WHISKER_ENGINE_CLOSED
#include "firmware/fuzzy/closed_form.hpp"
#include "firmware/fuzzy/rules.hpp"
#else
#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/fuzzy/response_table.hpp"
#endif

namespace whisker::fuzzy {

#ifdef WHISKER_ENGINE_CLOSED
using Engine = ClosedForm;
inline constexpr const Engine::Table& kDefaultTable = kRules;
#else
using Engine = Bilinear;
inline constexpr const Engine::Table& kDefaultTable = kResponseTable;
#endif

}  // namespace whisker::fuzzy
