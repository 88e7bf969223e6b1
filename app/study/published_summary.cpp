#include "app/study/published_summary.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace app {
namespace {

/// Half of the last digit, and what rounding of binary numbers takes.
constexpr double kHalfDigit = 0.005 + 1e-9;

bool isPrintedAs(double value, const std::optional<double>& printed) {
  return !printed || std::abs(value - *printed) <= kHalfDigit;
}

}  // namespace

bool canBeAnswered(const PublishedSummary& published, int low, int high) {
  // By sum, then by sum of squares, of what the answers lie above `low`.
  const auto most = static_cast<std::size_t>(high - low);
  const std::size_t sums = published.count * most + 1, squares = published.count * most * most + 1;
  std::vector<std::uint8_t> reached(sums * squares, 0);
  reached[0] = 1;
  for (std::size_t n = 1; n <= published.count; ++n) {
    std::vector<std::uint8_t> next(reached.size(), 0);
    for (std::size_t sum = 0; sum <= (n - 1) * most; ++sum)
      for (std::size_t square = 0; square <= (n - 1) * most * most; ++square) {
        if (reached[sum * squares + square] == 0) continue;
        for (std::size_t above = 0; above <= most; ++above) next[(sum + above) * squares + square + above * above] = 1;
      }
    reached = std::move(next);
  }
  const auto count = static_cast<double>(published.count);
  for (std::size_t at = 0; at < reached.size(); ++at) {
    if (reached[at] == 0) continue;
    const auto sum = static_cast<double>(at / squares), square = static_cast<double>(at % squares);
    if (!isPrintedAs(low + sum / count, published.mean)) continue;
    if (published.count < 2) return true;
    if (isPrintedAs(std::sqrt((square - sum * sum / count) / (count - 1.0)), published.deviation)) return true;
  }
  return false;
}

}  // namespace app
