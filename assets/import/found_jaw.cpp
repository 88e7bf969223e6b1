#include "assets/import/found_jaw.h"

#include <algorithm>
#include <string>
#include <utility>

#include "assets/import/lower_jaw.h"
#include "assets/import/modelled_gum.h"
#include "assets/import/shading.h"
#include "assets/import/tissue_from_grey.h"
#include "assets/import/tooth_site.h"
#include "assets/tooth.h"

namespace assets {

std::vector<std::int16_t> greyToSearch(const CtVolume& ct) {
  std::vector<std::int16_t> flat = ct.hounsfield;
  flattenShading(ct.grid, flat);
  return flat;
}

FoundJaw takeLabels(JawSegmentation found, CtVolume& ct) {
  const std::vector<std::size_t> gum = modelledGum(ct.grid, ct.hounsfield, found.label, found.tooth);
  ct.label = labelsFromGrey(ct.grid, ct.hounsfield);
  for (std::size_t v = 0; v < ct.label.size(); ++v) {
    if (found.label[v] != 0)
      ct.label[v] = found.label[v];
    else if (isToothPart(ct.label[v]))
      ct.label[v] = static_cast<std::uint8_t>(Tissue::other_teeth);
  }
  for (const std::size_t v : gum)
    if (ct.label[v] == 0) ct.label[v] = static_cast<std::uint8_t>(Tissue::gingiva);
  ct.tooth = std::move(found.tooth);
  return {found.levels, std::move(found.teeth), std::move(found.canals), !gum.empty()};
}

const CanalProposal* canalBeside(const std::vector<CanalProposal>& canals, const std::optional<OperativeSite>& site) {
  for (const CanalProposal& canal : canals)
    if (!site || canal.is_right == isRight(site->fdi)) return &canal;
  return nullptr;
}

bool isTold(const FoundJaw& jaw, int fdi) {
  return std::ranges::any_of(jaw.teeth, [fdi](const FoundTooth& tooth) { return tooth.told_fdi == fdi; });
}

void takeCanal(const FoundJaw& jaw, Patient& patient) {
  const CanalProposal* const canal = canalBeside(jaw.canals, patient.site);
  patient.mandibular_canal_P_mm = canal != nullptr ? canal->line_P_mm : std::vector<glm::dvec3>{};
  if (canal != nullptr) patient.mandibular_canal_radius_mm = canal->radius_mm;
  patient.found = Confirmation{patient.site && isTold(jaw, patient.site->fdi), canal != nullptr && canal->is_confirmed};
}

void takeFoundJaw(JawSegmentation found, Patient& patient) {
  const FoundJaw jaw = takeLabels(std::move(found), patient.ct);
  labelPartialVoxels(patient.ct);
  const std::optional<OperativeSite> before = std::exchange(patient.site, std::nullopt);
  for (const int fdi : {before ? before->fdi : 48, 48, 38})
    if (!patient.site) patient.site = siteAtTooth(patient.ct, fdi);
  takeCanal(jaw, patient);
  patient.has_modelled_gum = jaw.has_gum;
  if (patient.site)
    patient.jaw_P_mm = patient.site->centre_P_mm;
  else
    patient.jaw_P_mm = lowerJawCentre_P_mm(patient.ct, patient.mandibular_canal_P_mm).value_or(patient.jaw_P_mm);
  // A title that its owner wrote stays.
  if (patient.title == titleOf(before)) patient.title = titleOf(patient.site);
}

std::string titleOf(const std::optional<OperativeSite>& site) {
  return site ? "imported scan, " + toothName(site->fdi) + " (" + std::to_string(site->fdi) + ")"
              : "imported scan, site unknown";
}

}  // namespace assets
