#include "app/text/suggestion.h"

#include <algorithm>

namespace app {

std::size_t editDistance(std::string_view a, std::string_view b) {
  // Three rows of the table of distances between beginnings.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

std::string closestName(std::string_view word, const std::vector<std::string>& names) {
  if (word.empty()) return {};
  std::string closest;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& name : names)
    if (const std::size_t edits = editDistance(word, name); edits < fewest) fewest = edits, closest = name;
  if (!closest.empty()) return closest;
  for (const std::string& name : names)
    if (word.size() > 1 && name.starts_with(word) && (closest.empty() || name.size() < closest.size())) closest = name;
  return closest;
}

std::string didYouMean(std::string_view word, const std::vector<std::string>& names) {
  const std::string closest = closestName(word, names);
  return closest.empty() ? std::string() : ", did you mean " + closest + "?";
}

}  // namespace app
