#pragma once

#include <string>

namespace whisker::hal::socketcan {

/// What the kernel says of a network interface at this moment.
struct Interface {
  int index = 0;         ///< 0: there is none of this name
  bool up = false;       ///< set up by somebody
  bool running = false;  ///< has a carrier: a CAN controller that is bus-off has none
};

/// socket: any open one. name: shorter than IFNAMSIZ.
Interface look_up(int socket, const std::string& name) noexcept;

}  // namespace whisker::hal::socketcan
