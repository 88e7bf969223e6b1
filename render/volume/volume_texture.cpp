#include "render/volume/volume_texture.h"

#include "assets/ct_volume.h"
#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

constexpr int kFramesBetweenRebuilds = 60;

template <class T>
void upload(Texture& texture, const BorderedField<T>& field, const VoxelBox& box) {
  texture.upload(box.first, box.extent, reinterpret_cast<const std::byte*>(field.at(box.first)),
                 static_cast<int>(field.layout().row), static_cast<int>(field.layout().slice / field.layout().row));
}

template <class T>
VoxelBox whole(const BorderedField<T>& field) {
  return {glm::ivec3(0), field.layout().size};
}

}  // namespace

VolumeTexture::VolumeTexture(const VolumeFields& fields)
    : solid_(Texture::volume(fields.grid().size, TexelFormat::r16)),
      smooth_(Texture::volume(fields.grid().size, TexelFormat::r16)),
      appearance_(Texture::volume(fields.grid().size, TexelFormat::rgba8)),
      label_(Texture::volume(fields.grid().size, TexelFormat::r8ui)),
      emptiness_(Texture::volume(fields.grid().bricks(), TexelFormat::r8ui)),
      ambient_(Texture::volume(fields.ambient().layout().size, TexelFormat::r16)),
      occupancy_(fields.solid(), assets::kBrickVoxels, assets::kHalfSolid) {
  // Slice by slice, to limit the working memory.
  for (int k = 0; k < fields.grid().size.z; ++k)
    uploadSolid(fields, {{0, 0, k}, {fields.grid().size.x, fields.grid().size.y, 1}});
  upload(smooth_, fields.smooth(), whole(fields.smooth()));
  upload(appearance_, fields.appearance(), whole(fields.appearance()));
  upload(label_, fields.label(), whole(fields.label()));
  upload(ambient_, fields.ambient(), whole(fields.ambient()));
  emptiness_.upload({0, 0, 0}, occupancy_.bricks(), std::as_bytes(occupancy_.emptiness()));
}

void VolumeTexture::uploadSolid(const VolumeFields& fields, const VoxelBox& box) {
  wide_.resize(box.count());
  std::size_t n = 0;
  for (int k = 0; k < box.extent.z; ++k)
    for (int j = 0; j < box.extent.y; ++j) {
      const std::uint8_t* const row = fields.solid().at(box.first + glm::ivec3(0, j, k));
      for (int i = 0; i < box.extent.x; ++i) wide_[n++] = static_cast<std::uint16_t>(row[i] * 257);
    }
  solid_.upload(box.first, box.extent, std::as_bytes(std::span(wide_)));
}

// Carving only empties bricks, so stale emptiness is safe; it is recomputed in a frame without changes, or every
// kFramesBetweenRebuilds.
void VolumeTexture::update(const VolumeFields& fields, const FieldChanges& changes) {
  for (const VoxelBox& box : changes.solid) uploadSolid(fields, box);
  for (const VoxelBox& box : changes.smooth) upload(smooth_, fields.smooth(), box);
  for (const VoxelBox& box : changes.ambient) upload(ambient_, fields.ambient(), box);
  for (const VoxelBox& box : changes.tissue) {
    upload(appearance_, fields.appearance(), box);
    upload(label_, fields.label(), box);
  }

  for (const VoxelBox& box : changes.solid) occupancy_.touch(box);
  bool moved = occupancy_.refresh();
  if (changes.solid.empty() || ++frames_since_rebuild_ >= kFramesBetweenRebuilds) {
    moved = occupancy_.rebuildIfStale() || moved;
    frames_since_rebuild_ = 0;
  }
  if (moved) emptiness_.upload({0, 0, 0}, occupancy_.bricks(), std::as_bytes(occupancy_.emptiness()));
}

void VolumeTexture::setGuides(const GuideField& guides) {
  guides_ = Texture::volume(guides.layout().size, TexelFormat::rg16);
  upload(guides_, guides, whole(guides));
}

// The box of a tooth stays as large as it is: its texture is kept.
void VolumeTexture::setPaint(const SurfacePaint& paint) {
  const glm::ivec3 size = paint.texels.layout().size;
  const bool fits = size == paint_size_;
  paint_low_ = paint.low, paint_size_ = size;
  if (size.x <= 0) return;
  if (!fits) paint_ = Texture::volume(size, TexelFormat::rgba8);
  upload(paint_, paint.texels, whole(paint.texels));
}

void VolumeTexture::bind() const {
  solid_.bind(SOLID_UNIT);
  smooth_.bind(SMOOTH_UNIT);
  appearance_.bind(APPEARANCE_UNIT);
  label_.bind(LABEL_UNIT);
  emptiness_.bind(EMPTINESS_UNIT);
  ambient_.bind(AMBIENT_UNIT);
  if (hasGuides()) guides_.bind(GUIDE_UNIT);
  if (paint_size_.x > 0) paint_.bind(PAINT_UNIT);
}

}  // namespace render
