/// The messages of messages.hpp as a table, made at compile time.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/can/messages.hpp"

namespace whisker::can {
namespace table {

struct Counter {
  int signals = 0;
  template <class T>
  constexpr void operator()(const Signal&, const T&) noexcept {
    ++signals;
  }
};

struct Collector {
  Signal* to;
  template <class T>
  constexpr void operator()(const Signal& signal, const T&) noexcept {
    *to++ = signal;
  }
};

template <class M>
constexpr auto more(int) noexcept -> decltype(sizeof M::kMore) {
  return sizeof M::kMore / sizeof(Signal);
}
template <class M>
constexpr size_t more(long) noexcept {
  return 0;
}

template <class M>
constexpr size_t count_of() noexcept {
  const M message{};
  Counter counter;
  M::each(message, counter);
  return static_cast<size_t>(counter.signals) + more<M>(0);
}

template <class M>
struct Signals {
  Signal of[count_of<M>()];
};

template <class M>
constexpr Signals<M> signals_of() noexcept {
  Signals<M> signals{};
  const M message{};
  Collector collector{signals.of};
  M::each(message, collector);
  if constexpr (more<M>(0) > 0) {
    for (const Signal& signal : M::kMore) *collector.to++ = signal;
  }
  return signals;
}

/// The signals of a message, in the table's order.
template <class M>
inline constexpr Signals<M> kSignals = signals_of<M>();

constexpr int count_messages() noexcept {
  int count = 0;
  for_each_message([&](const Message&, const auto&) { ++count; });
  return count;
}

}  // namespace table

constexpr int kKinds = table::count_messages();

struct Messages {
  Message of[kKinds];
  bool in_order = true;
};

constexpr Messages messages() noexcept {
  Messages all{};
  int at = 0;
  for_each_message([&](const Message& row, auto message) {
    using M = decltype(message);
    all.of[at] = row;
    all.of[at].signals = table::kSignals<M>.of;
    all.of[at].count = static_cast<uint8_t>(table::count_of<M>());
    all.in_order = all.in_order && static_cast<int>(M::kKind) == at;
    ++at;
  });
  return all;
}

inline constexpr Messages kTable = messages();
static_assert(kTable.in_order, "the table has the order of MessageKind");
inline constexpr const Message (&kMessages)[kKinds] = kTable.of;

constexpr const Message& message_of(MessageKind kind) noexcept {
  return kMessages[static_cast<uint8_t>(kind)];
}

}  // namespace whisker::can
