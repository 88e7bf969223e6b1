#include "render/cpu/shade_kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "render/shaders/light_constants.glsl"
#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

using assets::InstructionSet;

constexpr double kPi = 3.14159265358979;

std::vector<InstructionSet> sets() {
  std::vector<InstructionSet> have;
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512})
    if (assets::available(set)) have.push_back(set);
  return have;
}

struct Lit {
  std::vector<float> r = std::vector<float>(300), g = r, b = r;
  Light light() { return {r.data(), g.data(), b.data()}; }
  glm::dvec3 at(std::size_t n) const { return {r[n], g[n], b[n]}; }
};

// An eye at the origin looking along -z at a point 100 mm away, lit from direction `to_lamp`.
ShadeScene theatre(glm::vec3 to_lamp) {
  const glm::vec3 place(0, 0, -100), lamp = place + 500.0f * to_lamp;
  ShadeScene scene;
  scene.eye = {};
  scene.eye.lamp_P = glm::vec4(lamp, 500.0f);
  scene.eye.lamp_axis_P = glm::vec4(-to_lamp, 0.0f);
  scene.eye.up_P = {0, 1, 0, 0};
  return scene;
}

MeshPoints place(glm::vec3 colour, float roughness, int finish = FINISH_INSTRUMENT, glm::vec3 normal = {0, 0, 1}) {
  MeshPoints points;
  points.makeRoom(1);
  points.count = 1;
  points.ray[0] = 0;
  points.distance_mm[0] = 100.0f;
  points.nx[0] = normal.x, points.ny[0] = normal.y, points.nz[0] = normal.z;
  points.r[0] = colour.r, points.g[0] = colour.g, points.b[0] = colour.b, points.a[0] = 1.0f;
  points.roughness[0] = roughness;
  points.finish[0] = finish;
  points.faces_eye[0] = 1;
  return points;
}

glm::dvec3 lightOn(const ShadeScene& scene, const MeshPoints& points, InstructionSet set) {
  RayBatch rays;
  rays.count = 1;
  rays.z[0] = -1.0f;
  Lit lit;
  shadeKernels(set).meshes(scene, rays, points, lit.light());
  return lit.at(0);
}

// The lamp's contribution: the light minus that with the lamp behind the surface.
glm::dvec3 ofTheLamp(glm::vec3 to_lamp, const MeshPoints& points, InstructionSet set) {
  return lightOn(theatre(to_lamp), points, set) - lightOn(theatre({0, 0, -1}), points, set);
}

TEST(ShadeKernels, FollowTheCosineOnADullWhiteSurface) {
  for (const InstructionSet set : sets()) {
    // Of two surfaces with the same highlight only the white one scatters: albedo / pi * cosine.
    const glm::vec3 aslant(std::sqrt(0.75f), 0.0f, 0.5f);
    const glm::dvec3 white = ofTheLamp(aslant, place(glm::vec3(1.0f), 1.0f), set);
    const glm::dvec3 black = ofTheLamp(aslant, place(glm::vec3(0.0f), 1.0f), set);
    const double lamp[] = {LAMP_LIGHT};
    EXPECT_NEAR((white - black).r, lamp[0] * 0.5 / kPi, 1e-5);
    EXPECT_NEAR((white - black).b, lamp[2] * 0.5 / kPi, 1e-5);
  }
}

TEST(ShadeKernels, ReflectTheLampByGgxAtNormalIncidence) {
  for (const InstructionSet set : sets()) {
    // n = l = v: Fresnel f0, D = 1 / (pi a^2), visibility 1/4.
    const double a2 = std::pow(0.5, 4.0), lamp[] = {LAMP_LIGHT};
    const glm::dvec3 light = ofTheLamp({0, 0, 1}, place(glm::vec3(0.0f), 0.5f), set);
    EXPECT_NEAR(light.r, lamp[0] * MESH_F0 * 0.25 / (kPi * a2), 1e-5);
  }
}

TEST(ShadeKernels, WrapLightAroundSkinAndNotAroundSteel) {
  for (const InstructionSet set : sets()) {
    const glm::vec3 past(std::sqrt(1.0f - 0.01f), 0.0f, -0.1f);  // slightly behind the terminator
    EXPECT_NEAR(ofTheLamp(past, place(glm::vec3(0.8f), 0.6f), set).r, 0.0, 1e-6);
    const glm::dvec3 skin = ofTheLamp(past, place({0.8f, 0.5f, 0.4f}, 0.6f, FINISH_SKIN), set);
    EXPECT_GT(skin.r, 0.02);
    EXPECT_GT(skin.r / skin.b, 2.0) << "what creeps is red";
  }
}

TEST(ShadeKernels, FlipTheNormalOfABackFaceAndDimIt) {
  for (const InstructionSet set : sets()) {
    MeshPoints inside = place(glm::vec3(0.5f), 0.8f, FINISH_GINGIVA, {0, 0, -1});
    inside.faces_eye[0] = 0;
    const glm::dvec3 dim = ofTheLamp({0, 0, 1}, inside, set);
    const glm::dvec3 bright = ofTheLamp({0, 0, 1}, place(glm::vec3(0.5f), 0.8f, FINISH_GINGIVA), set);
    EXPECT_NEAR(dim.g, INSIDE_LAMP * bright.g, 1e-5);
  }
}

TEST(ShadeKernels, AimRaysThroughPointsOfTheImage) {
  for (const InstructionSet set : sets()) {
    EyeBlock eye{};
    eye.eye_P = {10, 20, 300, 0};
    eye.lower_left_P = {-90, -55, 0, 0};
    eye.right_edge_P = {200, 0, 0, 0};
    eye.up_edge_P = {0, 150, 0, 0};
    RayBatch rays;
    rays.count = 2;
    const float x[16] = {0.5f, 0.0f}, y[16] = {0.5f, 1.0f};
    shadeKernels(set).aim(eye, x, y, rays);
    EXPECT_NEAR(rays.z[0], -1.0f, 1e-6);
    EXPECT_NEAR(rays.near_mm[0], 30.0f, 1e-4);
    const glm::vec3 corner = glm::normalize(glm::vec3(-100, 75, -300));
    EXPECT_NEAR(rays.x[1], corner.x, 1e-6);
    EXPECT_NEAR(rays.y[1], corner.y, 1e-6);
  }
}

TEST(ShadeKernels, RollOffBrightLightOnly) {
  for (const InstructionSet set : sets()) {
    Lit lit;
    lit.r[0] = 0.6f, lit.r[1] = 1.0f, lit.r[2] = 1000.0f;
    shadeKernels(set).shoulder(lit.light(), 3);
    EXPECT_FLOAT_EQ(lit.r[0], 0.6f);
    EXPECT_FLOAT_EQ(lit.r[1], 0.85f);  // as far above the knee as 1 is: half of the rest
    EXPECT_NEAR(lit.r[2], 1.0f, 1e-3);
  }
}

TEST(ShadeKernels, EncodeSrgbWithinTheStatedError) {
  constexpr int kSteps = 1 << 16;
  std::vector<float> x(kSteps + 16);
  for (int i = 0; i <= kSteps; ++i) x[static_cast<std::size_t>(i)] = static_cast<float>(i) / kSteps;
  for (const InstructionSet set : sets()) {
    std::vector<std::uint32_t> rgba(x.size());
    shadeKernels(set).encode(x.data(), x.data(), x.data(), kSteps + 1, rgba.data());
    double worst = 0.0;
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const double exact = x[i] <= 0.0031308 ? 12.92 * x[i] : 1.055 * std::pow(x[i], 1.0 / 2.4) - 0.055;
      worst = std::max(worst, std::abs(255.0 * exact - (rgba[i] & 0xff)));
      EXPECT_EQ(rgba[i] >> 24, 255u);
    }
    EXPECT_LE(worst, 0.57);
    EXPECT_EQ(rgba[0], 0xff000000u);
    EXPECT_EQ(rgba[kSteps], 0xffffffffu);
  }
}

TEST(ShadeKernels, ClampValuesOutsideTheRange) {
  const float odd[16] = {-3.0f, 1.0001f, 1e30f, -0.0f, 7.0f};
  for (const InstructionSet set : sets()) {
    std::uint32_t rgba[6] = {0, 0, 0, 0, 0, 42};
    shadeKernels(set).encode(odd, odd, odd, 5, rgba);
    EXPECT_THAT(rgba, testing::ElementsAre(0xff000000u, 0xffffffffu, 0xffffffffu, 0xff000000u, 0xffffffffu, 42u));
  }
}

TEST(ShadeKernels, AgreeOverInstructionSets) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f), both(-1.0f, 1.0f);
  RayBatch rays;
  MeshPoints points;
  points.makeRoom(200);
  points.count = 200;
  rays.count = 200;
  for (int i = 0; i < 200; ++i) {
    const glm::vec3 d = glm::normalize(glm::vec3(both(engine), both(engine), -2.0f));
    rays.x[i] = d.x, rays.y[i] = d.y, rays.z[i] = d.z;
    points.ray[i] = i;
    points.distance_mm[i] = 50.0f + 100.0f * unit(engine);
    points.nx[i] = both(engine), points.ny[i] = both(engine), points.nz[i] = both(engine) + 0.01f;
    points.r[i] = unit(engine), points.g[i] = unit(engine), points.b[i] = unit(engine);
    points.roughness[i] = unit(engine), points.metallic[i] = static_cast<float>(i % 3 == 0);
    points.finish[i] = i % 3, points.is_cut[i] = i % 2, points.faces_eye[i] = i % 5 != 0;
  }
  ShadeScene scene = theatre(glm::normalize(glm::vec3(1, 1, 1)));
  scene.eye.window_eye_P = {0, 0, 0, 0};
  scene.eye.window_site_P = {0, 0, -150, 10};
  scene.window_axis_P = {0, 0, -1};
  scene.window_reach_mm = 150.0f;
  Lit first;
  shadeKernels(InstructionSet::portable).meshes(scene, rays, points, first.light());
  for (const InstructionSet set : sets()) {
    Lit lit;
    shadeKernels(set).meshes(scene, rays, points, lit.light());
    for (std::size_t i = 0; i < 200; ++i) {
      EXPECT_TRUE(std::isfinite(lit.r[i]));
      EXPECT_NEAR(lit.r[i], first.r[i], 1e-3 * (1.0 + first.r[i])) << i;
      EXPECT_NEAR(lit.b[i], first.b[i], 1e-3 * (1.0 + first.b[i])) << i;
    }
  }
}

}  // namespace
}  // namespace render
