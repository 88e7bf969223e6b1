// The product's CPU ray caster with the bench's plain appearance: fields, cells, rays, casting; everything of
// CpuSceneRenderer but meshes, theatre light and display. One thread per core but one, as there.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "assets/instruction_set.h"
#include "assets/volume_grid.h"
#include "render/cpu/solid_cells.h"
#include "render/cpu/volume_cast.h"
#include "render/display/camera.h"
#include "render/display/eye_projection.h"
#include "render/frame.h"
#include "render/volume/volume_fields.h"

namespace bench {

class CpuView {
 public:
  CpuView(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid);

  /// Linear light, rows bottom first.
  struct Image {
    glm::ivec2 px{0};
    std::vector<float> r, g, b;
  };
  void draw(const render::Camera& camera, render::Eye eye, render::ViewMode mode, Image& image) const;
  void updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, render::Occupancy::kBrickValues> values) {
    fields_.updateBrick(brick, values);
  }
  /// After an edit.
  void prepare();

  assets::InstructionSet set = assets::chosenInstructionSet();
  bool skip_empty_space = true;
  const render::SolidCells& cells() const { return cells_; }

 private:
  render::VolumeFields fields_;
  render::SolidCells cells_;
};

}  // namespace bench
