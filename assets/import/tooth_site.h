// Numbered teeth of a labelled scan, and one of them as the operative site.
// A scan with one labelled tooth (enamel, dentine, pulp) and no numbers shows a lower third molar. Its side: a cropped
// scan's origin says nothing about the midline, so the molar is right if it lies to the right of the most anterior
// teeth, or else bone, at least 5 mm in front of it. Frame P, mm. Any thread; a pass over the labels, about 2 ns a
// voxel.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/operative_site.h"

namespace assets {

/// Voxels per value.
std::array<std::size_t, 256> countsOf(std::span<const std::uint8_t> values);

/// Enamel, dentine and pulp of all teeth.
double labelledTeeth_mm3(const CtVolume& ct);

/// none: less than 10 mm3; too_large: above 3000 mm3, more than one tooth.
enum class ThirdMolar { none, numbered, too_large, of_unknown_side };

/// Numbers enamel, dentine and pulp 38 or 48 in a scan without numbers; `requested_fdi` decides if the scan shows no
/// side.
ThirdMolar numberThirdMolar(CtVolume& ct, const std::optional<int>& requested_fdi = std::nullopt);

/// Volume of every numbered tooth, by number.
std::map<int, double> toothVolumes_mm3(const CtVolume& ct);

/// Numbers of the teeth valid for siteAtTooth: at least 10 mm3 of hard tissue.
std::vector<int> siteCandidates(const CtVolume& ct);

/// Centroid of the tooth's hard tissue and its axis (tooth_axis.h); none below 10 mm3.
std::optional<OperativeSite> siteAtTooth(const CtVolume& ct, int fdi);

}  // namespace assets
