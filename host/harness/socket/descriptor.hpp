/// File descriptors and bounded waits.
#pragma once

#include <chrono>
#include <string>

namespace whisker::socket {

/// Closed with this object unless it is a standard one.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

/// The end of a wait of several steps.
class Deadline {
 public:
  explicit Deadline(double most_s);
  double left_s() const;  ///< negative: it is over

 private:
  std::chrono::steady_clock::time_point until_;
};

/// True: ready for `events` of poll(). False: not within this time.
bool wait_for(const Descriptor& descriptor, short events, double most_s);

/// A socket of this type bound to an IPv4 address; port 0: any. Throws ChannelError.
Descriptor bound(int type, const std::string& address, int port);
int port_of(const Descriptor& socket);

}  // namespace whisker::socket
