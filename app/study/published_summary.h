// What another study printed for an item, to stand beside one's own: mean and deviation of so many whole answers, and
// whether any such answers can have them. Pure; any thread; 0.3 s for 30 answers on eleven steps, 1 ms for ten on
// seven.
#pragma once

#include <cstddef>
#include <optional>

namespace app {

struct PublishedSummary {
  std::size_t count = 0;                  ///< of answers
  std::optional<double> mean, deviation;  ///< to two digits, the deviation with n - 1; none: not legible
};

/// Whether `count` whole answers from `low` to `high` have this mean and this deviation once both are rounded to two
/// digits: every sum and sum of squares that so many answers reach is looked at. What was not legible is not asked for.
bool canBeAnswered(const PublishedSummary& published, int low, int high);

}  // namespace app
