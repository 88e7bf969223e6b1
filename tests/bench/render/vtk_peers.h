// VTK's ways to draw the same volume, for comparison alone: FixedPoint ray casting (DVR on the CPU), Flying Edges with
// triangles through OpenGL, and the GPU mapper. One window each, off screen; a frame ends with one pixel read back.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "assets/volume_grid.h"
#include "render/display/camera.h"

namespace bench {

class VtkPeer {
 public:
  enum class Kind { fixed_point, triangles, gpu_dvr, gpu_iso };

  /// The values are borrowed and may change: then call edited().
  VtkPeer(Kind kind, const assets::VolumeGrid& grid, std::span<std::int16_t> hounsfield, glm::ivec2 px);
  ~VtkPeer();

  void edited();
  /// One eye, its place beside the camera in mm to the right.
  void draw(const render::Camera& camera, double aside_mm);
  /// Off what was drawn last, RGB, rows bottom first.
  std::vector<std::uint8_t> picture();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bench
