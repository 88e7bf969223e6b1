// `molar export`: bone and teeth as a surface for other programs, STL (mm, LPS) or glTF (metres, y up), from a session,
// a patient or a volume. Prints the parts as JSON on stdout.

#include <cstdio>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/options/volume_option.h"
#include "app/session/replay.h"
#include "app/session/session_folder.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "assets/mesh/bone_surface.h"
#include "assets/mesh/gltf_file.h"
#include "assets/mesh/stl_file.h"
#include "assets/patient/patient_folder.h"
#include "assets/scan/hard_tissue.h"
#include "assets/scenery/face_frame.h"
#include "calibration/output_file.h"

namespace app {
namespace {

using assets::HardTissue;

struct ExportOptions {
  VolumeOption volume;
  std::string session, patient, out, tissue = "all";
  std::optional<double> to_s;
  bool force = false;

  bool isStl() const { return out.ends_with(".stl"); }
};

SolidVolume sourceOf(const ExportOptions& options) {
  if (options.session.empty()) {
    if (options.patient.empty()) return options.volume.load();
    assets::Patient patient = assets::loadPatient(patientNamed(options.patient));
    return {patient.ct.grid, std::move(patient.ct.solid), std::move(patient.ct.label)};
  }
  BoneAtTime bone = boneAtTime(options.session, options.to_s);
  for (const std::string& remark : bone.remarks) printMessage(remark);
  return {bone.start.grid, std::move(bone.solid), std::move(bone.start.label)};
}

assets::Material materialOf(HardTissue tissue) {
  if (tissue == HardTissue::tooth) return {{0.75f, 0.71f, 0.61f, 1.0f}, 0.25f, 0.0f};
  return {{0.74f, 0.63f, 0.47f, 1.0f}, 0.5f, 0.0f};
}

assets::MeshPart surfaceOf(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::string name) {
  return assets::BoneSurface(assets::SolidVoxels::inGridOrder(grid, solid)).mergedMesh(std::move(name));
}

/// One part per requested body. STL has no parts: bone and teeth become one surface.
assets::MeshModel modelOf(const ExportOptions& options, const SolidVolume& volume) {
  assets::MeshModel model_P;
  if (options.tissue == "all" && (options.isStl() || volume.label.empty())) {
    model_P.parts.push_back(surfaceOf(volume.grid, volume.solid, std::string(nameOf(HardTissue::bone))));
    model_P.parts.back().material = materialOf(HardTissue::bone);
  } else {
    for (const HardTissue tissue : {HardTissue::bone, HardTissue::tooth}) {
      if (options.tissue == (tissue == HardTissue::bone ? "tooth" : "bone")) continue;
      const auto solid = assets::solidOf(tissue, volume.grid, volume.solid, volume.label);
      model_P.parts.push_back(surfaceOf(volume.grid, solid, std::string(nameOf(tissue))));
      model_P.parts.back().material = materialOf(tissue);
    }
  }
  std::erase_if(model_P.parts, [](const assets::MeshPart& part) { return part.triangles.empty(); });
  if (model_P.parts.empty())
    throw UsageError("--tissue " + options.tissue + ": none in this volume, check its labels or use all");
  return model_P;
}

/// Enclosed volume, by the divergence theorem about the first vertex.
double enclosed_mm3(const assets::MeshPart& part) {
  const glm::dvec3 about = part.position_mm[part.triangles[0]];
  double six_fold_mm3 = 0.0;
  for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t n) { return glm::dvec3(part.position_mm[part.triangles[t + n]]) - about; };
    six_fold_mm3 += glm::dot(corner(0), glm::cross(corner(1), corner(2)));
  }
  return six_fold_mm3 / 6.0;
}

int exportSurface(const ExportOptions& options) {
  const int sources = !options.session.empty() + !options.patient.empty() + options.volume.given();
  if (sources != 1) throw UsageError("export: give exactly one of SESSION, --patient DIR and --volume FILE");
  if (options.to_s && options.session.empty()) throw UsageError("--to: only a session has a time, give one");
  if (!options.isStl() && !options.out.ends_with(".glb"))
    throw UsageError("--out " + options.out + ": surfaces are STL or glTF, end the name in .stl or .glb");

  // The output is claimed before the work.
  calibration::OutputFile out(options.out, options.force);
  const assets::MeshModel model_P = modelOf(options, sourceOf(options));
  nlohmann::json parts = nlohmann::json::array();
  for (const assets::MeshPart& part : model_P.parts)
    parts.push_back({{"name", part.name},
                     {"vertices", part.position_mm.size()},
                     {"triangles", part.triangles.size() / 3},
                     {"enclosed_mm3", enclosed_mm3(part)}});
  if (options.isStl())
    assets::writeStl(model_P, out);
  else
    assets::writeGltf(assets::modelInFaceFrame(model_P), out);
  std::printf("%s\n", nlohmann::json{{"parts", parts}}.dump(2).c_str());
  return 0;
}

}  // namespace

void addExport(CommandLine& molar) {
  auto options = std::make_shared<ExportOptions>();
  CommandLine& command = molar.command("export", "Bone and teeth as a surface, .stl (mm, LPS) or .glb (metres)");
  command.option("SESSION", options->session, "Session file, or last: the bone at its end");
  command.option("--to", options->to_s, "At this time, s").from(0.0, 1e9);
  command.option("--patient", options->patient, "Patient folder, instead of SESSION").valueNamed("DIR");
  options->volume.addTo(command);
  command.option("--tissue", options->tissue, "all, bone or tooth").oneOf({"all", "bone", "tooth"}).showsDefault();
  command.option("--out", options->out, "Surface, .stl or .glb").required();
  command.flag("--force", options->force, "Replace the output if it exists");
  command.does([options] {
    options->session = sessionNamed(options->session);
    return exportSurface(*options);
  });
}

}  // namespace app
