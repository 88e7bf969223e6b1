// Individuals control chart: centre = mean, sigma = mean moving range / 1.128 (Montgomery, Introduction to Statistical
// Quality Control, 6.4), alarms by Western Electric's rules (Statistical Quality Control Handbook, 1956). Any unit.
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
  std::size_t n = 0;  ///< number of values

  double at(double sigmas) const { return centre + sigmas * sigma; }
};
/// None: fewer than `least_n` values. Sigma is at least `least_sigma`, the resolution of the instrument.
std::optional<ControlLimits> controlLimits(std::span<const double> values, std::size_t min_n, double min_sigma);

/// Fastest for a large change first.
enum class ControlRule { one_beyond_3, two_of_3_beyond_2, four_of_5_beyond_1, eight_on_one_side };
std::string_view nameOf(ControlRule rule);  ///< "2 of 3 beyond 2 sigma on one side", …

struct ControlAlarm {
  ControlRule rule;
  std::size_t at;  ///< index of the value that completed the rule
  bool above;
};
/// `sigmas`: deviations from the centre, in order. At each value at most one alarm per side: the first rule that the
/// value completes.
std::vector<ControlAlarm> controlAlarms(std::span<const double> sigmas);

}  // namespace calibration
