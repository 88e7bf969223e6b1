#include "calibration/synthetic/glass_plate.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "calibration/geometry/units.h"
#include "tests/calibration/synthetic/glass_formulas.h"

namespace calibration {
namespace {

const glm::dvec3 kSlanted = glm::normalize(glm::dvec3(0, 1, 1));

TEST(GlassPlate, ShiftsARayByTheTextbookFigures) {
  const double angle = radFromDegrees(45.0);
  EXPECT_NEAR(plateShift_mm({{kSlanted, 0.0}, 3.0}, angle), 1.01, 0.01);
  EXPECT_NEAR(plateShift_mm({{kSlanted, 0.0}, 2.0}, angle), 0.67, 0.01);
  EXPECT_NEAR(plateShift_mm({{kSlanted, 0.0}, 1.0}, angle), 0.34, 0.01);
  EXPECT_NEAR(ghostSpacing_mm({{kSlanted, 0.0}, 3.0}, angle), 2.2, 0.05);
}

TEST(GlassPlate, ShiftsARayByTheFormulaWithoutRotation) {
  std::mt19937 rng(5);
  std::normal_distribution<double> any;
  for (int i = 0; i < 1000; ++i) {
    const GlassPlate plate{{glm::normalize(glm::dvec3(any(rng), any(rng), any(rng))), 20.0 * any(rng)},
                           1.0 + std::abs(any(rng)),
                           1.3 + 0.1 * std::abs(any(rng))};
    const Ray ray{{{any(rng), any(rng), any(rng)}}, {glm::normalize(glm::dvec3(any(rng), any(rng), any(rng)))}};
    const Ray out = seenThrough(plate, ray);
    EXPECT_EQ(out.along_W.xyz, ray.along_W.xyz);
    const double moved_mm = glm::length(glm::cross(out.from_W.mm - ray.from_W.mm, ray.along_W.xyz));
    const double angle = std::acos(std::min(1.0, std::abs(glm::dot(ray.along_W.xyz, plate.face.normal))));
    EXPECT_NEAR(moved_mm, plateShift_mm(plate, angle), 1e-9);
  }
}

TEST(GlassPlate, DoesNotShiftAPerpendicularRay) {
  const Ray ray{{{1, 2, 300}}, {{0, 0, -1}}};
  EXPECT_EQ(seenThrough({{{0, 0, 1}, 100.0}, 5.0}, ray).from_W.mm, ray.from_W.mm);
}

TEST(GlassPlate, ReflectsLikeThePlane) {
  const Plane<World> face{kSlanted, 141.4};
  const Ray ray{{{10, 20, 450}}, {glm::normalize(glm::dvec3(0.1, -0.05, -1))}};
  const Ray out = mirrored(face, ray);
  EXPECT_NEAR(face.distance_mm(out.from_W), 0.0, 1e-9);
  const glm::dvec3 farther = ray.from_W.mm + 900.0 * ray.along_W.xyz;
  const glm::dvec3 along_out = face.reflect({farther}).mm - out.from_W.mm;
  EXPECT_NEAR(glm::length(glm::cross(glm::normalize(along_out), out.along_W.xyz)), 0.0, 1e-12);
}

TEST(GlassPlate, TheFarFaceGivesAShiftedGhost) {
  const GlassPlate plate{{kSlanted, 141.4}, 3.0};
  const Ray ray{{{0, 0, 450}}, {{0, 0, -1}}};
  const Ray first = mirrored(plate.face, ray), ghost = mirroredByFarFace(plate, ray);
  EXPECT_EQ(first.along_W.xyz, ghost.along_W.xyz);
  EXPECT_NEAR(glm::length(glm::cross(ghost.from_W.mm - first.from_W.mm, first.along_W.xyz)),
              ghostSpacing_mm(plate, radFromDegrees(45.0)), 1e-9);
}

}  // namespace
}  // namespace calibration
