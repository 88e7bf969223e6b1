// Whether raters agree. Krippendorff's alpha (2011) for codes, ranks and numbers, with an interval by 1000 samples of
// the units from a seed that is told; intraclass correlation of scores (Shrout and Fleiss 1979). Nothing is told of too
// few values or of values that are all equal: an absent result says so. Pure; any thread; 1000 samples of 20 problems
// take 10 ms.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/study/statistics.h"

namespace app {

/// Rows are raters, columns what was rated; none: not rated.
using Ratings = std::vector<std::vector<std::optional<int>>>;

enum class RatingScale : std::uint8_t { nominal, ordinal, interval };

/// None where fewer than two values can be paired, or all are equal.
std::optional<double> krippendorffAlpha(const Ratings& ratings, RatingScale scale);

/// Between the 2.5th and the 97.5th of the hundred; none where fewer than half of the samples have an alpha.
inline constexpr std::size_t kAlphaSamples = 1000;
std::optional<ValueRange> alphaInterval(const Ratings& ratings, RatingScale scale, std::uint64_t seed);

/// Of one rater's score, at 95 % by F. `agreement`: ICC(2,1), raters are a sample of many; `consistency`: ICC(3,1),
/// these raters alone, what each adds to all of his scores does not count.
struct IntraclassCorrelation {
  double agreement = 0.0, consistency = 0.0;
  std::optional<ValueRange> agreement_interval, consistency_interval;  ///< none: raters do not differ at all
};
/// None unless two raters or more scored the same two or more, nothing missing, not all equal.
std::optional<IntraclassCorrelation> intraclassCorrelation(const Ratings& ratings);

}  // namespace app
