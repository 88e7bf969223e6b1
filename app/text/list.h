// Joining a table to "agus, forssim, hertz", and splitting such a list. Any thread.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// `name`: member or function of an entry.
template <class Table, class Name = std::identity>
std::string joined(const Table& table, Name name = {}, std::string_view between = ", ") {
  std::string list;
  for (const auto& one : table) {
    if (!list.empty()) list += between;
    list += std::invoke(name, one);
  }
  return list;
}

/// Views into `text`; at least one, empty parts included.
inline std::vector<std::string_view> split(std::string_view text, char between = ',') {
  std::vector<std::string_view> parts;
  for (std::size_t end; (end = text.find(between)) != std::string_view::npos; text.remove_prefix(end + 1))
    parts.push_back(text.substr(0, end));
  parts.push_back(text);
  return parts;
}

}  // namespace app
