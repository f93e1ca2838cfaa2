#include "hal/ports/tty/tty_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace whisker::hal::tty {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A separate folder for each test.
class TtyLineTest : public ::testing::Test {
 protected:
  TtyLineTest() {
    std::string pattern = (fs::temp_directory_path() / "whisker-tty-XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  ~TtyLineTest() override { fs::remove_all(folder); }

  /// Listens there; returns the socket.
  static int listen_at(const fs::path& path) {
    const int server = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(bind(server, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(listen(server, 1), 0);
    return server;
  }
  template <class Condition>
  static bool soon(const Condition& condition) {
    for (int i = 0; i < 10000; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  static std::string take(TtyLine& line, std::size_t count) {
    std::string text;
    soon([&] {
      std::uint8_t byte = 0;
      while (text.size() < count && line.take(&byte, 1) == 1) text += static_cast<char>(byte);
      return text.size() == count;
    });
    return text;
  }
  static std::size_t offer(TtyLine& line, const std::string& text) {
    return line.offer(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }
  static std::string read_from(int file, std::size_t count) {
    std::string text(count, '\0');
    std::size_t done = 0;
    while (done < count) {
      const ssize_t got = read(file, &text[done], count - done);
      if (got <= 0) break;
      done += static_cast<std::size_t>(got);
    }
    return text.substr(0, done);
  }

  fs::path folder;
};

/// The master end of a pseudo terminal, which has no path.
class Master {
 public:
  Master() : file(posix_openpt(O_RDWR | O_NOCTTY)) {
    EXPECT_EQ(grantpt(file) + unlockpt(file), 0);
    path = ptsname(file);
  }
  ~Master() { close(file); }
  int file;
  std::string path;
};

TEST_F(TtyLineTest, CarriesBytesOverAPseudoTerminalUnchanged) {
  Master master;
  TtyLine line(master.path);
  ASSERT_TRUE(line.ready()) << line.waits_for();
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  ASSERT_EQ(offer(line, all), all.size());
  EXPECT_EQ(read_from(master.file, all.size()), all);
  ASSERT_EQ(write(master.file, all.data(), all.size()), static_cast<ssize_t>(all.size()));
  EXPECT_EQ(take(line, all.size()), all);
  std::uint8_t none = 0;
  EXPECT_EQ(line.take(&none, 1), 0U);
  EXPECT_TRUE(line.ready());
}

TEST_F(TtyLineTest, NoticesThatAPseudoTerminalHasGone) {
  auto master = std::make_unique<Master>();
  fs::create_symlink(master->path, folder / "port");
  TtyLine line(folder / "port");
  ASSERT_TRUE(line.ready());
  master.reset();
  std::uint8_t byte = 0;
  EXPECT_TRUE(soon([&] { return line.take(&byte, 1) == 0 && !line.ready(); }));
  Master next;
  fs::remove(folder / "port");
  fs::create_symlink(next.path, folder / "port");
  EXPECT_TRUE(soon([&] { return line.ready(); }));
  EXPECT_EQ(offer(line, "x"), 1U);
  EXPECT_EQ(read_from(next.file, 1), "x");
}

TEST_F(TtyLineTest, ConnectsToASocketWheneverSomebodyListens) {
  const fs::path path = folder / "socket";
  TtyLine line(path);
  EXPECT_FALSE(line.ready());
  EXPECT_THAT(line.waits_for(), HasSubstr("No such file"));
  for (int round = 0; round < 2; ++round) {
    const int server = listen_at(path);
    EXPECT_TRUE(soon([&] { return line.ready(); }));
    EXPECT_EQ(line.waits_for(), "");
    const int peer = accept(server, nullptr, nullptr);
    ASSERT_EQ(offer(line, "hello"), 5U);
    EXPECT_EQ(read_from(peer, 5), "hello");
    ASSERT_EQ(write(peer, "there", 5), 5);
    EXPECT_EQ(take(line, 5), "there");
    close(peer);
    close(server);
    fs::remove(path);
    std::uint8_t byte = 0;
    EXPECT_TRUE(soon([&] { return line.take(&byte, 1) == 0 && line.descriptor() < 0; }));
    EXPECT_THAT(line.waits_for(), HasSubstr("the other end has gone"));
    EXPECT_FALSE(line.ready());
  }
}

TEST_F(TtyLineTest, SaysOnceThatItWasLostEvenIfTheOtherEndIsBack) {
  const fs::path path = folder / "socket";
  const int server = listen_at(path);
  TtyLine line(path);
  ASSERT_TRUE(soon([&] { return line.ready(); }));
  close(accept(server, nullptr, nullptr));
  // SIGPIPE would end the test.
  EXPECT_TRUE(soon([&] { return offer(line, "x") == 0; }));
  EXPECT_FALSE(line.ready());
  EXPECT_TRUE(soon([&] { return line.ready(); }));
  close(server);
}

TEST_F(TtyLineTest, TakesNoMoreThanTheOtherEndDoes) {
  Master master;
  TtyLine line(master.path);
  ASSERT_TRUE(line.ready());
  const std::string much(1000000, 'x');
  const std::size_t taken = offer(line, much);
  EXPECT_LT(taken, much.size());
  EXPECT_TRUE(line.ready());
}

TEST_F(TtyLineTest, RefusesWhatIsNoLine) {
  const fs::path file = folder / "file";
  std::ofstream(file) << "text";
  EXPECT_THROW(TtyLine(file.string()), TtyError);
  EXPECT_THROW(TtyLine(folder.string()), TtyError);
  EXPECT_THROW(TtyLine("x", 12345), TtyError);
  TtyLine null("/dev/null");
  EXPECT_FALSE(null.ready());
  EXPECT_THAT(null.waits_for(), HasSubstr("ioctl"));
}

}  // namespace
}  // namespace whisker::hal::tty
