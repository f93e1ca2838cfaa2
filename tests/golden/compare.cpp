#include "tests/golden/compare.hpp"

#include <cstddef>
#include <sstream>
#include <stdexcept>

#include <fmt/core.h>

#include "firmware/apps/pil_link/params.hpp"

namespace whisker::golden {
namespace {

/// The fields of a message as text and number.
class Lister {
 public:
  template <class T>
  void operator()(const char* name, const T& value) {
    names.emplace_back(name);
    values.push_back(static_cast<std::int64_t>(value));
  }
  std::vector<std::string> names;
  std::vector<std::int64_t> values;
};

template <class M>
Lister listed(const M& message) {
  Lister lister;
  M::each(message, lister);
  return lister;
}

/// "turn is 5, not 6" for the first field that differs; "" if none does.
template <class M>
std::string difference(const M& expected, const M& answered) {
  const Lister want = listed(expected);
  const Lister got = listed(answered);
  for (std::size_t i = 0; i < want.names.size(); ++i) {
    if (want.values[i] != got.values[i]) {
      return fmt::format("{} is {}, not {}", want.names[i], got.values[i], want.values[i]);
    }
  }
  return "";
}

std::size_t body_size(link::Name name) {
  switch (name) {
    case link::Name::hello:
    case link::Name::cancel:
    case link::Name::reset:
    case link::Name::end: return 0;
    case link::Name::params: return link::kParamsSize;
    case link::Name::begin: return link::size_of<link::Begin>();
    case link::Name::goal: return link::size_of<link::Target>();
    case link::Name::place: return link::size_of<link::Stand>();
    case link::Name::gyro: return link::size_of<link::GyroSums>();
    case link::Name::fix: return link::size_of<link::Fix>();
    case link::Name::tick: return link::size_of<link::Tick>();
    case link::Name::fuzzy: return link::size_of<link::Probe>();
  }
  throw std::runtime_error("not a recording");
}

class Judge {
 public:
  Judge(const chip::Bytes& expected, const chip::Bytes& answered)
      : expected_(expected), answered_(answered) {}

  Judgement result;

  void begin(const std::string& stream) {
    result.costs.push_back({stream, 0, 0, 0});
    step_ = 0;
  }
  /// False at the end.
  bool hear(link::Name name) {
    switch (name) {
      case link::Name::hello: return greeting();
      case link::Name::fuzzy: return compare<link::Reaction>(fmt::format("probe {}", step_++));
      case link::Name::fix: return compare<link::Verdict>(fmt::format("fix before tick {}", step_));
      case link::Name::tick: return tick();
      case link::Name::end: return end();
      default: return true;
    }
  }

 private:
  template <class M>
  bool next(M& expected, M& answered, const std::string& place) {
    const std::size_t size = link::size_of<M>();
    if (at_ + size > expected_.size()) throw std::runtime_error("the expected answers end too soon");
    if (at_ + size > answered_.size()) return differ(place, "no answer");
    expected = link::decode<M>(expected_.data() + at_);
    answered = link::decode<M>(answered_.data() + at_);
    at_ += size;
    return true;
  }
  bool greeting() {
    link::Greeting expected, answered;
    if (!next(expected, answered, "greeting")) return false;
    expected.most_map_bytes = answered.most_map_bytes;
    return differ("greeting", difference(expected, answered));
  }
  template <class M>
  bool compare(const std::string& place) {
    M expected, answered;
    if (!next(expected, answered, place)) return false;
    return differ(place, difference(expected, answered));
  }
  bool tick() {
    link::Answer expected, answered;
    const std::string place = fmt::format("tick {}", step_++);
    if (!next(expected, answered, place)) return false;
    Cost& cost = result.costs.back();
    ++cost.ticks;
    cost.work += answered.work;
    if (answered.work > cost.worst) cost.worst = answered.work;
    expected.work = answered.work;
    return differ(place, difference(expected, answered));
  }
  bool end() {
    link::Total expected;
    if (!next(expected, result.total, "end")) return false;
    expected.stack = result.total.stack;
    return differ("end", difference(expected, result.total));
  }
  bool differ(const std::string& place, const std::string& what) {
    if (what.empty()) return true;
    const std::string stream = result.costs.empty() ? "" : result.costs.back().name + ", ";
    result.difference = stream + place + ": " + what;
    return false;
  }

  const chip::Bytes& expected_;
  const chip::Bytes& answered_;
  std::size_t at_ = 0;
  int step_ = 0;
};

}  // namespace

Judgement judge(const chip::Bytes& recorded, const std::string& index, const chip::Bytes& expected,
                const chip::Bytes& answered) {
  Judge judge(expected, answered);
  std::istringstream lines(index);
  std::size_t next_stream = 0;
  std::string next_name;
  const auto read_line = [&] {
    if (!(lines >> next_stream) || !std::getline(lines >> std::ws, next_name)) next_stream = recorded.size();
  };
  read_line();
  for (std::size_t at = 0; at < recorded.size();) {
    if (at == next_stream) {
      judge.begin(next_name);
      read_line();
    }
    const auto name = static_cast<link::Name>(recorded[at]);
    at += 1 + body_size(name);
    if (!judge.hear(name)) break;
  }
  return judge.result;
}

}  // namespace whisker::golden
