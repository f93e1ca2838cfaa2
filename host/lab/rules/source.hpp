/// The text of a rule file with the places of its words, for error messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/text.hpp"
#include "host/lab/rules/rule_base.hpp"

namespace whisker::rules {

/// Limits of a rule file: more is refused.
constexpr std::size_t kMostVariables = 32;
constexpr std::size_t kMostTerms = 64;
constexpr std::size_t kMostRules = 4096;
constexpr std::size_t kMostSteps = 60;
/// Greatest size of any number but a shoulder's infinity.
constexpr double kGreatest = 1e9;

/// A part of the text.
struct Word {
  std::string_view text;
  std::size_t at = 0;  ///< offset in the file

  bool empty() const { return text.empty(); }
  bool operator==(std::string_view other) const { return text == other; }
  bool operator!=(std::string_view other) const { return text != other; }
};

class Source {
 public:
  /// The text must outlive it.
  Source(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  const std::string& file() const { return file_; }
  std::string_view text() const { return text_; }
  Place place(std::size_t at) const;
  [[noreturn]] void fail(const Word& at, std::string_view what) const { fail(at.at, what); }
  [[noreturn]] void fail(std::size_t at, std::string_view what) const;
  [[noreturn]] void fail(Place at, std::string_view what) const;
  /// For what is read otherwise than the file says.
  void warn(Place at, std::string_view what) const;
  void warn(const Word& at, std::string_view what) const { warn(place(at.at), what); }
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Its lines without line ends.
  std::vector<Word> lines() const;

  /// The whole word as a number, in decimal; at most kGreatest in size.
  double number(const Word& word) const;
  /// As number(), or an infinity.
  double number_or_infinity(const Word& word) const;
  /// A whole number in [low, high].
  long whole(const Word& word, long low, long high) const;

  /// The index of a word among names; fails as "unknown WHAT 'word'", with the nearest name.
  std::size_t index_of(const Word& word, const std::vector<std::string_view>& names,
                       std::string_view what) const;
  /// As index_of(), for the terms of a variable: fails as "'VARIABLE' has no term 'word'".
  std::size_t index_of_term(const Word& word, const std::vector<std::string_view>& names,
                            std::string_view variable) const;

 private:
  std::size_t find(const Word& word, const std::vector<std::string_view>& names,
                   const std::string& otherwise) const;

  std::string_view text_;
  std::string file_;
  mutable std::vector<std::string> warnings_;
};

Word trimmed(Word word);
/// Parts of the word between blanks, commas count as blanks if asked.
std::vector<Word> split(Word word, bool commas = false);
/// The parts before and after the first `c`; the second is empty if there is none.
struct Halves {
  Word before;
  Word after;
  bool found;
};
Halves split_at(Word word, char c);

template <class Named>
std::vector<std::string_view> names_of(const std::vector<Named>& all) {
  std::vector<std::string_view> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

/// Fails if the name is empty or already among them.
template <class Named>
void check_new_name(const Source& source, const Word& name, const std::vector<Named>& all,
                    std::string_view what) {
  if (name.empty()) source.fail(name, "a " + std::string(what) + " needs a name");
  for (const Named& one : all)
    if (one.name == name.text) source.fail(name, "a second " + std::string(what) + " '" + one.name + "'");
}

}  // namespace whisker::rules
