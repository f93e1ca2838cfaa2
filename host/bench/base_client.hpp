/// The bench in the place of a robot's base.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/can/rules_sender.hpp"
#include "host/bench/param_client.hpp"

namespace whisker::bench {

/// A base that only asks. No other base of this robot may be on the bus: both would stop permanently.
class BaseClient final : public ParamClient {
 public:
  BaseClient(hal::CanPort& port, hil::Clock& clock, const can::Identity& identity, Patience patience);

  /// Waits for the handshake.
  void connect() override;
  /// Both nodes stop running.
  void cancel() override;
  /// The hash of the controller's response table; none: it names none in this time.
  std::optional<std::uint32_t> rules();
  /// Sends a response table and activates it; null restores the controller's own. The reply is that of
  /// can::RulesSender.
  can::RulesReply send_rules(const can::RulesSender::Table* table);

  void request(const can::ParamRequest& request) override;
  bool replied(can::ParamReply& reply) const override { return node_.replied(reply); }

 private:
  void poll() override;

  can::BaseNode node_;
  std::uint8_t upload_ = 0;
};

}  // namespace whisker::bench
