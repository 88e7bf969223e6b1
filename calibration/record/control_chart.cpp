#include "calibration/record/control_chart.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace calibration {
namespace {

constexpr double kD2 = 1.128;  ///< mean range of two normal values, in sigmas

struct RuleNumbers {
  ControlRule rule;
  std::size_t enough, of;
  double beyond;
};
constexpr std::array<RuleNumbers, 4> kRules = {{{ControlRule::one_beyond_3, 1, 1, 3.0},
                                                {ControlRule::two_of_3_beyond_2, 2, 3, 2.0},
                                                {ControlRule::four_of_5_beyond_1, 4, 5, 1.0},
                                                {ControlRule::eight_on_one_side, 8, 8, 0.0}}};

/// `side`: +1 or -1.
bool completes(const RuleNumbers& rule, std::span<const double> sigmas, std::size_t at, double side) {
  const auto beyond = [&](double v) { return side * v > rule.beyond; };
  if (!beyond(sigmas[at])) return false;
  const std::size_t from = at + 1 >= rule.of ? at + 1 - rule.of : 0;
  return static_cast<std::size_t>(std::ranges::count_if(sigmas.subspan(from, at + 1 - from), beyond)) >= rule.enough;
}

}  // namespace

std::optional<ControlLimits> controlLimits(std::span<const double> values, std::size_t min_n, double min_sigma) {
  if (values.size() < std::max<std::size_t>(min_n, 2)) return std::nullopt;
  double sum = 0.0, moved = 0.0;
  for (const double v : values) sum += v;
  for (std::size_t i = 1; i < values.size(); ++i) moved += std::abs(values[i] - values[i - 1]);
  const auto n = static_cast<double>(values.size());
  return ControlLimits{sum / n, std::max(moved / (n - 1.0) / kD2, min_sigma), values.size()};
}

std::string_view nameOf(ControlRule rule) {
  constexpr std::array<std::string_view, 4> kNames = {"beyond 3 sigma", "2 of 3 beyond 2 sigma on one side",
                                                      "4 of 5 beyond 1 sigma on one side", "8 on one side"};
  return kNames[static_cast<std::size_t>(rule)];
}

std::vector<ControlAlarm> controlAlarms(std::span<const double> sigmas) {
  std::vector<ControlAlarm> alarms;
  for (std::size_t at = 0; at < sigmas.size(); ++at)
    for (const double side : {1.0, -1.0})
      for (const RuleNumbers& rule : kRules)
        if (completes(rule, sigmas, at, side)) {
          alarms.push_back({rule.rule, at, side > 0.0});
          break;
        }
  return alarms;
}

}  // namespace calibration
