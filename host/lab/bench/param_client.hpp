/// The parameters of a controller on a bus.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "firmware/can/param_server.hpp"
#include "firmware/can/rules_sender.hpp"
#include "host/harness/hil/clock.hpp"

namespace whisker::bench {

/// The controller did not answer in time, or cannot answer; what() is the reason in one line.
class NoAnswer : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The caller was requested to stop.
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Patience {
  std::uint32_t ms = 3000;            ///< for each answer
  std::function<bool()> interrupted;  ///< true: give up; may be empty
};

/// Reads and writes the parameters of a controller. Port and clock must outlive it. Every call throws
/// NoAnswer and Interrupted.
class ParamClient {
 public:
  ParamClient(hil::Clock& clock, Patience patience) : clock_(clock), patience_(std::move(patience)) {}
  virtual ~ParamClient() = default;
  ParamClient(const ParamClient&) = delete;
  ParamClient& operator=(const ParamClient&) = delete;

  /// Waits until the controller listens.
  virtual void connect() = 0;
  /// Clears the goal.
  virtual void cancel() = 0;
  /// The staged value; none: the controller has no parameter with this index.
  std::optional<std::uint32_t> read(std::uint8_t index);
  /// Stages a value.
  can::ParamStatus write(std::uint8_t index, std::uint32_t raw);
  /// status: ok or busy, or inconsistent with the violated relation in `value`.
  can::ParamReply commit();

  // For hil::ParamQuestion.
  virtual void request(const can::ParamRequest& request) = 0;
  virtual bool replied(can::ParamReply& reply) const = 0;

 protected:
  static constexpr std::uint64_t kAskAgain_us = 50000;

  /// Takes what has come, and sends. Throws NoAnswer if an answer cannot come any more.
  virtual void poll() = 0;
  /// Polls until `done`; awaited: for the message of NoAnswer.
  void wait_until(const std::function<bool()>& done, const std::string& awaited);
  hil::Clock& clock() { return clock_; }
  std::uint32_t patience_ms() const { return patience_.ms; }

 private:
  can::ParamReply ask(const can::ParamRequest& request,
                      const std::function<bool(const can::ParamReply&)>& answers);

  hil::Clock& clock_;
  const Patience patience_;
};

struct Change {
  std::uint8_t index;
  std::uint32_t before;
  std::uint32_t after;
};

/// Outcome of write_all.
struct Written {
  bool committed = false;
  std::optional<std::uint8_t> refused;  ///< index of the refused parameter, if it was one
  can::ParamStatus status = can::ParamStatus::ok;
  std::uint32_t relation = 0;  ///< number of the violated relation, if inconsistent
};

/// Stages all changes, commits them, and reads them back. If the controller refuses, the earlier values are
/// staged again, and nothing has changed. If it stops to answer, NoAnswer says which changes were staged:
/// name_of(index).
Written write_all(ParamClient& client, const std::vector<Change>& changes,
                  const std::function<std::string(std::uint8_t)>& name_of);

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
