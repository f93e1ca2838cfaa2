#include "host/lab/bench/param_client.hpp"

#include <utility>

#include <fmt/format.h>

#include "host/harness/hil/param_question.hpp"

namespace whisker::bench {
namespace {

constexpr std::uint64_t kNoRules_us = 500000;
constexpr std::int16_t kRamp = 1;  // the wheels of this base never turn

}  // namespace

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

BaseClient::BaseClient(hal::CanPort& port, hil::Clock& clock, const can::Identity& identity,
                       Patience patience)
    : ParamClient(clock, std::move(patience)), node_(port, identity, kRamp) {}

void BaseClient::poll() {
  node_.poll(clock().now_ms());
  if ((node_.permanent_errors() & can::Error::duplicate_node) != 0) {
    throw NoAnswer("another base of this robot came onto the bus (duplicate_node): restart it");
  }
}

void BaseClient::request(const can::ParamRequest& request) {
  node_.request(request);
  node_.poll(clock().now_ms());
}

void BaseClient::connect() {
  const auto matched = [&] {
    if ((node_.errors() & can::Error::wrong_version) != 0) {
      throw NoAnswer("the controller speaks another protocol or table (wrong_version)");
    }
    return node_.matched();
  };
  wait_until(matched, "Info with its table");
}

void BaseClient::cancel() {
  node_.give(can::Order::cancel, {{}, {{}, millimetres(1)}}, can::SyncMode::real_time);
  wait_until([&] { return node_.order_state() != can::OrderState::waiting; }, "MissionReply");
  if (node_.order_state() == can::OrderState::refused) throw NoAnswer("the controller refuses the cancel");
}

std::optional<std::uint32_t> BaseClient::rules() {
  const std::uint64_t begun_us = clock().now_us();
  std::uint64_t asked_us = begun_us;
  node_.ask_for_info();
  const auto named = [&] {
    if (node_.peer_rules() != 0) return true;
    const std::uint64_t now_us = clock().now_us();
    if (now_us - asked_us >= kAskAgain_us) {
      node_.ask_for_info();
      asked_us = now_us;
    }
    return now_us - begun_us >= kNoRules_us;
  };
  wait_until(named, "Info");
  // A controller that is held up has sent its Info before the second reply.
  for (int i = 0; i < 2 && node_.peer_rules() == 0; ++i) read(0);
  if (node_.peer_rules() == 0) return std::nullopt;
  return node_.peer_rules();
}

can::RulesReply BaseClient::send_rules(const can::RulesSender::Table* table) {
  can::RulesSender sender(node_, table, ++upload_);
  std::uint16_t had = 0;
  while (!sender.ended()) {
    const auto goes_on = [&] {
      sender.poll(clock().now_ms());
      return sender.ended() || sender.reply().next != had;
    };
    wait_until(goes_on, "RulesReply");
    had = sender.reply().next;
  }
  return sender.reply();
}

}  // namespace whisker::bench
