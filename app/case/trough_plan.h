// The planned cut of a patient: the gutter around the operated tooth's crown (gutter_plan.h), or where there is none a
// straight practice cut on the nearest bone that the surgeon sees, found by casting rays onto the solid. Frame P.
// Start-up only; some tenths of a second.
#pragma once

#include <optional>

#include "assets/patient.h"
#include "assets/planned_cut.h"

namespace app {

/// Direction of the dental arch at a tooth, mesial to distal, horizontal, unit. Of a third molar: from the centroid of
/// its neighbours; of other teeth: the principal axis of their neighbours. That of a normal arch if these give none.
glm::dvec3 archDirection_P(const assets::CtVolume& ct, const assets::OperativeSite& site);

/// Whether voxel `v` belongs to any tooth but the operated one.
bool isOtherTooth(const assets::CtVolume& ct, std::size_t v, int site_fdi);

enum class CutKind { gutter, nearest_bone };

struct CutPlan {
  assets::PlannedCut cut;
  CutKind kind = CutKind::gutter;
};

/// The gutter, or else a practice cut on visible bone within 40 mm: followed by scripted input and shown as guide.
std::optional<CutPlan> plannedCut(const assets::Patient& patient, double bur_radius_mm);

}  // namespace app
