#include "render/frame_renderer.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "render/cpu/cpu_scene_renderer.h"
#include "render/display/stereo_layout.h"
#include "render/gl_scene_renderer.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/window_upload.h"
#include "render/scene_renderer.h"

namespace render {
namespace {

Picture turned(Picture picture, bool flip_x, bool flip_y) {
  if (!flip_x && !flip_y) return picture;
  Picture result = picture;
  for (int y = 0; y < picture.h; ++y)
    for (int x = 0; x < picture.w; ++x) {
      const int from_x = flip_x ? picture.w - 1 - x : x, from_y = flip_y ? picture.h - 1 - y : y;
      std::copy_n(&picture.rgba[4 * static_cast<std::size_t>(from_y * picture.w + from_x)], 4,
                  &result.rgba[4 * static_cast<std::size_t>(y * picture.w + x)]);
    }
  return result;
}

}  // namespace

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
void FrameRenderer::setSecondInstrument(const assets::MeshModel& instrument_O) {
  scene_->setSecondInstrument(instrument_O);
}

void FrameRenderer::setGuides(const Guides& guides) { scene_->setGuides(guides); }

void FrameRenderer::setScan(CtScan scan) { slices_.emplace(scene_->fields().grid(), std::move(scan)); }

Picture FrameRenderer::slice(SlicePlane plane, const Frame& frame, int edge_px) const {
  assert(slices_);
  return slices_->picture(plane, frame, scene_->fields().solid(), edge_px);
}

// A column at the viewer's left, upright for the viewer however the panel hangs.
void FrameRenderer::layInsets(const Frame& frame, glm::ivec2 eye_px) {
  std::vector<Inset> insets;
  if (frame.layers.slices && slices_) {
    constexpr double kHeight = 0.3, kGap = 0.025;  // of the picture's
    const glm::dvec2 screen_px = frame.rig.screen.px;
    const glm::dvec2 per_height{eye_px.x * screen_px.y / screen_px.x, eye_px.y};
    const EyeView view = eyeView(frame.rig, Eye::cyclopean);
    const bool flip_x = glm::dot(view.right_edge_W.xyz, frame.rig.right_eye.mm - frame.rig.left_eye.mm) < 0.0;
    const bool flip_y = flip_x != view.mirrored;
    for (std::size_t n = 0; n < kSlicePlanes.size(); ++n) {
      Inset inset;
      inset.size_px = glm::max(glm::ivec2(kHeight * per_height), 1);
      inset.first_px = kGap * per_height * glm::dvec2(1.0, static_cast<double>(n) + 1.0);
      inset.first_px.y += static_cast<int>(n) * inset.size_px.y;
      if (flip_x) inset.first_px.x = eye_px.x - inset.first_px.x - inset.size_px.x;
      if (flip_y) inset.first_px.y = eye_px.y - inset.first_px.y - inset.size_px.y;
      inset.picture = turned(slice(kSlicePlanes[n], frame, inset.size_px.y), flip_x, flip_y);
      insets.push_back(std::move(inset));
    }
  }
  scene_->setInsets(std::move(insets));
}

void FrameRenderer::updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> solid) {
  scene_->updateBrick(brick, solid);
}

void FrameRenderer::render(const Frame& frame) {
  const glm::ivec2 place_px = eyePictureSize(frame.display, frame.rig.screen.px);
  const glm::ivec2 eye_px = glm::max((place_px + frame.quality.pixel_edge - 1) / frame.quality.pixel_edge, 1);
  scene_->prepare(frame);
  layInsets(frame, eye_px);
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
  layInsets(frame, frame.rig.screen.px);
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
