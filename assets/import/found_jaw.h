// What was found in a scan without labels (segment/jaw_segmentation.h), taken over into a patient: labels and tooth
// numbers, hard tissue elsewhere by grey value, site, canal, and what of it a person has confirmed. `molar import` and
// `molar check` make the same patient of the same clicks. Frame P, mm. Any thread but the servo; 2 s for 512^3.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/patient.h"
#include "assets/segment/jaw_segmentation.h"

namespace assets {

struct FoundJaw {
  GreyLevels levels;
  std::vector<FoundTooth> teeth;
  std::vector<CanalProposal> canals;
  bool has_gum = false;  ///< modelled (modelled_gum.h)
};

/// Grey values as jaws are looked for in them: without shading.
std::vector<std::int16_t> greyToSearch(const CtVolume& ct);

/// Labels and tooth numbers of the volume, gum among them.
FoundJaw takeLabels(JawSegmentation found, CtVolume& ct);

/// The canal on the site's side, without a site the first; none there.
const CanalProposal* canalBeside(const std::vector<CanalProposal>& canals, const std::optional<OperativeSite>& site);
/// Whether a person gave the tooth its number.
bool isTold(const FoundJaw& jaw, int fdi);
/// Canal and confirmation of a patient whose site is known.
void takeCanal(const FoundJaw& jaw, Patient& patient);

/// All of it, into a patient that was imported before: its operated tooth stays where it is still found, else it is a
/// third molar, or none.
void takeFoundJaw(JawSegmentation found, Patient& patient);

std::string titleOf(const std::optional<OperativeSite>& site);

}  // namespace assets
