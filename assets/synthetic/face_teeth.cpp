#include "assets/synthetic/face_teeth.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "assets/synthetic/dental_arch.h"
#include "assets/tooth.h"

namespace assets {
namespace {

// Along the arch, Wheeler's Dental Anatomy, and below the occlusal plane.
constexpr std::array<double, 8> kWidths_mm{5.3, 5.8, 6.9, 7.1, 7.1, 11.2, 10.7, 10.5};
constexpr double kMiddle_mm = -9.0, kOwnTooth_mm = 6.0;

}  // namespace

std::vector<FaceTooth> builtInFaceTeeth() {
  static const DentalArch kArch;
  std::vector<FaceTooth> teeth;
  double along_mm = 0.0;
  for (std::size_t n = 0; n < kWidths_mm.size(); ++n) {
    const glm::dvec2 at = kArch.stationAt(along_mm + 0.5 * kWidths_mm[n]).centre_mm;
    along_mm += kWidths_mm[n];
    for (const bool is_right : {true, false}) {
      const calibration::Point<calibration::Patient> p{{is_right ? -at.x : at.x, at.y, kMiddle_mm}};
      teeth.push_back({(is_right ? 40 : 30) + static_cast<int>(n) + 1, (kFaceAxes_PF.inverse() * p).mm});
    }
  }
  return teeth;
}

void dropTeeth(MeshModel& face_P, const FacePlacement& placed, const std::vector<FaceTooth>& teeth,
               const std::vector<glm::dvec3>& own_P_mm) {
  std::vector<std::pair<glm::dvec2, bool>> places;
  for (const FaceTooth& tooth : teeth) {
    const glm::dvec2 at((placed.X_PF * calibration::Point<calibration::Face>{tooth.open_F_mm}).mm);
    places.emplace_back(at, std::ranges::any_of(own_P_mm, [&](const glm::dvec3& own) {
                          return glm::distance(glm::dvec2(own), at) < kOwnTooth_mm;
                        }));
  }
  for (MeshPart& part : face_P.parts) {
    if (part.name != "LowerTeeth") continue;
    std::vector<std::uint32_t> kept;
    for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
      const glm::dvec2 p(part.position_mm[part.triangles[t]]);
      const auto nearest = std::ranges::min_element(
          places, {}, [&p](const std::pair<glm::dvec2, bool>& place) { return glm::distance(place.first, p); });
      if (!nearest->second) kept.insert(kept.end(), {part.triangles[t], part.triangles[t + 1], part.triangles[t + 2]});
    }
    part.triangles = std::move(kept);
  }
  std::erase_if(face_P.parts, [](const MeshPart& part) { return part.triangles.empty(); });
}

}  // namespace assets
