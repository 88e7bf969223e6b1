// What stands behind FrameRenderer: one way of drawing the scene, in OpenGL (gl_scene_renderer) or on the CPU
// (cpu_scene_renderer). Both draw the same image from the same values; the GLSL in render/shaders is the
// specification. The fields of the volume are borrowed from FrameRenderer. Render thread. Errors: GpuError.
#pragma once

#include <vector>

#include "assets/mesh.h"
#include "render/display/eye_projection.h"
#include "render/display/stereo_layout.h"
#include "render/frame.h"
#include "render/gpu/window_target.h"
#include "render/image.h"
#include "render/scene/models.h"
#include "render/volume/guide_field.h"
#include "render/volume/volume_fields.h"

namespace render {

/// Besides the one or two of the display: what those see who stand by, and an eye that is read alone.
inline constexpr int kBystanderOutput = 2, kEyeOutput = 3, kOutputs = 4;

/// A small image laid over every eye at one place, so that it lies on the screen itself.
struct Inset {
  Image image;
  glm::ivec2 first_px{0}, size_px{0};  ///< of the eye's image, from its top left
};

class SceneRenderer {
 public:
  SceneRenderer() = default;
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;
  virtual ~SceneRenderer() = default;

  /// An empty mesh removes what was drawn.
  virtual void setModel(Model model, const assets::MeshModel& mesh) = 0;
  virtual void setGuides(GuideField guides) = 0;
  /// Laid over the eyes that are drawn from now on.
  virtual void setInsets(std::vector<Inset> insets) = 0;

  /// Once per frame, before its eyes: what was carved since becomes drawable.
  virtual void prepare(const Frame& frame, const FieldChanges& changes) = 0;
  /// One eye, in linear light, `px` large; kept until it is drawn again.
  virtual void drawEye(const Frame& frame, Eye eye, glm::ivec2 px) = 0;
  /// Two drawn eyes become an output, sRGB (display/stereo_layout.h); mono shows `left`. Eyes drawn smaller than
  /// eyeImageSize() are stretched bilinearly.
  virtual void compose(const StereoLayout& layout, Eye left, Eye right, int output) = 0;

  /// Scales an output into the current window; the context may be one that shares with the renderer's.
  virtual void showOnWindow(const WindowTarget& place, int output) = 0;
  virtual Image readImage(int output) = 0;
  /// `frame`: as the eye was drawn last.
  virtual DistanceImage readDistance(const Frame& frame, Eye eye) = 0;
  virtual void throwIfError() = 0;
};

}  // namespace render
