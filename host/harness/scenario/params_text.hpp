/// The parameters of the robot as text: in files, in messages and in the manual.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/params.hpp"

namespace whisker {

/// raw = SI value * numerator / denominator.
struct ParamUnit {
  const char* symbol;
  double numerator;
  double denominator;
};

constexpr ParamUnit unit_of(const Length&) { return {"m", 1e6, 1}; }
constexpr ParamUnit unit_of(const Speed&) { return {"m/s", 1e6, 1}; }
constexpr ParamUnit unit_of(const Acceleration&) { return {"m/s^2", 1e6, 1}; }
constexpr ParamUnit unit_of(const AngularRate&) { return {"rad/s", 1e6, 1}; }
constexpr ParamUnit unit_of(const Duration&) { return {"s", 1e3, 1}; }
constexpr ParamUnit unit_of(const Ratio&) { return {"ratio", 1e6, 1}; }
constexpr ParamUnit unit_of(const Angle&) { return {"deg", 4294967296.0, 360}; }
constexpr ParamUnit unit_of(const Direction&) { return {"deg", 4294967296.0, 360}; }

/// The words of a choice between "false" and "true": a boolean in a file.
bool is_boolean(const char* const* names, int count);
/// The word of a choice as in a file: quoted unless it is a boolean.
std::string choice_text(const char* word, bool boolean);

/// To nearest. |si| <= 1e9.
std::int64_t to_raw(double si, ParamUnit unit);
/// Sets a parameter to an SI value, or degrees, rounded to its unit. The value must lie within its range.
template <class T>
void set_si(T& field, double si) {
  field = T::from_raw(static_cast<std::int32_t>(to_raw(si, unit_of(field))));
}
inline void set_si(Angle& field, double deg) {
  field = Angle::from_raw(static_cast<std::uint32_t>(to_raw(deg, unit_of(field))));
}
/// The shortest decimal that to_raw() converts back to the same raw value.
std::string si_text(std::int64_t raw, ParamUnit unit);

/// The keys of the parameters, in the order of for_each_param.
std::vector<std::string_view> robot_keys();
/// The keys of former parameters that the robot derives now.
std::vector<std::string_view> derived_keys();
/// What to say where one of them is set.
std::string derived_words(std::string_view key);
/// Both: the keys that a [robot] table may have.
std::vector<std::string_view> keys_in_files();

/// `key = value` lines for the parameters that differ from the reference robot's.
std::string robot_toml(const Params& params);

/// What robot_keys() says of a parameter: the robot's owner must set it, or may tune it.
bool must_set(std::string_view key);

/// The tables of docs/parameters.md: what must be set, what may be tuned, what is derived.
std::string params_markdown();

}  // namespace whisker
