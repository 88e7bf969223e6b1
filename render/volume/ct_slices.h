// CT slices through the bur, or beside it (Frame::slices_beside_bur_P_mm), in three planes: grey values in a bone
// window, carved material marked, moved pieces of tooth with their grey values where they are now, outlines of canal,
// bur and, with its layer, planned cut, a cross at the centre, plane, sides, a scale of 5 mm, the way from bur to
// canal, and the ruler where it passes through. Radiological views: axial from below, coronal from in front, sagittal
// from the patient's left. Frame P (LPS), mm. Plain CPU code; one thread at a time. Cost: below 1 ms a plane of 160 px
// (two or three voxel rows are mixed once per pixel row). The scan's voxels are borrowed. Grey value: level 500, width
// 2500 HU, the usual bone window. Carved: the loss of solid fraction. Not for measuring: the scan is sampled
// trilinearly.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assets/volume_grid.h"
#include "render/frame.h"
#include "render/image.h"
#include "render/volume/bordered_field.h"
#include "render/volume/guide_field.h"

namespace render {

struct PlacedFields;

enum class SlicePlane { axial, coronal, sagittal };
inline constexpr std::array kSlicePlanes{SlicePlane::axial, SlicePlane::coronal, SlicePlane::sagittal};

/// The scan, as far as the slices need it; its voxels are borrowed.
struct CtScan {
  std::span<const std::int16_t> hounsfield;       ///< in the order of the grid
  std::span<const std::uint8_t> solid;            ///< solid fraction before carving
  std::vector<glm::dvec3> mandibular_canal_P_mm;  ///< centre line of the mandibular canal, or empty
  double mandibular_canal_radius_mm = 1.4;
};

class CtSlices {
 public:
  static constexpr double kWidth_mm = 24.0;  ///< of the region that an image shows

  /// Throws GpuError if the scan does not fit the grid.
  CtSlices(const assets::VolumeGrid& grid, CtScan scan);

  /// A square image of `edge_px`; `live`: the current bone; `guides`: of the planned cut, null: none; `moved`: pieces
  /// that are not in `live`.
  Image image(SlicePlane plane, const Frame& frame, const BorderedField<std::uint8_t>& live, int edge_px,
              const GuideField* guides = nullptr, std::span<const PlacedFields> moved = {}) const;

 private:
  assets::VolumeGrid grid_;
  CtScan scan_;
};

/// From the bur's surface to the wall of the mandibular canal, 0 where they touch; none where no canal is known.
std::optional<double> canalDistance_mm(const Frame& frame, const CtScan& scan);

}  // namespace render
