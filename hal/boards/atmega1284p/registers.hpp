/// The registers and bits that the drivers use, under the names of the data sheet; a test compares them with
/// avr-libc's.
#pragma once

#include "hal/boards/atmega1284p/io.hpp"

namespace whisker::hal::atmega1284p {

namespace reg {
inline constexpr Register kPINB{0x23};
inline constexpr Register kDDRB{0x24};
inline constexpr Register kPORTB{0x25};
inline constexpr Register kDDRC{0x27};
inline constexpr Register kPORTC{0x28};
inline constexpr Register kPIND{0x29};
inline constexpr Register kDDRD{0x2A};
inline constexpr Register kPORTD{0x2B};
inline constexpr Register kTIFR1{0x36};
inline constexpr Register kGPIOR0{0x3E};
inline constexpr Register kTCCR0A{0x44};
inline constexpr Register kTCCR0B{0x45};
inline constexpr Register kOCR0A{0x47};
inline constexpr Register kOCR0B{0x48};
inline constexpr Register kGPIOR1{0x4A};
inline constexpr Register kGPIOR2{0x4B};
inline constexpr Register kSMCR{0x53};
inline constexpr Register kMCUSR{0x54};
inline constexpr Register kWDTCSR{0x60};
inline constexpr Register kPCICR{0x68};
inline constexpr Register kPCMSK2{0x6D};
inline constexpr Register kTIMSK1{0x6F};
inline constexpr Register kTIMSK2{0x70};
inline constexpr Register kADCL{0x78};
inline constexpr Register kADCH{0x79};
inline constexpr Register kADCSRA{0x7A};
inline constexpr Register kADMUX{0x7C};
inline constexpr Register kDIDR0{0x7E};
inline constexpr Register kTCCR1A{0x80};
inline constexpr Register kTCCR1B{0x81};
inline constexpr Register kICR1L{0x86};
inline constexpr Register kICR1H{0x87};
inline constexpr Register kTCCR2A{0xB0};
inline constexpr Register kTCCR2B{0xB1};
inline constexpr Register kOCR2A{0xB3};
}  // namespace reg

namespace bits {
inline constexpr uint8_t kWGM00 = bit(0);
inline constexpr uint8_t kWGM01 = bit(1);
inline constexpr uint8_t kCOM0B1 = bit(5);
inline constexpr uint8_t kCOM0A1 = bit(7);
inline constexpr uint8_t kCS01 = bit(1);
inline constexpr uint8_t kCS10 = bit(0);
inline constexpr uint8_t kCS11 = bit(1);
inline constexpr uint8_t kICES1 = bit(6);
inline constexpr uint8_t kICNC1 = bit(7);
inline constexpr uint8_t kICIE1 = bit(5);
inline constexpr uint8_t kICF1 = bit(5);
inline constexpr uint8_t kWGM21 = bit(1);
inline constexpr uint8_t kCS22 = bit(2);
inline constexpr uint8_t kOCIE2A = bit(1);
inline constexpr uint8_t kPCIE2 = bit(2);
inline constexpr uint8_t kREFS0 = bit(6);
inline constexpr uint8_t kADEN = bit(7);
inline constexpr uint8_t kADSC = bit(6);
inline constexpr uint8_t kADPS0 = bit(0);
inline constexpr uint8_t kADPS1 = bit(1);
inline constexpr uint8_t kADPS2 = bit(2);
inline constexpr uint8_t kSE = bit(0);
inline constexpr uint8_t kWDE = bit(3);
inline constexpr uint8_t kWDCE = bit(4);
inline constexpr uint8_t kWDP2 = bit(2);
}  // namespace bits

}  // namespace whisker::hal::atmega1284p
