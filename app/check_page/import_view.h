// What a scan that is being imported looks like, while it is worked on: axial, coronal and sagittal slices of its grey
// values as soon as they are read, with what has been found so far in colours. A coarser copy is kept (256 voxels
// along the longest edge), so that the import goes on with its own. Frame P, mm. Any thread; 30 ms to take a scan of
// 512 voxels, or what was found in it, 3 ms for the pictures.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "assets/ct_volume.h"
#include "assets/segment/jaw_segmentation.h"
#include "render/image.h"

namespace app {

class ImportView {
 public:
  enum Slice : std::uint8_t { axial, coronal, sagittal };
  static constexpr std::size_t kSlices = 3;

  // The thread that works:
  void takeGrey(const assets::VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield);
  void takeJaw(const assets::JawSoFar& jaw);

  // The one that shows:
  /// Of those sizes; none: there are no grey values yet.
  std::optional<std::array<render::Image, kSlices>> pictures(const std::array<glm::ivec2, kSlices>& px) const;
  /// Through the slices; from then on they stay where they were put.
  void turn(Slice slice, double notches);
  /// Counts what was taken or turned: the pictures differ.
  std::uint64_t changes() const;

 private:
  mutable std::mutex guard_;
  assets::CtVolume coarse_;         ///< grey values alone
  std::vector<std::uint8_t> what_;  ///< as jaw_views.h
  assets::VolumeGrid scan_;
  int every_ = 1;  ///< voxels of the scan along an edge
  glm::dvec3 at_P_mm_{0.0};
  bool is_turned_ = false;
  std::uint64_t changes_ = 0;
};

}  // namespace app
