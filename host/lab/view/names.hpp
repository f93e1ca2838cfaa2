/// The names under which a server answers. Otherwise a site whose name points to this computer could read the
/// run in a visitor's browser.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace whisker::view {

class Names {
 public:
  /// For a server at this address (numeric or a name) and port.
  Names(const std::string& address, int port);

  /// Checks the value of the header Host: this computer's own names, and the address. On an address that
  /// others can reach, any numeric address is accepted too, because no site can use one as its name.
  bool knows(std::string_view host) const;
  /// A page of this server sent the request: compares the header Origin with Host.
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
