/// Words and signs of a .fcl file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/lab/rules/source.hpp"

namespace whisker::rules {

/// The text with blanks in place of its comments: (* ... *), /* ... */ and // to the end of the line.
std::string without_fcl_comments(std::string_view text);

class FclTokens {
 public:
  /// The source must have no comments and outlive it.
  explicit FclTokens(const Source& source);

  bool ended() const { return at_ == tokens_.size(); }
  /// Empty at the end.
  Word peek() const { return ended() ? end_ : tokens_[at_]; }
  Word peek_after() const { return at_ + 1 < tokens_.size() ? tokens_[at_ + 1] : end_; }
  /// True, and past it, if the next word is this one in any case; `keyword` is in lower case.
  bool take(std::string_view keyword);
  void expect(std::string_view keyword);
  Word next(std::string_view what);
  void skip_to_semicolon();
  /// After RULE: the text between the colon and the semicolon, the next RULE or END_RULEBLOCK.
  Word rule_text();

 private:
  const Source& source_;
  std::vector<Word> tokens_;
  Word end_;
  std::size_t at_ = 0;
};

}  // namespace whisker::rules
