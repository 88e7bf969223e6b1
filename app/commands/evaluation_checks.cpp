#include "app/commands/evaluation_checks.h"

#include <filesystem>
#include <system_error>

#include <fmt/core.h>

namespace app {
namespace {

namespace fs = std::filesystem;

/// Two hours of recording need 1.3 GB.
constexpr double kLeastFree_GB = 2.0, kEnoughFree_GB = 10.0;

/// Of the folder, or of the nearest above it that is there.
Check diskCheck(const std::string& folder) {
  fs::path there = fs::absolute(folder);
  std::error_code failed;
  while (!fs::exists(there, failed) && there.has_parent_path() && there != there.parent_path())
    there = there.parent_path();
  const fs::space_info space = fs::space(there, failed);
  constexpr double kGB = 1e9;
  const double free_GB = failed ? 0.0 : static_cast<double>(space.available) / kGB;
  const CheckLight light = free_GB < kLeastFree_GB    ? CheckLight::red
                           : free_GB < kEnoughFree_GB ? CheckLight::amber
                                                      : CheckLight::green;
  return {"disk", light, fmt::format("{:.0f} GB are free, {:.0f} should be", free_GB, kEnoughFree_GB)};
}

}  // namespace

std::vector<Check> evaluationChecks(const RehearsalPlan& plan, const std::string& folder, const std::string& voice) {
  std::vector<Check> checks;
  checks.push_back({"case", CheckLight::green, plan.patient.title});
  checks.push_back({"device", CheckLight::green, plan.device});
  checks.push_back(diskCheck(folder));
  if (!plan.recording) checks.push_back({"recording", CheckLight::red, "there is no data folder to record into"});
  for (const std::string& remark : plan.remarks) checks.push_back({"rig", CheckLight::amber, remark});
  checks.push_back({"voice", CheckLight::green, voice});
  return checks;
}

}  // namespace app
