// Which teeth a labelled scan tells apart, and where one of them lies as the site of an operation.
// A scan whose labels mark one tooth only (enamel, dentine and pulp, no numbers) marks a lower third molar. Its side:
// the patient's right is -x in LPS, but a cropped scan's origin says nothing about the midline; the front teeth do: a
// right molar lies to the right of the most anterior teeth, or of the most anterior bone. Frame P, mm. Any thread; a
// pass over the labels, about 2 ns a voxel.
#pragma once

#include <map>
#include <optional>

#include "assets/ct_volume.h"
#include "assets/operative_site.h"

namespace assets {

/// Numbers the enamel, dentine and pulp of a scan without numbers 38 or 48; nothing if they are less than 10 mm3.
void numberThirdMolar(CtVolume& ct);

/// mm3 of the voxels of every tooth that is told apart, by its number.
std::map<int, double> toothVolumes_mm3(const CtVolume& ct);

/// Centroid of the tooth's enamel, dentine and undivided hard tissue, and its axis (tooth_axis.h); none if that is less
/// than 10 mm3.
std::optional<OperativeSite> siteAtTooth(const CtVolume& ct, int fdi);

}  // namespace assets
