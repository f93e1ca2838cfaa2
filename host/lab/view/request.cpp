#include "host/lab/view/request.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "host/lab/view/lower.hpp"

namespace whisker::view {
namespace {

constexpr std::string_view kLine = "\r\n";
constexpr std::string_view kEnd = "\r\n\r\n";

Asked refused(int status, std::string fault) { return {status, std::move(fault)}; }

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t") - from + 1);
}

/// Removes and returns the text up to the mark; also removes the mark.
std::string_view up_to(std::string_view mark, std::string_view& rest) {
  const std::size_t at = std::min(rest.find(mark), rest.size());
  const std::string_view text = rest.substr(0, at);
  rest.remove_prefix(std::min(at + mark.size(), rest.size()));
  return text;
}

Asked first_line(std::string_view line) {
  const std::string_view method = up_to(" ", line);
  const std::string_view target = up_to(" ", line);
  if (target.empty() || target.front() != '/' || line.rfind("HTTP/", 0) != 0) {
    return refused(400, "this is no request of HTTP");
  }
  if (line != "HTTP/1.1" && line != "HTTP/1.0") return refused(505, "this server speaks HTTP/1.1");
  if (method != "GET") return refused(405, "there is nothing here but to read: use GET");
  Asked asked;
  asked.request.path = target.substr(0, target.find('?'));
  return asked;
}

/// False if the line is not a header, or repeats a header that must be unique.
bool take_header(std::string_view line, std::optional<std::string>& host, Request& request) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  const std::string_view name = line.substr(0, colon);
  if (name.find_first_of(" \t") != std::string_view::npos) return false;
  const std::string key = lower(name);
  const std::string value(trimmed(line.substr(colon + 1)));
  if (key == "host") {
    if (host) return false;
    host = value;
  } else if (key == "origin") {
    if (request.origin) return false;
    request.origin = value;
  } else if (key == "last-event-id") {
    request.last_event_id = value;
  }
  return true;
}

Asked parsed(std::string_view head) {
  Asked asked = first_line(up_to(kLine, head));
  if (asked.status != 200) return asked;
  std::optional<std::string> host;
  while (!head.empty()) {
    if (!take_header(up_to(kLine, head), host, asked.request)) return refused(400, "a header is malformed");
  }
  if (!host) return refused(400, "the request names no host");
  asked.request.host = *host;
  return asked;
}

}  // namespace

std::optional<Asked> Head::add(std::string_view bytes) {
  const std::size_t known = text_.size();
  text_ += bytes.substr(0, kMostHead + kEnd.size() - std::min(known, kMostHead));
  // The mark may lie across both parts.
  const std::size_t end = text_.find(kEnd, known < kEnd.size() ? 0 : known - kEnd.size());
  if (end <= kMostHead) return parsed(std::string_view(text_).substr(0, end));
  if (text_.size() < kMostHead + kEnd.size()) return std::nullopt;
  return refused(431, fmt::format("the request's head is longer than {} kB", kMostHead >> 10U));
}

}  // namespace whisker::view
