// `molar plan PATIENT`: what the scan tells before an impacted lower third molar is removed; as a table, or JSON for
// programs.

#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>

#include "app/case/extraction_plan.h"
#include "app/commands/command.h"
#include "app/commands/patient_or_case.h"
#include "app/text/command_line.h"

namespace app {
namespace {

struct PlanOptions {
  PatientOrCase patient;
  bool json = false;
};

nlohmann::ordered_json jsonOf(const ExtractionPlan& plan) {
  nlohmann::ordered_json out;
  for (const PlanItem& item : plan) {
    nlohmann::ordered_json& entry = out[std::string(item.key)];
    if (const auto* words = std::get_if<std::string>(&item.value)) entry["value"] = *words;
    if (const auto* figure = std::get_if<double>(&item.value)) entry["value"] = *figure;
    if (!item.isKnown()) entry["value"] = nullptr;
    if (item.unit.empty())
      entry["unit"] = nullptr;
    else
      entry["unit"] = std::string(item.unit);
    entry[item.isKnown() ? "how" : "reason"] = item.how;
    entry["confirmed"] = item.is_confirmed;
  }
  return out;
}

int plan(const PlanOptions& options) {
  options.patient.refuseUnlessOne("plan");
  const ExtractionPlan found = extractionPlan(options.patient.load(), options.patient.name());
  std::fputs((options.json ? jsonOf(found).dump(2) + "\n" : planTable(found)).c_str(), stdout);
  return 0;
}

}  // namespace

void addPlan(CommandLine& molar) {
  auto options = std::make_shared<PlanOptions>();
  CommandLine& command =
      molar.command("plan", "What the scan tells of an impacted third molar: classes, distances, difficulty");
  options->patient.addTo(command);
  command.flag("--json", options->json, "All of it as JSON");
  command.footer(
      "Measured on labels and numbers of the teeth. What the scan does not show is \"not known\", with the reason.\n"
      "JSON: by parameter {value, unit, how, confirmed}, or value null and a reason: fdi, winter_angle, winter_class, "
      "depth, "
      "pell_gregory_depth, pell_gregory_ramus, canal_distance, canal_relation, lingual_plate, second_molar, roots, "
      "root_shape, difficulty. Not confirmed: it rests on a tooth or canal that was found in a scan and that nobody "
      "has "
      "confirmed, see molar check.");
  command.does([options] { return plan(*options); });
}

}  // namespace app
