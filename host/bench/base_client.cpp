#include "host/bench/base_client.hpp"

#include <utility>

namespace whisker::bench {
namespace {

constexpr std::uint64_t kNoRules_us = 500000;
constexpr std::int16_t kRamp = 1;  // the wheels of this base never turn

}  // namespace

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
