#include "haptics/contact/overlap.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "haptics/bone/lens_curve.h"
#include "haptics/bone/voxel_sphere.h"
#include "haptics/contact/sphere_sums.h"

namespace haptics {
namespace {

using calibration::kPi;
using calibration::Patient;
using calibration::Point;

/// A spiral of equal areas over the directions.
const auto kSpiral = [] {
  std::array<glm::dvec3, 48> directions;
  const double golden_rad = kPi * (3.0 - std::sqrt(5.0));
  for (std::size_t n = 0; n < directions.size(); ++n) {
    const double count = static_cast<double>(directions.size()), at = static_cast<double>(n);
    const double z = 1.0 - (2.0 * at + 1.0) / count, ring = std::sqrt(1.0 - z * z);
    directions[n] = {ring * std::cos(golden_rad * at), ring * std::sin(golden_rad * at), z};
  }
  return directions;
}();

VoxelBox boxOf(const SolidField& field, const glm::dvec3& centre, double outer) {
  return {field.grid, centre - outer, centre + outer};
}

SphereOverlap scaled(double weight, const glm::dvec3& moment, double grey, double stiff, double spacing_mm) {
  const double s3 = spacing_mm * spacing_mm * spacing_mm;
  return {weight / 255.0 * s3, {moment * (s3 * spacing_mm / 255.0)}, grey / (255.0 * 255.0) * s3, stiff / 255.0 * s3};
}

}  // namespace

SphereOverlap sphereOverlap(const SolidField& field, const Point<Patient>& centre_P, double radius_mm,
                            const TissueStiffness* tissue, assets::InstructionSet set) noexcept {
  assert(assets::available(set));
  const double radius = radius_mm / field.grid.spacing_mm;
  if (!(radius >= LensCurve::kMinRadius && radius <= kMaxSumRadius))
    return sphereOverlapVoxelByVoxel(field, centre_P, radius_mm, tissue);
  const glm::dvec3 centre = field.grid.indexFromPoint(centre_P.mm);
  if (boxOf(field, centre, radius + kVoxelSphereRadius).empty()) return {};

  const LensCurve curve(radius);
  SphereSumsInput in{field.slot_of,
                     field.solid,
                     tissue == nullptr ? nullptr : field.label,
                     field.weight,
                     field.weight_x,
                     field.weight_y,
                     field.weight_z,
                     field.grey,
                     field.only_label,
                     {field.blocks.x, field.blocks.y, field.blocks.z},
                     {centre.x, centre.y, centre.z},
                     radius,
                     curve.coefficients,
                     {},
                     {},
                     curve.scale,
                     curve.offset,
                     {}};
  std::copy(curve.volume.begin(), curve.volume.end(), in.volume);
  std::copy(curve.cap.begin(), curve.cap.end(), in.cap);
  if (in.label != nullptr) {
    const auto steps = [&](std::size_t label) {
      const double factor = tissue->factor[label];
      return static_cast<std::uint32_t>(factor > 0.0 ? std::min(factor, 1000.0) * kFactorSteps + 0.5 : 0.0);
    };
    std::fill(std::begin(in.factor_steps), std::end(in.factor_steps), steps(0));
    for (std::size_t label = 0; label < tissue->factor.size(); ++label) in.factor_steps[label] = steps(label);
  }

  SphereSums sums;
#if defined(__x86_64__)
  if (set == assets::InstructionSet::avx512)
    sphereSumsAvx512(in, sums);
  else if (set == assets::InstructionSet::avx2)
    sphereSumsAvx2(in, sums);
  else
#endif
    sphereSumsPortable(in, sums);

  const double whole = static_cast<double>(sums.weight), weight = whole + sums.shell_weight;
  const glm::dvec3 inside{static_cast<double>(sums.x), static_cast<double>(sums.y), static_cast<double>(sums.z)};
  const glm::dvec3 shell{sums.shell_x, sums.shell_y, sums.shell_z};
  // Without a table, or in an unlabelled volume, there is one factor.
  const double one = tissue == nullptr ? 1.0 : tissue->factor[0];
  const double stiff =
      in.label == nullptr ? one * weight : static_cast<double>(sums.stiff_steps) / kFactorSteps + sums.shell_stiff;
  return scaled(weight, inside - whole * centre + shell, static_cast<double>(sums.grey) + sums.shell_grey, stiff,
                field.grid.spacing_mm);
}

SphereOverlap sphereOverlapVoxelByVoxel(const SolidField& field, const Point<Patient>& centre_P, double radius_mm,
                                        const TissueStiffness* tissue) noexcept {
  const double radius = radius_mm / field.grid.spacing_mm;
  if (!(radius > 0.0)) return {};
  const glm::dvec3 centre = field.grid.indexFromPoint(centre_P.mm);
  const VoxelBox box = boxOf(field, centre, radius + kVoxelSphereRadius);
  double volume = 0.0, grey = 0.0, stiff = 0.0;
  glm::dvec3 moment{0.0};
  for (int k = box.first.z; k <= box.last.z; ++k)
    for (int j = box.first.y; j <= box.last.y; ++j)
      for (int i = box.first.x; i <= box.last.x; ++i) {
        const double w = field.solidAt({i, j, k});
        const glm::dvec3 offset = glm::dvec3(i, j, k) - centre;
        const double d = glm::length(offset);
        const Lens lens = lensOfSpheres(radius, kVoxelSphereRadius, d);
        volume += w * lens.volume;
        grey += w * (255.0 - w) * lens.volume;
        stiff += w * lens.volume * (tissue == nullptr ? 1.0 : tissue->of(field.labelAt({i, j, k})));
        if (d > 0.0) moment += w * lens.moment / d * offset;
      }
  return scaled(volume, moment, grey, stiff, field.grid.spacing_mm);
}

SphereOverlap sphereOverlap(const SolidBodies& bodies, const Point<Patient>& centre_P, double radius_mm,
                            const TissueStiffness* tissue) noexcept {
  const std::span<const SolidBody> all = bodies.bodies();
  SphereOverlap sum = sphereOverlap(all.front().field, centre_P, radius_mm, tissue);
  for (const SolidBody& body : all.subspan(1)) {
    const SphereOverlap part = sphereOverlap(body.field, body.inBody(centre_P), radius_mm, tissue);
    sum.volume_mm3 += part.volume_mm3;
    sum.first_moment_P_mm4 = sum.first_moment_P_mm4 + body.fromBody(part.first_moment_P_mm4);
    sum.grey_mm3 += part.grey_mm3;
    sum.stiff_mm3 += part.stiff_mm3;
  }
  return sum;
}

std::uint8_t dominantLabel(const SolidBodies& bodies, const Point<Patient>& centre_P, double radius_mm) noexcept {
  if (!bodies.isLabelled() || !(radius_mm > 0.0)) return 0;
  std::array<std::uint32_t, 256> weight{};
  for (const SolidBody& body : bodies.bodies()) {
    const SolidField& field = body.field;
    const glm::dvec3 centre = field.grid.indexFromPoint(body.inBody(centre_P).mm);
    const double radius = radius_mm / field.grid.spacing_mm;
    if (boxOf(field, centre, radius).empty()) continue;
    // Four concentric balls, closer together towards the surface.
    for (const glm::dvec3& direction : kSpiral)
      for (const double part : {0.98, 0.88, 0.7, 0.4}) {
        const glm::ivec3 ijk(glm::floor(centre + part * radius * direction + 0.5));
        if (!field.grid.contains(ijk)) continue;
        const std::size_t offset = field.offsetOf(ijk);
        weight[field.label[offset]] += static_cast<std::uint32_t>(field.solid[offset]);
      }
  }
  const auto most = std::max_element(weight.begin(), weight.end());
  return *most == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(most - weight.begin());
}

}  // namespace haptics
