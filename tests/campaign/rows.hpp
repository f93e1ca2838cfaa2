/// Rows for tests.
#pragma once

#include <string>

#include "host/harness/worlds/random.hpp"
#include "host/lab/campaign/row.hpp"

namespace whisker::campaign {

/// A random valid row.
Row random_row(worlds::Random& random);

/// A private folder, removed with its contents.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name) const { return path_ + "/" + name; }
  /// Writes the file and returns its path.
  std::string file(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

std::string text_of(const std::string& file);

}  // namespace whisker::campaign
