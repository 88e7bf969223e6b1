// `molar plan PATIENT`: what the scan tells before an impacted lower third molar is removed; as a table, or JSON for
// programs.

#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>

#include "app/case/case.h"
#include "app/case/extraction_plan.h"
#include "app/case/patient_source.h"
#include "app/commands/command.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "assets/patient/patient_folder.h"

namespace app {
namespace {

struct PlanOptions {
  std::string patient, case_name;
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
  }
  return out;
}

int plan(const PlanOptions& options) {
  if (options.patient.empty() == options.case_name.empty())
    throw UsageError("plan: give exactly one of PATIENT and --case NAME");
  const bool built_in = !options.case_name.empty();
  const assets::Patient patient =
      built_in ? builtInPatient(caseNamed(options.case_name)->jaw) : assets::loadPatient(patientNamed(options.patient));
  const ExtractionPlan found = extractionPlan(patient, built_in ? "--case " + options.case_name : options.patient);
  std::fputs((options.json ? jsonOf(found).dump(2) + "\n" : planTable(found)).c_str(), stdout);
  return 0;
}

}  // namespace

void addPlan(CommandLine& molar) {
  auto options = std::make_shared<PlanOptions>();
  CommandLine& command =
      molar.command("plan", "What the scan tells of an impacted third molar: classes, distances, difficulty");
  command.option("PATIENT", options->patient, kPatientHelp);
  command.option("--case", options->case_name, "A case of the built-in patient, see molar rehearse --cases")
      .oneOf(caseNames());
  command.flag("--json", options->json, "All of it as JSON");
  command.footer(
      "Measured on labels and numbers of the teeth. What the scan does not show is \"not known\", with the reason.\n"
      "JSON: by parameter {value, unit, how}, or value null and a reason: fdi, winter_angle, winter_class, depth, "
      "pell_gregory_depth, pell_gregory_ramus, canal_distance, canal_relation, lingual_plate, second_molar, roots, "
      "root_shape, difficulty.");
  command.does([options] { return plan(*options); });
}

}  // namespace app
