// `molar see`: one image without a window, as PNG; optionally the distances along the rays and the matrices.

#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/case/case.h"
#include "app/case/gutter_plan.h"
#include "app/case/patient_placement.h"
#include "app/case/patient_source.h"
#include "app/case/trough_plan.h"
#include "app/commands/command.h"
#include "app/options/picture_option.h"
#include "app/options/settings_text.h"
#include "app/options/view_option.h"
#include "app/options/volume_option.h"
#include "app/rehearsal/frame_builder.h"
#include "app/session/field_clarity.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "app/view/panoramic_picture.h"
#include "app/view/patient_renderer.h"
#include "app/view/renderer_choice.h"
#include "assets/patient/patient_folder.h"
#include "assets/scan/image_file.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"
#include "render/frame_renderer.h"
#include "render/gpu/offscreen_context.h"

namespace app {
namespace {

constexpr double kPanoramicZoom = 4.0;
struct SeeOptions {
  VolumeOption volume;
  ViewOption view;
  PictureOption picture;
  std::vector<double> tool_at_mm;
  std::string patient, case_name, out, depth, matrices;
  double opening_mm = assets::kUsualOpening_mm;
  int samples = 2;
  bool bone_only = false, dry = false, panoramic = false, force = false;
};

std::string matricesText(const glm::dmat4& clip_from_P, glm::ivec2 px) {
  std::vector<double> rows;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) rows.push_back(clip_from_P[c][r]);
  return nlohmann::json{{"clip_from_P", rows}, {"size", {px.x, px.y}}}.dump(1) + "\n";
}

assets::Patient patientOf(const SeeOptions& options) {
  if (!options.patient.empty()) return assets::loadPatient(patientNamed(options.patient));
  assets::JawParameters jaw = caseNamed(options.case_name)->jaw;
  jaw.opening_mm = options.opening_mm;
  return builtInPatient(jaw);
}

/// The patient's jaw unrolled along its arch.
int seePanoramic(const SeeOptions& options) {
  if (options.patient.empty() && options.case_name.empty())
    throw UsageError("--panoramic: it shows a patient's CT, use --patient or --case");
  if (!options.depth.empty() || !options.matrices.empty())
    throw UsageError("--panoramic: it is no projection, leave --depth and --matrices out");
  calibration::OutputFile out(options.out, options.force);
  const auto picture = PanoramicPicture::of(patientOf(options));
  if (!picture)
    throw UsageError(options.patient + ", --panoramic: no tooth is numbered, so its arch is not known; " +
                     "import the scan with labels of its teeth");
  std::optional<glm::dvec3> bur_P_mm;
  if (const std::vector<double>& at = options.tool_at_mm; !at.empty()) bur_P_mm = glm::dvec3(at[0], at[1], at[2]);
  const render::Image image = picture->image(kPanoramicZoom, bur_P_mm);
  calibration::writePng(out.temporaryPath(), {image.w, image.h}, image.rgba);
  out.commit();
  return 0;
}

/// As a rehearsal begins: moist at the planned cut, or at the site; a specimen of its own all over.
render::SurgicalField moistField(const assets::Patient& patient, const std::optional<assets::PlannedCut>& cut,
                                 bool of_patient) {
  render::SurgicalField field = surgicalField(FieldClarity({cut ? cut->surface_P_mm : patient.focus_P_mm()}));
  if (!of_patient) field.reach_mm = 0.0;
  return field;
}

int see(const SeeOptions& options) {
  const bool of_patient = !options.patient.empty() || !options.case_name.empty();
  if (options.volume.given() == of_patient)
    throw UsageError("see: give exactly one of --volume FILE, --patient DIR and --case NAME");
  render::Frame frame;
  options.picture.apply(frame);
  if (frame.layers.slices && !of_patient)
    throw UsageError("--layers slices: they show a patient's CT, use --patient or --case");

  // Outputs are claimed before the work.
  calibration::OutputFile out(options.out, options.force);
  std::unique_ptr<calibration::OutputFile> depth;
  std::optional<calibration::OutputFile> matrices;
  if (!options.depth.empty())
    depth.reset(new calibration::OutputFile(assets::nrrdOutput(options.depth, options.force)));
  if (!options.matrices.empty()) matrices.emplace(options.matrices, options.force);

  SolidVolume volume;
  assets::Patient patient;
  render::Guides guides;
  if (!of_patient) {
    volume = options.volume.load();
  } else {
    patient = patientOf(options);
    const auto plan = plannedCut(patient, kUsualBurRadius_mm);
    guides = guidesFor(patient, plan ? std::optional(plan->cut) : std::nullopt);
    volume = {patient.ct.grid, std::move(patient.ct.solid), std::move(patient.ct.label)};
  }
  if (!options.dry) frame.field = moistField(patient, guides.cut, of_patient);
  const render::Eye eye = options.view.apply(frame.rig, volume.grid);
  if (options.view.namesRig() && hasNoPatientPose(frame.rig) && of_patient)
    frame.rig.X_WP = placePatientAtSite(patient, patient.X_PF.value_or(assets::kFaceAxes_PF));
  frame.tool_visible = false;
  if (!options.tool_at_mm.empty())
    frame.X_PT.translation_mm = {options.tool_at_mm[0], options.tool_at_mm[1], options.tool_at_mm[2]};
  else if (patient.site)
    frame.X_PT.translation_mm = patient.site->centre_P_mm;

  std::optional<render::OffscreenContext> context;
  render::RenderOptions how;
  how.backend = rendererWithoutWindow(options.picture.backend(), context, printMessage);
  how.samples = options.samples;
  render::FrameRenderer renderer(volume.grid, volume.solid, volume.label, how);
  renderer.setGuides(guides);
  if (!options.bone_only) {
    renderer.setFace(patient.face);
    renderer.setGingiva(patient.gingiva);
  }
  if (frame.layers.slices)
    renderer.setScan({patient.ct.hounsfield, volume.solid, std::move(patient.mandibular_canal_P_mm),
                      patient.mandibular_canal_radius_mm});
  renderer.renderEye(frame, eye);
  const render::Image image = renderer.readEye(eye);
  const glm::dmat4 clip_from_P = render::clipFromPatient(frame.rig, render::eyeView(frame.rig, eye));
  renderer.throwIfError();

  // All files are written before any is committed.
  calibration::writePng(out.temporaryPath(), {image.w, image.h}, image.rgba);
  if (matrices) matrices->write(matricesText(clip_from_P, frame.rig.screen.px));
  if (depth) {
    const render::DistanceImage distance = renderer.readDistance(eye);
    assets::writeDepth(distance.w, distance.h, distance.mm, *depth);
  }
  if (matrices) matrices->commit();
  out.commit();
  return 0;
}

}  // namespace

void addSee(CommandLine& molar) {
  auto options = std::make_shared<SeeOptions>();
  CommandLine& command = molar.command("see", "One image without a window: PNG, depths, matrices").forEngineers();
  options->volume.addTo(command);
  Option patient = command.option("--patient", options->patient, "Patient folder, instead of --volume");
  patient.valueNamed("DIR");
  Option named =
      command.option("--case", options->case_name, "The same of the built-in patient, see molar rehearse --cases");
  named.oneOf(caseNames()).excludes(patient);
  command.option("--opening", options->opening_mm, kOpeningHelp)
      .from(assets::kLeastOpening_mm, assets::kMostOpening_mm)
      .needs(named);
  options->view.addTo(command);
  options->picture.addTo(command);
  command.option("--samples", options->samples, "Rays along each edge of a pixel, 1 to 4")
      .wholeFrom(1, 4)
      .showsDefault();
  command
      .option("--tool-at", options->tool_at_mm,
              "x,y,z: position of the slices or of the bur, mm in P (default: the operated tooth)")
      .numbers(3)
      .from(-1e4, 1e4);
  command.flag("--panoramic", options->panoramic, "The jaw unrolled along its arch, as dentists read it");
  command.flag("--dry", options->dry, "Tooth and bone dry as a specimen, not moist as in a rehearsal");
  command.flag("--bone-only", options->bone_only, "Without face and gingiva");
  command.option("--out", options->out, "Image, .png").required();
  command.option("--depth", options->depth, "Distances along the rays in mm, .nrrd");
  command.option("--matrices", options->matrices, "clip_from_P and size, .json");
  command.flag("--force", options->force, "Replace outputs that exist");
  command.does([options] {
    refuseUnlessPng("--out", options->out);
    return options->panoramic ? seePanoramic(*options) : see(*options);
  });
}

}  // namespace app
