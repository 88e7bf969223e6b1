// Codes of people: one to three capitals, an optional hyphen, one to four digits; too short for a name or a date. Any
// thread.
#pragma once

#include <algorithm>
#include <string>

namespace app {

inline bool isAnonymousId(const std::string& id) {
  std::size_t at = 0;
  while (at < id.size() && id[at] >= 'A' && id[at] <= 'Z') ++at;
  if (at < 1 || at > 3) return false;
  if (at < id.size() && id[at] == '-') ++at;
  const std::size_t digits = id.size() - at;
  return digits >= 1 && digits <= 4 && std::all_of(id.begin() + static_cast<std::ptrdiff_t>(at), id.end(), [](char c) {
           return c >= '0' && c <= '9';
         });
}

}  // namespace app
