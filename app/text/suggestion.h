// "did you mean": the closest of a list of names to a mistyped one. Pure; any thread; below 1 ms for some hundred
// names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace app {

/// Edits (insert, delete, replace a letter, swap two neighbours) between two words: the optimal string alignment
/// distance (Damerau 1964, Levenshtein 1966).
std::size_t editDistance(std::string_view a, std::string_view b);

/// The name within a third of the word's length in edits, or the shortest that begins with the word; empty: none.
std::string closestName(std::string_view word, const std::vector<std::string>& names);

/// ", did you mean NAME?", or empty.
std::string didYouMean(std::string_view word, const std::vector<std::string>& names);

}  // namespace app
