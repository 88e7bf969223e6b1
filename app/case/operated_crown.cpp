#include "app/case/operated_crown.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/case/trough_plan.h"
#include "assets/tooth.h"

namespace app {
namespace {

using assets::CtVolume;
using assets::Tissue;

constexpr double kWithoutEnamel_mm = 7.5;  ///< height of a crown whose enamel is not labelled
constexpr double kCervixShare = 0.05;      ///< of the enamel that lies below the cervical line
constexpr double kForwardUpright = 0.3, kForwardPerLean = 0.9, kMostForward = 0.75;  ///< of the way in
constexpr double kToCheek = 0.45;

}  // namespace

bool isOfTooth(const CtVolume& ct, std::size_t v, int fdi) {
  return ct.tooth.empty() ? assets::isToothPart(ct.label[v]) : ct.tooth[v] == fdi;
}

std::optional<OperatedCrown> operatedCrown(const CtVolume& ct, const assets::OperativeSite& site) {
  const glm::dvec3 axis = glm::normalize(site.axis_P);
  std::vector<double> enamel_mm;
  std::vector<std::pair<glm::dvec3, double>> tooth;
  double top_mm = kNoHeight_mm;
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (!isOfTooth(ct, v, site.fdi)) return;
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const double along_mm = glm::dot(p, axis);
    tooth.emplace_back(p, along_mm);
    top_mm = std::max(top_mm, along_mm);
    if (Tissue{ct.label[v]} == Tissue::enamel) enamel_mm.push_back(along_mm);
  });
  if (tooth.empty()) return std::nullopt;
  OperatedCrown crown;
  crown.cervix_mm = top_mm - kWithoutEnamel_mm;
  // A tooth that is enamel alone in its labels has no cervical line.
  if (!enamel_mm.empty() && enamel_mm.size() < tooth.size()) {
    const auto cervix = enamel_mm.begin() + static_cast<std::ptrdiff_t>(kCervixShare * double(enamel_mm.size()));
    std::ranges::nth_element(enamel_mm, cervix);
    crown.cervix_mm = *cervix;
  }
  for (const auto& [p, along_mm] : tooth)
    if (along_mm >= crown.cervix_mm) crown.voxels_P_mm.push_back(p), crown.middle_P_mm += p;
  crown.middle_P_mm /= static_cast<double>(crown.voxels_P_mm.size());
  return crown;
}

WayIn SiteAxes::wayIn(const glm::dvec3& middle_P_mm, double to_cheek, double to_front) const {
  const glm::dvec3 outward = glm::normalize(up_P + to_cheek * buccal_P - to_front * distal_P);
  const glm::dvec3 along = glm::normalize(distal_P - glm::dot(distal_P, outward) * outward);
  const glm::dvec3 across = glm::cross(outward, along);
  return {middle_P_mm, along, glm::dot(across, buccal_P) < 0.0 ? -across : across, outward};
}

SiteAxes siteAxes(const CtVolume& ct, const assets::OperativeSite& site) {
  const glm::dvec3 distal = archDirection_P(ct, site), up = assets::occlusalDirection_P(site.fdi);
  const glm::dvec3 buccal = glm::cross(up, distal);
  return {distal, glm::dot(buccal, assets::buccalDirection_P(site.fdi)) < 0.0 ? -buccal : buccal, up};
}

WayIn wayIn(const CtVolume& ct, const assets::OperativeSite& site, const glm::dvec3& middle_P_mm) {
  const SiteAxes axes = siteAxes(ct, site);
  const double lean = std::abs(glm::dot(glm::normalize(site.axis_P), axes.distal_P));
  return axes.wayIn(middle_P_mm, kToCheek, std::min(kForwardUpright + kForwardPerLean * lean, kMostForward));
}

}  // namespace app
