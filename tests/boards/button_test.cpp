#include <gtest/gtest.h>

#include <vector>

#include "firmware/calibration/store.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/table_store.hpp"
#include "hal/boards/stm32f405/flash_storage.hpp"
#include "hal/boards/stm32f405/pins.hpp"
#include "hal/boards/stm32f405/push_button.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"
#include "tests/boards/chip_fixture.hpp"
#include "tests/boards/models/flash_model.hpp"

namespace whisker::hal::stm32f405 {
namespace {

/// The driver on the model of the port, asked every millisecond.
class ButtonTest : public ::testing::Test, public ModelChip {
 protected:
  ButtonTest() {
    set_up_pins();
    gpio_c.held_low = [this](std::uint8_t pin) { return closed && pin == wiring::kButton.number; };
  }
  void pass(int ms) {
    for (int i = 0; i < ms; ++i) button.poll(now++);
  }
  void press(int ms) {
    closed = true;
    pass(ms);
    closed = false;
  }

  bool closed = false;
  std::uint32_t now = UINT32_MAX - 500;  // wraps in the middle
  PushButton button;
};

TEST_F(ButtonTest, HasAPinWithAPullUp) {
  EXPECT_EQ(gpio_c.mode(wiring::kButton.number), model::GpioModel::kInput);
  EXPECT_TRUE(gpio_c.pulled_up(wiring::kButton.number));
}

TEST_F(ButtonTest, ReportsABriefPressOnceWhenItIsLetGo) {
  pass(100);
  press(200);
  EXPECT_EQ(button.take(), Press::none) << "still down";
  pass(30);
  EXPECT_EQ(button.take(), Press::brief);
  EXPECT_EQ(button.take(), Press::none);
  pass(1000);
  EXPECT_EQ(button.take(), Press::none);
}

TEST_F(ButtonTest, ReportsAHeldPressOnceAfterASecond) {
  pass(100);
  press(999);
  EXPECT_EQ(button.take(), Press::none);
  press(2);
  EXPECT_EQ(button.take(), Press::held) << "while it is still down";
  press(5000);
  pass(100);
  EXPECT_EQ(button.take(), Press::none);
  press(300);
  pass(30);
  EXPECT_EQ(button.take(), Press::brief) << "the next one";
}

TEST_F(ButtonTest, BouncingContactsAreOnePress) {
  pass(100);
  for (int i = 0; i < 10; ++i) {
    press(3);
    pass(2);
  }
  press(200);
  for (int i = 0; i < 10; ++i) {
    pass(15);
    press(1);
  }
  pass(30);
  EXPECT_EQ(button.take(), Press::brief);
  pass(200);
  EXPECT_EQ(button.take(), Press::none);
}

TEST_F(ButtonTest, AShortDisturbanceIsNoPress) {
  pass(100);
  for (int i = 0; i < 20; ++i) {
    press(40);
    pass(100);
    ASSERT_EQ(button.take(), Press::none) << i;
  }
}

/// Of a short circuit, or of a port that nobody answers for.
TEST_F(ButtonTest, OneThatIsDownAtTheStartIsNoPress) {
  press(5000);
  EXPECT_EQ(button.take(), Press::none);
  pass(100);
  EXPECT_EQ(button.take(), Press::none);
  press(200);
  pass(30);
  EXPECT_EQ(button.take(), Press::brief) << "from now on it counts";
}

class FlashTest : public ::testing::Test {
 protected:
  std::vector<std::uint8_t> read(std::uint8_t slot, std::uint16_t at, std::uint16_t size) {
    std::vector<std::uint8_t> bytes(size);
    EXPECT_TRUE(storage.read(slot, at, bytes.data(), size));
    return bytes;
  }

  model::Chip chip;
  model::FlashMemory memory{chip, FlashStorage::kSize};
  model::FlashModel& flash = memory.model;
  FlashStorage storage{FlashUse::calibration};
};

TEST_F(FlashTest, KeepsWhatIsWrittenInEachSlot) {
  const std::vector<std::uint8_t> bytes{1, 2, 3, 4, 5, 6, 7, 8};
  for (std::uint8_t slot = 0; slot < 2; ++slot) {
    ASSERT_TRUE(storage.erase(slot));
    EXPECT_EQ(flash.erasures[10U + slot], 1);
    ASSERT_TRUE(storage.write(slot, 0, bytes.data(), 8));
    ASSERT_TRUE(storage.write(slot, 8188, bytes.data(), 4));
    EXPECT_EQ(read(slot, 0, 8), bytes);
    EXPECT_EQ(read(slot, 3, 3), (std::vector<std::uint8_t>{4, 5, 6}));
    EXPECT_EQ(read(slot, 8186, 6), (std::vector<std::uint8_t>{0xFF, 0xFF, 1, 2, 3, 4}));
  }
  ASSERT_TRUE(storage.erase(0));
  EXPECT_EQ(read(0, 0, 4), (std::vector<std::uint8_t>{0xFF, 0xFF, 0xFF, 0xFF}));
  EXPECT_EQ(read(1, 0, 8), bytes) << "of the other slot";
  EXPECT_EQ(flash.get(flash::kLock), 1U);
  EXPECT_EQ(flash.get(flash::kDcen), 1U);
}

TEST_F(FlashTest, RefusesWhatLiesOutsideOrBetweenWords) {
  std::uint8_t bytes[8] = {};
  EXPECT_FALSE(storage.erase(2));
  EXPECT_FALSE(storage.read(2, 0, bytes, 1));
  EXPECT_FALSE(storage.read(0, 8190, bytes, 3));
  EXPECT_FALSE(storage.write(0, 8192, bytes, 4));
  EXPECT_FALSE(storage.write(0, 2, bytes, 4));
  EXPECT_FALSE(storage.write(0, 0, bytes, 3));
  EXPECT_EQ(flash.erasures[10] + flash.erasures[11], 0);
}

TEST_F(FlashTest, FailsIfTheFlashRefuses) {
  const std::uint8_t bytes[4] = {};
  flash.write_protected = true;
  EXPECT_FALSE(storage.erase(0));
  EXPECT_FALSE(storage.write(0, 0, bytes, 4));
  flash.write_protected = false;
  EXPECT_TRUE(storage.erase(0)) << "earlier errors are cleared";
  flash.jammed = true;
  EXPECT_FALSE(storage.write(0, 0, bytes, 4));
  EXPECT_EQ(read(0, 0, 1), (std::vector<std::uint8_t>{0xFF}));
}

TEST_F(FlashTest, CalibrationAndAResponseTableComeBack) {
  calibration::Values values, loaded;
  values[calibration::Quantity::track] = {141200, millionths(160)};
  ASSERT_EQ(calibration::Store(storage).save(values), calibration::Stored::ok);
  ASSERT_EQ(calibration::Store(storage).load(loaded), calibration::Stored::ok);
  EXPECT_EQ(loaded, values);
  fuzzy::TableStore tables(storage);
  ASSERT_EQ(tables.save(&fuzzy::kResponseTable), fuzzy::Stored::ok);
  fuzzy::Bilinear::Table table{};
  bool has_table = false;
  ASSERT_EQ(tables.load(table, has_table), fuzzy::Stored::ok);
  EXPECT_TRUE(has_table);
  EXPECT_EQ(table.node[7][9].step, fuzzy::kResponseTable.node[7][9].step);
}

TEST_F(FlashTest, EachUseHasSectorsOfItsOwn) {
  FlashStorage tables(FlashUse::response_table);
  for (std::uint8_t slot = 0; slot < 2; ++slot) {
    const std::uint8_t one[] = {1, 2, 3, 4}, other[] = {5, 6, 7, 8};
    std::uint8_t back[4] = {};
    ASSERT_TRUE(storage.erase(slot) && storage.write(slot, 0, one, 4));
    ASSERT_TRUE(tables.erase(slot) && tables.write(slot, 0, other, 4));
    EXPECT_EQ(flash.erasures[8U + slot], 1);
    EXPECT_EQ(flash.erasures[10U + slot], 1);
    EXPECT_EQ(read(slot, 0, 4), (std::vector<std::uint8_t>{1, 2, 3, 4}));
    ASSERT_TRUE(tables.read(slot, 0, back, 4));
    EXPECT_EQ(back[3], 8);
  }
}

TEST_F(FlashTest, ATableFitsIntoASlot) { EXPECT_GE(storage.size(), fuzzy::kTableRecordBytes); }

TEST(StuckFlash, EveryWaitEnds) {
  model::Chip chip;
  model::FlashModel flash;
  chip.attach(base::kFlash, flash);
  flash.stuck = true;
  FlashStorage storage(FlashUse::calibration);
  EXPECT_FALSE(storage.erase(1));
}

}  // namespace
}  // namespace whisker::hal::stm32f405
