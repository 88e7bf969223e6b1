// Which teeth a labelled scan tells apart, and where one of them lies as the site of an operation.
// A scan whose labels mark one tooth only (enamel, dentine and pulp, no numbers) marks a lower third molar. Its side:
// the patient's right is -x in LPS, but a cropped scan's origin says nothing about the midline; the front teeth do: a
// right molar lies to the right of the most anterior teeth, or else of the most anterior bone, if that lies at least 5
// mm in front of the molar. Frame P, mm. Any thread; a pass over the labels, about 2 ns a voxel.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/operative_site.h"

namespace assets {

/// mm3 of the enamel, dentine and pulp of all teeth.
double labelledTeeth_mm3(const CtVolume& ct);

/// What became of the marked tooth. none: less than 10 mm3; too_large: above 3000 mm3, no single tooth.
enum class ThirdMolar { none, numbered, too_large, of_unknown_side };

/// Numbers the enamel, dentine and pulp of a scan without numbers 38 or 48. `asked_fdi`, if it is one of these, says
/// which where the scan does not.
ThirdMolar numberThirdMolar(CtVolume& ct, const std::optional<int>& asked_fdi = std::nullopt);

/// mm3 of the voxels of every tooth that is told apart, by its number.
std::map<int, double> toothVolumes_mm3(const CtVolume& ct);

/// The numbers of those that siteAtTooth takes: with at least 10 mm3 of hard tissue.
std::vector<int> siteCandidates(const CtVolume& ct);

/// Centroid of the tooth's enamel, dentine and undivided hard tissue, and its axis (tooth_axis.h); none if that is less
/// than 10 mm3.
std::optional<OperativeSite> siteAtTooth(const CtVolume& ct, int fdi);

}  // namespace assets
