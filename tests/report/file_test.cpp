#include "host/harness/file/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace whisker::files {
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
      write(path, "new");
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }
  fs::path folder_;
};

TEST_F(WriteFile, writes_every_byte_and_nothing_else) {
  const std::string text("a\0b\r\n\xFF", 6);
  write(path("a.csv"), text);
  EXPECT_EQ(content(path("a.csv")), text);
  EXPECT_THAT(names(), ::testing::ElementsAre("a.csv"));
}

TEST_F(WriteFile, replaces_what_was_there) {
  write(path("a"), std::string(100000, 'x'));
  write(path("a"), "short");
  EXPECT_EQ(content(path("a")), "short");
  EXPECT_THAT(names(), ::testing::ElementsAre("a"));
}

TEST_F(WriteFile, replaces_the_file_under_a_reader_who_keeps_the_old_one) {
  write(path("a"), "old");
  std::ifstream reader(path("a"));
  write(path("a"), "new");
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
  write(path("a"), "old");
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
  write(path("real"), "old");
  fs::create_symlink("real", path("link"));
  write(path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("real")), "new");
}

TEST_F(WriteFile, writes_to_a_device_and_never_replaces_it) {
  write("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(WriteFile, reports_a_full_device) {
  EXPECT_EQ(error_of("/dev/full"), "cannot write /dev/full: No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(WriteFile, takes_a_dash_for_standard_output) {
  testing::internal::CaptureStdout();
  write("-", "text");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "text");
}

TEST_F(WriteFile, keeps_the_permissions_of_the_old_file) {
  write(path("a"), "old");
  ASSERT_EQ(::chmod(path("a").c_str(), 0604), 0);
  write(path("a"), "new");
  Growing(path("a")).write("never finished");
  Growing grows(path("a"));
  grows.write(", until now");
  grows.finish();
  struct stat s {};
  ASSERT_EQ(::stat(path("a").c_str(), &s), 0);
  EXPECT_EQ(s.st_mode & 07777U, 0604U);
  EXPECT_EQ(content(path("a")), "never finished, until now");
  EXPECT_THAT(names(), ::testing::ElementsAre("a"));
}

TEST_F(WriteFile, follows_a_link_to_a_file_that_is_not_there_yet) {
  fs::create_directory(path("folder"));
  fs::create_symlink("folder/b", path("a"));
  fs::create_symlink("a", path("link"));
  write(path("link"), "text");
  EXPECT_EQ(content(path("folder/b")), "text");
  Growing grows(path("a"));
  grows.write("more");
  EXPECT_EQ(grows.part(), path("folder/b.part"));
  grows.finish();
  EXPECT_EQ(content(path("folder/b")), "more");
  EXPECT_TRUE(fs::is_symlink(path("link")) && fs::is_symlink(path("a")));
}

TEST_F(WriteFile, writes_through_no_link_in_the_place_of_its_part) {
  write(path("target"), "precious");
  const std::string pid = std::to_string(::getpid());
  for (const std::string& name : {"a." + pid + "-0.part", std::string("a.part")}) {
    fs::create_symlink("target", path(name.c_str()));
  }
  write(path("a"), "new");
  EXPECT_EQ(content(path("a")), "new");
  EXPECT_THROW(Growing(path("a")), std::runtime_error);
  EXPECT_EQ(content(path("target")), "precious");
}

TEST_F(WriteFile, grows_beside_the_old_file_and_stays_there_until_it_is_finished) {
  write(path("a"), "old");
  {
    Growing grows(path("a"));
    EXPECT_THROW(Growing(path("a")), std::runtime_error) << "two would mix their text";
    EXPECT_EQ(grows.found(), "");
    grows.write("1\n2");
  }
  EXPECT_EQ(content(path("a")), "old");
  {
    Growing grows(path("a"));
    EXPECT_EQ(grows.found(), "1\n2");
    grows.keep(2);
    grows.write("3\n");
    grows.finish();
  }
  EXPECT_EQ(content(path("a")), "1\n3\n");
  Growing(path("b"));
  EXPECT_THAT(names(), ::testing::ElementsAre("a")) << "an empty one is no loss";
}

TEST_F(WriteFile, grows_at_its_place_where_nothing_is_lost) {
  const auto in_place = Growing::From::path_if_new;
  write(path("empty"), "");
  for (const char* name : {"new", "empty"}) {
    {
      Growing grows(path(name), in_place);
      EXPECT_EQ(grows.part(), path(name));
      EXPECT_THROW(Growing(path(name), in_place), std::runtime_error) << "it has a writer";
      grows.write("1");
      EXPECT_EQ(content(path(name)), "1");
      EXPECT_THROW(Growing(path(name), in_place), std::runtime_error) << "also now";
    }
    Growing(path(name), in_place).write("2");
    EXPECT_EQ(content(path(name)), "1");
    EXPECT_EQ(content(path(name) + ".part"), "2");
    Growing grows(path(name), in_place);
    EXPECT_EQ(grows.found(), "2");
    grows.finish();
    EXPECT_EQ(content(path(name)), "2");
  }
  EXPECT_THAT(names(), ::testing::UnorderedElementsAre("empty", "new"));
}

TEST_F(WriteFile, grows_by_all_of_a_text_or_nothing) {
  Growing grows(path("a"));
  grows.write("1\n");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tight{3, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
  EXPECT_THROW(grows.write("22\n"), std::runtime_error);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(content(grows.part()), "1\n");
}

TEST_F(WriteFile, obeys_the_umask) {
  const mode_t before = ::umask(027);
  write(path("a"), "text");
  ::umask(before);
  struct stat s {};
  ASSERT_EQ(::stat(path("a").c_str(), &s), 0);
  EXPECT_EQ(s.st_mode & 0777U, 0640U);
}

}  // namespace
}  // namespace whisker::files
