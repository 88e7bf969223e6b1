// Whether markup is well-formed: every element closed by its own name, every attribute in quotes, no bare ampersand.
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace app {

/// Empty: it is.
inline std::string whatIsWrongWith(const std::string& markup) {
  if (std::regex_search(markup, std::regex("&(?!amp;|lt;|gt;|quot;|#39;|emsp;)"))) return "a bare ampersand";
  std::vector<std::string> open;
  for (std::size_t at = markup.find('<'); at != std::string::npos; at = markup.find('<', at + 1)) {
    const std::size_t end = markup.find('>', at);
    if (end == std::string::npos) return "a tag without end";
    const std::string tag = markup.substr(at + 1, end - at - 1);
    if (tag.starts_with("!DOCTYPE") || tag.starts_with("meta ") || tag == "br") continue;
    if (tag.find('<') != std::string::npos) return "a tag in a tag: " + tag;
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return "a quote too many: " + tag;
    const std::string name = tag.substr(tag[0] == '/', tag.find_first_of(" /", 1) - (tag[0] == '/'));
    if (tag[0] == '/') {
      if (open.empty() || "/" + open.back() != tag) return "closed without being open: " + tag;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

inline std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace app
