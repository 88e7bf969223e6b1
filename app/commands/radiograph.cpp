// `molar radiograph`: a periapical radiograph of one tooth, of a patient as scanned or of what a session left of it.

#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/core.h>

#include "app/commands/command.h"
#include "app/commands/patient_or_case.h"
#include "app/options/settings_text.h"
#include "app/session/replay.h"
#include "app/session/session_folder.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "app/view/radiograph_picture.h"
#include "assets/scan/fine_radiograph.h"
#include "assets/scan/metal_shadow.h"
#include "assets/synthetic/built_in_teeth.h"
#include "assets/tooth.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"

namespace app {
namespace {

struct RadiographOptions {
  PatientOrCase patient;
  std::string session, out;
  std::optional<double> to_s;
  int fdi = 0;
  double shift_deg = 0.0;
  bool force = false;
};

/// What the beam goes through, and the name of its source for messages.
struct Exposed {
  assets::CtVolume ct;
  std::string name;
  std::optional<assets::JawParameters> jaw;      ///< of a built-in patient, as it was made
  std::vector<assets::MetalFragment> fragments;  ///< of files that broke
};

Exposed exposedOf(const RadiographOptions& options) {
  if (options.session.empty()) {
    options.patient.refuseUnlessOne("radiograph");
    return {options.patient.load().ct, options.patient.name(), options.patient.builtInJaw(), {}};
  }
  BoneAtTime bone = boneAtTime(sessionNamed(options.session), options.to_s);
  for (const std::string& remark : bone.remarks) printMessage(remark);
  return {{bone.start.grid, {}, std::move(bone.start.label), std::move(bone.solid), std::move(bone.start.teeth)},
          options.session,
          std::nullopt,
          std::move(bone.fragments)};
}

/// The canals of a built-in tooth are in it: no voxel of a scan holds them.
std::vector<float> weakening_mm(const Exposed& exposed, const assets::PeriapicalView& view, int fdi) {
  constexpr double kSpacing_mm = 0.08;
  const assets::CtVolume& ct = exposed.ct;
  if (!exposed.jaw || !std::ranges::count(assets::builtInTeeth(*exposed.jaw), fdi))
    return assets::radiographOf(ct.grid, ct.solid, ct.label, view);
  const assets::BuiltInTooth tooth = assets::builtInTooth(*exposed.jaw, fdi);
  return assets::fineRadiographOf(ct, fdi, *assets::fineBuiltInTooth(tooth, ct, kSpacing_mm), view);
}

int expose(const RadiographOptions& options) {
  if (!options.session.empty() && options.patient.isGiven())
    throw UsageError("radiograph: give one of PATIENT, --case NAME and --session SESSION");
  if (!assets::isToothNumber(options.fdi))
    throw UsageError(fmt::format("--tooth {}: give an FDI number, 11 to 48 or 51 to 85", options.fdi));
  calibration::OutputFile out(options.out, options.force);
  const Exposed exposed = exposedOf(options);
  const assets::CtVolume& ct = exposed.ct;
  const auto view = assets::periapicalViewOf(ct, options.fdi, options.shift_deg);
  if (!view)
    throw UsageError(fmt::format("{}: no voxel is labelled as tooth {}, see molar inspect", exposed.name, options.fdi));
  std::vector<float> bone_mm = weakening_mm(exposed, *view, options.fdi);
  assets::addMetal(*view, exposed.fragments, bone_mm);
  const render::Image image = radiographPicture(*view, bone_mm, options.fdi, options.shift_deg);
  calibration::writePng(out.temporaryPath(), {image.w, image.h}, image.rgba);
  out.commit();
  return 0;
}

}  // namespace

void addRadiograph(CommandLine& molar) {
  auto options = std::make_shared<RadiographOptions>();
  CommandLine& command = molar.command("radiograph", "A periapical radiograph of a tooth, as scanned or as carved");
  command.example("molar radiograph --case usual --tooth 46 --shift 20 --out F.png", "the tube shifted to mesial");
  options->patient.addTo(command);
  Option session = command.option("--session", options->session, "What a recorded session left, instead of PATIENT");
  command.option("--to", options->to_s, "As it was at this time of the session, s").from(0.0, 1e9).needs(session);
  command.option("--tooth", options->fdi, "FDI number of the tooth").required();
  command
      .option("--shift", options->shift_deg,
              "Of the tube, degrees, towards mesial positive; parts the canals of a root")
      .from(-30.0, 30.0)
      .showsDefault();
  command.option("--out", options->out, "Image, .png").required();
  command.flag("--force", options->force, "Replace the output if it exists");
  command.footer(
      "The film stands along the tooth, 0.1 mm a pixel, two of the image's each; seen from the tube. Attenuations of\n"
      "enamel, dentine, bone and pulp are ratios of our own, no dose is modelled. Canals thinner than a voxel of the\n"
      "scan are not in it, but those of a built-in patient as it was made are (molar teeth --case).");
  command.does([options] {
    refuseUnlessPng("--out", options->out);
    return expose(*options);
  });
}

}  // namespace app
