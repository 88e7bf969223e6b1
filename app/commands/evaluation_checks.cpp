#include "app/commands/evaluation_checks.h"

#include <filesystem>
#include <system_error>

#include <fmt/core.h>

#include "app/session/measures/untold.h"
#include "app/station/session_case.h"
#include "assets/ct_volume.h"

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

/// As a recording of this rehearsal will begin, as far as measures ask for it.
StoredStart startOf(const RehearsalPlan& plan) {
  StoredStart start;
  start.dt_s = 0.001;
  start.grid = plan.patient.ct.grid;
  start.solid = plan.patient.ct.solid;
  start.label = plan.patient.ct.label;
  start.teeth = plan.patient.ct.tooth;
  start.is_tooth = assets::voxelsOfTooth(plan.patient.ct, plan.patient.operatedTooth());
  if (plan.recording) start.setup = plan.recording->setup;
  start.setup.site = plan.patient.site;
  start.setup.canal_P_mm = plan.patient.mandibular_canal_P_mm;
  start.setup.canal_radius_mm = plan.patient.mandibular_canal_radius_mm;
  return start;
}

/// A rule over what this case never tells would never hold, and nobody would know.
Check ruleCheck(const RehearsalPlan& plan, const StudyTemplate& study) {
  const StoredStart start = startOf(plan);
  const SessionCase about = caseOfSessionWith(start, plan.risks);
  std::string words;
  std::size_t rules = 0;
  for (const TaskTemplate& task : study.tasks)
    for (const Rule* const rule : {&task.success, task.fail ? &*task.fail : nullptr}) {
      if (rule == nullptr) continue;
      ++rules;
      for (const std::string& id : rule->measures())
        if (const auto why = whyNeverTold(id, start, about))
          words += fmt::format("{}task {}: {} cannot be told here, {}", words.empty() ? "" : "; ", task.id, id, *why);
    }
  if (!words.empty()) return {"rules", CheckLight::red, words};
  return {"rules", CheckLight::green, fmt::format("{} rules, every measure of which this case tells", rules)};
}

}  // namespace

std::vector<Check> evaluationChecks(const RehearsalPlan& plan, const StudyTemplate& study, const std::string& folder,
                                    const std::string& voice) {
  std::vector<Check> checks;
  checks.push_back({"case", CheckLight::green, plan.patient.title});
  checks.push_back({"device", CheckLight::green, plan.device});
  checks.push_back(diskCheck(folder));
  if (!plan.recording) checks.push_back({"recording", CheckLight::red, "there is no data folder to record into"});
  for (const std::string& remark : plan.remarks) checks.push_back({"rig", CheckLight::amber, remark});
  checks.push_back(ruleCheck(plan, study));
  checks.push_back({"voice", CheckLight::green, voice});
  return checks;
}

}  // namespace app
