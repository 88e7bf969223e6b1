#include "assets/synthetic/face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "assets/load_error.h"
#include "assets/synthetic/dental_arch.h"
#include "assets/synthetic/face_frames.h"
#include "assets/synthetic/mandible_shape.h"
#include "assets/synthetic/mouth_interior.h"

namespace assets {
namespace {

constexpr double kCoarse_mm = 2.0;
constexpr glm::dvec3 kThirdMolar38_mm{26.0, 38.0, -5.0};

const MeshModel& leftFace() {
  static const MeshModel model = syntheticFace({.tooth_fdi = 38, .voxel_mm = kCoarse_mm});
  return model;
}

// Distance along a ray to the nearest triangle, infinite if it is free (Moeller and Trumbore, 1997).
double firstHit_mm(const MeshModel& model, const glm::dvec3& from, const glm::dvec3& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const MeshPart& part : model.parts) {
    for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
      const auto corner = [&](std::size_t i) { return glm::dvec3(part.position_mm[part.triangles[t + i]]); };
      const glm::dvec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
      const glm::dvec3 h = glm::cross(direction, ac);
      const double det = glm::dot(ab, h);
      if (std::abs(det) < 1e-12) continue;
      const glm::dvec3 s = from - a, q = glm::cross(s, ab);
      const double u = glm::dot(s, h) / det, v = glm::dot(direction, q) / det, t_mm = glm::dot(ac, q) / det;
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t_mm > 0.0) nearest = std::min(nearest, t_mm);
    }
  }
  return nearest;
}

TEST(Face, LeavesTheViewOfTheThirdMolarFree) {
  // A window of 8 mm around the crown, seen from the surgeon's eye.
  const glm::dvec3 to_eye = surgeonEyeDirection(38);
  const glm::dvec3 across = glm::normalize(glm::cross(to_eye, glm::dvec3(0, 0, 1)));
  const glm::dvec3 up = glm::cross(across, to_eye);
  for (const double radius_mm : {0.0, 4.0, 8.0}) {
    for (int n = 0; n < 8; ++n) {
      const double turn = 0.785398 * n;
      const glm::dvec3 offset = radius_mm * (std::cos(turn) * across + std::sin(turn) * up);
      const glm::dvec3 from = kThirdMolar38_mm + offset + 6.0 * to_eye;
      EXPECT_TRUE(std::isinf(firstHit_mm(leftFace(), from, to_eye))) << radius_mm << " mm at " << turn;
    }
  }
}

TEST(Face, HidesTheMolarBehindTheFreeCheek) {
  // The same view on the other side is blocked: the test above can fail.
  const glm::dvec3 eye = surgeonEyeDirection(48);
  const glm::dvec3 molar48(-kThirdMolar38_mm.x, kThirdMolar38_mm.y, kThirdMolar38_mm.z);
  EXPECT_TRUE(std::isfinite(firstHit_mm(leftFace(), molar48 + 6.0 * eye, eye)));
}

TEST(Face, KeepsOutOfTheSpaceOfTheScannedJaw) {
  for (const MeshPart& part : leftFace().parts) {
    for (const glm::vec3& p : part.position_mm) ASSERT_GT(jawSegmentSpace_mm(glm::dvec3(p)), -1.5) << part.name;
  }
}

TEST(Face, KeepsOutOfTheBoneOfTheBuiltInJaw) {
  const DentalArch arch;
  const MandibleShape bone(arch, 1);
  for (const MeshPart& part : leftFace().parts) {
    for (const glm::vec3& p : part.position_mm) {
      const glm::dvec3 p_J(p);
      ASSERT_GT(std::max(bone.outer_mm(p_J), bone.cut_mm(p_J)), -0.1)
          << part.name << " " << p.x << " " << p.y << " " << p.z;
    }
  }
}

TEST(Face, HasAWholeCanineInFrontOfTheScan) {
  // The same teeth on both sides in front of the plane where the scan begins.
  const ArchStation cut = anteriorCut(DentalArch());
  std::mt19937 random(11);
  std::uniform_real_distribution<double> x(4.0, 22.0), y(-4.0, 14.0), z(-11.0, 1.0);
  int inside = 0;
  for (int n = 0; n < 20000; ++n) {
    const glm::dvec3 p(x(random), y(random), z(random));
    if (glm::dot(glm::dvec2(p) - cut.centre_mm, cut.distal) > -0.2) continue;
    const bool is_tooth = lowerTeeth_mm(p) < 0.0;
    EXPECT_EQ(is_tooth, lowerTeeth_mm({-p.x, p.y, p.z}) < 0.0) << p.x << ' ' << p.y << ' ' << p.z;
    inside += is_tooth ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
}

TEST(Face, HasATongueBesideTheCrownsAndNotThroughThem) {
  constexpr float kGingiva_mm = -11.0f;
  for (const MeshPart& part : leftFace().parts) {
    if (part.name != "LowerTeeth") continue;
    for (const glm::vec3& p : part.position_mm) {
      if (p.z < kGingiva_mm) continue;
      ASSERT_GT(tongue_mm(glm::dvec3(p)), 0.0) << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
}

TEST(Face, IsValidAndHasAllItsParts) {
  std::set<std::string> names;
  for (const MeshPart& part : leftFace().parts) {
    names.insert(part.name);
    ASSERT_FALSE(part.triangles.empty()) << part.name;
    ASSERT_EQ(part.normal.size(), part.position_mm.size());
    for (const std::uint32_t vertex : part.triangles) ASSERT_LT(vertex, part.position_mm.size());
    for (const glm::vec3& n : part.normal) ASSERT_NEAR(glm::length(n), 1.0f, 1e-3f) << part.name;
    for (const glm::vec4& c : part.colour)
      ASSERT_TRUE(c.r >= 0 && c.r <= 1.2f && std::isfinite(c.g + c.b)) << part.name;
  }
  EXPECT_EQ(names, (std::set<std::string>{"Face", "Mouth", "UpperTeeth", "LowerTeeth", "Tongue", "Hair", "Cap", "Drape",
                                          "Retractor"}));
}

TEST(Face, IsOpenByThirtyFiveToFortyMillimetres) {
  // From the lower incisal edge to the upper one, on the midline.
  double lower = -1e9;
  double upper = 1e9;
  for (const MeshPart& part : leftFace().parts) {
    for (const glm::vec3& p : part.position_mm) {
      if (std::abs(p.x) > 4.0f) continue;
      if (part.name == "LowerTeeth") lower = std::max<double>(lower, p.z);
      if (part.name == "UpperTeeth") upper = std::min<double>(upper, p.z);
    }
  }
  EXPECT_NEAR(lower, 0.0, 1.0);
  EXPECT_GE(upper - lower, 35.0);
  EXPECT_LE(upper - lower, 40.0);
}

/// The left face with the mouth open so far.
const MeshModel& faceOpenedBy(double opening_mm) {
  static std::map<double, MeshModel> made;
  const auto [at, is_new] = made.try_emplace(opening_mm);
  if (is_new) at->second = syntheticFace({.tooth_fdi = 38, .opening_mm = opening_mm, .voxel_mm = kCoarse_mm});
  return at->second;
}

TEST(Face, IsOpenAsFarAsAsked) {
  for (const double opening_mm : {kLeastOpening_mm, 30.0, 35.0, kMostOpening_mm}) {
    double lower = -1e9, upper = 1e9;
    for (const MeshPart& part : faceOpenedBy(opening_mm).parts)
      for (const glm::vec3& p : part.position_mm) {
        if (std::abs(p.x) > 4.0f) continue;
        if (part.name == "LowerTeeth") lower = std::max<double>(lower, p.z);
        if (part.name == "UpperTeeth") upper = std::min<double>(upper, p.z);
      }
    EXPECT_NEAR(upper - lower, opening_mm, 0.7);
  }
}

TEST(Face, LeavesALessOpenMouthANarrowerWayToTheThirdMolar) {
  // Directions within 30 degrees of the best line of sight that meet nothing on the way out.
  const glm::dvec3 to_eye = surgeonEyeDirection(38);
  const glm::dvec3 across = glm::normalize(glm::cross(to_eye, glm::dvec3(0, 0, 1))), up = glm::cross(across, to_eye);
  const auto free_ways = [&](double opening_mm) {
    int ways = 0;
    for (int i = -5; i <= 5; ++i)
      for (int j = -5; j <= 5; ++j) {
        const glm::dvec3 way = glm::normalize(to_eye + 0.115 * (double(i) * across + double(j) * up));
        ways += std::isinf(firstHit_mm(faceOpenedBy(opening_mm), kThirdMolar38_mm + 6.0 * to_eye, way)) ? 1 : 0;
      }
    return ways;
  };
  const int narrow = free_ways(kLeastOpening_mm), usual = free_ways(kUsualOpening_mm),
            wide = free_ways(kMostOpening_mm);
  EXPECT_LT(narrow, 0.9 * usual);
  EXPECT_GT(wide, 1.15 * usual);
  EXPECT_GT(narrow, 5);
}

TEST(Face, KeepsOutOfTheSpaceOfTheScannedJawHoweverFarItIsOpen) {
  for (const double opening_mm : {kLeastOpening_mm, kMostOpening_mm})
    for (const MeshPart& part : faceOpenedBy(opening_mm).parts)
      for (const glm::vec3& p : part.position_mm) {
        if (part.name == "UpperTeeth") continue;
        ASSERT_GT(jawSegmentSpace_mm(glm::dvec3(p)), -1.5) << part.name << " at " << opening_mm << " mm";
      }
}

TEST(MouthOpening, TurnsTheSkullAboutTheHingeThatGlides) {
  const MouthOpening usual, narrow(kLeastOpening_mm), wide(kMostOpening_mm);
  for (const MouthOpening* opening : {&usual, &narrow, &wide}) {
    const glm::dvec3 p(11.0, 23.0, -7.0), there = opening->mandibleFromSkull(opening->skullFromMandible(p));
    EXPECT_NEAR(glm::distance(p, there), 0.0, 1e-12);
  }
  // 22 degrees and a glide of (0, -10, -4) mm at 37 mm: the upper incisal edge by hand.
  const glm::dvec3 edge = usual.mandibleFromSkull({0.0, -3.0, -0.7});
  EXPECT_NEAR(edge.y, -3.85, 0.01);
  EXPECT_NEAR(edge.z, 36.90, 0.01);
  EXPECT_EQ(usual.raised_mm(-14.0), 0.0);
  EXPECT_NEAR(wide.raised_mm(-3.0), 13.0, 0.3);
  EXPECT_LT(narrow.raised_mm(-3.0), -11.0);
  EXPECT_LT(wide.raised_mm(40.0), 0.7 * wide.raised_mm(-3.0)) << "less at the molars";
}

TEST(Face, IsTheMirrorImageOnTheOtherSide) {
  const MeshModel right = syntheticFace({.tooth_fdi = 48, .voxel_mm = kCoarse_mm});
  ASSERT_EQ(right.parts.size(), leftFace().parts.size());
  for (std::size_t n = 0; n < right.parts.size(); ++n) {
    const MeshPart& a = leftFace().parts[n];
    const MeshPart& b = right.parts[n];
    ASSERT_EQ(a.position_mm.size(), b.position_mm.size()) << a.name;
    for (std::size_t i = 0; i < a.position_mm.size(); ++i) {
      ASSERT_EQ(a.position_mm[i], b.position_mm[i] * glm::vec3(-1, 1, 1)) << a.name;
    }
    ASSERT_EQ(a.triangles[1], b.triangles[2]);
  }
}

TEST(Face, RefusesOtherTeethThanLowerThirdMolars) {
  EXPECT_THROW(syntheticFace({.tooth_fdi = 18}), LoadError);
  EXPECT_THROW(syntheticFace({.opening_mm = 24.9}), LoadError);
  EXPECT_THROW(syntheticFace({.opening_mm = 50.1}), LoadError);
  EXPECT_THROW(syntheticFace({.voxel_mm = 0.0}), LoadError);
  EXPECT_THROW(syntheticFace({.voxel_mm = std::nan("")}), LoadError);
}

}  // namespace
}  // namespace assets
