/// The controller node on models of its chip, a CAN bus, and a base with a simulated robot.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "firmware/apps/can/base.hpp"
#include "firmware/apps/can/keeping_controller.hpp"
#include "firmware/can/rules_sender.hpp"
#include "hal/boards/stm32f405/node_board.hpp"
#include "host/harness/bus/memory_bus.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/sim/sim_board.hpp"
#include "tests/boards/chip_fixture.hpp"
#include "tests/boards/models/flash_model.hpp"

namespace whisker::hal::test {

namespace model = stm32f405::model;
using stm32f405::NodeBoard;

/// The chip from power-on, with what its flash has, and the program.
struct PoweredNode : stm32f405::ModelChip {
  PoweredNode(const model::FlashMemory::Contents& kept, std::uint32_t noise) {
    // Without crystal and PLL, so that the clock is the models' 16 MHz.
    rcc.dead_crystal = rcc.pll_without_lock = true;
    rng.seed(noise);
    if (!kept.empty()) memory.fill(kept);
  }
  void start() {
    board.start();
    boot = board.boot_number();
    program.emplace(board.can(), can::Identity{1, boot, 0}, board.tables(), board.calibration());
    board.watch();
  }
  /// One pass of the program's loop.
  void pass() {
    board.report(program->controller().status());
    if (board.due(1)) program->controller().poll(board.now_ms());
  }
  std::uint32_t now_ms() const { return static_cast<std::uint32_t>(chip.now_us() / 1000); }

  model::FlashMemory memory{chip, stm32f405::FlashStorage::kSize};
  NodeBoard board;
  std::uint16_t boot = 0;
  std::optional<can_app::KeepingController> program;
};

class CanNodeTest : public ::testing::Test {
 protected:
  static constexpr int kEraseOf2s = static_cast<int>(2e6 / model::Chip::kUsPerAccess);

  CanNodeTest() { power_up(); }

  void power_up() {
    model::FlashMemory::Contents kept;
    if (unit) kept = unit->memory.contents();
    unit.reset();
    unit = std::make_unique<PoweredNode>(kept, ++noise_);
    unit->start();
    ahead_ms_ = now_ - unit->now_ms();
  }
  /// Both nodes run. While an erasure holds the chip, nobody takes frames out of its CAN controller.
  template <class Done>
  bool pass(int ms, const Done& done) {
    for (const std::uint32_t end = now_ + static_cast<std::uint32_t>(ms); now_ < end;) {
      while (chip_ms() <= now_) unit->pass();
      for (const CanFrame& frame : unit->can.sent) at_chip_.send(frame, 100);
      unit->can.sent.clear();
      bool interrupt = false;
      const bool stands_still = chip_ms() > now_ + 1;
      while (now_ < chip_ms()) {
        ++now_;
        base.poll(now_);
        if (sender) sender->poll(now_);
        at_chip_.poll(now_);
        base.poll(now_);
        CanFrame frame{};
        while (at_chip_.receive(frame)) {
          interrupt = unit->can.receive(frame) || interrupt;
          if (interrupt && !stands_still) unit->board.on_can_interrupt();
        }
      }
      if (interrupt) unit->board.on_can_interrupt();
      if (done()) return true;
    }
    return false;
  }
  void pass(int ms) {
    pass(ms, [] { return false; });
  }

  void connect() {
    ASSERT_TRUE(pass(500, [this] { return base.matched(); }));
    pass(5);
  }
  /// Null: restores the built-in table.
  can::RulesReply send_table(const fuzzy::Bilinear::Table* table) {
    sender.emplace(base, table, ++upload_);
    EXPECT_TRUE(pass(20000, [this] { return sender->ended(); }));
    const can::RulesReply reply = sender->reply();
    sender.reset();
    return reply;
  }
  std::uint32_t table_of_greeting() {
    base.ask_for_info();
    EXPECT_TRUE(pass(500, [this] { return base.peer_rules() != 0; }));
    return base.peer_rules();
  }
  void send_params(const Params& params) {
    can::each_param(params, [this](std::uint8_t index, std::uint32_t raw) {
      base.request({can::ParamAction::write, index, raw});
      pass(3);
    });
    base.request({can::ParamAction::commit, can::kCommitIndex, 0});
    pass(3);
    can::ParamReply reply;
    EXPECT_TRUE(base.replied(reply) && reply.index == can::kCommitIndex &&
                reply.status == can::ParamStatus::ok);
  }

  bus::MemoryBus wire_;
  bus::MemoryPort& at_chip_ = wire_.attach();
  can::BaseNode base{wire_.attach(), {1, 11, 0}, 100};
  std::optional<can::RulesSender> sender;
  std::unique_ptr<PoweredNode> unit;

 private:
  std::uint32_t chip_ms() const { return unit->now_ms() + ahead_ms_; }

  std::uint32_t now_ = 1000;
  std::uint32_t ahead_ms_ = 0;
  std::uint32_t noise_ = 0;
  std::uint8_t upload_ = 0;
};

}  // namespace whisker::hal::test
