#include "render/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "render/display/camera.h"
#include "render/display/stereo_layout.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/window_image.h"
#include "render/scene/bead_mesh.h"
#include "render/scene/guide_tube.h"
#include "render/scene/obstacle_mesh.h"
#include "render/scene_renderer.h"
#include "render/volume/clearance_legend.h"
#include "render/volume/paint_legend.h"

namespace render {
namespace {

constexpr double kLegendLine = 0.023, kMaxLegendHeight = 0.3, kLegendTop = 0.28;  // of the viewer's screen
constexpr double kMaxPaintLegendHeight = 0.5;
constexpr int kLeastLegendLine_px = 11;
constexpr double kMagnifiedHeight = 0.32, kMagnifiedTop = 0.30;  // alike, at the right
constexpr std::array<std::uint8_t, 4> kMagnifiedRim{205, 214, 220, 255};

// Where a slice lies in the viewer's pixels. `per_height`: px along x and y of the screen's height.
PixelBox sliceBox(std::size_t n, const glm::dvec2& per_height) {
  PixelBox seen;
  seen.size_px = glm::max(glm::ivec2(kSliceHeight * per_height), 1);
  seen.corner_px = kInsetGap * per_height * glm::dvec2(1.0, static_cast<double>(n) + 1.0);
  seen.corner_px.y += static_cast<int>(n) * seen.size_px.y;
  return seen;
}

}  // namespace

FrameRenderer::FrameRenderer(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                             std::span<const std::uint8_t> label, RenderOptions options)
    : fields_(grid, solid, label), gap_(grid, fields_.solid()) {
  if (options.samples < 1 || options.samples > 8)
    throw GpuError("samples " + std::to_string(options.samples) + ", renderer options: choose 1 to 8");
  if (options.backend != Backend::cpu) {
    scene_ = glSceneRenderer(fields_, options);
    return;
  }
  upload_ = std::make_unique<WindowUpload>();
  scene_ = cpuSceneRenderer(fields_, options,
                            [this](const Image& image, const WindowTarget& target) { upload_->show(image, target); });
}

FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::setFace(const assets::MeshModel& face_P) { scene_->setModel(Model::face, face_P); }
void FrameRenderer::setFragments(const assets::MeshModel& wires_P) { scene_->setModel(Model::fragments, wires_P); }
void FrameRenderer::setGingiva(const assets::MeshModel& gum_P) { scene_->setModel(Model::gingiva, gum_P); }
void FrameRenderer::setInstrument(const assets::MeshModel& instrument_T) {
  for (const Model model : {Model::instrument, Model::ghost}) scene_->setModel(model, instrument_T);
}
void FrameRenderer::setSecondInstrument(const assets::MeshModel& instrument_O) {
  scene_->setModel(Model::second_instrument, instrument_O);
}

void FrameRenderer::setPiece(std::size_t piece, const assets::VolumeGrid& grid_Q, std::span<const std::uint8_t> solid) {
  assert(piece < kMostPieces);
  fields_.place({}, false);
  scene_->setModel(pieceModel(piece), {});
  pieces_[piece] = solid.empty() ? nullptr : std::make_unique<Piece>(grid_Q, solid);
}

void FrameRenderer::updatePieceBrick(std::size_t piece, glm::ivec3 brick,
                                     std::span<const std::uint8_t, Occupancy::kBrickValues> solid) {
  assert(piece < kMostPieces && pieces_[piece]);
  pieces_[piece]->mesh.updateBrick(brick, solid);
  pieces_[piece]->gap.touch(brick);
}

std::optional<BoneGap> FrameRenderer::gap(const Frame& frame) {
  std::optional<BoneGap> least = gap_.find(frame);
  for (std::size_t n = 0; n < kMostPieces; ++n) {
    if (!pieces_[n] || !frame.pieces[n]) continue;
    // The bur as the piece sees it.
    Frame in_piece = frame;
    const auto X_QT = frame.pieces[n]->inverse() * frame.X_PT;
    in_piece.X_PT = {X_QT.rotation, X_QT.translation_mm};
    std::optional<BoneGap> gap = pieces_[n]->gap.find(in_piece);
    if (!gap || (least && least->mm <= gap->mm)) continue;
    gap->nearest_P = *frame.pieces[n] * calibration::Point<calibration::Piece>{gap->nearest_P.mm};
    least = gap;
  }
  return least;
}

void FrameRenderer::setGuides(const Guides& guides) {
  const std::vector<glm::dvec3>& canal = guides.mandibular_canal_P_mm;
  const double radius_mm = guides.mandibular_canal_radius_mm;
  scene_->setModel(Model::mandibular_canal, mandibularCanalTube(canal, radius_mm));
  scene_->setModel(Model::mandibular_canal_overlay, mandibularCanalDashes(canal, radius_mm));
  has_canal_ = canal.size() >= 2;
  // A field of no distances would be drawn as none is: of a tooth at 0.04 mm it takes 71 MB.
  if (!has_canal_ && !guides.cut && !guides_) return;
  guides_ = guideField(fields_.grid(), guides);
  scene_->setGuides(*guides_);
}

void FrameRenderer::setScan(CtScan scan) { slices_.emplace(fields_.grid(), std::move(scan)); }

Image FrameRenderer::slice(SlicePlane plane, const Frame& frame, int edge_px) const {
  assert(slices_);
  return slices_->image(plane, frame, fields_.solid(), edge_px, guides_ ? &*guides_ : nullptr, placedPieces(frame));
}

std::optional<SlicePlane> FrameRenderer::sliceAt(const Frame& frame, const glm::dvec2& share) const {
  if (!frame.layers.slices || !slices_) return {};
  const glm::dvec2 screen_px = screenOrientation(frame.rig).viewerSize(frame.rig.screen.px);
  const glm::dvec2 at_px = share * screen_px;
  for (std::size_t n = 0; n < kSlicePlanes.size(); ++n) {
    const PixelBox box = sliceBox(n, glm::dvec2(screen_px.y));
    const glm::dvec2 inside = at_px - glm::dvec2(box.corner_px);
    if (glm::all(glm::greaterThanEqual(inside, glm::dvec2(0.0))) &&
        glm::all(glm::lessThan(inside, glm::dvec2(box.size_px))))
      return kSlicePlanes[n];
  }
  return {};
}

Image FrameRenderer::magnifiedPicture(const Frame& frame, int edge_px) {
  constexpr double kFar_mm = 6.0;
  const Magnified& shown = *frame.magnified;
  const glm::dvec3 eyes_P = (frame.rig.X_WP.inverse() * eyeView(frame.rig, Eye::cyclopean).eye_W).mm - shown.at_P.mm;
  glm::dvec3 across_P = eyes_P - glm::dot(eyes_P, shown.up_P) * shown.up_P;
  // Seen along it, any side is as good.
  if (glm::length(across_P) < 1e-3 * glm::length(eyes_P))
    across_P = glm::cross(shown.up_P, std::abs(shown.up_P.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  Frame near = frame;
  near.rig = cameraRig({.eye_P_mm = shown.at_P.mm + kFar_mm * glm::normalize(across_P),
                        .look_at_P_mm = shown.at_P.mm,
                        .up_P = shown.up_P,
                        .fov_y_rad = 2.0 * std::atan(0.5 * shown.across_mm / kFar_mm)},
                       glm::ivec2(edge_px));
  near.display = DisplayMode::mono;
  near.mode = ViewMode::clear;
  scene_->setInsets({});
  drawEye(near, Eye::magnified, near.rig.screen.px);
  Image picture = readEye(Eye::magnified);
  // A rim of one pixel.
  const auto put = [&](int x, int y) {
    std::ranges::copy(kMagnifiedRim, &picture.rgba[4 * static_cast<std::size_t>(y * edge_px + x)]);
  };
  for (int n = 0; n < edge_px; ++n)
    for (const int rim : {0, edge_px - 1}) put(n, rim), put(rim, n);
  return picture;
}

// Slices in a column at the viewer's left, the legend at the right, upright for the viewer however the panel is
// mounted.
void FrameRenderer::updateInsets(const Frame& frame, glm::ivec2 eye_px) {
  std::vector<Inset> insets;
  const ScreenOrientation orientation = screenOrientation(frame.rig);
  const glm::ivec2 seen_px = orientation.viewerSize(eye_px);
  const glm::dvec2 screen_px = orientation.viewerSize(frame.rig.screen.px);
  const glm::dvec2 per_height = glm::dvec2(seen_px) * glm::dvec2(screen_px.y / screen_px.x, 1.0);
  const auto add = [&](const PixelBox& seen, const Image& upright) {
    const PixelBox box = orientation.imageBox(seen, eye_px);
    insets.push_back({turned(upright, orientation), box.corner_px, box.size_px});
  };
  if (frame.layers.slices && slices_)
    for (std::size_t n = 0; n < kSlicePlanes.size(); ++n) {
      const PixelBox seen = sliceBox(n, per_height);
      add(seen, slice(kSlicePlanes[n], frame, seen.size_px.y));
    }
  if (frame.magnified) {
    PixelBox seen;
    seen.size_px = glm::max(glm::ivec2(kMagnifiedHeight * per_height), 8);
    seen.corner_px = {seen_px.x - seen.size_px.x - static_cast<int>(kInsetGap * per_height.x),
                      static_cast<int>(kMagnifiedTop * per_height.y)};
    add(seen, magnifiedPicture(frame, std::max(seen.size_px.x, seen.size_px.y)));
  }
  // Translucent bone shows no bands; in a small image the legend would cover what it explains.
  const bool has_room = clearanceLegendSize(kLeastLegendLine_px).y <= kMaxLegendHeight * per_height.y;
  if (frame.layers.clearance && has_canal_ && !isTranslucent(frame.mode) && has_room) {
    const int line_px = std::max(static_cast<int>(kLegendLine * per_height.y), kLeastLegendLine_px);
    const glm::dvec2 size_px = glm::dvec2(clearanceLegendSize(line_px)) * glm::dvec2(per_height.x / per_height.y, 1.0);
    PixelBox seen;
    seen.size_px = glm::max(glm::ivec2(glm::round(size_px)), 1);
    seen.corner_px = seen_px - seen.size_px - glm::ivec2(kInsetGap * per_height);
    // Between the lines of text that may lie at the upper and at the lower edge.
    seen.corner_px.y = static_cast<int>(kLegendTop * per_height.y);
    if (glm::all(glm::greaterThanEqual(seen.corner_px, glm::ivec2(0)))) add(seen, clearanceLegend(line_px));
  }
  if (frame.paint != nullptr && !frame.paint->rows.empty() && !isTranslucent(frame.mode)) {
    const int line_px = std::max(static_cast<int>(kLegendLine * per_height.y), kLeastLegendLine_px);
    const auto stretched = glm::dvec2(per_height.x / per_height.y, 1.0);
    PixelBox seen;
    seen.size_px = glm::max(glm::ivec2(glm::round(glm::dvec2(paintLegendSize(*frame.paint, line_px)) * stretched)), 1);
    seen.corner_px = seen_px - seen.size_px - glm::ivec2(kInsetGap * per_height);
    // Under what else is shown at this side.
    int top_px = static_cast<int>(kLegendTop * per_height.y);
    if (frame.magnified) top_px += static_cast<int>((kMagnifiedHeight + kInsetGap) * per_height.y);
    seen.corner_px.y = top_px;
    const bool fits = seen.corner_px.x >= 0 && seen.corner_px.y + seen.size_px.y <= seen_px.y &&
                      seen.size_px.y <= kMaxPaintLegendHeight * per_height.y;
    if (fits) add(seen, paintLegend(*frame.paint, line_px));
  }
  scene_->setInsets(std::move(insets));
}

void FrameRenderer::setOverlay(std::vector<OverlayPanel> panels) { overlay_ = std::move(panels); }

void FrameRenderer::updateOverlay(const StereoLayout& layout, const ScreenOrientation& orientation, int output) {
  ShownOverlay& shown = shown_overlays_[static_cast<std::size_t>(output)];
  const bool same_place = shown.layout.mode == layout.mode && shown.layout.screen_px == layout.screen_px &&
                          shown.orientation == orientation;
  bool changed = !same_place || shown.serials.size() != overlay_.size();
  shown.layout = layout;
  shown.orientation = orientation;
  shown.serials.resize(overlay_.size());
  shown.patches.resize(overlay_.size());
  for (std::size_t n = 0; n < overlay_.size(); ++n) {
    if (same_place && shown.patches[n].serial != 0 && shown.serials[n] == overlay_[n].serial) continue;
    shown.patches[n] = patchOf(overlay_[n], layout, orientation);
    shown.patches[n].serial = ++patch_serial_;
    shown.serials[n] = overlay_[n].serial;
    changed = true;
  }
  if (changed) scene_->setPatches(output, shown.patches);
}

void FrameRenderer::updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> solid) {
  fields_.updateBrick(brick, solid);
  gap_.touch(brick);
}

void FrameRenderer::updateTissue(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> tissue) {
  fields_.updateTissue(brick, tissue);
}

void FrameRenderer::updateRuler(const Frame& frame) {
  if (frame.arrow != arrow_) {
    arrow_ = frame.arrow;
    for (const bool behind : {false, true})
      scene_->setModel(behind ? Model::arrow_overlay : Model::arrow,
                       arrow_ ? arrowMesh(*arrow_, behind) : assets::MeshModel{});
  }
  if (frame.ruler == ruler_) return;
  ruler_ = frame.ruler;
  for (const bool behind : {false, true})
    scene_->setModel(behind ? Model::ruler_overlay : Model::ruler,
                     ruler_ ? rulerMesh(*ruler_, behind) : assets::MeshModel{});
}

void FrameRenderer::updateBeads(const Frame& frame) {
  if (frame.beads == beads_) return;
  beads_ = frame.beads;
  scene_->setModel(Model::beads, beadMesh(beads_));
}

void FrameRenderer::updateObstacles(const Frame& frame) {
  if (frame.obstacles == obstacles_) return;
  obstacles_ = frame.obstacles;
  scene_->setModel(Model::obstacles, obstacleMesh(obstacles_));
}

void FrameRenderer::updateFlap(const Frame& frame) {
  if (frame.gum != nullptr && frame.gum_serial != gum_serial_) scene_->setModel(Model::gingiva, *frame.gum);
  if (frame.flap_serial != flap_serial_)
    scene_->setModel(Model::flap, frame.flap != nullptr ? *frame.flap : assets::MeshModel{});
  flap_serial_ = frame.flap_serial, gum_serial_ = frame.gum_serial;
}

void FrameRenderer::updatePaint(const Frame& frame) {
  if (frame.paint_serial == paint_serial_) return;
  paint_serial_ = frame.paint_serial;
  scene_->setPaint(frame.paint);
}

void FrameRenderer::drawEye(const Frame& frame, Eye eye, glm::ivec2 px) {
  scene_->drawEye(frame, eye, px);
  drawn(eye) = {frame, px};
}

std::vector<PlacedFields> FrameRenderer::placedPieces(const Frame& frame) const {
  std::vector<PlacedFields> placed;
  for (std::size_t n = 0; n < kMostPieces; ++n)
    if (pieces_[n] && frame.pieces[n]) placed.push_back({&pieces_[n]->mesh.fields(), *frame.pieces[n]});
  return placed;
}

// Pieces are brought up to date where they are seen.
void FrameRenderer::prepare(const Frame& frame) {
  updateRuler(frame);
  updateBeads(frame);
  updateObstacles(frame);
  updateFlap(frame);
  updatePaint(frame);
  bool any_changed = false;
  for (std::size_t n = 0; n < kMostPieces; ++n) {
    if (!pieces_[n] || !frame.pieces[n] || !pieces_[n]->mesh.prepare()) continue;
    scene_->setModel(pieceModel(n), pieces_[n]->mesh.model());
    any_changed = true;
  }
  fields_.place(placedPieces(frame), any_changed);
  scene_->prepare(frame, fields_.prepare());
}

void FrameRenderer::render(const Frame& frame) {
  const glm::ivec2 full_px = eyeImageSize(frame.display, frame.rig.screen.px);
  const glm::ivec2 eye_px = glm::max((full_px + frame.quality.pixel_edge - 1) / frame.quality.pixel_edge, 1);
  const bool mono = frame.display == DisplayMode::mono;
  const Eye left = mono ? Eye::cyclopean : Eye::left, right = mono ? Eye::cyclopean : Eye::right;
  prepare(frame);
  updateInsets(frame, eye_px);
  drawEye(frame, left, eye_px);
  if (!mono) drawEye(frame, right, eye_px);
  composed_from_ = left;
  compose(frame);
}

void FrameRenderer::composeAgain() { compose(drawn(composed_from_).frame); }

void FrameRenderer::compose(const Frame& frame) {
  StereoLayout layout{.mode = frame.display,
                      .screen_px = frame.rig.screen.px,
                      .at_px = frame.output_at_px,
                      .swapped = frame.eyes_swapped};
  const Eye right = frame.display == DisplayMode::mono ? Eye::cyclopean : Eye::right;
  const ScreenOrientation orientation = screenOrientation(frame.rig);
  for (; layout.output < outputCount(layout.mode); ++layout.output) {
    updateOverlay(layout, orientation, layout.output);
    scene_->compose(layout, composed_from_, right, layout.output);
  }
}

void FrameRenderer::renderEye(const Frame& frame, Eye eye) {
  prepare(frame);
  updateInsets(frame, frame.rig.screen.px);
  drawEye(frame, eye, frame.rig.screen.px);
}

void FrameRenderer::composeForBystander() {
  const calibration::Rig& rig = drawn(composed_from_).frame.rig;
  const StereoLayout layout{.screen_px = rig.screen.px};
  updateOverlay(layout, screenOrientation(rig), kBystanderOutput);
  scene_->compose(layout, composed_from_, composed_from_, kBystanderOutput);
}

void FrameRenderer::showOnWindow(const WindowTarget& target, int output) { scene_->showOnWindow(target, output); }
void FrameRenderer::showBystander(const WindowTarget& target) { scene_->showOnWindow(target, kBystanderOutput); }
Image FrameRenderer::readImage(int output) { return scene_->readImage(output); }
Image FrameRenderer::readEye(Eye eye) {
  assert(drawn(eye).px.x > 0);
  scene_->compose({.screen_px = drawn(eye).px}, eye, eye, kEyeOutput);
  return readImage(kEyeOutput);
}
std::optional<Image> FrameRenderer::readLate(glm::ivec2 most_px, std::optional<Eye> eye) {
  if (!eye) return scene_->readLate(0, most_px);
  assert(drawn(*eye).px.x > 0);
  scene_->compose({.screen_px = drawn(*eye).px}, *eye, *eye, kEyeOutput);
  return scene_->readLate(kEyeOutput, most_px);
}
DistanceImage FrameRenderer::readDistance(Eye eye) {
  assert(drawn(eye).px.x > 0);
  return scene_->readDistance(drawn(eye).frame, eye);
}
void FrameRenderer::throwIfError() { scene_->throwIfError(); }

glm::dmat4 clipFromPatient(const calibration::Rig& rig, const EyeView& view) {
  return view.clip_from_W * rig.X_WP.matrix();
}

}  // namespace render
