#include "app/case/caries_lesion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "app/case/treated_tooth.h"
#include "app/text/usage_error.h"
#include "assets/scan/exact_distance.h"

namespace app {
namespace {

using assets::Tissue;

constexpr std::array<std::string_view, 3> kCariesNames{"occlusal", "mesial", "distal"};
constexpr double kWalk_mm = 0.02;
constexpr double kFissureWithin_mm = 1.5;  ///< of the axis
constexpr double kContactHeight = 0.55;    ///< of the crown's
constexpr double kThickestEnamel_mm = 3.5;
constexpr double kSoundLeft_mm = 0.5;                                  ///< of dentine left over the pulp, at least
constexpr double kDeepestLesion_mm = 2.8, kShallowestLesion_mm = 0.8;  ///< into the dentine
constexpr double kShareToPulp = 0.75;                                  ///< of the way there
constexpr double kConeBase_mm = 1.5;                                   ///< radius at the border
constexpr double kSoftShare = 0.65;                                    ///< of the cone's sizes
constexpr double kBorderAlong_mm = 1.9, kBorderDeep_mm = 0.4;          ///< along the border: how far, how deep
constexpr double kLesionReach_mm = 5.0;                                ///< from the border, of all of it

class LayeredTooth {
 public:
  LayeredTooth(const assets::CtVolume& ct, const assets::ToothFrame& frame) : ct_(ct), frame_(frame) {}

  Tissue at(const glm::dvec3& p_mm) const {
    const glm::ivec3 ijk(glm::floor(ct_.grid.indexFromPoint(frame_.inP(p_mm)) + 0.5));
    if (!ct_.grid.contains(ijk)) return Tissue::unlabelled;
    const std::size_t v = ct_.grid.index(ijk);
    const Tissue tissue{ct_.label[v]};
    if (tissue == Tissue::pulp) return tissue;
    return ct_.solid[v] >= assets::kHalfSolid && assets::isToothPart(ct_.label[v]) ? tissue : Tissue::unlabelled;
  }
  /// The first place of the tooth on a way; none within its length.
  std::optional<glm::dvec3> firstOn(const glm::dvec3& from_mm, const glm::dvec3& way, double length_mm,
                                    Tissue tissue) const {
    for (double mm = 0.0; mm <= length_mm; mm += kWalk_mm) {
      const glm::dvec3 p = from_mm + mm * way;
      const Tissue here = at(p);
      if (tissue == Tissue::unlabelled ? here != Tissue::unlabelled : here == tissue) return p;
    }
    return std::nullopt;
  }
  double top_mm() const {
    double top_mm = 0.0;
    assets::forVoxels(ct_.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (assets::isToothPart(ct_.label[v]) && ct_.solid[v] >= assets::kHalfSolid)
        top_mm = std::max(top_mm, frame_.local(ct_.grid.centre_P_mm(ijk)).z);
    });
    return top_mm;
  }
  /// Of the crown's pulp.
  std::optional<glm::dvec3> nearestPulp(const glm::dvec3& p_mm) const {
    constexpr double kLowest_mm = -2.0;
    std::optional<glm::dvec3> nearest;
    assets::forVoxels(ct_.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (Tissue{ct_.label[v]} != Tissue::pulp) return;
      const glm::dvec3 p = frame_.local(ct_.grid.centre_P_mm(ijk));
      if (p.z > kLowest_mm && (!nearest || glm::distance(p, p_mm) < glm::distance(*nearest, p_mm))) nearest = p;
    });
    return nearest;
  }

 private:
  const assets::CtVolume& ct_;
  const assets::ToothFrame& frame_;
};

/// Where it begins at the surface.
std::optional<glm::dvec3> beginning(const LayeredTooth& tooth, CariesSite site) {
  constexpr double kBeyond_mm = 9.0;
  const double top_mm = tooth.top_mm();
  if (site != CariesSite::occlusal) {
    const double side = site == CariesSite::mesial ? 1.0 : -1.0;
    return tooth.firstOn({side * kBeyond_mm, 0.0, kContactHeight * top_mm}, {-side, 0.0, 0.0}, kBeyond_mm,
                         Tissue::unlabelled);
  }
  // The lowest place of the fissure.
  constexpr double kRaster_mm = 0.1;
  std::optional<glm::dvec3> lowest;
  for (double y = -kFissureWithin_mm; y <= kFissureWithin_mm; y += kRaster_mm)
    for (double x = -kFissureWithin_mm; x <= kFissureWithin_mm; x += kRaster_mm) {
      const auto place = tooth.firstOn({x, y, top_mm + 0.5}, {0.0, 0.0, -1.0}, top_mm, Tissue::unlabelled);
      if (place && (!lowest || place->z < lowest->z)) lowest = place;
    }
  return lowest;
}

/// Its form along the way to the pulp.
struct Lesion {
  CariesSite site;
  glm::dvec3 border_mm{0.0}, way{0.0};  ///< where it meets the dentine, unit towards the pulp
  double enamel_mm = 0.0, depth_mm = 0.0;

  /// What becomes of sound tissue, so far from the enamel.
  Tissue at(const glm::dvec3& p_mm, Tissue sound, double to_enamel_mm) const {
    const glm::dvec3 off = p_mm - border_mm;
    const double along_mm = glm::dot(off, way), aside_mm = glm::length(off - along_mm * way);
    if (sound == Tissue::enamel) {
      // Widest at the border under a fissure, at the surface of a side.
      const double out = std::clamp(-along_mm / enamel_mm, 0.0, 1.2);
      const double radius_mm = site == CariesSite::occlusal ? 0.7 - 0.4 * out : 0.35 + 0.45 * out;
      if (along_mm > kBorderDeep_mm || aside_mm > radius_mm) return sound;
      return aside_mm < kSoftShare * radius_mm ? Tissue::caries_soft : Tissue::caries_firm;
    }
    const auto is_within = [&](double size) {
      const double cone = aside_mm / (size * kConeBase_mm) + std::max(0.0, along_mm) / (size * depth_mm);
      return cone < 1.0 || (aside_mm < size * kBorderAlong_mm && to_enamel_mm < size * kBorderDeep_mm);
    };
    if (std::abs(along_mm) > kLesionReach_mm || along_mm < -enamel_mm - kBorderDeep_mm) return sound;
    return is_within(kSoftShare) ? Tissue::caries_soft : is_within(1.0) ? Tissue::caries_firm : sound;
  }
};

Lesion lesionOf(const LayeredTooth& tooth, CariesSite site, const std::string& option) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError(fmt::format("{} {}: {}", option, kCariesNames[static_cast<std::size_t>(site)], why));
  };
  Lesion lesion{.site = site};
  const auto begins = beginning(tooth, site);
  if (!begins) refuse("the tooth has no crown there, choose another place or tooth");
  const auto pulp = tooth.nearestPulp(*begins);
  lesion.way = glm::normalize((pulp ? *pulp : glm::dvec3(0.0)) - *begins);
  const auto border = tooth.firstOn(*begins, lesion.way, kThickestEnamel_mm, Tissue::dentine);
  if (!border) refuse("no dentine lies under its surface there, choose another place or tooth");
  lesion.border_mm = *border;
  lesion.enamel_mm = std::max(0.1, glm::distance(*begins, *border));
  const double to_pulp_mm = pulp ? glm::distance(*border, *pulp) : 2.0 * kDeepestLesion_mm;
  lesion.depth_mm = std::min({kDeepestLesion_mm, kShareToPulp * to_pulp_mm, to_pulp_mm - kSoundLeft_mm});
  if (lesion.depth_mm < kShallowestLesion_mm)
    refuse(fmt::format("only {:.1f} mm of dentine lie over the pulp there, choose another place or tooth", to_pulp_mm));
  return lesion;
}

}  // namespace

std::optional<CariesSite> cariesSiteOf(std::string_view name) {
  const auto found = std::ranges::find(kCariesNames, name);
  if (found == kCariesNames.end()) return std::nullopt;
  return static_cast<CariesSite>(found - kCariesNames.begin());
}

std::vector<std::string> cariesSites() { return {kCariesNames.begin(), kCariesNames.end()}; }

void placeCaries(assets::CtVolume& ct, const assets::ToothFrame& frame, CariesSite site, const std::string& option) {
  const Lesion lesion = lesionOf(LayeredTooth(ct, frame), site, option);
  // Around where it meets the dentine, with the distance to the enamel.
  const glm::ivec3 middle(glm::round(ct.grid.indexFromPoint(frame.inP(lesion.border_mm))));
  const int reach = static_cast<int>(std::ceil(kLesionReach_mm / ct.grid.spacing_mm));
  const glm::ivec3 low = glm::max(middle - reach, glm::ivec3(0)), end = glm::min(middle + reach + 1, ct.grid.size);
  const glm::ivec3 size = end - low;
  std::vector<std::uint8_t> enamel(assets::countIn(size));
  const auto within = [&](glm::ivec3 ijk) { return assets::indexIn(size, ijk - low); };
  assets::forVoxels(low, end, [&](glm::ivec3 ijk) {
    enamel[within(ijk)] = Tissue{ct.label[ct.grid.index(ijk)]} == Tissue::enamel ? 1 : 0;
  });
  const std::vector<float> to_enamel_mm = assets::exactDistance_mm(size, ct.grid.spacing_mm, enamel);
  assets::forVoxels(low, end, [&](glm::ivec3 ijk) {
    const std::size_t v = ct.grid.index(ijk);
    const Tissue sound{ct.label[v]};
    if (sound != Tissue::enamel && sound != Tissue::dentine) return;
    const Tissue now =
        lesion.at(frame.local(ct.grid.centre_P_mm(ijk)), sound, static_cast<double>(to_enamel_mm[within(ijk)]));
    if (now == sound) return;
    ct.label[v] = static_cast<std::uint8_t>(now);
    ct.hounsfield[v] = greyOf(ct.solid[v], ct.label[v]);
  });
}

}  // namespace app
