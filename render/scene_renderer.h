// What stands behind FrameRenderer: one way of drawing the scene, in OpenGL (GlSceneRenderer) or on the CPU
// (CpuSceneRenderer). Both draw the same picture from the same values; the GLSL in render/shaders is the specification.
// Render thread. Errors: GpuError.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/mesh.h"
#include "render/display/eye_projection.h"
#include "render/frame.h"
#include "render/gpu/window_place.h"
#include "render/picture.h"
#include "render/volume/guide_field.h"
#include "render/volume/occupancy.h"
#include "render/volume/volume_fields.h"

namespace render {

/// Besides the one or two of the display: what those see who stand by.
inline constexpr int kBystanderOutput = 2;

/// A small picture laid over every eye at one place, so that it lies on the screen itself.
struct Inset {
  Picture picture;
  glm::ivec2 first_px{0}, size_px{0};  ///< of the eye's picture, from its top left
};

class SceneRenderer {
 public:
  SceneRenderer() = default;
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;
  virtual ~SceneRenderer() = default;

  virtual void setFace(const assets::MeshModel& face_P) = 0;
  virtual void setGum(const assets::MeshModel& gum_P) = 0;
  virtual void setInstrument(const assets::MeshModel& instrument_T) = 0;
  virtual void setSecondInstrument(const assets::MeshModel& instrument_O) = 0;
  virtual void setGuides(const Guides& guides) = 0;
  virtual void updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> solid) = 0;

  /// Laid over the eyes that are drawn from now on.
  virtual void setInsets(std::vector<Inset> insets) = 0;
  virtual const VolumeFields& fields() const = 0;

  /// Once per frame, before its eyes: what was carved since becomes drawable.
  virtual void prepare(const Frame& frame) = 0;
  /// One eye, in linear light, `px` large; kept until it is drawn again.
  virtual void drawEye(const Frame& frame, Eye eye, glm::ivec2 px) = 0;
  /// The drawn eyes become outputCount(frame.display) outputs of outputSize(), sRGB (display/stereo_layout.h). Eyes
  /// drawn smaller than eyePictureSize() are stretched bilinearly.
  virtual void compose(const Frame& frame) = 0;

  /// The left or cyclopean eye of the frame composed last, alone and of frame.rig.screen.px: output kBystanderOutput.
  virtual void composeForBystander() = 0;

  /// Scales an output into the current window; the context may be one that shares with the renderer's.
  virtual void showOnWindow(const WindowPlace& place, int output) = 0;
  virtual Picture readPicture(int output) = 0;
  virtual Picture readEye(Eye eye) = 0;
  virtual DistancePicture readDistance(Eye eye) = 0;
  virtual void throwIfError() = 0;
};

}  // namespace render
