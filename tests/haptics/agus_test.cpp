#include "haptics/contact/immersion.h"

#include <gtest/gtest.h>

#include <random>

#include "calibration/geometry/units.h"
#include "haptics/contact/law.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

struct Errors {
  double depth_rms = 0.0, angle_deg_max = 0.0;
};

glm::dvec3 anyDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

/// Depth (relative) and direction over faces of random or axis-aligned orientation and random lattice phase.
Errors errorsOnFlatBone(double R, double h, double s, bool aligned) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> phase(-0.5, 0.5);
  Errors errors;
  constexpr int kFaces = 24;
  for (int face = 0; face < kFaces; ++face) {
    glm::dvec3 normal = anyDirection(random);
    if (aligned) {
      normal = glm::dvec3(0.0);
      normal[face % 3] = face % 2 == 0 ? 1.0 : -1.0;
    }
    // Aligned faces take evenly spread phases, so that the rms is one over all of them.
    const double even = (face + 0.5) / kFaces - 0.5;
    const glm::dvec3 shift = s * (aligned ? glm::dvec3(even) : glm::dvec3(phase(random), phase(random), phase(random)));
    const Phantom phantom = halfSpace(R + 0.6, s, normal, shift);
    const Immersion contact = sphereImmersion(phantom.field(), {(R - h) * normal}, R);
    errors.depth_rms += (contact.depth_mm / h - 1.0) * (contact.depth_mm / h - 1.0) / kFaces;
    const double cosine = glm::dot(glm::normalize(contact.normal_P.xyz), normal);
    errors.angle_deg_max =
        std::max(errors.angle_deg_max, calibration::degreesFromRad(std::acos(std::min(1.0, cosine))));
    EXPECT_NEAR(glm::length(contact.normal_P.xyz), 1.0, 1e-12);
  }
  errors.depth_rms = std::sqrt(errors.depth_rms);
  return errors;
}

TEST(Agus, FeelsTheDepthOfFlatBoneInAnyOrientation) {
  for (bool aligned : {false, true}) {
    for (double h : {1.0, 1.5, 2.0}) {
      const Errors errors = errorsOnFlatBone(2.0, h, 0.1, aligned);
      EXPECT_LE(errors.depth_rms, 0.005) << "h " << h << " aligned " << aligned;
      EXPECT_LE(errors.angle_deg_max, 0.3) << "h " << h << " aligned " << aligned;
    }
    const Errors shallow = errorsOnFlatBone(2.0, 0.2, 0.1, aligned);
    EXPECT_LE(shallow.depth_rms, 0.01) << "aligned " << aligned;
    EXPECT_LE(shallow.angle_deg_max, 0.3) << "aligned " << aligned;
  }
}

TEST(Agus, FeelsTheSameForceAtBothVoxelSizes) {
  std::mt19937 random(5);
  for (int face = 0; face < 8; ++face) {
    const glm::dvec3 normal = anyDirection(random);
    for (double h : {0.5, 1.0, 2.0}) {
      const Point<Patient> centre{(2.0 - h) * normal};
      const double fine = sphereImmersion(halfSpace(2.6, 0.1, normal).field(), centre, 2.0).depth_mm;
      const double coarse = sphereImmersion(halfSpace(2.6, 0.2, normal).field(), centre, 2.0).depth_mm;
      EXPECT_NEAR(coarse, fine, 0.02 * fine);
    }
  }
}

TEST(Agus, IsSmoothAlongAFlatFace) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
  const glm::dvec3 along = glm::normalize(glm::cross(normal, glm::dvec3(0.0, 1.0, 0.0)));
  const Phantom phantom = halfSpace(4.0, 0.2, normal);
  double least = 1e9, most = 0.0;
  for (int i = 0; i <= 40; ++i) {
    const double depth = sphereImmersion(phantom.field(), {1.0 * normal + 0.025 * i * along}, 2.0).depth_mm;
    least = std::min(least, depth);
    most = std::max(most, depth);
  }
  EXPECT_LT((most - least) / least, 0.005);
}

TEST(Agus, TouchesWhereTheSurfaceIs) {
  // No force a twentieth of a millimetre above the face, some a twentieth below.
  for (double s : {0.1, 0.2}) {
    const Phantom phantom = halfSpace(3.0, s, {0.0, 0.0, 1.0}, glm::dvec3(0.31 * s));
    EXPECT_EQ(sphereImmersion(phantom.field(), {{0.0, 0.0, 2.05}}, 2.0).depth_mm, 0.0);
    EXPECT_GT(sphereImmersion(phantom.field(), {{0.0, 0.0, 1.95}}, 2.0).depth_mm, 0.0);
  }
}

TEST(Agus, PushesOutWithStiffnessTimesDepthAndDampsOnlyInContact) {
  const Phantom phantom = halfSpace(3.0, 0.1);
  LawSettings law;
  law.agus.stiffness_N_per_mm = 0.5;
  law.damping_Ns_per_mm = 0.002;
  const Vector<Patient> velocity{{10.0, 0.0, -20.0}};
  const auto contactAt = [&](double z_mm) {
    return contactOf(law, {phantom.field(), {}, {glm::dquat(1.0, 0.0, 0.0, 0.0), {0.0, 0.0, z_mm}}, law.tissue, {}});
  };
  EXPECT_NEAR(contactAt(1.0).force_P_N.xyz.z, 0.5, 0.005);
  EXPECT_EQ(dampingForce_N(law, contactAt(1.0), velocity).xyz, -0.002 * velocity.xyz);
  EXPECT_EQ(contactAt(3.0).force_P_N.xyz, glm::dvec3(0.0));
  EXPECT_EQ(dampingForce_N(law, contactAt(3.0), velocity).xyz, glm::dvec3(0.0));
}

TEST(Agus, HasNoDirectionInTheMiddleOfBone) {
  const Phantom phantom = block(4.0, 0.1);
  EXPECT_LT(glm::length(sphereImmersion(phantom.field(), {{0.017, 0.031, -0.05}}, 2.0).normal_P.xyz), 0.1);
}

TEST(Agus, KeepsItsFullLengthInAShallowTouch) {
  const Phantom phantom = halfSpace(3.0, 0.1, {0.0, 0.0, 1.0}, glm::dvec3(0.03));
  const Immersion contact = sphereImmersion(phantom.field(), {{0.0, 0.0, 1.97}}, 2.0);
  EXPECT_GT(contact.depth_mm, 0.0);
  EXPECT_NEAR(glm::length(contact.normal_P.xyz), 1.0, 1e-12);
}

}  // namespace
}  // namespace haptics
