#pragma once

#include <string>

namespace whisker::hal::socketcan {

/// Current state of a network interface in the kernel.
struct Interface {
  int index = 0;         ///< 0: there is no interface of this name
  bool up = false;       ///< administratively up
  bool running = false;  ///< has a carrier; a CAN controller in bus-off has none
};

/// socket: any open one. name: shorter than IFNAMSIZ.
Interface look_up(int socket, const std::string& name) noexcept;

}  // namespace whisker::hal::socketcan
