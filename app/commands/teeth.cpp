// `molar teeth`: the teeth of a patient whose canals can be treated, with their canals; as a table, or JSON for
// programs.

#include <cstdio>
#include <memory>
#include <numbers>

#include <nlohmann/json.hpp>

#include "app/case/case.h"
#include "app/case/root_canals.h"
#include "app/commands/command.h"
#include "app/text/command_line.h"
#include "assets/tooth.h"

namespace app {
namespace {

nlohmann::json pointOf(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

nlohmann::ordered_json jsonOf(const assets::ToothCanals& tooth, const assets::ToothCanal& canal) {
  nlohmann::ordered_json out{{"name", canal.name},
                             {"length_mm", canal.length_mm()},
                             {"working_length_mm", canal.workingLength_mm()},
                             {"constriction_mm", canal.constriction_mm},
                             {"schneider_deg", canal.schneider_rad * 180.0 / std::numbers::pi},
                             {"smallest_width_mm", canal.smallestWidth_mm()},
                             {"joins", nullptr},
                             {"orifice_P_mm", pointOf(canal.orifice_P_mm())},
                             {"foramen_P_mm", pointOf(canal.foramen_P_mm())},
                             {"apex_P_mm", pointOf(canal.apex_P_mm)},
                             {"reference_P_mm", pointOf(canal.reference_P_mm)}};
  if (canal.joins) out["joins"] = tooth.canals[*canal.joins].name;
  return out;
}

nlohmann::ordered_json jsonOf(const std::vector<CanalTooth>& teeth) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CanalTooth& tooth : teeth) {
    nlohmann::ordered_json one{{"fdi", tooth.fdi}, {"name", assets::toothName(tooth.fdi)}, {"canals_are", nullptr}};
    nlohmann::ordered_json canals = nlohmann::ordered_json::array();
    if (tooth.canals) {
      one["canals_are"] = tooth.canals->is_modelled ? "modelled" : "built-in";
      for (const assets::ToothCanal& canal : tooth.canals->canals) canals.push_back(jsonOf(*tooth.canals, canal));
    }
    one["remark"] = nullptr;
    if (!tooth.remark.empty()) one["remark"] = tooth.remark;
    one["canals"] = canals;
    list.push_back(one);
  }
  return {{"teeth", list}};
}

}  // namespace

void addTeeth(CommandLine& molar) {
  struct TeethOptions {
    std::string case_name;
    bool json = false;
  };
  auto options = std::make_shared<TeethOptions>();
  CommandLine& command = molar.command("teeth", "The teeth whose root canals can be treated, with their canals");
  command.example("molar teeth --case usual", "those of a built-in patient");
  command.option("--case", options->case_name, "A case of the built-in patient, see molar rehearse --cases")
      .oneOf(caseNames())
      .required();
  command.flag("--json", options->json, "For programs");
  command.footer(
      "Lengths from the orifice on the chamber's floor to the foramen; the working length from the cusp to 0.5 mm "
      "short\n"
      "of the foramen. Schneider: between the canal's upper axis and the line from where it leaves it to the foramen.");
  command.does([options] {
    const std::vector<CanalTooth> teeth = canalTeeth(caseNamed(options->case_name)->jaw);
    std::fputs((options->json ? jsonOf(teeth).dump(2) + "\n" : canalTable(teeth)).c_str(), stdout);
    return 0;
  });
}

}  // namespace app
