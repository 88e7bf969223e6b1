// Lists on one line: "agus, forssim, hertz" out of a table, and what stands between the commas of one. Any thread.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// `name`: a member or a function of each entry.
template <class Table, class Name = std::identity>
std::string joined(const Table& table, Name name = {}, std::string_view between = ", ") {
  std::string list;
  for (const auto& one : table) {
    if (!list.empty()) list += between;
    list += std::invoke(name, one);
  }
  return list;
}

/// At least one, empty ones too; parts of `text`.
inline std::vector<std::string_view> split(std::string_view text, char between = ',') {
  std::vector<std::string_view> parts;
  for (std::size_t end; (end = text.find(between)) != std::string_view::npos; text.remove_prefix(end + 1))
    parts.push_back(text.substr(0, end));
  parts.push_back(text);
  return parts;
}

}  // namespace app
