#include "host/cli/provenance.hpp"

#include <string_view>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "host/harness/scenario/param_list.hpp"

namespace whisker::cli {
namespace {

using Json = nlohmann::ordered_json;

class Fnv1a64 {
 public:
  void add(std::string_view text) {
    for (const char c : text) add_byte(static_cast<unsigned char>(c));
    add_byte(0);
  }
  void add(std::int64_t number) {
    auto bits = static_cast<std::uint64_t>(number);
    for (int i = 0; i < 8; ++i, bits >>= 8) add_byte(static_cast<unsigned char>(bits & 0xFF));
  }
  std::uint64_t value() const { return value_; }

 private:
  void add_byte(unsigned char byte) { value_ = (value_ ^ byte) * UINT64_C(0x100000001B3); }
  std::uint64_t value_ = UINT64_C(0xCBF29CE484222325);
};

template <class T>
Json or_null(const std::optional<T>& x) {
  return x ? Json(*x) : Json(nullptr);
}

}  // namespace

std::string robot_digest(const Params& params) {
  Fnv1a64 hash;
  for (const ParamEntry& e : param_list(params)) {
    hash.add(e.key);
    hash.add(e.raw);
  }
  return fmt::format("{:016x}", hash.value());
}

std::string robot_name(const Params& params, const std::string& robot_file,
                       const std::string& scenario_file) {
  if (!robot_file.empty()) return robot_file;
  return robot_digest(params) == robot_digest(Params{}) ? "reference" : scenario_file;
}

std::string with_provenance(const std::string& json_object, const Provenance& p) {
  Json json = Json::parse(json_object);
  json["schema"] = kSchema;
  json["version"] = version();
  json["seed"] = or_null(p.seed);
  json["planner"] = or_null(p.planner);
  json["robot_name"] = or_null(p.robot_name);
  json["robot_digest"] = or_null(p.robot_digest);
  json["rules_digest"] = or_null(p.rules_digest);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void print_object(const std::string& json_object, const Provenance& provenance) {
  fmt::print("{}\n", with_provenance(json_object, provenance));
}

}  // namespace whisker::cli
