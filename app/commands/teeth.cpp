// `molar teeth`: the teeth of a patient whose canals can be treated, with their canals, as a table or JSON for
// programs; of one tooth the dentine around them, and their sections as a picture.

#include <cstdio>
#include <memory>
#include <numbers>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/case/root_canals.h"
#include "app/commands/command.h"
#include "app/commands/patient_or_case.h"
#include "app/options/settings_text.h"
#include "app/procedure/root_canal/section_picture.h"
#include "app/procedure/root_canal/tooth_blocks.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "assets/tooth.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"

namespace app {
namespace {

struct TeethOptions {
  PatientOrCase patient;
  std::optional<int> fdi;
  std::string sections;
  bool json = false, force = false;
};

/// What the fine field of one tooth tells of each of its canals.
using Measured = std::vector<CanalOutcomes>;

nlohmann::json pointOf(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

nlohmann::ordered_json jsonOf(const assets::ToothCanals& tooth, std::size_t which, const Measured& measured) {
  const assets::ToothCanal& canal = tooth.canals[which];
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
  if (measured.empty()) return out;
  out["least_dentine_mm"] = measured[which].least_wall_mm;
  out["least_dentine_P_mm"] = pointOf(measured[which].thinnest_P_mm);
  return out;
}

nlohmann::ordered_json jsonOf(const std::vector<CanalTooth>& teeth, const Measured& measured) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CanalTooth& tooth : teeth) {
    nlohmann::ordered_json one{{"fdi", tooth.fdi}, {"name", assets::toothName(tooth.fdi)}, {"canals_are", nullptr}};
    nlohmann::ordered_json canals = nlohmann::ordered_json::array();
    if (tooth.canals) {
      one["canals_are"] = tooth.canals->is_modelled ? "modelled" : "built-in";
      for (std::size_t n = 0; n < tooth.canals->canals.size(); ++n)
        canals.push_back(jsonOf(*tooth.canals, n, measured));
    }
    one["remark"] = nullptr;
    if (!tooth.remark.empty()) one["remark"] = tooth.remark;
    one["canals"] = canals;
    list.push_back(one);
  }
  return {{"teeth", list}};
}

Measured measuredIn(const assets::ToothSampler& sampler, const assets::ToothCanals& tooth) {
  const ToothBlocks blocks(sampler);
  Measured all;
  for (std::size_t n = 0; n < tooth.canals.size(); ++n) {
    CanalSections sections(blocks, blocks, tooth.canals[n], furcationSide_P(tooth, n));
    all.push_back(canalOutcomes(sections, 0.0));
  }
  return all;
}

void drawSections(const assets::ToothCanals& tooth, const Measured& measured, calibration::OutputFile& out) {
  std::vector<CanalRow> rows;
  for (std::size_t n = 0; n < measured.size(); ++n)
    rows.push_back({fmt::format("{} {}{}, from the foramen", tooth.fdi, tooth.canals[n].name,
                                tooth.is_modelled ? ", modelled" : ""),
                    measured[n].sections});
  const render::Image picture = sectionPicture(rows);
  calibration::writePng(out.temporaryPath(), {picture.w, picture.h}, picture.rgba);
  out.commit();
}

/// The tooth of --tooth alone.
CanalTooth chosen(const std::vector<CanalTooth>& teeth, int fdi, const std::string& patient) {
  for (const CanalTooth& tooth : teeth) {
    if (tooth.fdi != fdi) continue;
    if (!tooth.canals) throw UsageError(patient + ": " + tooth.remark);
    return tooth;
  }
  throw UsageError(fmt::format("{}: it has no tooth {}, see molar teeth", patient, fdi));
}

int list(const TeethOptions& options) {
  options.patient.refuseUnlessOne("teeth");
  std::optional<calibration::OutputFile> picture;
  if (!options.sections.empty()) picture.emplace(options.sections, options.force);
  const auto jaw = options.patient.builtInJaw();
  const assets::CtVolume ct = jaw && !options.fdi ? assets::CtVolume{} : options.patient.load().ct;
  std::vector<CanalTooth> teeth = jaw ? canalTeeth(*jaw) : canalTeeth(ct);
  if (teeth.empty()) throw UsageError(options.patient.name() + ": no tooth of it has a number, see molar inspect");
  Measured measured;
  if (options.fdi) {
    teeth = {chosen(teeth, *options.fdi, options.patient.name())};
    measured = measuredIn(*fineTooth(ct, jaw, *teeth[0].canals), *teeth[0].canals);
    if (picture) drawSections(*teeth[0].canals, measured, *picture);
  }
  if (options.json) {
    std::printf("%s\n", jsonOf(teeth, measured).dump(2).c_str());
    return 0;
  }
  std::fputs(canalTable(teeth).c_str(), stdout);
  for (std::size_t n = 0; n < measured.size(); ++n)
    std::printf("%s: at least %.2f mm of dentine to 2 mm from the foramen\n", teeth[0].canals->canals[n].name.c_str(),
                measured[n].least_wall_mm);
  return 0;
}

}  // namespace

void addTeeth(CommandLine& molar) {
  auto options = std::make_shared<TeethOptions>();
  CommandLine& command = molar.command("teeth", "The teeth whose root canals can be treated, with their canals");
  command.example("molar teeth --case usual", "those of a built-in patient");
  command.example("molar teeth --case usual --tooth 46 --sections F.png", "the dentine around the canals of one");
  options->patient.addTo(command);
  Option tooth =
      command.option("--tooth", options->fdi, "FDI number: this one alone, with the dentine around its canals");
  command.option("--sections", options->sections, "Image, .png: sections 1, 3, 5 and 7 mm from each foramen")
      .needs(tooth);
  command.flag("--force", options->force, "Replace the output if it exists");
  command.flag("--json", options->json, "For programs");
  command.footer(
      "Lengths from the orifice on the chamber's floor to the foramen; the working length from the cusp to 0.5 mm "
      "short\n"
      "of the foramen. Schneider: between the canal's upper axis and the line from where it leaves it to the foramen.\n"
      "A scan shows no canals: those of a patient are modelled by rule from its labelled pulp and roots, and say so.");
  command.does([options] {
    if (!options->sections.empty()) refuseUnlessPng("--sections", options->sections);
    return list(*options);
  });
}

}  // namespace app
