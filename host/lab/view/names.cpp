#include "host/lab/view/names.hpp"

#include <algorithm>

#include <arpa/inet.h>
#include <fmt/core.h>
#include <unistd.h>

#include "host/lab/view/lower.hpp"

namespace whisker::view {
namespace {

/// The host part of a URL: an IPv6 address gets brackets.
std::string host_of(const std::string& address) {
  return address.find(':') == std::string::npos ? address : "[" + address + "]";
}

/// Whether the name is an IP address; IPv6 needs brackets.
bool is_number(const std::string& name) {
  unsigned char bytes[sizeof(in6_addr)];
  if (inet_pton(AF_INET, name.c_str(), bytes) == 1) return true;
  return name.size() > 2 && name.front() == '[' && name.back() == ']' &&
         inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), bytes) == 1;
}

bool is_everywhere(const std::string& address) { return address == "0.0.0.0" || address == "::"; }

std::string own_name() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? lower(name) : "";
}

}  // namespace

bool is_loopback(const std::string& address) {
  return address == "localhost" || address == "::1" || address.rfind("127.", 0) == 0;
}

Names::Names(const std::string& address, int port)
    : names_{"localhost", "127.0.0.1", "[::1]", lower(host_of(address))},
      port_(fmt::format("{}", port)),
      numbers_(!is_loopback(address)),
      url_(fmt::format("http://{}:{}/", host_of(address), port)) {
  const std::string own = own_name();
  if (!is_everywhere(address) || own.empty()) return;
  names_.push_back(own);
  names_.push_back(own + ".local");
}

bool Names::knows(std::string_view host) const {
  // A colon within brackets belongs to the address.
  const std::size_t colon = host.rfind(':');
  const bool has_port = colon != std::string_view::npos && host.find(']', colon) == std::string_view::npos;
  const std::string name = lower(host.substr(0, has_port ? colon : host.size()));
  const std::string_view port = has_port ? host.substr(colon + 1) : "80";
  if (port != port_) return false;
  return std::find(names_.begin(), names_.end(), name) != names_.end() || (numbers_ && is_number(name));
}

bool Names::same(std::string_view origin, std::string_view host) {
  return lower(origin) == "http://" + lower(host);
}

}  // namespace whisker::view
