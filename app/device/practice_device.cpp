#include "app/device/practice_device.h"

#include <string_view>

#include "app/text/parse_number.h"
#include "app/text/usage_error.h"

namespace app {

std::optional<calibration::SyntheticRig> practiceRig(const std::string& address) {
  constexpr std::string_view kPractice = "practice";
  if (!address.starts_with(kPractice)) return std::nullopt;
  std::string_view rest = std::string_view(address).substr(kPractice.size());
  if (!rest.empty() && rest.front() != ':') return std::nullopt;
  if (!rest.empty()) rest.remove_prefix(1);

  const std::size_t colon = rest.find(':');
  const auto scenario = calibration::scenarioNamed(rest.substr(0, colon));
  std::optional<std::uint32_t> seed = 1;
  if (colon != std::string_view::npos) seed = parseNumber<std::uint32_t>(rest.substr(colon + 1));
  if (!scenario || !seed)
    throw UsageError(address + ": a practice device is practice:SCENARIO[:SEED], A to G and a number, " +
                     "as in practice:D:7");
  return calibration::syntheticRig(*scenario, *seed);
}

}  // namespace app
