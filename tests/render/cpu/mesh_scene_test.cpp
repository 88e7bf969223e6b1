#include "render/cpu/mesh_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>

namespace render {
namespace {

assets::MeshPart triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, float opacity = 1.0f) {
  assets::MeshPart part;
  part.name = "Part";
  part.material.base_colour = {0.5f, 0.25f, 1.0f, opacity};
  part.position_mm = {a, b, c};
  part.normal = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  part.triangles = {0, 1, 2};
  return part;
}

// Facing +z, 20 mm wide.
assets::MeshPart sheet(float z, float opacity = 1.0f) {
  assets::MeshPart part = triangle({-10, -10, z}, {10, -10, z}, {10, 10, z}, opacity);
  part.position_mm.push_back({-10, 10, z});
  part.normal.assign(4, {0, 0, 1});
  part.triangles = {0, 1, 2, 0, 2, 3};
  return part;
}

RayBatch rays(glm::vec3 from, const std::vector<glm::vec3>& directions) {
  RayBatch batch;
  batch.origin_P = from;
  for (const glm::vec3& d : directions) {
    const int i = batch.count++;
    batch.x[i] = d.x, batch.y[i] = d.y, batch.z[i] = d.z;
    batch.near_mm[i] = 0.0f, batch.far_mm[i] = 1e6f;
  }
  return batch;
}

struct Met {
  MeshPoints points;
  std::vector<float> distance_mm;
};

void findFirst(const MeshScene& scene, const RayBatch& batch, MeshHits& hits) {
  scene.staticHits(batch, hits);
  scene.addDynamicHits(batch, hits);
}

Met first(const MeshScene& scene, const RayBatch& batch) {
  Met met;
  MeshHits hits;
  findFirst(scene, batch, hits);
  scene.addSeen(batch, hits, hits.distance_mm, met.points);
  met.distance_mm.assign(hits.distance_mm, hits.distance_mm + batch.count);
  return met;
}

MeshPoints layersOf(const MeshScene& scene, const RayBatch& batch, float limit_mm = 1e6f) {
  MeshPoints points;
  const std::vector<float> limit(RayBatch::kMaxRays, limit_mm);
  MeshHits veil;
  if (scene.hasVeil()) scene.veilHits(batch, veil);
  scene.layers(batch, limit.data(), scene.hasVeil() ? &veil : nullptr, points);
  return points;
}

// Moeller & Trumbore 1997, in double.
std::optional<double> distanceTo(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& a, const glm::dvec3& b,
                                 const glm::dvec3& c) {
  const glm::dvec3 e = b - a, f = c - a, p = glm::cross(d, f);
  const double det = glm::dot(e, p);
  const glm::dvec3 s = o - a, q = glm::cross(s, e);
  const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det, t = glm::dot(f, q) / det;
  if (u < 0.0 || v < 0.0 || u + v > 1.0 || t <= 0.0) return std::nullopt;
  return t;
}

TEST(MeshScene, HasNoHitsWhenItIsEmpty) {
  MeshScene scene;
  const Met met = first(scene, rays({0, 0, 50}, {{0, 0, -1}}));
  EXPECT_EQ(met.points.count, 0);
  EXPECT_EQ(met.distance_mm[0], 0.0f);
}

TEST(MeshScene, GivesDistanceColourAndVisibleSide) {
  MeshScene scene;
  scene.setModel(Model::gingiva, {{sheet(0.0f)}});
  const Met front = first(scene, rays({0, 1, 50}, {{0, 0, -1}}));
  ASSERT_EQ(front.points.count, 1);
  EXPECT_FLOAT_EQ(front.distance_mm[0], 50.0f);
  EXPECT_EQ(front.points.faces_eye[0], 1);
  EXPECT_EQ(front.points.finish[0], FINISH_GINGIVA);
  EXPECT_FLOAT_EQ(front.points.g[0], 0.25f);
  const Met back = first(scene, rays({0, 1, -30}, {{0, 0, 1}}));
  ASSERT_EQ(back.points.count, 1);
  EXPECT_FLOAT_EQ(back.distance_mm[0], 30.0f);
  EXPECT_EQ(back.points.faces_eye[0], 0);
}

TEST(MeshScene, InterpolatesNormalsAndColoursLinearlyOnTheTriangle) {
  MeshScene scene;
  assets::MeshPart part = triangle({0, 0, 0}, {8, 0, 0}, {0, 8, 0});
  part.colour = {{1, 1, 1, 1}, {0, 1, 1, 1}, {1, 0, 1, 1}};
  scene.setModel(Model::face, {{part}});
  // At (2, 4): a quarter of the way to the second corner, half to the third.
  const Met met = first(scene, rays({2, 4, 9}, {{0, 0, -1}}));
  ASSERT_EQ(met.points.count, 1);
  EXPECT_NEAR(met.points.nx[0], 0.25, 1e-6);
  EXPECT_NEAR(met.points.ny[0], 0.25, 1e-6);
  EXPECT_NEAR(met.points.nz[0], 0.5, 1e-6);
  EXPECT_NEAR(met.points.r[0], 0.5 * 0.75, 1e-6);
  EXPECT_NEAR(met.points.g[0], 0.25 * 0.5, 1e-6);
}

TEST(MeshScene, FindsTheFirstOfManyTrianglesAsAnExhaustiveSearchDoes) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> in(-20.0f, 20.0f), small(-4.0f, 4.0f);
  const auto place = [&] { return glm::vec3(in(engine), in(engine), in(engine)); };
  assets::MeshModel model;
  for (int i = 0; i < 200; ++i) {
    const glm::vec3 a = place();
    model.parts.push_back(triangle(a, a + glm::vec3(small(engine), small(engine), small(engine)),
                                   a + glm::vec3(small(engine), small(engine), small(engine))));
  }
  MeshScene scene;
  scene.setModel(Model::gingiva, model);
  int hits = 0;
  std::vector<glm::vec3> directions;
  const glm::vec3 from{3, 2, 60};
  for (int i = 0; i < 253; ++i) directions.push_back(glm::normalize(place() - from));
  const RayBatch batch = rays(from, directions);
  const Met met = first(scene, batch);
  for (std::size_t r = 0; r < directions.size(); ++r) {
    double best = std::numeric_limits<double>::infinity();
    for (const assets::MeshPart& part : model.parts)
      if (const auto t = distanceTo(from, directions[r], part.position_mm[0], part.position_mm[1], part.position_mm[2]))
        best = std::min(best, *t);
    EXPECT_EQ(std::isfinite(best), met.distance_mm[r] > 0.0f) << r;
    if (!std::isfinite(best)) continue;
    EXPECT_NEAR(met.distance_mm[r], best, 1e-3) << r;
    ++hits;
  }
  EXPECT_GT(hits, 60);
}

TEST(MeshScene, HasNoPinholesAlongSharedEdges) {
  // A bumpy sheet of 40x40 squares: every ray through it must hit it.
  assets::MeshPart part;
  part.name = "Sheet";
  for (int j = 0; j <= 40; ++j)
    for (int i = 0; i <= 40; ++i) {
      part.position_mm.emplace_back(i - 20, j - 20, std::sin(static_cast<float>(i * 7 + j * 3)));
      part.normal.emplace_back(0, 0, 1);
    }
  for (unsigned j = 0; j < 40; ++j)
    for (unsigned i = 0; i < 40; ++i) {
      const unsigned a = j * 41 + i;
      part.triangles.insert(part.triangles.end(), {a, a + 1, a + 42, a, a + 42, a + 41});
    }
  MeshScene scene;
  scene.setModel(Model::face, {{part}});
  for (int j = -15; j <= 15; ++j) {
    // Exactly through vertices, where several triangles meet.
    std::vector<glm::vec3> directions;
    const glm::vec3 from{0.3f, 0.2f, 100.0f};
    for (int i = -15; i <= 15; ++i)
      directions.push_back(glm::normalize(part.position_mm[static_cast<std::size_t>((j + 20) * 41 + i + 20)] - from));
    EXPECT_EQ(first(scene, rays(from, directions)).points.count, 31);
  }
}

TEST(MeshScene, CutsTheWindowOnlyIntoSkinInFrontOfTheSite) {
  assets::MeshPart steel = sheet(10.0f);
  steel.material.metallic = 1.0f;
  MeshScene scene;
  scene.setModel(Model::face, {{sheet(20.0f), sheet(-20.0f), steel}});
  scene.place(placementsIn(Frame{}), {.eye_P = {0, 0, 100}, .site_P = {0, 0, 0}, .radius_mm = 5.0f});
  const RayBatch batch = rays({0, 0, 100}, {{0, 0, -1}, glm::normalize(glm::vec3(8, 0, -80))});
  Met met = first(scene, batch);
  EXPECT_FLOAT_EQ(met.distance_mm[0], 90.0f) << "the skin before is open, steel is not";
  EXPECT_NEAR(met.distance_mm[1], std::hypot(8.0, 80.0), 1e-4) << "beside the window the skin is whole";
  scene.setModel(Model::face, {{sheet(20.0f), sheet(-20.0f)}});
  met = first(scene, batch);
  EXPECT_FLOAT_EQ(met.distance_mm[0], 120.0f) << "behind the site nothing is cut";
}

TEST(MeshScene, MovesTheInstrumentAndRotatesItsBur) {
  assets::MeshPart bur = triangle({1, -1, 0}, {3, -1, 0}, {2, 2, 0});
  bur.name = "Bur";
  MeshScene scene;
  scene.setModel(Model::instrument, {{bur, sheet(-5.0f)}});
  Frame frame;
  frame.X_PT.translation_mm = {100, 0, 0};
  frame.bur_angle_rad = 1.5707963267948966;
  scene.place(placementsIn(frame));
  // After a quarter turn the corner (2, 0, 0) of the tool is at (0, 2, 0).
  const Met turned = first(scene, rays({100, 2, 10}, {{0, 0, -1}}));
  ASSERT_EQ(turned.points.count, 1);
  EXPECT_NEAR(turned.distance_mm[0], 10.0, 1e-4);
  EXPECT_EQ(turned.points.finish[0], FINISH_INSTRUMENT);
  EXPECT_NEAR(first(scene, rays({102, 0, 10}, {{0, 0, -1}})).distance_mm[0], 15.0, 1e-4) << "the shaft stands still";
  frame.tool_visible = false;
  scene.place(placementsIn(frame));
  EXPECT_EQ(first(scene, rays({100, 2, 10}, {{0, 0, -1}})).points.count, 0);
}

TEST(MeshScene, MovesTheSecondInstrumentAndKeepsStaticHits) {
  MeshScene scene;
  scene.setModel(Model::gingiva, {{sheet(0.0f)}});
  scene.setModel(Model::instrument, {{sheet(10.0f)}});
  scene.setModel(Model::second_instrument, {{sheet(20.0f)}});
  Frame frame;
  const std::uint64_t revision = scene.staticRevision();
  const auto distance = [&] {
    scene.place(placementsIn(frame));
    return first(scene, rays({0, 1, 50}, {{0, 0, -1}})).distance_mm[0];
  };
  EXPECT_FLOAT_EQ(distance(), 40.0f) << "not seen unless asked for";
  frame.second_visible = true;
  EXPECT_FLOAT_EQ(distance(), 30.0f);
  frame.X_PO.translation_mm = {0, 0, -15};
  EXPECT_FLOAT_EQ(distance(), 40.0f) << "behind the first";
  frame.X_PT.translation_mm = {0, 0, -8};
  EXPECT_FLOAT_EQ(distance(), 45.0f) << "before it";
  frame.tool_visible = false;
  EXPECT_FLOAT_EQ(distance(), 45.0f);
  frame.X_PO.translation_mm = {40, 0, 0};
  EXPECT_FLOAT_EQ(distance(), 50.0f) << "aside";
  EXPECT_EQ(scene.staticRevision(), revision);
  scene.setModel(Model::second_instrument, {});
  EXPECT_EQ(first(scene, rays({40, 1, 50}, {{0, 0, -1}})).points.count, 0);
}

TEST(MeshScene, CollectsLayersFromBackToFrontAsASlowSortDoes) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> in(-30.0f, 30.0f);
  assets::MeshModel model;
  std::map<float, int> expected;  // distance from the eye, falling
  for (int i = 0; i < 40; ++i) {
    const float z = in(engine);
    model.parts.push_back(sheet(z, 0.5f));
    ++expected[-(100.0f - z)];
  }
  MeshScene scene;
  scene.setModel(Model::gingiva, model);
  ASSERT_TRUE(scene.hasTransparent());
  const MeshPoints met = layersOf(scene, rays({0, 1, 100}, {{0, 0, -1}, {0, 1, 0}, {0, 0, -1}}));
  ASSERT_EQ(met.count, 80);
  std::size_t n = 0;
  for (const int ray : {0, 2})
    for (const auto& [minus_distance, count] : expected)
      for (int i = 0; i < count; ++i, ++n) {
        EXPECT_EQ(met.ray[n], ray);
        EXPECT_NEAR(met.distance_mm[n], -minus_distance, 1e-4);
        EXPECT_FLOAT_EQ(met.a[n], 0.5f);
      }
  EXPECT_EQ(layersOf(scene, rays({0, 1, 100}, {{0, 0, -1}}), 50.0f).count, 0) << "behind what is opaque";
}

TEST(MeshScene, TreatsAFadedFaceAsALayerAndOmitsAHiddenOne) {
  MeshScene scene;
  scene.setModel(Model::face, {{sheet(0.0f)}});
  const RayBatch batch = rays({0, 1, 100}, {{0, 0, -1}});
  Frame frame;
  frame.layers.face_opacity = 0.25f;
  scene.place(placementsIn(frame));
  EXPECT_EQ(first(scene, batch).points.count, 0);
  const MeshPoints faded = layersOf(scene, batch);
  ASSERT_EQ(faded.count, 1);
  EXPECT_FLOAT_EQ(faded.a[0], 0.25f);
  frame.layers.face_opacity = 0.0f;
  scene.place(placementsIn(frame));
  EXPECT_EQ(layersOf(scene, batch).count, 0);
  scene.place(placementsIn(Frame{}));
  EXPECT_EQ(first(scene, batch).points.count, 1);
}

TEST(MeshScene, OfAFadedFaceTheNearestSurfaceIsALayerAmongTheOthers) {
  MeshScene scene;
  scene.setModel(Model::face, {{sheet(-20.0f), sheet(20.0f), sheet(0.0f), sheet(30.0f, 0.5f)}});
  scene.setModel(Model::gingiva, {{sheet(25.0f, 0.5f), sheet(10.0f, 0.5f)}});
  const RayBatch batch = rays({0, 1, 100}, {{0, 0, -1}, {0, 1, 0}, {0, 0, -1}});
  Frame frame;
  frame.layers.face_opacity = 0.5f;
  scene.place(placementsIn(frame));
  const auto distances = [&](float limit_mm) {
    const MeshPoints met = layersOf(scene, batch, limit_mm);
    return std::vector<float>(met.distance_mm, met.distance_mm + met.count);
  };
  EXPECT_THAT(distances(1e6f), testing::ElementsAre(90, 80, 75, 70, 90, 80, 75, 70));
  EXPECT_THAT(distances(78.0f), testing::ElementsAre(75, 70, 75, 70)) << "bone before it";
  scene.setModel(Model::gingiva, {});
  EXPECT_THAT(distances(1e6f), testing::ElementsAre(80, 70, 80, 70));
}

TEST(MeshScene, LooksUpOnlyVisibleHits) {
  MeshScene scene;
  scene.setModel(Model::face, {{sheet(0.0f)}});
  const RayBatch batch = rays({0, 1, 100}, {{0, 0, -1}, {0, 0, -1}, {0, 1, 0}});
  MeshHits hits;
  findFirst(scene, batch, hits);
  const float seen[] = {60.0f, 100.0f, 0.0f};
  MeshPoints points;
  scene.addSeen(batch, hits, seen, points);
  ASSERT_EQ(points.count, 1);
  EXPECT_EQ(points.ray[0], 1);
}

TEST(MeshScene, ReplacesAndRemovesModels) {
  MeshScene scene;
  scene.setModel(Model::face, {{sheet(0.0f)}});
  scene.setModel(Model::gingiva, {{sheet(5.0f)}});
  scene.setModel(Model::face, {{sheet(20.0f), sheet(10.0f, 0.5f)}});
  const RayBatch batch = rays({0, 1, 100}, {{0, 0, -1}});
  EXPECT_FLOAT_EQ(first(scene, batch).distance_mm[0], 80.0f);
  EXPECT_EQ(layersOf(scene, batch).count, 1);
  scene.setModel(Model::face, {});
  EXPECT_FLOAT_EQ(first(scene, batch).distance_mm[0], 95.0f);
  EXPECT_FALSE(scene.hasTransparent());
}

}  // namespace
}  // namespace render
