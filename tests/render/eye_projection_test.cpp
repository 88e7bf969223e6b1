#include "render/display/eye_projection.h"

#include <gtest/gtest.h>

#include "render/display/camera.h"
#include "render/gpu/gpu_error.h"
#include "tests/render/ball_volume.h"

namespace render {
namespace {

using calibration::Point;
using calibration::Rig;
using calibration::World;
using testing::Random;
using testing::randomRig;

glm::dvec3 ndc(const EyeView& view, const Point<World>& p_W) {
  const glm::dvec4 clip = view.clip_from_W * glm::dvec4(p_W.mm, 1.0);
  return glm::dvec3(clip) / clip.w;
}

// The light path: from the panel by the mirror to the eye, that is, straight from the reflected eye to the reflected
// point through the physical panel.
glm::dvec2 tracedOntoPanel(const Rig& rig, const Point<World>& eye_W, const Point<World>& p_W) {
  const glm::dvec3 from = rig.mirror ? rig.mirror->reflect(eye_W).mm : eye_W.mm;
  const glm::dvec3 to = rig.mirror ? rig.mirror->reflect(p_W).mm : p_W.mm;
  const glm::dvec3 row = rig.screen.lower_right.mm - rig.screen.lower_left.mm;
  const glm::dvec3 column = rig.screen.upper_left.mm - rig.screen.lower_left.mm;
  const glm::dvec3 normal = glm::cross(row, column);
  const double t = glm::dot(normal, rig.screen.lower_left.mm - from) / glm::dot(normal, to - from);
  const glm::dvec3 hit = from + t * (to - from) - rig.screen.lower_left.mm;
  return {2.0 * glm::dot(hit, row) / glm::dot(row, row) - 1.0,
          2.0 * glm::dot(hit, column) / glm::dot(column, column) - 1.0};
}

Point<World> pointNearVirtualScreen(const Rig& rig, Random& random) {
  return {rig.X_WP.translation_mm + random.inCube(90.0)};
}

TEST(EyeProjection, AgreesWithTheTracedLightPathOver20000Rigs) {
  Random random(1);
  double worst = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const Rig rig = randomRig(random, n % 2 == 1);
    const Point<World> p_W = pointNearVirtualScreen(rig, random);
    for (const Eye eye : {Eye::left, Eye::right}) {
      const EyeView view = eyeView(rig, eye);
      const glm::dvec2 traced = tracedOntoPanel(rig, eye == Eye::left ? rig.left_eye : rig.right_eye, p_W);
      worst = std::max(worst, glm::length(glm::dvec2(ndc(view, p_W)) - traced));
    }
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(EyeProjection, GivesPointsOnTheVirtualScreenNoDisparity) {
  Random random(2);
  for (int n = 0; n < 2000; ++n) {
    const Rig rig = randomRig(random, n % 2 == 1);
    const EyeView left = eyeView(rig, Eye::left), right = eyeView(rig, Eye::right);
    const Point<World> p_W =
        left.lower_left_W + random.between(0.0, 1.0) * left.right_edge_W + random.between(0.0, 1.0) * left.up_edge_W;
    EXPECT_NEAR(ndc(left, p_W).x, ndc(right, p_W).x, 1e-9);
    EXPECT_NEAR(ndc(left, p_W).y, ndc(right, p_W).y, 1e-9);
  }
}

TEST(EyeProjection, CrossesTheEyesInFrontOfTheScreenOnly) {
  const Rig rig = cameraRig({.eye_P_mm = {0, -500, 0}}, {640, 480});
  const EyeView left = eyeView(rig, Eye::left), right = eyeView(rig, Eye::right);
  const Point<World> near_W{{0, 0, 50}}, far_W{{0, 0, -50}};
  EXPECT_GT(ndc(left, near_W).x, ndc(right, near_W).x);
  EXPECT_LT(ndc(left, far_W).x, ndc(right, far_W).x);
}

TEST(EyeProjection, IsLeftHandedExactlyWithAMirror) {
  Random random(3);
  for (int n = 0; n < 1000; ++n) EXPECT_EQ(eyeView(randomRig(random, n % 2 == 1), Eye::left).mirrored, n % 2 == 1);
}

TEST(EyeProjection, MakesALetterReadRightInTheMirroredWorkstation) {
  // A point is drawn at a pixel of the panel, which is seen in the mirror at the same point.
  const Rig rig = calibration::mirroredWorkstationRig();
  const EyeView view = eyeView(rig, Eye::cyclopean);
  EXPECT_TRUE(view.mirrored);
  for (const glm::dvec3 stroke : {glm::dvec3(-40, 60, 0), glm::dvec3(40, 60, 0), glm::dvec3(-40, -60, 0)}) {
    const glm::dvec2 share = 0.5 * (glm::dvec2(ndc(view, {stroke})) + 1.0);
    const glm::dvec3 lit = rig.screen.lower_left.mm + share.x * (rig.screen.lower_right - rig.screen.lower_left).xyz +
                           share.y * (rig.screen.upper_left - rig.screen.lower_left).xyz;
    EXPECT_LT(glm::distance(rig.mirror->reflect({lit}).mm, stroke), 1e-9);
  }
  EXPECT_LT(ndc(view, {{0.0, 10.0, 0.0}}).y, 0.0) << "on the panel itself it is upside down";
  EXPECT_GT(ndc(view, {{10.0, 0.0, 0.0}}).x, 0.0);
}

TEST(EyeProjection, GrowsInDepthAwayFromTheEye) {
  Random random(4);
  for (int n = 0; n < 500; ++n) {
    const Rig rig = randomRig(random, n % 2 == 1);
    const EyeView view = eyeView(rig, Eye::cyclopean);
    const glm::dvec3 ahead = rig.X_WP.translation_mm - view.eye_W.mm;
    EXPECT_LT(ndc(view, {view.eye_W.mm + 0.8 * ahead}).z, ndc(view, {view.eye_W.mm + 1.2 * ahead}).z);
    EXPECT_GT(ndc(view, {view.eye_W.mm + 0.8 * ahead}).z, -1.0);
    EXPECT_LT(ndc(view, {view.eye_W.mm + 1.2 * ahead}).z, 1.0);
  }
}

TEST(Camera, LooksAtItsTargetWithTheGivenAngle) {
  const Camera camera{.eye_P_mm = {10, -200, 40}, .look_at_P_mm = {5, 5, 5}, .up_P = {0, 0, 1}, .fov_y_rad = 0.6};
  const Rig rig = cameraRig(camera, {400, 300});
  const EyeView view = eyeView(rig, Eye::cyclopean);
  const auto seen = [&](const glm::dvec3& p_P) { return ndc(view, rig.X_WP * Point<calibration::Patient>{p_P}); };
  EXPECT_NEAR(glm::length(glm::dvec2(seen(camera.look_at_P_mm))), 0.0, 1e-9);

  // A point half the angle above the axis is projected to the middle of the upper edge.
  const glm::dvec3 back = camera.eye_P_mm - camera.look_at_P_mm;
  const glm::dvec3 up = glm::normalize(camera.up_P - glm::dot(camera.up_P, back) / glm::dot(back, back) * back);
  const glm::dvec3 top = seen(camera.look_at_P_mm + std::tan(0.3) * glm::length(back) * up);
  EXPECT_NEAR(top.x, 0.0, 1e-9);
  EXPECT_NEAR(top.y, 1.0, 1e-9);
  EXPECT_NEAR(glm::length(view.eye_W.mm - (rig.X_WP * Point<calibration::Patient>{camera.eye_P_mm}).mm), 0.0, 1e-9);
}

TEST(Camera, RefusesAnInvalidView) {
  EXPECT_THROW(cameraRig({.eye_P_mm = {1, 2, 3}, .look_at_P_mm = {1, 2, 3}}, {64, 48}), GpuError);
  EXPECT_THROW(cameraRig({.eye_P_mm = {0, 0, 9}, .look_at_P_mm = {0, 0, 0}, .up_P = {0, 0, 2}}, {64, 48}), GpuError);
  EXPECT_THROW(cameraRig({.fov_y_rad = 3.2}, {64, 48}), GpuError);
  EXPECT_THROW(cameraRig({.eye_P_mm = {NAN, 0, 9}}, {64, 48}), GpuError);
}

// A plane between the eye and the screen's middle, out towards the eye.
calibration::Plane<World> glassBefore(const EyeView& view, Random& random) {
  const glm::dvec3 middle = view.lower_left_W.mm + 0.5 * (view.right_edge_W.xyz + view.up_edge_W.xyz);
  const glm::dvec3 to_eye = glm::normalize(view.eye_W.mm - middle);
  const glm::dvec3 out = glm::normalize(to_eye + 0.7 * random.direction());
  return {out, glm::dot(out, middle + random.inCube(30.0))};
}

TEST(ReflectedView, RayOfAPixelIsTheReflectedRayOfThatPixel) {
  Random random(11);
  double worst = 0.0;
  for (int n = 0; n < 5000; ++n) {
    const EyeView view = eyeView(randomRig(random, n % 2 == 1), Eye::left);
    const calibration::Plane<World> glass = glassBefore(view, random);
    const EyeView there = reflected(view, glass);
    const double u = random.between(0.0, 1.0), v = random.between(0.0, 1.0);
    const auto ray = [&](const EyeView& of) {
      return glm::normalize(of.lower_left_W.mm + u * of.right_edge_W.xyz + v * of.up_edge_W.xyz - of.eye_W.mm);
    };
    const glm::dvec3 d = ray(view), e = view.eye_W.mm;
    const glm::dvec3 bounced = d - 2.0 * glm::dot(d, glass.normal) * glass.normal;
    worst = std::max(worst, glm::length(ray(there) - bounced));
    // It comes from the reflected eye through the place where the ray meets the glass.
    const glm::dvec3 hit = e - glass.distance_mm(view.eye_W) / glm::dot(d, glass.normal) * d;
    worst = std::max(worst, glm::length(glm::cross(bounced, glm::normalize(hit - there.eye_W.mm))));
  }
  EXPECT_LT(worst, 1e-12);
}

TEST(ReflectedView, ShowsAPointInThePixelOfItsMirrorImageAndEndsAtTheGlass) {
  Random random(12);
  double worst_px = 0.0;
  int before = 0;
  for (int n = 0; n < 5000; ++n) {
    const Rig rig = randomRig(random, n % 2 == 1);
    const EyeView view = eyeView(rig, Eye::right);
    const calibration::Plane<World> glass = glassBefore(view, random);
    const double begins_mm = n % 3 == 0 ? 0.05 : 0.0;
    const EyeView there = reflected(view, glass, begins_mm);
    EXPECT_NE(there.mirrored, view.mirrored);
    const Point<World> p = pointNearVirtualScreen(rig, random), image = glass.reflect(p);
    const glm::dvec3 seen = ndc(there, p), straight = ndc(view, image);
    if (glm::length(glm::dvec2(straight)) > 4.0) continue;
    worst_px = std::max(worst_px, 0.5 * 1920.0 * glm::length(glm::dvec2(seen) - glm::dvec2(straight)));
    const bool is_before = glass.distance_mm(p) > begins_mm;
    before += is_before ? 1 : 0;
    EXPECT_EQ(seen.z > -1.0, is_before);
    EXPECT_LT(seen.z, 1.0);
  }
  EXPECT_LT(worst_px, 1e-8);
  EXPECT_GT(before, 1000);
}

}  // namespace
}  // namespace render
