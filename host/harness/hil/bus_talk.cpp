#include "host/harness/hil/bus_talk.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "firmware/can/param_server.hpp"
#include "firmware/can/rules_sender.hpp"
#include "host/harness/hil/error_names.hpp"
#include "host/harness/hil/param_question.hpp"

namespace whisker::hil {
namespace {

constexpr std::uint64_t kAskAgain_us = 200000;
constexpr std::uint64_t kNoRules_us = 1000000;
constexpr int kMostDamaged = 3;

}  // namespace

void BusTalk::nap() {
  node_.poll(clock_.now_ms());
  clock_.wait_a_ms();
  node_.poll(clock_.now_ms());
}

void BusTalk::watchful_nap() {
  nap();
  check();
}

void BusTalk::ask_for(const char* answer) {
  awaited_ = answer;
  asked_us_ = clock_.now_us();
}

/// A missing controller may return; a controller that is present but silent will not answer.
void BusTalk::watch_patience() {
  const std::uint64_t now_us = clock_.now_us();
  const bool e_stopped =
      node_.state() == can::NodeState::e_stopped || node_.peer().state == can::NodeState::e_stopped;
  if (!node_.matched() || e_stopped) asked_us_ = now_us;
  if (now_us - asked_us_ <= std::uint64_t{options_.patience_ms} * 1000) return;
  throw NoAnswer(fmt::format("the controller sends no {} for {} ms", awaited_, options_.patience_ms));
}

void BusTalk::check() {
  if (options_.interrupted && options_.interrupted()) throw Interrupted("interrupted");
  if (node_.permanent_errors() != 0) throw Hopeless();
  if (restarts_ && node_.peer_restarts() != *restarts_) throw ControllerRestarted("the controller restarted");
  explain();
}

void BusTalk::explain() {
  std::string now = waits_for(node_, options_);
  if (said_ == now) return;
  said_ = std::move(now);
  if (options_.say) options_.say(said_);
}

void BusTalk::make_it_drive_with(std::uint32_t wanted, const can::RulesServer::Table* table) {
  const bool sends = table != nullptr;
  // A controller without a table never names one.
  ask_info_until("Info with its rules", [&] {
    return node_.peer_rules() != 0 || (sends && clock_.now_us() - asked_us_ >= kNoRules_us);
  });
  const std::uint32_t had = node_.peer_rules();
  if (had == wanted) return;
  if (!sends || !send_rules(wanted, table)) refuse_rules(had, wanted);
  ask_info_until("Info with the table that it activated", [&] { return node_.peer_rules() == wanted; });
}

template <class F>
void BusTalk::ask_info_until(const char* answer, const F& done) {
  ask_for(answer);
  std::uint64_t again_us = asked_us_;
  while (!done()) {
    if (clock_.now_us() >= again_us) {
      node_.ask_for_info();
      again_us = clock_.now_us() + kAskAgain_us;
    }
    watchful_nap();
    watch_patience();
  }
}

/// Repeats while the robot still moves. False: the controller takes no table.
bool BusTalk::send_rules(std::uint32_t wanted, const can::RulesServer::Table* table) {
  if (options_.say) options_.say(fmt::format("sends the response table {:08x}", wanted));
  ask_for("RulesReply that activates");
  int damaged = 0;
  for (std::uint8_t upload = 1;; ++upload) {
    const can::RulesStatus status = send_rules_once(upload, table);
    if (status == can::RulesStatus::activated) return true;
    if (status == can::RulesStatus::unsupported) return false;
    if (status == can::RulesStatus::wrong_hash && ++damaged == kMostDamaged) {
      throw NoAnswer("the controller says wrong_hash: the response table arrives damaged");
    }
    for (std::uint32_t waited = 0; waited < can::kRulesRepeat_ms; ++waited) watchful_nap();
    watch_patience();
  }
}

can::RulesStatus BusTalk::send_rules_once(std::uint8_t upload, const can::RulesServer::Table* table) {
  can::RulesSender sender(node_, table, upload);
  for (std::uint16_t had = 0; !sender.ended(); had = sender.reply().next) {
    sender.poll(clock_.now_ms());
    watchful_nap();
    if (sender.reply().next > had) ask_for("RulesReply that activates");
    watch_patience();
  }
  return sender.reply().status;
}

void BusTalk::give(can::Order order, const can::Mission& mission) {
  ask_for("MissionReply that accepts");
  do {
    node_.give(order, mission, options_.sync_mode);
    while (node_.order_state() == can::OrderState::waiting) {
      watchful_nap();
      watch_patience();
    }
    refuse_calibration(node_, order);
  } while (node_.order_state() == can::OrderState::refused);
}

void BusTalk::hand_over(const Params& params) {
  can::each_param(params, [this](std::uint8_t index, std::uint32_t raw) {
    ask({can::ParamAction::write, index, raw});
  });
  ask({can::ParamAction::commit, can::kCommitIndex, 0});
}

void BusTalk::ask(const can::ParamRequest& request) {
  ParamQuestion question(request, std::uint64_t{options_.resend_ms} * 1000);
  ask_for("ParamReply");
  const auto answers = [](const can::ParamReply& r) { return r.status != can::ParamStatus::busy; };
  while (!question.poll(node_, clock_.now_us(), answers)) {
    watchful_nap();
    watch_patience();
  }
  if (question.reply().status != can::ParamStatus::ok)
    throw std::runtime_error("the controller refuses a parameter");
}

}  // namespace whisker::hil
