#include "host/harness/scenario/sensor_text.hpp"

#include <fmt/format.h>

#include "host/harness/scenario/sensor_models.hpp"
#include "host/harness/scenario/text.hpp"

namespace whisker {
namespace {

struct Key {
  const char* name;
  Limits limits;
  double Sensor::*number;
  std::optional<double> Sensor::*maybe;  // if it has no number
  const char* comment;                   // in a written file
};

constexpr Key key(const char* name, Limits limits, double Sensor::*number, const char* comment = "") {
  return {name, limits, number, nullptr, comment};
}
constexpr Key key(const char* name, Limits limits, std::optional<double> Sensor::*maybe,
                  const char* comment = "") {
  return {name, limits, nullptr, maybe, comment};
}

constexpr Key kKeys[] = {
    key("incidence_deg", kIncidence, &Sensor::incidence_deg,
        "surfaces farther from their normal give no echo"),
    key("cone_deg", kTrueCone, &Sensor::cone_deg, "the true full width"),
    key("cone_far_deg", kTrueCone, &Sensor::cone_far_deg, "the same at the maximum range"),
    key("corner_scatter_m", kTrueLength, &Sensor::corner_scatter_m, "up to it, corners echo at any angle"),
    key("min_range_m", kTrueMinRange, &Sensor::min_range_m, "nearer is near_is"),
    key("max_range_m", kTrueMaxRange, &Sensor::max_range_m, "farther is clear"),
    key("sigma_m", kRangeSigma, &Sensor::sigma_m, "standard deviation of a range"),
    key("sigma_share", kProbability, &Sensor::sigma_share, "the same, of the distance"),
    key("soft", kProbability, &Sensor::soft, "share of the obstacles that absorb"),
    key("soft_range_m", kTrueLength, &Sensor::soft_range_m, "farther, these give no echo"),
    key("reflectance", kProbability, &Sensor::reflectance, "of all targets"),
    key("reflectance_reference", kProbability, &Sensor::reflectance_reference,
        "from which max_range_m holds"),
    key("ambient_klux", kAmbient, &Sensor::ambient_klux, "light on sensor and targets"),
    key("ambient_knee_klux", kAmbient, &Sensor::ambient_knee_klux, "doubles the noise power of the dark"),
    key("cover_glass_probability", kProbability, &Sensor::cover_glass_probability,
        "clear readings that become an echo of the cover"),
    key("cover_glass_m", kCoverGlass, &Sensor::cover_glass_m, "at this distance"),
    key("skew_deg", kSkew, &Sensor::skew_deg, "of the side beams, outward"),
    key("scale", kRangeScale, &Sensor::scale, "of every distance"),
    key("phantom", kProbability, &Sensor::phantom, "clear readings that become echoes"),
    key("crosstalk", kProbability, &Sensor::crosstalk, "readings that may be a neighbouring beam's"),
};

/// A key whose value is one of two words, in the order of the enumeration.
struct Choice {
  const char* key;
  const char* words[2];
  const char* comment;
};
constexpr Choice kLost{"lost_is", {"clear", "invalid"}, "what is too dark"};
constexpr Choice kNear{"near_is", {"too_near", "farther"}, "what is nearer than min_range_m"};
constexpr Choice kFar{"far_is", {"clear", "distance"}, "what is beyond the robot's range_max_m"};

void read_model(const TableReader& table, Sensor& s) {
  const std::string name = table.text("model");
  const SensorModel* model = find_sensor_model(name);
  if (model == nullptr) {
    const std::vector<std::string_view> names = sensor_model_names();
    const std::string_view near = nearest_word(lower_case(name), names);
    table.fail_at("model", fmt::format("unknown sensor model '{}'; {}", name,
                                       near.empty() ? "it must be " + join_or(names)
                                                    : fmt::format("did you mean '{}'?", near)));
  }
  apply(*model, s);
}

template <class E>
void read_choice(const TableReader& table, const Choice& choice, E& value) {
  if (!table.has(choice.key)) return;
  const std::string word = table.text(choice.key);
  const bool second = word == choice.words[1];
  if (!second && word != choice.words[0]) {
    table.fail_at(choice.key, fmt::format("'{}' must be {} or {}, but is '{}'", choice.key, choice.words[0],
                                          choice.words[1], word));
  }
  value = static_cast<E>(second ? 1 : 0);
}

/// A key that is set alone may narrow a cone whose far width comes from elsewhere.
void check_cone(const TableReader& table, Sensor& s) {
  if (!s.cone_deg || !s.cone_far_deg || *s.cone_far_deg <= *s.cone_deg) return;
  if (table.has("cone_far_deg")) {
    table.fail_at("cone_far_deg", fmt::format("'cone_far_deg' must be at most cone_deg = {}, but is {}",
                                              *s.cone_deg, *s.cone_far_deg));
  }
  s.cone_far_deg = s.cone_deg;
}

void check_ranges(const TableReader& table, const Sensor& s) {
  if (s.min_range_m && s.max_range_m && *s.min_range_m >= *s.max_range_m) {
    const char* set = table.has("min_range_m") ? "min_range_m" : "max_range_m";
    if (table.has(set)) {
      table.fail_at(set, fmt::format("'min_range_m' must be below 'max_range_m', but {} is not below {}",
                                     *s.min_range_m, *s.max_range_m));
    }
  }
}

std::string line(std::string_view name, const std::string& value, std::string_view comment) {
  return fmt::format("{} = {}  # {}\n", name, value, comment);
}

}  // namespace

std::vector<std::string_view> sensor_keys() {
  std::vector<std::string_view> names = {"model", kLost.key, kNear.key, kFar.key};
  for (const Key& k : kKeys) names.emplace_back(k.name);
  return names;
}

void read_sensor(const TableReader& table, Sensor& s) {
  if (table.has("model")) read_model(table, s);
  for (const Key& k : kKeys) {
    if (!table.has(k.name)) continue;
    const double x = table.number(k.name, k.limits);
    if (k.number != nullptr) {
      s.*k.number = x;
    } else {
      s.*k.maybe = x;
    }
  }
  read_choice(table, kLost, s.lost_is);
  read_choice(table, kNear, s.near_is);
  read_choice(table, kFar, s.far_is);
  check_cone(table, s);
  check_ranges(table, s);
}

std::string sensor_toml(const Sensor& s) {
  Sensor usual;
  const SensorModel* model = find_sensor_model(s.model);
  if (model != nullptr) apply(*model, usual);
  std::string out = model != nullptr ? fmt::format("model = {}\n", toml_string(model->name)) : "";
  for (const Key& k : kKeys) {
    if (k.number != nullptr && s.*k.number != usual.*k.number) {
      out += line(k.name, toml_number(s.*k.number), k.comment);
    } else if (k.number == nullptr && s.*k.maybe && s.*k.maybe != usual.*k.maybe) {
      out += line(k.name, toml_number(*(s.*k.maybe)), k.comment);
    }
  }
  const auto add = [&out](const Choice& choice, int value, int usual_value) {
    if (value == usual_value) return;
    out += line(choice.key, toml_string(choice.words[value]), choice.comment);
  };
  add(kLost, static_cast<int>(s.lost_is), static_cast<int>(usual.lost_is));
  add(kNear, static_cast<int>(s.near_is), static_cast<int>(usual.near_is));
  add(kFar, static_cast<int>(s.far_is), static_cast<int>(usual.far_is));
  return out.empty() ? out : "\n[sensor]  # what the rangefinders really do\n" + out;
}

}  // namespace whisker
