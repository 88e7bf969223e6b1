// What is planned to be cut on this patient: a line on the bone's surface and the direction the bur comes from, found
// by casting rays onto the solid. Beside the crown of the tooth at the site, on the cheek's side, from mesial to
// distal; for a patient without one, on the bone nearest to where one looks that the surgeon's eye sees. Frame P.
// Start-up only; milliseconds.
#pragma once

#include <optional>

#include "assets/patient.h"
#include "assets/planned_cut.h"

namespace app {

/// Direction of the dental arch at a tooth, mesial to distal, horizontal, unit: of a third molar, which ends the row,
/// from the middle of its neighbours; of any other the principal axis of where those next to it stand. As a normal arch
/// has it where they do not tell.
glm::dvec3 archDirection_P(const assets::CtVolume& ct, const assets::OperativeSite& site);

/// The buccal trough that bares the tooth. None where no bone lies beside the crown, or the patient has no site.
std::optional<assets::PlannedCut> planBuccalTrough(const assets::Patient& patient, double bur_radius_mm);

/// A cut to practise with. None where no bone is seen within 40 mm.
std::optional<assets::PlannedCut> planOnNearestBone(const assets::Patient& patient, double bur_radius_mm);

enum class CutKind { buccal_trough, nearest_bone };

struct CutPlan {
  assets::PlannedCut cut;
  CutKind kind = CutKind::buccal_trough;
};

/// The trough, or else the cut to practise with: what a hand in numbers works at and what guides show.
std::optional<CutPlan> plannedCut(const assets::Patient& patient, double bur_radius_mm);

}  // namespace app
