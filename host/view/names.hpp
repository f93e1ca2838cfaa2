/// By which names a server may be asked. A site that lets its own name point to this computer could else read
/// the run in a visitor's browser.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace whisker::view {

class Names {
 public:
  /// Of the server on this address, which is a number or a name, and port.
  Names(const std::string& address, int port);

  /// The value of the header Host. This computer's own names, and the address; on an address that others
  /// reach, every number too: no site can make a number its name.
  bool knows(std::string_view host) const;
  /// A page of this server's own asks: the value of the header Origin against that of Host.
  static bool same(std::string_view origin, std::string_view host);

  /// Where to open the page.
  const std::string& url() const { return url_; }

 private:
  std::vector<std::string> names_;
  std::string port_;
  bool numbers_;
  std::string url_;
};

/// Only this computer can reach it.
bool is_loopback(const std::string& address);

}  // namespace whisker::view
