#include "host/lab/report/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace whisker::report {
namespace {

namespace fs = std::filesystem;

class WriteFile : public ::testing::Test {
 protected:
  WriteFile() {
    std::string name = ::testing::TempDir() + "whisker_file_XXXXXX";
    folder_ = ::mkdtemp(name.data());
  }
  ~WriteFile() override { fs::remove_all(folder_); }

  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) all.push_back(entry.path().filename());
    return all;
  }
  static std::string content(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::string error_of(const std::string& path) {
    try {
      write_file(path, "new");
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }
  fs::path folder_;
};

TEST_F(WriteFile, writes_every_byte_and_nothing_else) {
  const std::string text("a\0b\r\n\xFF", 6);
  write_file(path("a.csv"), text);
  EXPECT_EQ(content(path("a.csv")), text);
  EXPECT_THAT(names(), ::testing::ElementsAre("a.csv"));
}

TEST_F(WriteFile, replaces_what_was_there) {
  write_file(path("a"), std::string(100000, 'x'));
  write_file(path("a"), "short");
  EXPECT_EQ(content(path("a")), "short");
  EXPECT_THAT(names(), ::testing::ElementsAre("a"));
}

TEST_F(WriteFile, replaces_the_file_under_a_reader_who_keeps_the_old_one) {
  write_file(path("a"), "old");
  std::ifstream reader(path("a"));
  write_file(path("a"), "new");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(reader), {}), "old");
}

TEST_F(WriteFile, names_the_file_when_the_folder_is_missing) {
  const std::string missing = path("no/such/folder/a.svg");
  EXPECT_EQ(error_of(missing), "cannot write " + missing + ": No such file or directory");
  EXPECT_THAT(names(), ::testing::IsEmpty());
}

TEST_F(WriteFile, refuses_a_folder_and_leaves_nothing_behind) {
  fs::create_directory(path("folder"));
  EXPECT_EQ(error_of(path("folder")), "cannot write " + path("folder") + ": Is a directory");
  EXPECT_THAT(names(), ::testing::ElementsAre("folder"));
  EXPECT_TRUE(fs::is_empty(path("folder")));
}

TEST_F(WriteFile, keeps_the_old_file_and_no_part_when_the_space_ends_half_way) {
  write_file(path("a"), "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tight{2, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
  const std::string error = error_of(path("a"));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(error, "cannot write " + path("a") + ": File too large");
  EXPECT_EQ(content(path("a")), "old");
  EXPECT_THAT(names(), ::testing::ElementsAre("a"));
}

TEST_F(WriteFile, keeps_a_symbolic_link_a_link) {
  write_file(path("real"), "old");
  fs::create_symlink("real", path("link"));
  write_file(path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("real")), "new");
}

TEST_F(WriteFile, writes_to_a_device_and_never_replaces_it) {
  write_file("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(WriteFile, reports_a_full_device) {
  EXPECT_EQ(error_of("/dev/full"), "cannot write /dev/full: No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(WriteFile, takes_a_dash_for_standard_output) {
  testing::internal::CaptureStdout();
  write_file("-", "text");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "text");
}

TEST_F(WriteFile, obeys_the_umask) {
  const mode_t before = ::umask(027);
  write_file(path("a"), "text");
  ::umask(before);
  struct stat s {};
  ASSERT_EQ(::stat(path("a").c_str(), &s), 0);
  EXPECT_EQ(s.st_mode & 0777U, 0640U);
}

}  // namespace
}  // namespace whisker::report
