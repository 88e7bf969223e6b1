// Canals for a scanned tooth, modelled by rule: a scan's voxels of 0.1 to 0.4 mm hold none. From the pulp's labelled
// chamber through the middle of each root (root_course.h) to a foramen beside its apex; numbers of canals and radii
// from the kind of tooth (reference/sisters 3.2), narrower where the root leaves less than 0.5 mm of dentine. And the
// tooth itself on a fine grid: shell, enamel and chamber by the smoothed distance to its labels. Frame P, mm. Any
// thread but the servo; some 0.2 s a tooth.
#pragma once

#include <memory>

#include "assets/ct_volume.h"
#include "assets/scan/fine_tooth.h"

namespace assets {

/// Throws LoadError: no voxel has the number, no pulp is labelled in it, or no root is found.
ToothCanals modelledCanals(const CtVolume& ct, int fdi);

/// The tooth as it is labelled, without canals, to be prepared: it may have no pulp, or no roots. Throws LoadError: no
/// voxel has the number.
ToothCanals unmodelledTooth(const CtVolume& ct, int fdi);

/// `canals`: of modelledCanals() or unmodelledTooth().
std::unique_ptr<ToothSampler> fineScannedTooth(const CtVolume& ct, const ToothCanals& canals,
                                               double spacing_mm = kFineSpacing_mm);

}  // namespace assets
