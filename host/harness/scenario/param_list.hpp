/// The parameters as a list of numbers, for code that treats all of them alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "host/harness/scenario/params_text.hpp"

namespace whisker {

struct ParamEntry {
  int number;  ///< on the bus
  const char* key;
  std::int64_t raw;
  std::int64_t low;  ///< range of the parameter
  std::int64_t high;
  ParamUnit unit;            ///< symbol "" for a count or a choice
  const char* word;          ///< of a choice; otherwise null
  const char* type;          ///< "Length"; "int32_t" for a count, "" for a choice
  bool boolean = false;      ///< a choice between "false" and "true"
  bool of_one_beam() const;  ///< not of all three
  std::string text() const;  ///< as in a file
  std::string text_of(std::int64_t other) const;
};

/// In the order of for_each_param, without what is derived.
std::vector<ParamEntry> param_list(const Params& params);

/// Sets the parameter at this index of the list; raw must lie within its range.
void set_param(Params& params, std::size_t place, std::int64_t raw);

}  // namespace whisker
