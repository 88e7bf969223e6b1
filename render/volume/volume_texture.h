// The volume fields as textures: solid fraction, smoothed copy and ambient map in 16 bits, so that filtering is not
// quantised; appearance, label and emptiness in bytes. Uploads only the boxes that changed. Render thread.
// Cost: 1 to 2 us a brick on a software rasteriser (reference/rendering 1).
#pragma once

#include <cstdint>
#include <vector>

#include "render/gpu/texture.h"
#include "render/volume/guide_field.h"
#include "render/volume/occupancy.h"
#include "render/volume/surface_paint.h"
#include "render/volume/volume_fields.h"

namespace render {

class VolumeTexture {
 public:
  /// Throws GpuError if the volume is too large for the card.
  explicit VolumeTexture(const VolumeFields& fields);

  void update(const VolumeFields& fields, const FieldChanges& changes);
  void setGuides(const GuideField& guides);
  bool hasGuides() const { return guides_.name() != 0; }
  /// Empty texels: none.
  void setPaint(const SurfacePaint& paint);
  glm::ivec3 paintLow() const { return paint_low_; }
  glm::ivec3 paintSize() const { return paint_size_; }
  void bind() const;

 private:
  void uploadSolid(const VolumeFields& fields, const VoxelBox& box);

  Texture solid_, smooth_, appearance_, label_, emptiness_, ambient_, guides_, paint_;
  glm::ivec3 paint_low_{0}, paint_size_{0};  ///< of the texture
  Occupancy occupancy_;
  std::vector<std::uint16_t> wide_;
  int frames_since_rebuild_ = 0;
};

}  // namespace render
