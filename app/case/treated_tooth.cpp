#include "app/case/treated_tooth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "app/case/root_canals.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/import/modelled_canals.h"
#include "assets/load_error.h"
#include "assets/scenery/rubber_dam.h"
#include "assets/tooth.h"

namespace app {
namespace {

constexpr double kAccessTaper = 0.10, kAccessInto_mm = 0.3;  ///< wider a mm; below the roof's plane
constexpr double kDamHeight_mm = 1.0;                        ///< over the cervical line
constexpr double kFocus_mm = 4.0;                            ///< over the chamber's roof

double toSegment_mm(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 way = b - a;
  const double length2 = glm::dot(way, way);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, way) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + t * way);
}

/// Signed where the outline is a polygon.
double toOutline_mm(const std::vector<glm::dvec2>& outline, const glm::dvec2& p) {
  double nearest_mm = 1e9;
  bool is_inside = false;
  for (std::size_t n = 0, before = outline.size() - 1; n < outline.size(); before = n++) {
    const glm::dvec2 &a = outline[before], &b = outline[n];
    nearest_mm = std::min(nearest_mm, toSegment_mm(p, a, b));
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) is_inside = !is_inside;
  }
  return is_inside && outline.size() > 2 ? -nearest_mm : nearest_mm;
}

/// A scan in which the tooth stands alone: what lies over the dam of others would look cut off.
assets::CtVolume withoutNeighbours(const assets::CtVolume& ct, int fdi) {
  assets::CtVolume alone = ct;
  for (std::size_t v = 0; v < ct.tooth.size(); ++v) {
    if (ct.tooth[v] == 0 || ct.tooth[v] == fdi) continue;
    alone.solid[v] = 0;
    alone.label[v] = static_cast<std::uint8_t>(assets::Tissue::unlabelled);
    alone.tooth[v] = 0;
  }
  return alone;
}

/// How far the tooth reaches on the dam's level, in every direction.
assets::DamHole damHole(const assets::CtVolume& ct, const assets::ToothFrame& frame) {
  constexpr std::size_t kAround = 96;
  constexpr double kFarthest_mm = 8.0;
  assets::DamHole hole{kDamHeight_mm, {}};
  for (std::size_t n = 0; n < kAround; ++n) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(n) / kAround;
    double reach_mm = 0.5;
    for (double r = 0.5; r < kFarthest_mm; r += 0.5 * ct.grid.spacing_mm) {
      const glm::dvec3 p_P = frame.inP({r * std::cos(angle), r * std::sin(angle), kDamHeight_mm});
      const glm::ivec3 ijk(glm::round(ct.grid.indexFromPoint(p_P)));
      if (!ct.grid.contains(ijk)) break;
      const std::size_t v = ct.grid.index(ijk);
      if (ct.solid[v] >= assets::kHalfSolid && assets::isTooth(ct.label[v])) reach_mm = r;
    }
    hole.radius_mm.push_back(reach_mm);
  }
  return hole;
}

}  // namespace

std::int16_t greyOf(std::uint8_t solid, std::uint8_t label) {
  constexpr double kAir_HU = -1000.0;
  return static_cast<std::int16_t>(glm::mix(kAir_HU, assets::properties(label).hounsfield, solid / 255.0));
}

bool isRoofOpen(const assets::ToothCanals& tooth, const assets::CtVolume& ct) {
  constexpr double kOverRoof_mm = 0.5;
  glm::dvec2 middle(0.0);
  for (const glm::dvec2& p : tooth.chamber.outline_mm)
    middle += p / static_cast<double>(tooth.chamber.outline_mm.size());
  const glm::dvec3 p_P = tooth.frame.inP({middle, tooth.chamber.roof_mm + kOverRoof_mm});
  const glm::ivec3 ijk(glm::round(ct.grid.indexFromPoint(p_P)));
  return !ct.grid.contains(ijk) || ct.solid[ct.grid.index(ijk)] < assets::kHalfSolid;
}

double access_mm(const assets::PulpChamber& chamber, const glm::dvec3& p_mm) {
  const double over_mm = p_mm.z - chamber.roof_mm;
  const double beside_mm = toOutline_mm(chamber.outline_mm, {p_mm.x, p_mm.y}) - chamber.round_mm;
  return std::max(beside_mm - kAccessTaper * std::max(0.0, over_mm), -kAccessInto_mm - over_mm);
}

assets::Patient treatedTooth(const assets::Patient& whole, const assets::ToothCanals& canals,
                             const assets::ToothSampler& fine, bool is_open) {
  assets::Patient patient;
  patient.title = fmt::format("{}, {} ({}), root canals{}", whole.title, assets::toothName(canals.fdi), canals.fdi,
                              canals.is_modelled ? " modelled" : "");
  patient.canals = canals;
  assets::CtVolume& ct = patient.ct;
  ct.grid = fine.grid();
  const std::size_t count = ct.grid.voxelCount();
  ct.hounsfield.resize(count), ct.solid.resize(count), ct.label.resize(count);

  const glm::ivec3 size = ct.grid.size;
  const auto put = [&](glm::ivec3 block, const auto& solid_of, const auto& label_of) {
    for (int v = 0; v < assets::ToothSampler::kVoxels; ++v) {
      const glm::ivec3 ijk = block * assets::ToothSampler::kEdge + glm::ivec3(v & 3, v >> 2 & 3, v >> 4);
      if (glm::any(glm::greaterThanEqual(ijk, size))) continue;
      const std::size_t at = ct.grid.index(ijk);
      ct.solid[at] = solid_of(v), ct.label[at] = label_of(v);
    }
  };
  assets::forBlocks(
      fine,
      [&](glm::ivec3 block, const assets::ToothSampler::Same& same) {
        put(
            block, [&](int) { return same.solid; }, [&](int) { return same.label; });
      },
      [&](glm::ivec3 block, const auto& solid, const auto& label) {
        put(
            block, [&](int v) { return solid[static_cast<std::size_t>(v)]; },
            [&](int v) { return label[static_cast<std::size_t>(v)]; });
      });
  const assets::DamHole hole = damHole(ct, canals.frame);
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (is_open && ct.solid[v] > 0) {
      const double from_mm = access_mm(canals.chamber, canals.frame.local(ct.grid.centre_P_mm(ijk)));
      const double left = std::clamp(0.5 + from_mm / ct.grid.spacing_mm, 0.0, 1.0);
      ct.solid[v] = std::min(ct.solid[v], static_cast<std::uint8_t>(255.0 * left + 0.5));
    }
    ct.hounsfield[v] = greyOf(ct.solid[v], ct.label[v]);
  });

  patient.classification = whole.classification;
  patient.jaw_P_mm = canals.frame.inP({0.0, 0.0, canals.chamber.roof_mm + kFocus_mm});
  patient.gingiva = assets::rubberDam(canals.frame, hole);
  patient.face = whole.face;
  patient.has_built_in_face = whole.has_built_in_face;
  patient.X_PF = whole.X_PF;
  return patient;
}

FineTooth fineToothAlone(const assets::Patient& whole, const std::optional<assets::JawParameters>& jaw, int fdi,
                         double spacing_mm, const std::string& option, Canals canals) {
  const std::vector<CanalTooth> teeth = jaw ? canalTeeth(*jaw) : canalTeeth(whole.ct);
  const auto found = std::ranges::find(teeth, fdi, &CanalTooth::fdi);
  if (found == teeth.end())
    throw UsageError(fmt::format("{} {}: this patient has no such tooth, give {}", option, fdi,
                                 joined(teeth, [](const CanalTooth& tooth) { return std::to_string(tooth.fdi); })));
  if (!found->canals && !jaw && canals == Canals::wanted) {
    assets::ToothCanals none = assets::unmodelledTooth(whole.ct, fdi);
    auto fine = fineTooth(withoutNeighbours(whole.ct, fdi), jaw, none, spacing_mm);
    return {std::move(none), std::move(fine)};
  }
  // What a scan's tooth lacks is said by its remark, an impacted one of the built-in jaw has canals and lies too deep.
  if (!found->canals || (jaw && !found->remark.empty()))
    throw UsageError(fmt::format("{} {}: {}, choose another, see molar teeth", option, fdi, found->remark));
  try {
    return {*found->canals, fineTooth(withoutNeighbours(whole.ct, fdi), jaw, *found->canals, spacing_mm)};
  } catch (const assets::LoadError& error) {
    throw UsageError(fmt::format("{} {}: {}", option, fdi, error.what()));
  }
}

assets::Patient treatedTooth(const assets::Patient& whole, const std::optional<assets::JawParameters>& jaw, int fdi,
                             bool is_open, const std::string& option, double spacing_mm) {
  const FineTooth tooth = fineToothAlone(whole, jaw, fdi, spacing_mm, option);
  return treatedTooth(whole, tooth.canals, *tooth.fine, is_open);
}

}  // namespace app
