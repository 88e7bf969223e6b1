#include "app/review/bone_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/session/measures/plan_comparison.h"
#include "assets/trilinear.h"
#include "render/display/camera.h"
#include "render/display/eye_projection.h"
#include "render/frame_renderer.h"

namespace app {
namespace {

constexpr double kAway_mm = 160.0, kSeen_mm = 34.0;  ///< of the camera; height of what it sees
using FromPlan = std::function<double(const glm::dvec3&)>;

/// Solid fraction at a place, 0 outside of the grid.
double solidAt(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, const glm::dvec3& p_P_mm) {
  return assets::trilinearAt(grid, p_P_mm,
                             [&](glm::ivec3 ijk) { return grid.contains(ijk) ? solid[grid.index(ijk)] / 255.0 : 0.0; });
}

bool isBone(const BoneStates& bone, const glm::dvec3& p_P_mm) {
  if (bone.label.empty()) return true;
  const glm::ivec3 ijk(glm::round(bone.grid.indexFromPoint(p_P_mm)));
  if (!bone.grid.contains(ijk)) return false;
  return countsAsBone(bone.label[bone.grid.index(ijk)]);
}

enum class PlanColour { none, over, under };

/// What a place of the drawn surface shows, seen along `ray_P`.
PlanColour colourAt(const BoneStates& bone, const FromPlan& plan_mm, const glm::dvec3& p_P_mm,
                    const glm::dvec3& ray_P) {
  constexpr double kBefore_mm = 0.4;
  const double from_plan_mm = plan_mm(p_P_mm);
  if (from_plan_mm < -kPlanTolerance_mm)
    return isBone(bone, p_P_mm + kBefore_mm * ray_P) ? PlanColour::under : PlanColour::none;
  const glm::dvec3 in_front = p_P_mm - kBefore_mm * ray_P;
  const bool was_bone = solidAt(bone.grid, bone.before, in_front) >= 0.5 && isBone(bone, in_front);
  return was_bone && from_plan_mm > kPlanTolerance_mm ? PlanColour::over : PlanColour::none;
}

void tint(render::Image& image, std::size_t pixel, const std::array<double, 3>& colour) {
  constexpr double kShare = 0.5;
  for (std::size_t c = 0; c < 3; ++c) {
    std::uint8_t& value = image.rgba[4 * pixel + c];
    value = static_cast<std::uint8_t>((1.0 - kShare) * value + kShare * colour[c] + 0.5);
  }
}

void tintAgainstPlan(render::Image& image, const render::DistanceImage& distance, const render::Frame& frame,
                     const BoneStates& bone, const FromPlan& plan_mm) {
  constexpr std::array kOver{220.0, 30.0, 20.0}, kUnder{30.0, 90.0, 220.0};
  const render::EyeView view = render::eyeView(frame.rig, render::Eye::cyclopean);
  const auto X_PW = frame.rig.X_WP.inverse();
  const glm::dvec3 eye_P = (X_PW * view.eye_W).mm;
  for (int y = 0; y < image.h; ++y)
    for (int x = 0; x < image.w; ++x) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.w) + static_cast<std::size_t>(x);
      const double mm = static_cast<double>(distance.mm[pixel]);
      if (!(mm > 0.0)) continue;
      const calibration::Point<calibration::World> on_screen_W{view.lower_left_W.mm +
                                                               view.right_edge_W.xyz * ((x + 0.5) / image.w) +
                                                               view.up_edge_W.xyz * (1.0 - (y + 0.5) / image.h)};
      const glm::dvec3 ray_P = glm::normalize((X_PW * on_screen_W).mm - eye_P);
      const PlanColour colour = colourAt(bone, plan_mm, eye_P + mm * ray_P, ray_P);
      if (colour == PlanColour::over) tint(image, pixel, kOver);
      if (colour == PlanColour::under) tint(image, pixel, kUnder);
    }
}

/// What was laid, in its colours, as the rehearsal shows it (view/brick_upload).
void showLaid(const BoneStates& bone, render::FrameRenderer& renderer) {
  const haptics::Filling::Volumes& laid = *bone.laid;
  assets::forVoxels(glm::ivec3(0), bone.grid.bricks(), [&](glm::ivec3 brick) {
    std::array<std::uint8_t, 512> solid{}, tissue{};
    bool has_filling = false;
    std::size_t n = 0;
    const glm::ivec3 low = brick * assets::kBrickVoxels;
    assets::forVoxels(low, low + assets::kBrickVoxels, [&](glm::ivec3 ijk) {
      const std::size_t at = n++;
      if (!bone.grid.contains(ijk)) return;
      const std::size_t v = bone.grid.index(ijk);
      has_filling = has_filling || laid.laid[v] != 0;
      if (laid.laid[v] != 0 && laid.laid[v] >= bone.after[v]) tissue[at] = laid.tissue[v];
      solid[at] = static_cast<std::uint8_t>(std::min(255, bone.after[v] + laid.laid[v]));
    });
    if (!has_filling) return;
    renderer.updateTissue(brick, tissue);
    renderer.updateBrick(brick, solid);
  });
}

}  // namespace

std::vector<BonePicture> bonePictures(const BoneStates& bone, const SiteView& site, const FromPlan& from_plan_mm,
                                      glm::ivec2 px) {
  struct From {
    const char* words;
    glm::dvec3 eye_P, up_P;
  };
  const glm::dvec3 cheek = glm::normalize(site.buccal_P + 0.7 * site.up_P - 0.3 * site.distal_P);
  const glm::dvec3 tongue = glm::normalize(-site.buccal_P + 0.7 * site.up_P - 0.3 * site.distal_P);
  const glm::dvec3 front = glm::normalize(-site.distal_P + 1.1 * site.up_P + 0.4 * site.buccal_P);
  const std::array views{From{"from above", site.up_P, site.distal_P}, From{"from the cheek", cheek, site.up_P},
                         From{"from the tongue", tongue, site.up_P}, From{"from in front", front, site.up_P}};

  render::RenderOptions how;
  how.backend = render::Backend::cpu;
  how.samples = 2;
  render::FrameRenderer renderer(bone.grid, bone.after, bone.label, how);
  if (bone.laid != nullptr) showLaid(bone, renderer);
  std::vector<BonePicture> pictures;
  for (const From& from : views) {
    render::Frame frame;
    frame.tool_visible = false;
    frame.layers.gap_ring = false;
    render::Camera camera;
    camera.look_at_P_mm = site.middle_P_mm;
    camera.eye_P_mm = site.middle_P_mm + kAway_mm * from.eye_P;
    camera.up_P = from.up_P;
    camera.fov_y_rad = 2.0 * std::atan(0.5 * kSeen_mm / kAway_mm);
    frame.rig = render::cameraRig(camera, px);
    renderer.renderEye(frame, render::Eye::cyclopean);
    render::Image image = renderer.readEye(render::Eye::cyclopean);
    if (from_plan_mm) tintAgainstPlan(image, renderer.readDistance(render::Eye::cyclopean), frame, bone, from_plan_mm);
    pictures.push_back({from.words, std::move(image)});
  }
  return pictures;
}

}  // namespace app
