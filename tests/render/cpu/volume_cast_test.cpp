#include "render/cpu/volume_cast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

namespace render {
namespace {

using assets::InstructionSet;

struct Scene {
  BorderedField<std::uint8_t> solid, label;

  std::uint8_t& at(glm::ivec3 ijk) { return *solid.at(ijk); }
};

template <class Value>
void forVoxels(glm::ivec3 size, Value visit) {
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) visit(glm::ivec3(i, j, k));
}

std::uint8_t grey(double solid) { return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(solid, 0.0, 1.0))); }

/// Balls, a plate and specks in a volume whose size is no multiple of a brick.
Scene lumps(unsigned seed, glm::ivec3 size = {53, 41, 46}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Scene scene{BorderedField<std::uint8_t>(size), BorderedField<std::uint8_t>(size)};
  for (int ball = 0; ball < 4; ++ball) {
    const glm::dvec3 centre = glm::dvec3(size) * glm::dvec3(unit(random), unit(random), unit(random));
    const double radius = 3.0 + 6.0 * unit(random);
    forVoxels(size, [&](glm::ivec3 v) {
      scene.at(v) = std::max(scene.at(v), grey(0.5 + 0.7 * (radius - glm::length(glm::dvec3(v) - centre))));
      *scene.label.at(v) = static_cast<std::uint8_t>((v.x / 7 + v.y / 5 + v.z / 9) % 10);
    });
  }
  for (int speck = 0; speck < 40; ++speck)
    scene.at({static_cast<int>(random() % static_cast<unsigned>(size.x)),
              static_cast<int>(random() % static_cast<unsigned>(size.y)),
              static_cast<int>(random() % static_cast<unsigned>(size.z))}) = static_cast<std::uint8_t>(random() % 256);
  return scene;
}

/// A tile of 16 x 16 rays from an eye towards a point.
RayBatch tile(glm::dvec3 eye, glm::dvec3 look_at, double spread) {
  RayBatch rays;
  const glm::dvec3 forward = glm::normalize(look_at - eye);
  const glm::dvec3 right =
      glm::normalize(glm::cross(forward, std::abs(forward.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 up = glm::cross(right, forward);
  for (int n = 0; n < RayBatch::kMaxRays; ++n) {
    const double x = (n % 16 - 7.5) / 8.0 * spread, y = (n / 16 - 7.5) / 8.0 * spread;
    const glm::vec3 d = glm::vec3(glm::normalize(forward + x * right + y * up));
    const auto ray = static_cast<std::size_t>(n);
    rays.x[ray] = d.x;
    rays.y[ray] = d.y;
    rays.z[ray] = d.z;
  }
  rays.count = RayBatch::kMaxRays;
  return rays;
}

struct View {
  CastSettings settings;
  RayBatch rays;
  std::array<float, RayBatch::kMaxRays> limit_mm{};
};

/// From random points, also inside; some along an axis, some missing the volume.
View randomView(std::mt19937& random, glm::ivec3 size) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  View view;
  view.settings.spacing_mm = static_cast<float>(0.1 + unit(random));
  const auto anywhere = [&](double reach) {
    return glm::dvec3(size) * (glm::dvec3(0.5) + reach * (glm::dvec3(unit(random), unit(random), unit(random)) - 0.5));
  };
  glm::dvec3 eye = anywhere(random() % 3 == 0 ? 0.9 : 6.0), look_at = anywhere(1.2);
  if (random() % 4 == 0) look_at = eye, look_at[static_cast<int>(random() % 3)] += random() % 2 == 0 ? 30.0 : -30.0;
  view.settings.eye_index = glm::vec3(eye);
  view.rays = tile(eye, look_at, 0.02 + 0.5 * unit(random) * unit(random));
  for (float& limit : view.limit_mm)
    limit = random() % 5 == 0 ? static_cast<float>(unit(random) * 80.0) * view.settings.spacing_mm : 1e9f;
  return view;
}

std::vector<InstructionSet> setsHere() {
  std::vector<InstructionSet> all;
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512})
    if (assets::available(set)) all.push_back(set);
  return all;
}

/// Ray by ray, bit by bit. Rays are interleaved in any order: only the order within a ray counts.
std::string text(const VolumePoints& points) {
  std::vector<std::size_t> order(static_cast<std::size_t>(points.count));
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return points.ray[a] < points.ray[b]; });
  std::string all;
  for (const std::size_t n : order) {
    char line[80];
    std::snprintf(line, sizeof line, "%d %a %a\n", points.ray[n], static_cast<double>(points.length[n]),
                  static_cast<double>(points.weight[n]));
    all += line;
  }
  return all;
}

VolumePoints surfaceOf(const SolidCells& cells, const View& view, bool skip = true,
                       InstructionSet set = assets::chosenInstructionSet()) {
  VolumePoints points;
  CastSettings settings = view.settings;
  settings.skip_empty_space = skip;
  castSurface(cells, settings, view.rays, view.limit_mm.data(), points, set);
  return points;
}

const Transfer kTransfer{{0.3f, 0.24f, 0.05f, 0.8f, 0.92f, 0.75f, 0.5f, 0.5f, 0.0f, 0.05f},
                         {0.0f, 0.2f, 0.5f, 0.0f, 0.0f, 0.1f, 0.3f, 0.0f, 0.4f, 0.0f}};

VolumePoints throughOf(const SolidCells& cells, const Scene& scene, const View& view, RaySums& sums, bool skip = true,
                       InstructionSet set = assets::chosenInstructionSet()) {
  VolumePoints points;
  CastSettings settings = view.settings;
  settings.skip_empty_space = skip;
  castTranslucent(cells, settings, scene.label, opacityTable(kTransfer, settings.step * settings.spacing_mm), view.rays,
                  view.limit_mm.data(), points, sums, set);
  return points;
}

// Straightforward version in double, from the specification in shaders/ray_march.glsl.
struct Twin {
  const Scene& scene;

  double solidAt(glm::dvec3 p) const {
    const glm::dvec3 base = glm::floor(p), f = p - base;
    double sum = 0.0;
    for (int n = 0; n < 8; ++n) {
      const glm::ivec3 corner(n & 1, (n >> 1) & 1, n >> 2), v = glm::ivec3(base) + corner;
      const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(corner));
      const glm::ivec3 size = scene.solid.layout().size;
      if (glm::all(glm::greaterThanEqual(v, glm::ivec3(0))) && glm::all(glm::lessThan(v, size)))
        sum += w.x * w.y * w.z * *scene.solid.at(v) / 255.0;
    }
    return sum;
  }

  struct Ray {
    glm::dvec3 entry, direction;
    double near = 0.0, far = 0.0;
  };
  Ray ray(const View& view, std::size_t n) const {
    Ray ray;
    const glm::dvec3 eye(view.settings.eye_index), size(scene.solid.layout().size);
    ray.direction = glm::dvec3(view.rays.x[n], view.rays.y[n], view.rays.z[n]);
    ray.far = static_cast<double>(view.limit_mm[n]) / static_cast<double>(view.settings.spacing_mm);
    for (int a = 0; a < 3; ++a) {
      const double d = std::abs(ray.direction[a]) < 1e-9 ? 1e-9 : ray.direction[a];
      const double p = (-1.0 - eye[a]) / d, q = (size[a] - eye[a]) / d;
      ray.near = std::max(ray.near, std::min(p, q));
      ray.far = std::min(ray.far, std::max(p, q));
    }
    ray.entry = eye + ray.near * ray.direction;
    return ray;
  }

  /// Length to the surface; negative: none.
  double surface(const View& view, std::size_t n) const {
    const Ray r = ray(view, n);
    if (r.near >= r.far) return -1.0;
    const double step = static_cast<double>(view.settings.step);
    for (int k = 0; k * step <= r.far - r.near; ++k) {
      if (solidAt(r.entry + k * step * r.direction) < 0.5) continue;
      if (k == 0) return r.near;
      double low = (k - 1) * step, high = k * step;
      for (int i = 0; i < 6; ++i) {
        const double middle = 0.5 * (low + high);
        (solidAt(r.entry + middle * r.direction) >= 0.5 ? high : low) = middle;
      }
      return r.near + high;
    }
    return -1.0;
  }

  double opacity(const View& view, std::size_t n) const {
    const Ray r = ray(view, n);
    const double step = static_cast<double>(view.settings.step);
    double sum = 0.0;
    for (int k = 0; r.near < r.far && k * step <= r.far - r.near && sum < 0.98; ++k) {
      const glm::dvec3 place = r.entry + k * step * r.direction;
      const double share = std::clamp((solidAt(place) - 0.5) / 0.4, 0.0, 1.0);
      const std::size_t label = *scene.label.at(glm::ivec3(glm::floor(place + 0.5)));
      const double per_mm = opacityPerMm(kTransfer.inner_per_mm[label], kTransfer.wall_per_mm[label], share);
      sum += (1.0 - sum) * (1.0 - std::pow(1.0 - per_mm, step * static_cast<double>(view.settings.spacing_mm)));
    }
    return sum;
  }
};

TEST(VolumeCast, SurfaceSkippingEqualsBruteForceToTheBit) {
  std::mt19937 random(11);
  int hits = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Scene scene = lumps(seed);
    const SolidCells cells(scene.solid);
    for (int n = 0; n < 25; ++n) {
      const View view = randomView(random, scene.solid.layout().size);
      for (const InstructionSet set : setsHere()) {
        const VolumePoints fast = surfaceOf(cells, view, true, set);
        ASSERT_EQ(text(fast), text(surfaceOf(cells, view, false, set))) << "scene " << seed << ", view " << n;
        hits += fast.count;
      }
    }
  }
  EXPECT_GT(hits, 5000);
}

/// Rays that are drawn again at silhouettes lie anywhere: a beam of them is wide where the volume is mostly empty.
TEST(VolumeCast, ScatteredRaysMissNothingInALargeVolume) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const glm::ivec3 size(180, 150, 120);
  Scene scene{BorderedField<std::uint8_t>(size), BorderedField<std::uint8_t>(size)};
  for (int ball = 0; ball < 40; ++ball) {
    const glm::ivec3 centre(glm::dvec3(size) * glm::dvec3(unit(random), unit(random), unit(random)));
    forVoxels(glm::ivec3(9), [&](glm::ivec3 v) {
      const glm::ivec3 at = centre + v - 4;
      if (glm::all(glm::lessThan(at, size)) && glm::all(glm::greaterThanEqual(at, glm::ivec3(0))))
        scene.at(at) = grey(3.5 - glm::length(glm::dvec3(v - 4)));
    });
  }
  const SolidCells cells(scene.solid);
  int hits = 0;
  const auto anywhere = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  for (int n = 0; n < 300; ++n) {
    View view = randomView(random, size);
    view.limit_mm.fill(1e9f);
    const glm::dvec3 look_at = glm::dvec3(size) * anywhere();
    const glm::dvec3 eye = look_at + (150.0 + 600.0 * unit(random)) * glm::normalize(anywhere() - 0.5);
    view.settings.eye_index = glm::vec3(eye);
    const double spread = 5.0 + 60.0 * unit(random);
    for (std::size_t ray = 0; ray < RayBatch::kMaxRays; ++ray) {
      const glm::vec3 d(glm::normalize(look_at + spread * (anywhere() - 0.5) - eye));
      view.rays.x[ray] = d.x, view.rays.y[ray] = d.y, view.rays.z[ray] = d.z;
    }
    const VolumePoints fast = surfaceOf(cells, view, true, setsHere().back());
    ASSERT_EQ(text(fast), text(surfaceOf(cells, view, false, setsHere().back()))) << "view " << n;
    hits += fast.count;
  }
  EXPECT_GT(hits, 200);
}

TEST(VolumeCast, TranslucentSkippingEqualsBruteForceToTheBit) {
  std::mt19937 random(12);
  int shown = 0;
  for (unsigned seed = 10; seed < 14; ++seed) {
    const Scene scene = lumps(seed);
    const SolidCells cells(scene.solid);
    for (int n = 0; n < 20; ++n) {
      const View view = randomView(random, scene.solid.layout().size);
      for (const InstructionSet set : setsHere()) {
        RaySums fast_sums, slow_sums;
        const VolumePoints fast = throughOf(cells, scene, view, fast_sums, true, set);
        ASSERT_EQ(text(fast), text(throughOf(cells, scene, view, slow_sums, false, set)));
        ASSERT_EQ(fast_sums.opacity, slow_sums.opacity);
        ASSERT_EQ(fast_sums.reach, slow_sums.reach);
        shown += fast.count;
      }
    }
  }
  EXPECT_GT(shown, 20000);
}

TEST(VolumeCast, SkippingIsExactForEveryStep) {
  std::mt19937 random(13);
  const Scene scene = lumps(3);
  const SolidCells cells(scene.solid);
  for (const float step : {0.25f, 0.37f, 0.75f, 1.0f, 1.6f})
    for (int n = 0; n < 12; ++n) {
      View view = randomView(random, scene.solid.layout().size);
      view.settings.step = step;
      ASSERT_EQ(text(surfaceOf(cells, view)), text(surfaceOf(cells, view, false))) << step;
    }
}

TEST(VolumeCast, AgreesWithTheSlowTwinInDouble) {
  std::mt19937 random(14);
  int rays = 0, apart = 0;
  for (unsigned seed = 20; seed < 23; ++seed) {
    const Scene scene = lumps(seed);
    const SolidCells cells(scene.solid);
    const Twin twin{scene};
    for (int n = 0; n < 8; ++n) {
      const View view = randomView(random, scene.solid.layout().size);
      for (const InstructionSet set : setsHere()) {
        std::array<double, RayBatch::kMaxRays> length;
        length.fill(-1.0);
        const VolumePoints points = surfaceOf(cells, view, true, set);
        for (std::size_t p = 0; p < static_cast<std::size_t>(points.count); ++p)
          length[static_cast<std::size_t>(points.ray[p])] = static_cast<double>(points.length[p]);
        for (std::size_t r = 0; r < length.size(); ++r, ++rays) {
          const double exact = twin.surface(view, r);
          // A ray that grazes 0.5 may go either way, and bisection may end one of its 64 steps off.
          if (std::abs(length[r] - exact) > 0.5 / 64.0 + 1e-3) ++apart;
        }
      }
    }
  }
  EXPECT_LE(apart, rays / 500) << "of " << rays;
}

TEST(VolumeCast, AccumulatesTheOpacityOfTheSlowTwin) {
  std::mt19937 random(15);
  const Scene scene = lumps(31);
  const SolidCells cells(scene.solid);
  const Twin twin{scene};
  int rays = 0, apart = 0, seen = 0;
  for (int n = 0; n < 12; ++n) {
    const View view = randomView(random, scene.solid.layout().size);
    for (const InstructionSet set : setsHere()) {
      RaySums sums;
      throughOf(cells, scene, view, sums, true, set);
      for (std::size_t r = 0; r < RayBatch::kMaxRays; ++r, ++rays) {
        const double exact = twin.opacity(view, r), ours = static_cast<double>(sums.opacity[r]);
        seen += exact > 0.1 ? 1 : 0;
        // A sample halfway between two labels may take either.
        apart += std::abs(exact - ours) > 1e-3 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(seen, 500);
  EXPECT_LE(apart, rays / 200) << "of " << rays;
}

TEST(VolumeCast, InstructionSetsAgreeWithinRounding) {
  if (setsHere().size() < 2) GTEST_SKIP() << "this machine has only the portable kernels";
  std::mt19937 random(16);
  const Scene scene = lumps(5);
  const SolidCells cells(scene.solid);
  int together = 0, apart = 0;
  for (int n = 0; n < 30; ++n) {
    const View view = randomView(random, scene.solid.layout().size);
    const VolumePoints plain = surfaceOf(cells, view, true, InstructionSet::portable);
    for (const InstructionSet set : setsHere()) {
      const VolumePoints fast = surfaceOf(cells, view, true, set);
      std::array<float, RayBatch::kMaxRays> length{};
      for (std::size_t p = 0; p < static_cast<std::size_t>(plain.count); ++p)
        length[static_cast<std::size_t>(plain.ray[p])] = plain.length[p];
      apart += std::abs(fast.count - plain.count);
      for (std::size_t p = 0; p < static_cast<std::size_t>(fast.count); ++p)
        (std::abs(length[static_cast<std::size_t>(fast.ray[p])] - fast.length[p]) < 1e-3f ? together : apart) += 1;
    }
  }
  EXPECT_GT(together, 1000);
  EXPECT_LE(apart, together / 200);
}

TEST(VolumeCast, CarvingThenCastingEqualsCastingTheCarvedVolume) {
  std::mt19937 random(17);
  for (unsigned seed = 40; seed < 43; ++seed) {
    Scene scene = lumps(seed);
    const Scene before = scene;
    SolidCells cells(scene.solid);
    const SolidCells control(before.solid);
    const glm::ivec3 size = scene.solid.layout().size;
    // A groove from a ball's surface inwards, in cuts of a few voxels.
    glm::ivec3 inside{0};
    forVoxels(size, [&](glm::ivec3 v) {
      if (scene.at(v) > 128) inside = v;
    });
    for (int bite = 0; bite < 6; ++bite) {
      const glm::ivec3 first = glm::clamp(inside - 2 * bite - 3, glm::ivec3(0), size - 7);
      forVoxels(glm::ivec3(7), [&](glm::ivec3 v) { scene.at(first + v) = scene.at(first + v) / 5; });
      cells.touch({first, glm::ivec3(7)});
      cells.refresh();
    }
    const SolidCells anew(scene.solid);
    bool differs = false;
    for (int n = 0; n < 20; ++n) {
      const View view = randomView(random, size);
      RaySums sums, anew_sums;
      const std::string carved = text(surfaceOf(cells, view)), drawn = text(surfaceOf(anew, view));
      ASSERT_EQ(carved, drawn);
      ASSERT_EQ(carved, text(surfaceOf(cells, view, false)));
      ASSERT_EQ(text(throughOf(cells, scene, view, sums)), text(throughOf(anew, scene, view, anew_sums)));
      differs = differs || carved != text(surfaceOf(control, view));
    }
    EXPECT_TRUE(differs) << "nobody looked at the groove";

    // And back: fill what was carved.
    forVoxels(size, [&](glm::ivec3 v) { scene.at(v) = *before.solid.at(v); });
    cells.touch({glm::ivec3(0), size});
    cells.rebuildIfStale();
    for (int n = 0; n < 5; ++n) {
      const View view = randomView(random, size);
      ASSERT_EQ(text(surfaceOf(cells, view)), text(surfaceOf(control, view)));
    }
  }
}

TEST(VolumeCast, FillsBricksThatWereEmpty) {
  Scene scene{BorderedField<std::uint8_t>(glm::ivec3(40)), BorderedField<std::uint8_t>(glm::ivec3(40))};
  SolidCells cells(scene.solid);
  View view;
  view.settings.eye_index = {20.0f, -60.0f, 20.0f};
  view.rays = tile({20, -60, 20}, {20, 20, 20}, 0.1);
  view.limit_mm.fill(1e9f);
  EXPECT_EQ(surfaceOf(cells, view).count, 0);
  for (int k = 18; k < 23; ++k)
    for (int j = 18; j < 23; ++j)
      for (int i = 18; i < 23; ++i) scene.at({i, j, k}) = 255;
  cells.touch({glm::ivec3(18), glm::ivec3(5)});
  cells.refresh();
  EXPECT_GT(surfaceOf(cells, view).count, 0);
  EXPECT_EQ(text(surfaceOf(cells, view)), text(surfaceOf(cells, view, false)));
}

TEST(VolumeCast, HitsAFlatFaceAlongTheAxesExactly) {
  // Solid from voxel 10 on, half at 9.5: the surface.
  const glm::ivec3 size(24);
  Scene scene{BorderedField<std::uint8_t>(size), BorderedField<std::uint8_t>(size)};
  forVoxels(size, [&](glm::ivec3 v) { scene.at(v) = v.x >= 10 ? 255 : 0; });
  const SolidCells cells(scene.solid);
  View view;
  view.rays.count = 1;
  view.rays.x[0] = 1.0f;
  view.limit_mm.fill(1e9f);
  for (const float from : {-100.0f, -1.0f, 0.0f, 4.25f}) {
    view.settings.eye_index = {from, 12.0f, 12.0f};
    for (const InstructionSet set : setsHere()) {
      const VolumePoints points = surfaceOf(cells, view, true, set);
      ASSERT_EQ(points.count, 1);
      EXPECT_NEAR(points.length[0] + from, 9.5f, 0.5f / 64.0f);
      EXPECT_GE(points.length[0] + from, 9.5f - 1e-3f);
    }
  }
  // From inside the bone the ray ends at its start; behind it there is nothing; a limit hides it.
  view.settings.eye_index = {15.0f, 12.0f, 12.0f};
  EXPECT_EQ(surfaceOf(cells, view).length[0], 0.0f);
  view.settings.eye_index = {30.0f, 12.0f, 12.0f};
  EXPECT_EQ(surfaceOf(cells, view).count, 0);
  view.settings.eye_index = {0.0f, 12.0f, 12.0f};
  view.limit_mm[0] = 9.0f;
  EXPECT_EQ(surfaceOf(cells, view).count, 0);
}

TEST(VolumeCast, NeverGivesNaN) {
  std::mt19937 random(18);
  const Scene scene = lumps(6);
  const SolidCells cells(scene.solid);
  for (int n = 0; n < 40; ++n) {
    const View view = randomView(random, scene.solid.layout().size);
    for (const InstructionSet set : setsHere()) {
      RaySums sums;
      const VolumePoints points = throughOf(cells, scene, view, sums, true, set);
      for (std::size_t p = 0; p < static_cast<std::size_t>(points.count); ++p) {
        ASSERT_TRUE(std::isfinite(points.length[p]) && points.length[p] >= 0.0f);
        ASSERT_TRUE(points.weight[p] > 0.0f && points.weight[p] <= 1.0f);
      }
      for (const float opacity : sums.opacity) ASSERT_TRUE(opacity >= 0.0f && opacity <= 1.0f);
    }
  }
}

TEST(VolumeCast, WeightsOfARayAddUpToItsOpacity) {
  std::mt19937 random(19);
  const Scene scene = lumps(7);
  const SolidCells cells(scene.solid);
  for (int n = 0; n < 10; ++n) {
    const View view = randomView(random, scene.solid.layout().size);
    RaySums sums;
    const VolumePoints points = throughOf(cells, scene, view, sums);
    std::array<double, RayBatch::kMaxRays> total{}, last{};
    for (std::size_t p = 0; p < static_cast<std::size_t>(points.count); ++p) {
      const auto ray = static_cast<std::size_t>(points.ray[p]);
      total[ray] += static_cast<double>(points.weight[p]);
      EXPECT_GE(static_cast<double>(points.length[p]), last[ray]) << "not front to back";
      last[ray] = static_cast<double>(points.length[p]);
    }
    for (std::size_t r = 0; r < total.size(); ++r) {
      EXPECT_NEAR(total[r], static_cast<double>(sums.opacity[r]), 1e-5);
      EXPECT_EQ(sums.reach[r] >= 0.0f, sums.opacity[r] >= 0.5f);
    }
  }
}

}  // namespace
}  // namespace render
