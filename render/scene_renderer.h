// Interface of a back-end that draws the scene for FrameRenderer: OpenGL 4.5 (gl_scene_renderer.cpp) or CPU
// (cpu/cpu_scene_renderer.cpp). Both produce the same image; the GLSL in render/shaders is the specification.
// The volume fields are borrowed from FrameRenderer. Render thread. Errors: GpuError.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "assets/mesh.h"
#include "render/display/eye_projection.h"
#include "render/display/overlay.h"
#include "render/display/stereo_layout.h"
#include "render/frame.h"
#include "render/gpu/window_target.h"
#include "render/image.h"
#include "render/render_options.h"
#include "render/scene/models.h"
#include "render/volume/guide_field.h"
#include "render/volume/surface_paint.h"
#include "render/volume/volume_fields.h"

namespace render {

/// Outputs after the one or two of the display: the bystanders' view, and an eye that is read back alone.
inline constexpr int kBystanderOutput = 2, kEyeOutput = 3, kOutputs = 4;

/// A small image blended over every eye at the same position, so that it lies in the screen plane.
struct Inset {
  Image image;
  glm::ivec2 first_px{0}, size_px{0};  ///< in the eye's image, from its top left
};

class SceneRenderer {
 public:
  SceneRenderer() = default;
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;
  virtual ~SceneRenderer() = default;

  /// An empty mesh removes the model.
  virtual void setModel(Model model, const assets::MeshModel& mesh) = 0;
  virtual void setGuides(GuideField guides) = 0;
  /// Copied; null: none. Shown in frames that have some.
  virtual void setPaint(const SurfacePaint* paint) = 0;
  /// For the eyes drawn from now on.
  virtual void setInsets(std::vector<Inset> insets) = 0;

  /// Blended over an output whenever it is composed, from now on.
  virtual void setPatches(int output, std::span<const OverlayPatch> patches) = 0;

  /// Once per frame, before its eyes: takes over the changes of the fields.
  virtual void prepare(const Frame& frame, const FieldChanges& changes) = 0;
  /// One eye, in linear light, `px` large; kept until it is drawn again.
  virtual void drawEye(const Frame& frame, Eye eye, glm::ivec2 px) = 0;
  /// Composes two drawn eyes into an sRGB output (display/stereo_layout.h); mono shows `left`. Eyes smaller than
  /// eyeImageSize() are scaled bilinearly.
  virtual void compose(const StereoLayout& layout, Eye left, Eye right, int output) = 0;

  /// Scales an output into the current window; its context may be one that shares with the renderer's.
  virtual void showOnWindow(const WindowTarget& target, int output) = 0;
  virtual Image readImage(int output) = 0;
  /// Without waiting: none where it is still on its way, which a first call sets out (gpu/late_image.h).
  virtual std::optional<Image> readLate(int output, glm::ivec2 most_px) = 0;
  /// `frame`: the one the eye was last drawn with.
  virtual DistanceImage readDistance(const Frame& frame, Eye eye) = 0;
  virtual void throwIfError() = 0;
};

/// Needs a current OpenGL 4.5 context that outlives it. Throws GpuError.
std::unique_ptr<SceneRenderer> glSceneRenderer(const VolumeFields& fields, const RenderOptions& options);

/// Copies an image into the current window.
using ShowImage = std::function<void(const Image& image, const WindowTarget& target)>;

/// Without OpenGL: rays in tiles of 16x16 pixels over threads; within 2/255 of the OpenGL back-end except at edges, and
/// bit-identical for any number of threads. `show` is supplied by the owner of OpenGL. Throws GpuError.
std::unique_ptr<SceneRenderer> cpuSceneRenderer(const VolumeFields& fields, const RenderOptions& options,
                                                ShowImage show);

}  // namespace render
