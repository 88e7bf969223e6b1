// The planned cut of a patient: a line on the bone's surface and the direction of the bur, found by casting rays onto
// the solid. It lies buccally of the operated tooth's crown, from mesial to distal; without a tooth, on the nearest
// bone that the surgeon sees. Frame P. Start-up only; milliseconds.
#pragma once

#include <optional>

#include "assets/patient.h"
#include "assets/planned_cut.h"

namespace app {

/// Direction of the dental arch at a tooth, mesial to distal, horizontal, unit. Of a third molar: from the centroid of
/// its neighbours; of other teeth: the principal axis of their neighbours. That of a normal arch if these give none.
glm::dvec3 archDirection_P(const assets::CtVolume& ct, const assets::OperativeSite& site);

/// The buccal trough that exposes the tooth. None without bone next to the crown, or without a site.
std::optional<assets::PlannedCut> planBuccalTrough(const assets::Patient& patient, double bur_radius_mm);

enum class CutKind { buccal_trough, nearest_bone };

struct CutPlan {
  assets::PlannedCut cut;
  CutKind kind = CutKind::buccal_trough;
};

/// The trough, or else a practice cut on visible bone within 40 mm: followed by scripted input and shown as guide.
std::optional<CutPlan> plannedCut(const assets::Patient& patient, double bur_radius_mm);

}  // namespace app
