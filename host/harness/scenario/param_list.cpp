#include "host/harness/scenario/param_list.hpp"

#include <fmt/format.h>

#include <string_view>

namespace whisker {
namespace {

constexpr ParamUnit kPlain{"", 1, 1};

const char* type_of(const Length&) { return "Length"; }
const char* type_of(const Speed&) { return "Speed"; }
const char* type_of(const Acceleration&) { return "Acceleration"; }
const char* type_of(const AngularRate&) { return "AngularRate"; }
const char* type_of(const Duration&) { return "Duration"; }
const char* type_of(const Ratio&) { return "Ratio"; }
const char* type_of(const Angle&) { return "Angle"; }
const char* type_of(const Direction&) { return "Direction"; }

struct Lister {
  std::vector<ParamEntry> all;
  int at = 0;
  template <class T>
  void number(const char* key, const T& x, T low, T high) {
    all.push_back({at++, key, x.raw(), low.raw(), high.raw(), unit_of(x), nullptr, type_of(x)});
  }
  void count(const char* key, const std::int32_t& x, std::int32_t low, std::int32_t high) {
    all.push_back({at++, key, x, low, high, kPlain, nullptr, "int32_t"});
  }
  template <class E>
  void choice(const char* key, const E& x, const char* const* names, int count) {
    const int chosen = static_cast<int>(x);
    all.push_back({at++, key, chosen, 0, count - 1, kPlain, names[chosen], "", is_boolean(names, count)});
  }
  void derived(const char*) { ++at; }
};

struct RawSetter {
  std::size_t place;
  std::int64_t raw;
  std::size_t at = 0;
  template <class Tag>
  void number(const char*, Unit<Tag>& x, Unit<Tag>, Unit<Tag>) {
    if (at++ == place) x = Unit<Tag>::from_raw(static_cast<std::int32_t>(raw));
  }
  void number(const char*, Angle& x, Angle, Angle) {
    if (at++ == place) x = Angle::from_raw(static_cast<std::uint32_t>(raw));
  }
  void count(const char*, std::int32_t& x, std::int32_t, std::int32_t) {
    if (at++ == place) x = static_cast<std::int32_t>(raw);
  }
  template <class E>
  void choice(const char*, E& x, const char* const*, int) {
    if (at++ == place) x = static_cast<E>(raw);
  }
  void derived(const char*) {}
};

}  // namespace

bool ParamEntry::of_one_beam() const {
  const std::string_view name = key;
  return name.find("_left_") != name.npos || name.find("_front_") != name.npos ||
         name.find("_right_") != name.npos;
}

std::string ParamEntry::text_of(std::int64_t other) const { return si_text(other, unit); }

std::string ParamEntry::text() const { return word != nullptr ? choice_text(word, boolean) : text_of(raw); }

std::vector<ParamEntry> param_list(const Params& params) {
  Lister lister;
  for_each_param(params, lister);
  return lister.all;
}

void set_param(Params& params, std::size_t place, std::int64_t raw) {
  RawSetter setter{place, raw};
  for_each_param(params, setter);
}

}  // namespace whisker
