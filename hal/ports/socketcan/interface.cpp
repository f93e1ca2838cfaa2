#include "hal/ports/socketcan/interface.hpp"

#include <net/if.h>
#include <sys/ioctl.h>

namespace whisker::hal::socketcan {

Interface look_up(int socket, const std::string& name) noexcept {
  ifreq request{};
  name.copy(request.ifr_name, IFNAMSIZ - 1);
  Interface found;
  if (ioctl(socket, SIOCGIFINDEX, &request) != 0) return found;
  found.index = request.ifr_ifindex;
  if (ioctl(socket, SIOCGIFFLAGS, &request) != 0) return {};
  found.up = (request.ifr_flags & IFF_UP) != 0;
  found.running = (request.ifr_flags & IFF_RUNNING) != 0;
  return found;
}

}  // namespace whisker::hal::socketcan
