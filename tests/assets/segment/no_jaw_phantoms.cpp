#include "tests/assets/segment/no_jaw_phantoms.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "assets/segment/cell_filters.h"

namespace tests {
namespace {

constexpr double kSpacing_mm = 0.8, kAir_hu = -1000.0, kSoft_hu = 50.0;
constexpr double kPi = 3.14159265358979323846;

double seededNoise(std::uint64_t n) {
  n ^= n >> 33, n *= 0xff51afd7ed558ccdULL, n ^= n >> 33, n *= 0xc4ceb9fe1a85ec53ULL, n ^= n >> 33;
  return (static_cast<double>(n >> 11) * 0x1.0p-53 - 0.5) * 3.4641016;
}

/// `hu_at`: of a point, the middle of the volume at 0.
NoJawPhantom drawn(std::string name, const glm::dvec3& size_mm, unsigned seed,
                   const std::function<double(const glm::dvec3& p)>& hu_at) {
  NoJawPhantom phantom;
  phantom.name = std::move(name);
  const glm::ivec3 size(size_mm / kSpacing_mm);
  phantom.grid = {size, kSpacing_mm, -0.5 * kSpacing_mm * glm::dvec3(size - 1)};
  std::vector<float> hu(phantom.grid.voxelCount());
  tbb::parallel_for(0, size.z, [&](int k) {
    assets::forVoxels({0, 0, k}, {size.x, size.y, k + 1}, [&](glm::ivec3 ijk) {
      hu[phantom.grid.index(ijk)] = static_cast<float>(hu_at(phantom.grid.centre_P_mm(ijk)));
    });
  });
  assets::smoothCells(size, 0.3 / kSpacing_mm, hu);
  phantom.hounsfield.resize(hu.size());
  for (std::size_t n = 0; n < hu.size(); ++n)
    phantom.hounsfield[n] = static_cast<std::int16_t>(
        std::lround(std::clamp(static_cast<double>(hu[n]) + 60.0 * seededNoise(n + 977 * seed), -1024.0, 6000.0)));
  return phantom;
}

/// A tube of cortex with marrow; `depth`: how far inside.
double tube(double depth_mm, double wall_mm, double cortex_hu, double marrow_hu) {
  if (depth_mm < 0.0) return kAir_hu;
  return depth_mm < wall_mm ? cortex_hu : marrow_hu;
}

/// Inside is positive.
double inBall(const glm::dvec3& p, const glm::dvec3& centre, double radius) {
  return radius - glm::distance(p, centre);
}
double inRod(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double radius) {
  const glm::dvec3 ab = b - a;
  const double share = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
  return radius - glm::distance(p, a + share * ab);
}

}  // namespace

std::vector<NoJawPhantom> noJawPhantoms(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto between = [&](double low, double high) { return low + (high - low) * share(random); };
  std::vector<NoJawPhantom> all;

  // Shafts of thick cortex, knuckles of spongy bone, a knee cap in front.
  const double shaft_mm = between(13.0, 16.0), wall_mm = between(4.0, 6.5), cortex_hu = between(1500.0, 1950.0),
               flexed_mm = between(0.0, 25.0);
  all.push_back(drawn("knee", {110.0, 110.0, 130.0}, seed, [=](const glm::dvec3& p) {
    double hu = inRod(p, {0, 0, -90}, {0, 0, 90}, 48.0) > 0.0 ? kSoft_hu : kAir_hu;
    const auto take = [&hu](double bone_hu) { hu = std::max(hu, bone_hu); };
    take(tube(inRod(p, {0, flexed_mm, 90}, {0, 0, 22}, shaft_mm), wall_mm, cortex_hu, 20.0));
    take(tube(inRod(p, {0, flexed_mm, -90}, {0, 0, -26}, shaft_mm - 1.0), wall_mm, cortex_hu, 20.0));
    for (const double side : {-1.0, 1.0}) {
      take(tube(inBall(p, {21.0 * side, 4, 10}, 21.0), 1.5, 1000.0, 350.0));
      take(tube(inRod(p, {8.0 * side, 0, -18}, {24.0 * side, 0, -18}, 13.0), 1.5, 1000.0, 350.0));
    }
    take(tube(inBall(p, {0, -36, 12}, 13.0), 2.0, 1350.0, 450.0));
    take(tube(inRod(p, {32, 18, -90}, {30, 14, -24}, 6.0), 2.5, cortex_hu, 60.0));
    return hu;
  }));

  // A stack of vertebrae, pairs of ribs that bend forward, a breastbone; a vessel with contrast medium.
  const double rib_hu = between(1000.0, 1700.0), contrast_hu = between(250.0, 420.0);
  all.push_back(drawn("torso", {150.0, 120.0, 110.0}, seed, [=](const glm::dvec3& p) {
    const double body = 1.0 - (p.x * p.x / (72.0 * 72.0) + p.y * p.y / (56.0 * 56.0));
    double hu = body > 0.0 ? (body > 0.25 ? -800.0 : kSoft_hu) : kAir_hu;
    const auto take = [&hu](double bone_hu) { hu = std::max(hu, bone_hu); };
    const double z = p.z - 22.0 * std::round(p.z / 22.0);
    const glm::dvec2 q(p.x, p.y - 32.0);
    if (std::abs(z) < 9.0) take(tube(15.0 - glm::length(q), 1.5, std::abs(z) > 7.5 ? 900.0 : 800.0, 220.0));
    const glm::dvec2 arch(p.x - 0.0, p.y - 48.0);
    if (std::abs(z) < 9.0) take(tube(std::min(5.0 - std::abs(arch.y), 20.0 - std::abs(arch.x)), 1.5, 1100.0, 250.0));
    const double turn = std::atan2(p.x / 68.0, -p.y / 52.0),
                 slope = p.z + 14.0 * std::cos(turn) - 22.0 * std::round((p.z + 14.0 * std::cos(turn)) / 22.0);
    const double from_rib = std::hypot(glm::length(glm::dvec2(p.x / 68.0, p.y / 52.0)) * 60.0 - 60.0, 0.7 * slope);
    if (std::abs(turn) > 0.35) take(tube(5.0 - from_rib, 1.6, rib_hu, 200.0));
    take(tube(std::min(6.0 - std::abs(p.y + 50.0), 18.0 - std::abs(p.x)), 1.5, 900.0, 200.0));
    take(glm::distance(glm::dvec2(p), glm::dvec2(-12.0, 4.0)) < 11.0 ? contrast_hu : kAir_hu);
    return hu;
  }));

  // The vault with the dense bone of both ears.
  const double petrous_hu = between(1700.0, 2300.0);
  all.push_back(drawn("skull without jaws", {150.0, 150.0, 90.0}, seed, [=](const glm::dvec3& p) {
    const glm::dvec3 q = p - glm::dvec3(0, 0, -30);
    const double depth = 70.0 - glm::length(q * glm::dvec3(1.05, 0.98, 0.95));
    double hu = depth > -6.0 ? kSoft_hu : kAir_hu;
    if (depth > 0.0 && depth < 6.0) hu = depth < 2.0 || depth > 4.0 ? 1500.0 : 600.0;
    for (const double side : {-1.0, 1.0}) {
      const double petrous = inRod(p, {58.0 * side, 12, -32}, {20.0 * side, -8, -34}, 9.0);
      if (petrous > 0.0) hu = petrous > 3.0 && petrous < 5.0 ? 300.0 : petrous_hu;
      if (inBall(p, {58.0 * side, 26, -36}, 11.0) > 0.0)
        hu = std::fmod(std::abs(p.x) + 2.0 * std::abs(p.z), 4.0) < 2.4 ? -700.0 : 900.0;
    }
    return hu;
  }));

  // The long bones of five fingers side by side, tubes of dense cortex.
  const double finger_hu = between(1600.0, 1950.0), spread_mm = between(15.0, 19.0);
  all.push_back(drawn("hand", {100.0, 80.0, 120.0}, seed, [=](const glm::dvec3& p) {
    double hu = std::abs(p.y) < 16.0 && std::abs(p.x) < 46.0 ? kSoft_hu : kAir_hu;
    for (int finger = -2; finger <= 2; ++finger) {
      const double x = spread_mm * finger, bent = -1.8 * finger * finger;
      for (int bone = 0; bone < 3; ++bone) {
        const double low = -52.0 + 36.0 * bone, high = low + 33.0;
        const double thin = 1.0 - 0.35 * std::cos(kPi * (2.0 * (p.z - low) / (high - low) - 1.0) * 0.5);
        const double depth = inRod(p, {x, bent, low + 5.0}, {x, bent, high - 5.0}, (7.5 - bone) * thin);
        if (depth > 0.0) hu = depth < 2.4 ? finger_hu : 150.0;
      }
    }
    return hu;
  }));

  // A stem of metal in a thigh bone, with streaks.
  const double metal_hu = between(3500.0, 6000.0);
  all.push_back(drawn("hip with an implant", {110.0, 100.0, 120.0}, seed, [=](const glm::dvec3& p) {
    double hu = inRod(p, {0, 0, -90}, {0, 0, 90}, 46.0) > 0.0 ? kSoft_hu : kAir_hu;
    const double shaft = inRod(p, {-8, 0, -80}, {-8, 0, 20}, 16.0);
    if (shaft > 0.0) hu = shaft < 5.0 ? 1750.0 : 200.0;
    const double cup = glm::distance(p, glm::dvec3(26, 0, 34));
    if (cup < 30.0 && cup > 24.0 && p.z > 26.0) hu = 1300.0;
    if (inRod(p, {-8, 0, -50}, {-6, 0, 10}, 6.0) > 0.0 || inRod(p, {-6, 0, 10}, {26, 0, 34}, 6.0) > 0.0 || cup < 14.0)
      hu = metal_hu;
    else
      hu += 250.0 * std::cos(7.0 * std::atan2(p.y, p.x)) * std::exp(-glm::length(glm::dvec2(p)) / 25.0);
    return hu;
  }));

  // Rods of bone mineral on a horseshoe, as scanners are checked with.
  const double rod_hu = between(1700.0, 2400.0), rod_mm = between(3.5, 5.0);
  all.push_back(drawn("test object", {100.0, 90.0, 70.0}, seed, [=](const glm::dvec3& p) {
    double hu = glm::length(glm::dvec2(p)) < 40.0 ? 120.0 : kAir_hu;
    for (int rod = -5; rod <= 5; ++rod) {
      const double angle = 0.26 * rod;
      const glm::dvec2 at(26.0 * std::sin(angle), 14.0 - 34.0 * std::cos(angle));
      if (glm::distance(glm::dvec2(p), at) < rod_mm && std::abs(p.z) < 10.0) hu = rod_hu;
    }
    return hu;
  }));

  // Two-coloured tablets upright on a horseshoe: crowns without bone.
  const double tablet_mm = between(3.5, 4.5);
  all.push_back(drawn("tablets", {100.0, 90.0, 70.0}, seed, [=](const glm::dvec3& p) {
    double hu = glm::length(glm::dvec2(p)) < 42.0 ? kSoft_hu : kAir_hu;
    for (int tablet = -5; tablet <= 5; ++tablet) {
      const double angle = 0.28 * tablet;
      const glm::dvec2 at(28.0 * std::sin(angle), 14.0 - 36.0 * std::cos(angle));
      if (inRod(p, {at, -7.0}, {at, 7.0}, tablet_mm) > 0.0) hu = p.z > 3.0 ? 2600.0 : 1650.0;
    }
    return hu;
  }));
  return all;
}

}  // namespace tests
