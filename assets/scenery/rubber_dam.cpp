#include "assets/scenery/rubber_dam.h"

#include <cassert>
#include <cmath>

#include "assets/vertex_normals.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

using calibration::kPi;

constexpr double kOff_mm = 0.03;  ///< from the tooth
constexpr double kCuff_mm = 0.7;  ///< turned up along the tooth by the stretch
constexpr double kSag_mm = 2.5;   ///< of the edge
constexpr std::size_t kRings = 36;

/// Linear RGB of a usual dam.
const Material kLatex{{0.035f, 0.22f, 0.19f, 1.0f}, 0.62f, 0.0f};

/// Of ring n: how far from the hole to the edge, and its height over the hole's level.
struct Profile {
  double out_share, up_mm;
};
Profile profile(std::size_t ring) {
  const double t = static_cast<double>(ring) / (kRings - 1);
  const double out = t * t;
  const double cuff = kCuff_mm * std::exp(-out * 60.0), sag = kSag_mm * out * (2.0 - out);
  return {out, cuff - sag};
}

}  // namespace

MeshModel rubberDam(const ToothFrame& tooth, const DamHole& hole) {
  assert(hole.radius_mm.size() >= 8);
  const std::size_t around = hole.radius_mm.size();
  MeshPart sheet;
  sheet.name = "RubberDam";
  sheet.material = kLatex;
  // Seen from the side of the crown counter-clockwise, in either hand of the tooth's frame.
  const bool is_right_handed = glm::determinant(tooth.axes_P) > 0.0;
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    const Profile at = profile(ring);
    for (std::size_t n = 0; n < around; ++n) {
      const double angle = 2.0 * kPi * static_cast<double>(n) / static_cast<double>(around);
      // Folds of the stretch, none at the hole.
      const double fold_mm =
          0.35 * at.out_share * std::sin(5.0 * angle + 0.6) + 0.2 * at.out_share * std::sin(9.0 * angle);
      const double radius = glm::mix(hole.radius_mm[n] + kOff_mm, kDamEdge_mm, at.out_share);
      sheet.position_mm.emplace_back(
          tooth.inP({radius * std::cos(angle), radius * std::sin(angle), hole.height_mm + at.up_mm + fold_mm}));
    }
  }
  for (std::size_t ring = 0; ring + 1 < kRings; ++ring)
    for (std::size_t n = 0; n < around; ++n) {
      const auto a = static_cast<std::uint32_t>(ring * around + n);
      const auto b = static_cast<std::uint32_t>(ring * around + (n + 1) % around);
      const auto c = a + static_cast<std::uint32_t>(around), d = b + static_cast<std::uint32_t>(around);
      const std::uint32_t corners[6] = {a, c, b, b, c, d};
      for (int k = 0; k < 6; k += 3) {
        sheet.triangles.push_back(corners[k]);
        sheet.triangles.push_back(corners[is_right_handed ? k + 1 : k + 2]);
        sheet.triangles.push_back(corners[is_right_handed ? k + 2 : k + 1]);
      }
    }
  sheet.normal = vertexNormals(sheet.position_mm, sheet.triangles);
  MeshModel model;
  model.parts.push_back(std::move(sheet));
  return model;
}

}  // namespace assets
