#include "render/frame_renderer.h"

#include <string>

#include "render/cpu/cpu_scene_renderer.h"
#include "render/display/stereo_layout.h"
#include "render/gl_scene_renderer.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/window_upload.h"
#include "render/scene_renderer.h"

namespace render {

FrameRenderer::FrameRenderer(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                             std::span<const std::uint8_t> label, RenderOptions options) {
  if (options.samples < 1 || options.samples > 8)
    throw GpuError("samples " + std::to_string(options.samples) + ", renderer options: choose 1 to 8");
  if (options.backend != Backend::cpu) {
    scene_ = glSceneRenderer(grid, solid, label, options);
    return;
  }
  upload_ = std::make_unique<WindowUpload>();
  scene_ = cpuSceneRenderer(grid, solid, label, options, [this](const Picture& picture, const WindowPlace& place) {
    upload_->show(picture, place);
  });
}

FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::setFace(const assets::MeshModel& face_P) { scene_->setFace(face_P); }
void FrameRenderer::setGum(const assets::MeshModel& gum_P) { scene_->setGum(gum_P); }
void FrameRenderer::setInstrument(const assets::MeshModel& instrument_T) { scene_->setInstrument(instrument_T); }

void FrameRenderer::setGuides(const Guides& guides) { scene_->setGuides(guides); }

void FrameRenderer::updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> solid) {
  scene_->updateBrick(brick, solid);
}

void FrameRenderer::render(const Frame& frame) {
  const glm::ivec2 place_px = eyePictureSize(frame.display, frame.rig.screen.px);
  const glm::ivec2 eye_px = glm::max((place_px + frame.quality.pixel_edge - 1) / frame.quality.pixel_edge, 1);
  scene_->prepare(frame);
  if (frame.display == DisplayMode::mono) {
    scene_->drawEye(frame, Eye::cyclopean, eye_px);
  } else {
    scene_->drawEye(frame, Eye::left, eye_px);
    scene_->drawEye(frame, Eye::right, eye_px);
  }
  scene_->compose(frame);
}

void FrameRenderer::renderEye(const Frame& frame, Eye eye) {
  scene_->prepare(frame);
  scene_->drawEye(frame, eye, frame.rig.screen.px);
}

void FrameRenderer::composeForBystander() { scene_->composeForBystander(); }
void FrameRenderer::showOnWindow(const WindowPlace& place, int output) { scene_->showOnWindow(place, output); }
void FrameRenderer::showBystander(const WindowPlace& place) { scene_->showOnWindow(place, kBystanderOutput); }
Picture FrameRenderer::readPicture(int output) { return scene_->readPicture(output); }
Picture FrameRenderer::readEye(Eye eye) { return scene_->readEye(eye); }
DistancePicture FrameRenderer::readDistance(Eye eye) { return scene_->readDistance(eye); }
void FrameRenderer::throwIfError() { scene_->throwIfError(); }

glm::dmat4 clipFromPatient(const calibration::Rig& rig, const EyeView& view) {
  return view.clip_from_W * rig.X_WP.matrix();
}

}  // namespace render
