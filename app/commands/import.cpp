// `molar import SOURCE --out PATIENT` and `molar inspect PATIENT`: scans become patient folders, de-identified.

#include <cstdio>
#include <memory>
#include <numeric>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/commands/number_range.h"
#include "assets/gum_surface.h"
#include "assets/import/scan_import.h"
#include "assets/patient_folder.h"

namespace app {
namespace {

struct ImportOptions {
  std::string source, out;
  assets::Classification classification;
  bool force = false;
};

struct InspectOptions {
  std::string patient;
  bool json = false;
};

using Volumes_mm3 = std::array<double, assets::kTissueCount>;

Volumes_mm3 tissueVolumes(const assets::CtVolume& ct) {
  std::array<std::uint64_t, assets::kTissueCount> voxels{};
  for (const std::uint8_t label : ct.label) ++voxels[label < assets::kTissueCount ? label : 0];
  Volumes_mm3 volumes{};
  for (std::size_t l = 0; l < volumes.size(); ++l)
    volumes[l] = static_cast<double>(voxels[l]) * ct.grid.voxelVolume_mm3();
  return volumes;
}

double canalLength_mm(const assets::Patient& patient) {
  double length = 0.0;
  for (std::size_t i = 1; i < patient.canal_P_mm.size(); ++i)
    length += glm::distance(patient.canal_P_mm[i - 1], patient.canal_P_mm[i]);
  return length;
}

std::size_t triangles(const assets::MeshModel& model) {
  std::size_t count = 0;
  for (const assets::MeshPart& part : model.parts) count += part.triangles.size() / 3;
  return count;
}

nlohmann::json jsonOf(const assets::Patient& patient) {
  using nlohmann::json;
  const auto list = [](const auto& v) { return json{v.x, v.y, v.z}; };
  const assets::VolumeGrid& grid = patient.ct.grid;
  json tissues = json::object();
  const Volumes_mm3 volumes = tissueVolumes(patient.ct);
  for (std::size_t l = 1; l < volumes.size(); ++l) tissues[std::string(assets::kTissues[l].key)] = volumes[l];
  json out{{"title", patient.title},
           {"size", list(grid.size)},
           {"spacing_mm", grid.spacing_mm},
           {"origin_P_mm", list(grid.origin_P_mm)},
           {"iso_hu", patient.classification.iso_hu},
           {"sigma_hu", patient.classification.sigma_hu},
           {"tissue_mm3", tissues},
           {"canal",
            {{"points", patient.canal_P_mm.size()},
             {"length_mm", canalLength_mm(patient)},
             {"radius_mm", patient.canal_radius_mm}}},
           {"gum_triangles", triangles(patient.gum)},
           {"face_triangles", triangles(patient.face)}};
  if (patient.site.known)
    out["third_molar"] = {{"fdi", patient.site.tooth_fdi},
                          {"centroid_P_mm", list(patient.site.third_molar_P_mm)},
                          {"crown_direction_P", list(patient.site.crown_direction_P)}};
  else
    out["third_molar"] = nullptr;
  return out;
}

void printForPeople(const assets::Patient& patient, std::FILE* out) {
  const assets::VolumeGrid& grid = patient.ct.grid;
  std::fprintf(out, "patient      %s\n", patient.title.c_str());
  std::fprintf(out, "volume       %d x %d x %d voxels of %.3f mm\n", grid.size.x, grid.size.y, grid.size.z,
               grid.spacing_mm);
  if (patient.site.known)
    std::fprintf(out, "third molar  FDI %d at (%.1f, %.1f, %.1f) mm\n", patient.site.tooth_fdi,
                 patient.site.third_molar_P_mm.x, patient.site.third_molar_P_mm.y, patient.site.third_molar_P_mm.z);
  else
    std::fputs("third molar  not labelled in this scan\n", out);
  const Volumes_mm3 volumes = tissueVolumes(patient.ct);
  for (std::size_t l = 1; l < volumes.size(); ++l)
    if (volumes[l] > 0.0)
      std::fprintf(out, "  %-16s %9.1f mm³\n", std::string(assets::kTissues[l].name).c_str(), volumes[l]);
  if (!patient.canal_P_mm.empty())
    std::fprintf(out, "canal        %.1f mm long, radius %.1f mm\n", canalLength_mm(patient), patient.canal_radius_mm);
}

int import(const ImportOptions& options) {
  assets::Patient patient = assets::importScan(options.source, options.classification);
  patient.gum = assets::gumSurface(patient.ct, patient.site);
  assets::savePatient(patient, options.out, options.force);
  printForPeople(patient, stderr);
  return 0;
}

int inspect(const InspectOptions& options) {
  const assets::Patient patient = assets::loadPatient(options.patient);
  if (options.json)
    std::printf("%s\n", jsonOf(patient).dump(2).c_str());
  else
    printForPeople(patient, stdout);
  return 0;
}

}  // namespace

void addImport(CLI::App& molar, Chosen& chosen) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* command = molar.add_subcommand("import", "A scan becomes a patient folder, de-identified");
  command->add_option("SOURCE", options->source, "Folder with ct.nrrd and labels.nrrd, or one volume file")->required();
  command->add_option("--out", options->out, "Patient folder to write")->required();
  command->add_option("--iso", options->classification.iso_hu, "Grey value of the bone's surface, HU")
      ->check(numberRange(-1000.0, 4000.0))
      ->capture_default_str();
  command->add_option("--sigma", options->classification.sigma_hu, "Width of the soft transition, HU")
      ->check(numberRange(1.0, 2000.0))
      ->capture_default_str();
  command->add_flag("--force", options->force, "Replace the patient folder if it exists");
  command->callback([options, &chosen] { chosen.action = [options] { return import(*options); }; });
}

void addInspect(CLI::App& molar, Chosen& chosen) {
  auto options = std::make_shared<InspectOptions>();
  CLI::App* command = molar.add_subcommand("inspect", "What a patient folder holds");
  command->add_option("PATIENT", options->patient, "Patient folder")->required();
  command->add_flag("--json", options->json, "For programs");
  command->callback([options, &chosen] { chosen.action = [options] { return inspect(*options); }; });
}

}  // namespace app
