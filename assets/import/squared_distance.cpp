#include "assets/import/squared_distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "assets/volume_grid.h"

namespace assets {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// One line: lowest of the parabolas that stand on its values.
class Envelope {
 public:
  explicit Envelope(std::size_t length) : value_(length), place_(length), begin_(length + 1) {}

  void run(float* line, std::size_t stride) {
    const std::size_t length = value_.size();
    for (std::size_t n = 0; n < length; ++n) value_[n] = line[n * stride];
    std::size_t count = 0;
    for (std::size_t n = 0; n < length; ++n) {
      if (value_[n] == kFar) continue;
      double from = -std::numeric_limits<double>::infinity();
      while (count > 0 && (from = crossing(place_[count - 1], n)) <= begin_[count - 1]) --count;
      if (count == 0) from = -std::numeric_limits<double>::infinity();
      place_[count] = n, begin_[count] = from;
      ++count;
    }
    if (count == 0) return;
    std::size_t at = 0;
    for (std::size_t n = 0; n < length; ++n) {
      while (at + 1 < count && begin_[at + 1] < static_cast<double>(n)) ++at;
      const double offset = static_cast<double>(n) - static_cast<double>(place_[at]);
      line[n * stride] = static_cast<float>(offset * offset + static_cast<double>(value_[place_[at]]));
    }
  }

 private:
  /// Where the parabola of `b` falls below that of `a`.
  double crossing(std::size_t a, std::size_t b) const {
    const double p = static_cast<double>(a), q = static_cast<double>(b);
    return ((static_cast<double>(value_[b]) + q * q) - (static_cast<double>(value_[a]) + p * p)) / (2.0 * (q - p));
  }

  std::vector<float> value_;
  std::vector<std::size_t> place_;
  std::vector<double> begin_;
};

}  // namespace

std::vector<float> squaredDistance(glm::ivec3 size, std::span<const std::uint8_t> is_chosen) {
  std::vector<float> squared(countIn(size));
  std::ranges::transform(is_chosen, squared.begin(), [](std::uint8_t chosen) { return chosen != 0 ? 0.0F : kFar; });
  const std::array<std::size_t, 3> stride = {1, indexIn(size, {0, 1, 0}), indexIn(size, {0, 0, 1})};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    tbb::parallel_for(tbb::blocked_range<int>(0, size[v]), [&](const auto& range) {
      Envelope envelope(static_cast<std::size_t>(size[axis]));
      for (int j = range.begin(); j < range.end(); ++j)
        for (int i = 0; i < size[u]; ++i)
          envelope.run(squared.data() + static_cast<std::size_t>(i) * stride[static_cast<std::size_t>(u)] +
                           static_cast<std::size_t>(j) * stride[static_cast<std::size_t>(v)],
                       stride[static_cast<std::size_t>(axis)]);
    });
  }
  return squared;
}

}  // namespace assets
