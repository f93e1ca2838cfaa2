#include "host/cli/aliases.hpp"

#include <algorithm>
#include <sstream>

namespace whisker::cli {
namespace {

struct Alias {
  const char* former;
  const char* now;
  const char* file = nullptr;  ///< the option that names the file that stood alone
};

constexpr Alias kAliases[] = {
    {"dbc", "protocol --dbc"},
    {"figures", "protocol", "--figures"},
    {"scanner", "campaign --scanner"},
    {"rules evaluate", "rules show"},
    {"rules table", "table --json"},
    {"bench nodes", "bench watch --nodes"},
    {"bench record", "bench watch", "--log"},
    {"bench save", "bench get", "--out"},
    {"bench restore", "bench set"},
    {"bench reset", "bench stop --clear"},
    {"bench cancel", "bench stop --cancel"},
};

using Words = std::vector<std::string>;

Words words_in(const char* text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

/// The first word from `at` on that is neither an option nor the value of one.
Words::iterator lone_word(Words& words, std::size_t at) {
  auto word = words.begin() + static_cast<std::ptrdiff_t>(at);
  while (word != words.end() && is_option(*word)) word += std::min<std::ptrdiff_t>(2, words.end() - word);
  return word;
}

}  // namespace

std::vector<std::string> with_present_names(std::vector<std::string> words) {
  for (const Alias& alias : kAliases) {
    const Words former = words_in(alias.former), now = words_in(alias.now);
    if (words.size() < former.size() || !std::equal(former.begin(), former.end(), words.begin())) continue;
    if (alias.file != nullptr) words.insert(lone_word(words, former.size()), alias.file);
    words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(former.size()));
    words.insert(words.begin(), now.begin(), now.end());
    break;
  }
  return words;
}

}  // namespace whisker::cli
