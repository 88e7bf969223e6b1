#include "app/commands/patient_words.h"

#include <array>
#include <cstdint>
#include <optional>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "assets/import/modelled_gum.h"
#include "assets/import/tooth_site.h"
#include "assets/tooth.h"

namespace app {
namespace {

using Volumes_mm3 = std::array<double, assets::kScanTissueCount>;

Volumes_mm3 tissueVolumes(const assets::CtVolume& ct) {
  std::array<std::uint64_t, assets::kScanTissueCount> voxels{};
  for (const std::uint8_t label : ct.label) ++voxels[label < assets::kScanTissueCount ? label : 0];
  Volumes_mm3 volumes{};
  for (std::size_t l = 0; l < volumes.size(); ++l)
    volumes[l] = static_cast<double>(voxels[l]) * ct.grid.voxelVolume_mm3();
  return volumes;
}

double mandibularCanalLength_mm(const assets::Patient& patient) {
  double length = 0.0;
  for (std::size_t i = 1; i < patient.mandibular_canal_P_mm.size(); ++i)
    length += glm::distance(patient.mandibular_canal_P_mm[i - 1], patient.mandibular_canal_P_mm[i]);
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
           {"confirmed", !patient.isProposed()},
           {"size", list(grid.size)},
           {"spacing_mm", grid.spacing_mm},
           {"origin_P_mm", list(grid.origin_P_mm)},
           {"iso_hu", patient.classification.iso_hu},
           {"sigma_hu", patient.classification.sigma_hu},
           {"tissue_mm3", tissues},
           {"mandibular_canal",
            {{"points", patient.mandibular_canal_P_mm.size()},
             {"length_mm", mandibularCanalLength_mm(patient)},
             {"radius_mm", patient.mandibular_canal_radius_mm}}},
           {"gum_triangles", triangles(patient.gingiva)},
           {"gum", patient.has_modelled_gum        ? "modelled"
                   : patient.gingiva.parts.empty() ? "none"
                                                   : "labelled"},
           {"face_triangles", triangles(patient.face)},
           {"face", patient.has_built_in_face    ? "built-in"
                    : patient.face.parts.empty() ? "none"
                                                 : "own"}};
  json teeth = json::array();
  for (const auto& [fdi, volume_mm3] : assets::toothVolumes_mm3(patient.ct))
    teeth.push_back({{"fdi", fdi}, {"name", assets::toothName(fdi)}, {"volume_mm3", volume_mm3}});
  out["teeth"] = teeth;
  out["site"] = out["third_molar"] = nullptr;
  if (!patient.site) return out;
  const assets::OperativeSite& site = *patient.site;
  out["site"] = {{"fdi", site.fdi},
                 {"name", assets::toothName(site.fdi)},
                 {"centre_P_mm", list(site.centre_P_mm)},
                 {"axis_P", list(site.axis_P)}};
  // The name of before any tooth could be the site.
  if (assets::isThirdMolar(site.fdi))
    out["third_molar"] = {
        {"fdi", site.fdi}, {"centroid_P_mm", list(site.centre_P_mm)}, {"crown_direction_P", list(site.axis_P)}};
  return out;
}

std::string wordsOn(const assets::Patient& patient) {
  const assets::VolumeGrid& grid = patient.ct.grid;
  std::string text = fmt::format("patient      {}\nvolume       {} x {} x {} voxels of {:.3f} mm\n",
                                 patient.shownTitle(), grid.size.x, grid.size.y, grid.size.z, grid.spacing_mm);
  if (const auto& site = patient.site)
    text += fmt::format("site         FDI {}, {}, at ({:.1f}, {:.1f}, {:.1f}) mm\n", site->fdi,
                        assets::toothName(site->fdi), site->centre_P_mm.x, site->centre_P_mm.y, site->centre_P_mm.z);
  else
    text += "site         no third molar labelled here\n";
  for (const auto& [fdi, volume_mm3] : assets::toothVolumes_mm3(patient.ct))
    text += fmt::format("  tooth {}         {:9.1f} mm³\n", fdi, volume_mm3);
  const Volumes_mm3 volumes = tissueVolumes(patient.ct);
  for (std::size_t l = 1; l < volumes.size(); ++l)
    if (volumes[l] > 0.0) text += fmt::format("  {:16} {:9.1f} mm³\n", assets::kTissues[l].name, volumes[l]);
  if (!patient.mandibular_canal_P_mm.empty())
    text += fmt::format("canal        {:.1f} mm long, radius {:.1f} mm\n", mandibularCanalLength_mm(patient),
                        patient.mandibular_canal_radius_mm);
  if (patient.has_modelled_gum)
    text += fmt::format("gum          modelled, {:g} mm over the bone: not the patient's\n", assets::kGumThickness_mm);
  text += patient.has_built_in_face    ? "face         built-in, placed by the lower teeth: not the patient's\n"
          : patient.face.parts.empty() ? "face         none\n"
                                       : "face         the patient's\n";
  return text;
}

constexpr std::array kSeals = {"none", "broken", "of another machine", "of this machine"};

nlohmann::json jsonOf(const assets::StatementFacts& statement) {
  return {{"reviewed", statement.is_reviewed},
          {"signature", kSeals[static_cast<std::size_t>(statement.seal)]},
          {"of_this_volume", statement.is_of_volume}};
}

std::string wordsOn(const assets::StatementFacts& statement) {
  return fmt::format("identity     removed by software, {}; statement {}, signature {}\n",
                     statement.is_reviewed ? "pictures reviewed by a person"
                                           : "not reviewed (molar check PATIENT --pictures-reviewed)",
                     statement.is_of_volume ? "of this volume" : "of another volume",
                     kSeals[static_cast<std::size_t>(statement.seal)]);
}

}  // namespace

std::string patientWords(const assets::Patient& patient, const std::optional<assets::StatementFacts>& statement) {
  return wordsOn(patient) + (statement ? wordsOn(*statement) : std::string());
}

std::string patientJson(const assets::Patient& patient, const std::optional<assets::StatementFacts>& statement) {
  nlohmann::json out = jsonOf(patient);
  out["deidentified"] = statement ? jsonOf(*statement) : nlohmann::json(nullptr);
  return out.dump(2) + "\n";
}

}  // namespace app
