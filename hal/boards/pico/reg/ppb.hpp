/// Of the processor.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::ppb {  // PPB

inline constexpr Register kSystCsr{0xE010};   ///< SYST_CSR
inline constexpr Register kSystRvr{0xE014};   ///< SYST_RVR
inline constexpr Register kSystCvr{0xE018};   ///< SYST_CVR
inline constexpr Register kNvicIser{0xE100};  ///< NVIC_ISER
inline constexpr Register kNvicIcpr{0xE280};  ///< NVIC_ICPR
inline constexpr Register kNvicIpr0{0xE400};  ///< NVIC_IPR0
inline constexpr Field kIp0{0xE400, 6, 2};    ///< NVIC_IPR0.IP_0
inline constexpr Register kVtor{0xED08};      ///< VTOR

}  // namespace whisker::hal::pico::ppb
