/// What the robot tells a USB host about itself: USB 2.0, 9.6, and the Communications Device Class 1.2 with
/// its PSTN subclass.
#pragma once

#include <stdint.h>

namespace whisker::hal::pico::usb {

// Addresses of the endpoints.
constexpr uint8_t kNotices = 0x81;  ///< never has one
constexpr uint8_t kToHost = 0x82;
constexpr uint8_t kFromHost = 0x02;

constexpr uint8_t kConfiguration = 1;
constexpr uint8_t kControlInterface = 0;
constexpr uint8_t kDataInterface = 1;
constexpr uint8_t kInterfaces = 2;

/// Kinds of descriptors.
enum Kind : uint8_t { kDevice = 1, kConfigurations = 2, kString = 3 };

// Strings by number; 0 is the list of languages.
constexpr uint8_t kMaker = 1, kProduct = 2, kSerial = 3;

/// 0x1209 belongs to pid.codes, and its product 0x0001 to nobody: it is for tests
/// (docs/build-a-pico-robot.md).
constexpr uint16_t kVendorId = 0x1209, kProductId = 0x0001;
constexpr uint16_t kMilliamperes = 250;

constexpr uint8_t low(uint16_t word) noexcept { return static_cast<uint8_t>(word); }
constexpr uint8_t high(uint16_t word) noexcept { return static_cast<uint8_t>(word >> 8); }

// clang-format off
inline constexpr uint8_t kDeviceDescriptor[18] = {
    18, kDevice, 0x00, 0x02,                         // USB 2.0
    0xEF, 0x02, 0x01, 64,                            // its interfaces have an association; packets of 64 bytes
    low(kVendorId), high(kVendorId), low(kProductId), high(kProductId), 0x00, 0x01,  // version 1.0
    kMaker, kProduct, kSerial, 1};

inline constexpr uint8_t kConfigurationDescriptor[75] = {
    9, kConfigurations, 75, 0, kInterfaces, kConfiguration, 0, 0x80, kMilliamperes / 2,
    8, 0x0B, kControlInterface, kInterfaces, 0x02, 0x02, 0x00, 0,  // association: communication, abstract control
    9, 0x04, kControlInterface, 0, 1, 0x02, 0x02, 0x00, 0,
    5, 0x24, 0x00, 0x20, 0x01,                       // CDC 1.2
    5, 0x24, 0x01, 0x00, kDataInterface,             // no calls
    4, 0x24, 0x02, 0x06,                             // line coding, line state, break
    5, 0x24, 0x06, kControlInterface, kDataInterface,
    7, 0x05, kNotices, 0x03, 8, 0, 16,               // interrupt, every 16 ms
    9, 0x04, kDataInterface, 0, 2, 0x0A, 0x00, 0x00, 0,
    7, 0x05, kFromHost, 0x02, 64, 0, 0,              // bulk
    7, 0x05, kToHost, 0x02, 64, 0, 0};
// clang-format on

}  // namespace whisker::hal::pico::usb
