// `molar radiograph`: a periapical radiograph of one tooth, of a patient as scanned or of what a session left of it.

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "app/case/patient_source.h"
#include "app/commands/command.h"
#include "app/commands/patient_or_case.h"
#include "app/options/settings_text.h"
#include "app/review/treatment_films.h"
#include "app/session/replay.h"
#include "app/session/session_folder.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "app/view/radiograph_picture.h"
#include "assets/scan/fine_radiograph.h"
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
  std::optional<assets::JawParameters> jaw;  ///< of a built-in patient, as it was made
};

/// `bone`: of the session; none: of a patient.
Exposed exposedOf(const RadiographOptions& options, std::optional<BoneAtTime>& bone) {
  if (!bone) {
    options.patient.refuseUnlessOne("radiograph");
    return {options.patient.load().ct, options.patient.name(), options.patient.builtInJaw()};
  }
  StoredStart& start = bone->start;
  return {{start.grid, {}, std::move(start.label), std::move(bone->solid), std::move(start.teeth)},
          options.session,
          std::nullopt};
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

void save(const render::Image& image, calibration::OutputFile& out) {
  calibration::writePng(out.temporaryPath(), {image.w, image.h}, image.rgba);
  out.commit();
}

UsageError noSuchTooth(const std::string& name, int fdi) {
  return UsageError(fmt::format("{}: no voxel is labelled as tooth {}, see molar inspect", name, fdi));
}

/// Of a root canal treatment: the one tooth, within its jaw where that is built in.
render::Image filmOfTreated(const RadiographOptions& options, const BoneAtTime& bone) {
  const SessionSetup& setup = bone.start.setup;
  if (setup.canals->fdi != options.fdi)
    throw UsageError(fmt::format("--tooth {}: {} is a treatment of tooth {}, give that", options.fdi, options.session,
                                 setup.canals->fdi));
  std::optional<assets::CtVolume> jaw;
  if (setup.built_in) jaw = builtInPatient(*setup.built_in).ct;
  auto film = treatmentFilm(bone.start, {bone.solid, bone.fragments, bone.laid ? &*bone.laid : nullptr},
                            jaw ? &*jaw : nullptr, options.shift_deg);
  if (!film) throw noSuchTooth(options.session, options.fdi);
  return std::move(*film);
}

int expose(const RadiographOptions& options) {
  if (!options.session.empty() && options.patient.isGiven())
    throw UsageError("radiograph: give one of PATIENT, --case NAME and --session SESSION");
  if (!assets::isToothNumber(options.fdi))
    throw UsageError(fmt::format("--tooth {}: give an FDI number, 11 to 48 or 51 to 85", options.fdi));
  calibration::OutputFile out(options.out, options.force);
  std::optional<BoneAtTime> bone;
  if (!options.session.empty()) {
    bone = boneAtTime(sessionNamed(options.session), options.to_s);
    for (const std::string& remark : bone->remarks) printMessage(remark);
    if (bone->start.setup.canals) {
      save(filmOfTreated(options, *bone), out);
      return 0;
    }
  }
  const Exposed exposed = exposedOf(options, bone);
  const assets::CtVolume& ct = exposed.ct;
  const auto view = assets::periapicalViewOf(ct, options.fdi, options.shift_deg);
  if (!view) throw noSuchTooth(exposed.name, options.fdi);
  save(radiographPicture(*view, weakening_mm(exposed, *view, options.fdi), options.fdi, options.shift_deg), out);
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
