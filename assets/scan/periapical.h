// A periapical radiograph: what a film behind the tooth would show of a volume as it is now, in frame P, mm. Parallel
// technique: the film along the tooth, the tube 300 mm away on the cheek's side, turned about the tooth towards mesial
// for the tube shift that parts two canals of one root. Line integrals by Joseph's method (planes across the beam,
// bilinear in each; Joseph 1982, IEEE TMI 1:192). Pure; any thread; some 50 ms on one thread for 41 x 31 mm at 0.1 mm
// (radiograph_bench). Attenuations are ratios to cortical bone at the voltages of dental tubes, our own defaults, no
// measurement.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assets/ct_volume.h"

namespace assets {

struct PeriapicalView {
  glm::dvec3 source_P_mm{0.0};
  glm::dvec3 corner_P_mm{0.0};           ///< middle of the film's top left pixel
  glm::dvec3 right_P{0.0}, down_P{0.0};  ///< unit, along its rows and columns
  glm::ivec2 size_px{0};
  double pixel_mm = 0.1;
  bool mesial_is_right = true;  ///< seen from the tube, as films are mounted
};

/// `shift_deg`: of the tube, towards mesial positive. None where no voxel bears the tooth's number.
std::optional<PeriapicalView> periapicalViewOf(const CtVolume& ct, int fdi, double shift_deg);

/// For every pixel, rows from the top, mm of cortical bone that weaken the beam as much. Outside the volume is air, and
/// so is hard tissue where it is not solid (any more). `share`: of each voxel that counts, 255 all; empty: all.
std::vector<float> radiographOf(const VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                std::span<const std::uint8_t> label, const PeriapicalView& view,
                                std::span<const std::uint8_t> share = {});

}  // namespace assets
