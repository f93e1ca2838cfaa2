#include "tests/golden/compare.hpp"

#include <cstddef>
#include <sstream>
#include <stdexcept>

#include <fmt/core.h>

#include "firmware/params/words.hpp"

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

std::size_t body_size(Name name) {
  switch (name) {
    case Name::cancel:
    case Name::reset:
    case Name::end: return 0;
    case Name::params: return kParams * size_of<Word>();
    case Name::begin: return size_of<Begin>();
    case Name::goal: return size_of<Target>();
    case Name::place: return size_of<Stand>();
    case Name::fix: return size_of<Fix>();
    case Name::tick: return size_of<Tick>();
    case Name::fuzzy: return size_of<Probe>();
  }
  throw std::runtime_error("not a recording");
}

class Judge {
 public:
  Judge(const Bytes& expected, const Bytes& answered) : expected_(expected), answered_(answered) {}

  Judgement result;

  void begin(const std::string& stream) {
    result.costs.push_back({stream, 0, 0, 0});
    step_ = 0;
  }
  /// False at the end.
  bool hear(Name name) {
    switch (name) {
      case Name::fuzzy: return compare<Reaction>(fmt::format("probe {}", step_++));
      case Name::tick: return tick();
      case Name::end: return end();
      default: return true;
    }
  }

 private:
  template <class M>
  bool next(M& expected, M& answered, const std::string& place) {
    const std::size_t size = size_of<M>();
    if (at_ + size > expected_.size()) throw std::runtime_error("the expected answers end too soon");
    if (at_ + size > answered_.size()) return differ(place, "no answer");
    expected = decode<M>(expected_.data() + at_);
    answered = decode<M>(answered_.data() + at_);
    at_ += size;
    return true;
  }
  template <class M>
  bool compare(const std::string& place) {
    M expected, answered;
    if (!next(expected, answered, place)) return false;
    return differ(place, difference(expected, answered));
  }
  bool tick() {
    Answer expected, answered;
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
    Total expected;
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

  const Bytes& expected_;
  const Bytes& answered_;
  std::size_t at_ = 0;
  int step_ = 0;
};

}  // namespace

Judgement judge(const Bytes& recorded, const std::string& index, const Bytes& expected,
                const Bytes& answered) {
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
    const auto name = static_cast<Name>(recorded[at]);
    at += 1 + body_size(name);
    if (!judge.hear(name)) break;
  }
  return judge.result;
}

}  // namespace whisker::golden
