#include "host/bench/param_client.hpp"

#include <fmt/format.h>

#include "host/hil/param_question.hpp"

namespace whisker::bench {

void ParamClient::wait_until(const std::function<bool()>& done, const std::string& awaited) {
  const std::uint64_t end_us = clock_.now_us() + std::uint64_t{patience_.ms} * 1000;
  for (;;) {
    poll();
    if (done()) return;
    if (patience_.interrupted && patience_.interrupted()) throw Interrupted("interrupted");
    if (clock_.now_us() >= end_us) {
      throw NoAnswer(fmt::format("the controller sends no {} for {} ms", awaited, patience_.ms));
    }
    clock_.wait_a_ms();
  }
}

can::ParamReply ParamClient::ask(const can::ParamRequest& request,
                                 const std::function<bool(const can::ParamReply&)>& answers) {
  hil::ParamQuestion question(request, kAskAgain_us);
  wait_until([&] { return question.poll(*this, clock_.now_us(), answers); }, "ParamReply");
  return question.reply();
}

// A repeated request may have a second answer, which arrives during the next request for the same index.
std::optional<std::uint32_t> ParamClient::read(std::uint8_t index) {
  const can::ParamReply reply = ask({can::ParamAction::read, index, 0}, [](const can::ParamReply& r) {
    return r.status == can::ParamStatus::ok || r.status == can::ParamStatus::no_such;
  });
  if (reply.status == can::ParamStatus::no_such) return std::nullopt;
  return reply.value;
}

can::ParamStatus ParamClient::write(std::uint8_t index, std::uint32_t raw) {
  return ask({can::ParamAction::write, index, raw},
             [raw](const can::ParamReply& r) { return r.status != can::ParamStatus::ok || r.value == raw; })
      .status;
}

can::ParamReply ParamClient::commit() {
  return ask({can::ParamAction::commit, can::kCommitIndex, 0}, [](const can::ParamReply&) { return true; });
}

Written write_all(ParamClient& client, const std::vector<Change>& changes,
                  const std::function<std::string(std::uint8_t)>& name_of) {
  Written result;
  std::size_t staged = 0;
  const auto names = [&](std::size_t from, std::size_t to) {
    std::string all;
    for (std::size_t i = from; i < to; ++i) all += (all.empty() ? "" : ", ") + name_of(changes[i].index);
    return all.empty() ? std::string("none") : all;
  };
  try {
    while (staged < changes.size() && !result.refused) {
      const Change& change = changes[staged];
      result.status = client.write(change.index, change.after);
      if (result.status == can::ParamStatus::ok) {
        ++staged;
      } else {
        result.refused = change.index;
      }
    }
    if (!result.refused) {
      const can::ParamReply reply = client.commit();
      result.status = reply.status;
      result.committed = reply.status == can::ParamStatus::ok;
      if (reply.status == can::ParamStatus::inconsistent) result.relation = reply.value;
    }
    if (!result.committed) {
      for (; staged > 0; --staged) client.write(changes[staged - 1].index, changes[staged - 1].before);
      return result;
    }
  } catch (const NoAnswer& e) {
    throw NoAnswer(fmt::format("{}; staged, not in effect: {}; not confirmed: {}", e.what(), names(0, staged),
                               names(staged, changes.size())));
  }
  for (const Change& change : changes) {
    if (client.read(change.index) != change.after) {
      throw NoAnswer(fmt::format("{} reads back differently", name_of(change.index)));
    }
  }
  return result;
}

}  // namespace whisker::bench
