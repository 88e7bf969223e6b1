// The surface that is seen is the surface that is felt: the depth image and the onset of the default law's force agree
// on the built-in patient, before and after carving, for every renderer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/view/brick_upload.h"
#include "assets/synthetic/jaw.h"
#include "haptics/body/bodies.h"
#include "haptics/bone/carve.h"
#include "haptics/contact/law.h"
#include "render/display/camera.h"
#include "render/frame_renderer.h"
#include "render/gpu/offscreen_context.h"
#include "tests/haptics/time_erosion.h"

namespace app {
namespace {

constexpr glm::ivec2 kPx{160, 120};
constexpr double kBur_mm = 1.0, kPressed_mm = 0.3;
/// The disc in which the bur's cap meets the bone, and the largest deviation from flat in it: beyond, the cap's volume
/// differs from that in flat bone at the same depth, which is no error of the surface's position.
constexpr double kDisc_mm = 0.71, kFlat_mm = 0.08;

const assets::Patient& patient() {
  static const assets::Patient kPatient = assets::syntheticJaw({.spacing_mm = 0.4});
  return kPatient;
}

/// From the cheek onto the bone beside the third molar.
render::Frame fromTheCheek() {
  const glm::dvec3 look_at = patient().focus_P_mm() - glm::dvec3(0.0, 0.0, 6.0);
  render::Frame frame;
  frame.rig = render::cameraRig(
      {.eye_P_mm = look_at + glm::dvec3(-150.0, -15.0, 40.0), .look_at_P_mm = look_at, .fov_y_rad = 0.08}, kPx);
  frame.tool_visible = false;
  return frame;
}

/// Points in P of a depth image, and whether each was hit.
class SeenPlaces {
 public:
  SeenPlaces(const render::Frame& frame, const render::DistanceImage& distance) : mm_(distance.mm) {
    const render::EyeView view = eyeView(frame.rig, render::Eye::cyclopean);
    const auto X_PW = frame.rig.X_WP.inverse();
    const glm::dvec3 eye = (X_PW * view.eye_W).mm;
    for (int y = 0; y < kPx.y; ++y)
      for (int x = 0; x < kPx.x; ++x) {
        const glm::dvec3 on_screen = view.lower_left_W.mm + (x + 0.5) / kPx.x * view.right_edge_W.xyz +
                                     (1.0 - (y + 0.5) / kPx.y) * view.up_edge_W.xyz;
        const glm::dvec3 ray = glm::normalize(X_PW.rotation * (on_screen - view.eye_W.mm));
        places_.push_back(eye + double{mm_[static_cast<std::size_t>(y * kPx.x + x)]} * ray);
      }
    eye_ = eye;
  }

  /// The mean place and outward normal around a pixel where the surface is flat under the bur; false elsewhere.
  bool flatAround(int x, int y, glm::dvec3& place, glm::dvec3& normal) const {
    constexpr int kReach = 8;
    if (x < kReach || y < kReach || x >= kPx.x - kReach || y >= kPx.y - kReach || !hit(x, y)) return false;
    const glm::dvec3 across = at(x + kReach, y) - at(x - kReach, y), up = at(x, y - kReach) - at(x, y + kReach);
    normal = glm::normalize(glm::cross(across, up));
    if (glm::dot(normal, eye_ - at(x, y)) < 0.0) normal = -normal;
    if (glm::dot(normal, glm::normalize(eye_ - at(x, y))) < 0.6) return false;
    const glm::dvec3 middle = at(x, y);
    double sum_mm = 0.0;
    int count = 0;
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx) {
        if (!hit(x + dx, y + dy)) return false;
        const glm::dvec3 off = at(x + dx, y + dy) - middle;
        const double height_mm = glm::dot(off, normal);
        if (glm::length(off - height_mm * normal) > kDisc_mm) continue;
        if (std::abs(height_mm) > kFlat_mm) return false;
        sum_mm += height_mm;
        ++count;
      }
    place = middle + sum_mm / count * normal;
    return true;
  }

 private:
  bool hit(int x, int y) const { return mm_[static_cast<std::size_t>(y * kPx.x + x)] > 0.0f; }
  const glm::dvec3& at(int x, int y) const { return places_[static_cast<std::size_t>(y * kPx.x + x)]; }

  std::vector<float> mm_;
  std::vector<glm::dvec3> places_;
  glm::dvec3 eye_;
};

struct Agreement {
  int places = 0;
  double rms_mm = 0.0, worst_mm = 0.0;
};

/// Presses the bur into every visible point and compares the depth.
Agreement agreementOf(const SeenPlaces& seen, const haptics::Bodies& bodies) {
  Agreement found;
  const haptics::SolidBodies field = bodies.view();
  const haptics::LawSettings law;
  for (int y = 0; y < kPx.y; y += 2)
    for (int x = 0; x < kPx.x; x += 2) {
      glm::dvec3 place, normal;
      if (!seen.flatAround(x, y, place, normal)) continue;
      const calibration::Pose<calibration::Patient, calibration::Tool> X_PT{glm::dquat(1, 0, 0, 0),
                                                                            place + (kBur_mm - kPressed_mm) * normal};
      const haptics::ToolInBone at{
          field, {.kind = haptics::ShapeKind::sphere, .radius_mm = kBur_mm}, X_PT, law.tissue, {}};
      const double off_mm = haptics::contactOf(law, at).depth_mm - kPressed_mm;
      ++found.places;
      found.rms_mm += off_mm * off_mm;
      found.worst_mm = std::max(found.worst_mm, std::abs(off_mm));
    }
  found.rms_mm = std::sqrt(found.rms_mm / std::max(found.places, 1));
  return found;
}

class FeltIsSeen : public testing::TestWithParam<render::Backend> {};

TEST_P(FeltIsSeen, WithinATwentiethOfAMillimetreBeforeAndAfterCarving) {
  const render::OffscreenContext context;
  const assets::CtVolume& ct = patient().ct;
  haptics::Bodies bone(ct.grid, ct.solid, ct.label, assets::voxelsOfTooth(ct, patient().operatedTooth()));
  ASSERT_EQ(bone.pieces(), 1u);
  render::FrameRenderer renderer(ct.grid, ct.solid, ct.label, {.backend = GetParam()});
  const render::Frame frame = fromTheCheek();
  const auto look = [&] {
    renderer.renderEye(frame, render::Eye::cyclopean);
    return renderer.readDistance(render::Eye::cyclopean);
  };

  const render::DistanceImage before = look();
  const SeenPlaces seen(frame, before);
  const Agreement untouched = agreementOf(seen, bone);
  EXPECT_GT(untouched.places, 200);
  EXPECT_LT(untouched.rms_mm, 0.05) << "worst " << untouched.worst_mm;

  // A flat floor, cut with the end of a wide cylinder that stands on the bone where it is flat.
  glm::dvec3 place{0.0}, normal{0.0};
  int x = kPx.x / 2, y = 10;
  while (y < kPx.y && !seen.flatAround(x, y, place, normal)) (x += 3) < kPx.x - 10 ? x : (x = 10, ++y);
  ASSERT_LT(y, kPx.y);
  const haptics::BurShape head{.kind = haptics::ShapeKind::cylinder, .radius_mm = 3.0, .length_mm = 4.0};
  const calibration::Pose<calibration::Patient, calibration::Tool> X_PT{glm::dquat(glm::dvec3(0, 0, 1), normal),
                                                                        place + (0.5 * head.length_mm - 0.7) * normal};
  haptics::ErosionSettings fierce;
  fierce.time.removal_rate_per_s = 500.0;
  for (std::uint64_t tick = 0; tick < 40; ++tick)
    haptics::carveTool(bone, head, X_PT, haptics::phantom::timeErosion(fierce, 0.001), tick);
  EXPECT_GT(BrickUploader().upload(bone, {}, renderer), 0u);

  const render::DistanceImage after = look();
  const SeenPlaces cut(frame, after);
  const Agreement carved = agreementOf(cut, bone);
  EXPECT_LT(carved.rms_mm, 0.05) << "worst " << carved.worst_mm;
  // The floor alone.
  render::DistanceImage only_floor = after;
  for (std::size_t p = 0; p < before.mm.size(); ++p)
    if (after.mm[p] - before.mm[p] < 0.3f) only_floor.mm[p] = 0.0f;
  const Agreement floor = agreementOf(SeenPlaces(frame, only_floor), bone);
  EXPECT_GT(floor.places, 50);
  EXPECT_LT(floor.rms_mm, 0.05) << "worst " << floor.worst_mm;
  // The control.
  EXPECT_GT(agreementOf(seen, bone).rms_mm, 0.05) << "the uncarved depth image no longer fits the carved bone";
  for (const auto& [name, found] : {std::pair{"before", untouched}, {"after", carved}, {"floor", floor}})
    std::printf("%s: %d places, %.4f mm rms, worst %.3f\n", name, found.places, found.rms_mm, found.worst_mm);
}

INSTANTIATE_TEST_SUITE_P(Backends, FeltIsSeen,
                         testing::Values(render::Backend::gl_fragment, render::Backend::gl_compute,
                                         render::Backend::cpu),
                         [](const auto& given) {
                           return std::string(given.param == render::Backend::cpu           ? "Cpu"
                                              : given.param == render::Backend::gl_fragment ? "GlFragment"
                                                                                            : "GlCompute");
                         });

}  // namespace
}  // namespace app
