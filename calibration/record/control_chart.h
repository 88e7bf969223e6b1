// When a measurement that is repeated day by day says that something has changed: limits from the first of them, and
// the rules of Western Electric (Statistical Quality Control Handbook, 1956). Chart of individual values: centre =
// mean, sigma = mean moving range / 1.128 (Montgomery, Introduction to Statistical Quality Control, 6.4). Any unit.
// Pure; any thread; microseconds.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace calibration {

struct ControlLimits {
  double centre = 0.0, sigma = 0.0;
  std::size_t n = 0;  ///< values they are made of

  double at(double sigmas) const { return centre + sigmas * sigma; }
};
/// Of fewer than `least_n` values: none. A sigma below `least_sigma`, what the instrument can tell apart, becomes that.
std::optional<ControlLimits> controlLimits(std::span<const double> values, std::size_t least_n, double least_sigma);

/// In the order of how soon they tell of a large change.
enum class ControlRule { one_beyond_3, two_of_3_beyond_2, four_of_5_beyond_1, eight_on_one_side };
std::string_view nameOf(ControlRule rule);  ///< "2 of 3 beyond 2 sigma on one side", …

struct ControlAlarm {
  ControlRule rule;
  std::size_t at;  ///< the value that completed it
  bool above;
};
/// Of values less their centre in sigmas, in order. At each value the first rule that it completes on a side; a value
/// that is not itself where the rule looks completes none.
std::vector<ControlAlarm> controlAlarms(std::span<const double> sigmas);

}  // namespace calibration
