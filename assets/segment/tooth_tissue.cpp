#include "assets/segment/tooth_tissue.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "assets/segment/cell_filters.h"
#include "assets/tissue.h"

namespace assets {
namespace {

constexpr double kTissueSmooth_mm = 0.25, kBrightShare = 0.98, kLeastStep_hu = 500.0, kPulpShare = 0.5,
                 kLeastPulp_hu = 700.0;
constexpr double kPulpInside_mm = 0.8, kPulpDeep_mm = 1.2, kSurface_voxels = 1.05, kLeastEnamel_mm3 = 3.0;
constexpr int kToothMargin = 2;
constexpr auto kEnamel = static_cast<std::uint8_t>(Tissue::enamel),
               kDentine = static_cast<std::uint8_t>(Tissue::dentine), kPulp = static_cast<std::uint8_t>(Tissue::pulp);

/// One tooth in its box.
class ToothBody {
 public:
  ToothBody(glm::ivec3 size, double spacing_mm, CellMask mask, std::vector<float> grey)
      : size_(size), spacing_mm_(spacing_mm), mask_(std::move(mask)), grey_(std::move(grey)) {
    depth_mm_ = depthInside_mm(size_, spacing_mm_, mask_);
  }

  std::vector<std::uint8_t> tissues(const GreyLevels& levels) const {
    const double bright = std::max(brightest(), levels.dentine_hu + kLeastStep_hu);
    const double enamel_hu = levels.dentine_hu + 0.5 * (bright - levels.dentine_hu);
    const double pulp_hu = std::max(kPulpShare * levels.dentine_hu, kLeastPulp_hu);
    std::vector<std::uint8_t> out(mask_.size(), 0);
    CellMask pulp(mask_.size(), 0);
    for (std::size_t n = 0; n < out.size(); ++n) {
      if (mask_[n] == 0) continue;
      out[n] = static_cast<double>(grey_[n]) > enamel_hu ? kEnamel : kDentine;
      pulp[n] = static_cast<double>(grey_[n])<pulp_hu&& static_cast<double>(depth_mm_[n])> kPulpInside_mm ? 1 : 0;
    }
    // Without single voxels, except deep inside.
    const CellMask opened = grownByOne(size_, shrunkByOne(size_, pulp));
    for (std::size_t n = 0; n < out.size(); ++n)
      if (pulp[n] != 0 && (opened[n] != 0 || static_cast<double>(depth_mm_[n]) > kPulpDeep_mm)) out[n] = kPulp;
    takeFromBehind(out);
    dropCrumbs(out);
    return out;
  }

 private:
  double brightest() const {
    std::vector<float> greys;
    for (std::size_t n = 0; n < mask_.size(); ++n)
      if (mask_[n] != 0) greys.push_back(grey_[n]);
    const auto at = static_cast<std::size_t>(kBrightShare * static_cast<double>(greys.size() - 1));
    std::ranges::nth_element(greys, greys.begin() + static_cast<std::ptrdiff_t>(at));
    return static_cast<double>(greys[at]);
  }

  /// The tissue of the nearest voxel below the surface, within two; the first of equally near ones.
  void takeFromBehind(std::vector<std::uint8_t>& out) const {
    const auto is_core = [&](std::size_t n) {
      return mask_[n] != 0 && static_cast<double>(depth_mm_[n]) > kSurface_voxels * spacing_mm_;
    };
    const std::vector<std::uint8_t> before = out;
    forVoxels(glm::ivec3(0), size_, [&](glm::ivec3 ijk) {
      const std::size_t n = indexIn(size_, ijk);
      if (mask_[n] == 0 || is_core(n)) return;
      int nearest = 13;
      forVoxels(glm::max(ijk - 2, glm::ivec3(0)), glm::min(ijk + 3, size_), [&](glm::ivec3 other) {
        const glm::ivec3 apart = other - ijk;
        const int squared = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
        if (squared >= nearest || !is_core(indexIn(size_, other))) return;
        nearest = squared;
        out[n] = before[indexIn(size_, other)];
      });
    });
  }

  void dropCrumbs(std::vector<std::uint8_t>& out) const {
    CellMask enamel(out.size());
    std::ranges::transform(out, enamel.begin(), [](std::uint8_t t) -> std::uint8_t { return t == kEnamel ? 1 : 0; });
    const CellPieces pieces = piecesOfCells(size_, enamel);
    const double least = kLeastEnamel_mm3 / std::pow(spacing_mm_, 3);
    for (std::size_t n = 0; n < out.size(); ++n)
      if (pieces.of[n] != 0 && static_cast<double>(pieces.cells[static_cast<std::size_t>(pieces.of[n])]) < least)
        out[n] = kDentine;
  }

  glm::ivec3 size_;
  double spacing_mm_;
  CellMask mask_;
  std::vector<float> grey_, depth_mm_;
};

std::vector<std::uint8_t> tissuesIn(const Mandible& jaw, const CellBox& box, const CellMask& tooth,
                                    const GreyLevels& levels) {
  std::vector<float> grey = croppedTo(box, jaw.grid.size, jaw.hounsfield);
  smoothCells(box.size(), kTissueSmooth_mm / jaw.grid.spacing_mm, grey);
  return ToothBody(box.size(), jaw.grid.spacing_mm, tooth, std::move(grey)).tissues(levels);
}

}  // namespace

std::vector<std::uint8_t> ToothTissues::of(const Mandible& jaw, const ToothRegions& teeth, const GreyLevels& levels) {
  struct Asked {
    CellBox box;  ///< of the jaw
    CellMask tooth;
    std::vector<std::uint8_t> tissue;
    bool is_known = false;
  };
  const glm::ivec3 size = teeth.box.size();
  const std::vector<CellBox> boxes = boxesOfParts(teeth);
  std::vector<Asked> asked;
  for (std::size_t part = 1; part < boxes.size(); ++part) {
    if (boxes[part].isEmpty()) continue;
    const CellBox box = boxes[part].grown(kToothMargin, size);
    Asked one{{box.low + teeth.box.low, box.end + teeth.box.low}, croppedTo(box, size, teeth.part), {}, false};
    for (std::uint8_t& cell : one.tooth) cell = cell == part ? 1 : 0;
    if (const auto* const known = known_.find(one.box, one.tooth)) one.tissue = *known, one.is_known = true;
    asked.push_back(std::move(one));
  }
  tbb::parallel_for(std::size_t{0}, asked.size(), [&](std::size_t n) {
    if (!asked[n].is_known) asked[n].tissue = tissuesIn(jaw, asked[n].box, asked[n].tooth, levels);
  });
  std::vector<std::uint8_t> out(teeth.part.size(), 0);
  for (Asked& one : asked) {
    forCells(one.box.size(), [&](glm::ivec3 ijk, std::size_t n) {
      if (one.tooth[n] != 0) out[indexIn(size, one.box.low - teeth.box.low + ijk)] = one.tissue[n];
    });
    if (!one.is_known) known_.keep(one.box, std::move(one.tooth), std::move(one.tissue));
  }
  return out;
}

}  // namespace assets
