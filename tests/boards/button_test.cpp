#include <gtest/gtest.h>

#include "hal/boards/stm32f405/pins.hpp"
#include "hal/boards/stm32f405/push_button.hpp"
#include "tests/boards/chip_fixture.hpp"

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

}  // namespace
}  // namespace whisker::hal::stm32f405
