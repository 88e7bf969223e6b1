#include "tests/assets/segment/head_phantom.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "assets/scan/exact_distance.h"
#include "assets/scan/image_file.h"
#include "assets/segment/cell_filters.h"
#include "assets/segment/cell_masks.h"
#include "assets/segment/flooding.h"
#include "assets/segment/thick_parts.h"
#include "assets/tissue.h"

namespace tests {
namespace {

using assets::CellMask;
using assets::Tissue;
using assets::VolumeGrid;

constexpr std::uint8_t kSkull = 1, kMandible = 2, kUpperTeeth = 3, kLowerTeeth = 4, kCanals = 5;
constexpr double kMiddle_mm = 91.25, kLeftBehindRight_mm = 1.0;  ///< of the segmentation

constexpr std::uint8_t byteOf(Tissue tissue) { return static_cast<std::uint8_t>(tissue); }

/// Even in -1.73..1.73, standard deviation 1, by place alone.
double hashNoise(std::uint64_t n) {
  n ^= n >> 33, n *= 0xff51afd7ed558ccdULL, n ^= n >> 33, n *= 0xc4ceb9fe1a85ec53ULL, n ^= n >> 33;
  return (static_cast<double>(n >> 11) * 0x1.0p-53 - 0.5) * 3.4641016;
}
double nearlyNormal(std::uint64_t n) {
  return (hashNoise(4 * n) + hashNoise(4 * n + 1) + hashNoise(4 * n + 2) + hashNoise(4 * n + 3)) / 2.0;
}

CellMask maskOf(const assets::ByteImage& image, std::uint8_t label) {
  CellMask mask(image.values.size());
  std::ranges::transform(image.values, mask.begin(),
                         [=](std::uint8_t v) -> std::uint8_t { return v == label ? 1 : 0; });
  return mask;
}

/// A field between its cells, 0 outside.
double sampleAt(const VolumeGrid& grid, const std::vector<float>& field, const glm::dvec3& p) {
  const glm::dvec3 at = grid.indexFromPoint(p);
  const glm::ivec3 low(glm::floor(at));
  if (glm::any(glm::lessThan(low, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(low + 1, grid.size))) return 0.0;
  const glm::dvec3 share = at - glm::dvec3(low);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 off = assets::cornerOffset(corner);
    const glm::dvec3 weight = glm::mix(1.0 - share, share, glm::dvec3(off));
    sum += weight.x * weight.y * weight.z * static_cast<double>(field[grid.index(low + off)]);
  }
  return sum;
}

template <class Visit>
void inParallel(const VolumeGrid& grid, const Visit& visit) {
  tbb::parallel_for(0, grid.size.z, [&](int k) {
    assets::forVoxels({0, 0, k}, {grid.size.x, grid.size.y, k + 1},
                      [&](glm::ivec3 ijk) { visit(grid.index(ijk), grid.centre_P_mm(ijk)); });
  });
}

/// A mask of the segmentation in other voxels, with smooth surfaces.
CellMask onGrid(const VolumeGrid& from, const CellMask& mask, const VolumeGrid& to) {
  std::vector<float> field(mask.begin(), mask.end());
  assets::smoothCells(from.size, 0.6, field);
  CellMask out(to.voxelCount());
  inParallel(to, [&](std::size_t n, const glm::dvec3& p) { out[n] = sampleAt(from, field, p) > 0.5 ? 1 : 0; });
  return out;
}

template <class Value>
Value nearestAt(const VolumeGrid& grid, const std::vector<Value>& values, const glm::dvec3& p) {
  const glm::ivec3 at(glm::floor(grid.indexFromPoint(p) + 0.5));
  return grid.contains(at) ? values[grid.index(at)] : Value{0};
}

/// FDI numbers of the 14 lower teeth in the segmentation's cells, and a little beyond them.
std::vector<std::uint8_t> numberedTeeth(const assets::ByteImage& image) {
  const CellMask teeth = maskOf(image, kLowerTeeth);
  const glm::ivec3 size = image.grid.size;
  CellMask outside(teeth.size());
  std::ranges::transform(teeth, outside.begin(), [](std::uint8_t in) -> std::uint8_t { return in == 0 ? 1 : 0; });
  std::vector<float> thickness = assets::exactDistance_mm(size, image.grid.spacing_mm, outside);
  for (float& depth : thickness) depth = std::max(0.0F, depth);
  // Divided until nothing finer is left; then a crown lies over its root: the nearest from above are one tooth.
  constexpr std::size_t kTeeth = 14;
  assets::CellPieces parts = assets::thickParts(size, thickness, teeth, 0.58);
  const auto centres = [&] {
    std::vector<glm::dvec3> sum(parts.cells.size(), glm::dvec3(0.0));
    assets::forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
      if (parts.of[n] != 0) sum[static_cast<std::size_t>(parts.of[n])] += image.grid.centre_P_mm(ijk);
    });
    for (std::size_t part = 1; part < sum.size(); ++part)
      if (parts.cells[part] > 0) sum[part] /= static_cast<double>(parts.cells[part]);
    return sum;
  };
  std::vector<std::size_t> large(parts.cells.size() - 1);
  std::iota(large.begin(), large.end(), std::size_t{1});
  while (large.size() > kTeeth) {
    const std::vector<glm::dvec3> centre = centres();
    std::pair<std::int32_t, std::int32_t> nearest{0, 0};
    double nearest_mm = 1e9;
    for (const auto& [sides, neck] : assets::necksBetween(size, thickness, parts.of)) {
      const double apart_mm = glm::distance(glm::dvec2(centre[static_cast<std::size_t>(sides.first)]),
                                            glm::dvec2(centre[static_cast<std::size_t>(sides.second)]));
      if (apart_mm < nearest_mm) nearest_mm = apart_mm, nearest = sides;
    }
    std::ranges::replace(parts.of, nearest.second, nearest.first);
    parts.cells[static_cast<std::size_t>(nearest.first)] +=
        std::exchange(parts.cells[static_cast<std::size_t>(nearest.second)], 0);
    std::erase(large, static_cast<std::size_t>(nearest.second));
  }
  // From the right to the left along the arch.
  const std::vector<glm::dvec3> centre = centres();
  const auto angle = [&](std::size_t part) { return std::atan2(centre[part].x - kMiddle_mm, 85.0 - centre[part].y); };
  std::ranges::sort(large, {}, angle);
  std::vector<std::uint8_t> number(parts.cells.size(), 0), label(teeth.size(), 0);
  for (std::size_t n = 0; n < large.size(); ++n) {
    const int place = static_cast<int>(n) - static_cast<int>(large.size() / 2);
    number[large[n]] = static_cast<std::uint8_t>(place < 0 ? 40 - place : 31 + place);
  }
  for (std::size_t n = 0; n < label.size(); ++n) label[n] = number[static_cast<std::size_t>(parts.of[n])];
  const CellMask near = assets::grownBy(size, teeth, 2.0);
  assets::flood(size, std::vector<std::uint16_t>(label.size(), 0), near, label);
  return label;
}

/// The third molar of the other case: its labels at a point of the segmentation's frame.
class Donor {
 public:
  explicit Donor(const std::filesystem::path& patients)
      : image_(assets::readLabels((patients / "right_third_molar/labels.nrrd").string())) {
    CellMask tooth(image_.values.size());
    std::ranges::transform(image_.values, tooth.begin(),
                           [](std::uint8_t v) -> std::uint8_t { return assets::isToothPart(v) ? 1 : 0; });
    const double reach = 2.0 / image_.grid.spacing_mm;
    near_ = assets::grownBy(image_.grid.size, tooth, reach);
  }
  /// 0 far from the third molar; label, and its number.
  struct Found {
    std::uint8_t label = 0, fdi = 0;
  };
  Found at(const glm::dvec3& p) const {
    const bool is_right = p.x < kMiddle_mm;
    const glm::dvec3 q = is_right ? p : glm::dvec3(2.0 * kMiddle_mm - p.x, p.y - kLeftBehindRight_mm, p.z);
    const glm::ivec3 ijk(glm::floor(image_.grid.indexFromPoint(q) + 0.5));
    if (!image_.grid.contains(ijk) || near_[image_.grid.index(ijk)] == 0) return {};
    return {image_.values[image_.grid.index(ijk)], static_cast<std::uint8_t>(is_right ? 48 : 38)};
  }

 private:
  assets::ByteImage image_;
  CellMask near_;
};

/// Enamel, dentine and pulp of teeth by depth and height; `crown_up`: of lower teeth.
void labelTeeth(const VolumeGrid& grid, const std::vector<std::uint8_t>& tooth, bool crown_up,
                std::vector<std::uint8_t>& tissue) {
  constexpr double kCrownUp_mm = 7.0, kCap_mm = 1.3, kPulp_mm = 1.9;
  CellMask outside(tooth.size());
  std::ranges::transform(tooth, outside.begin(), [](std::uint8_t fdi) -> std::uint8_t { return fdi == 0 ? 1 : 0; });
  const std::vector<float> depth_mm = assets::exactDistance_mm(grid.size, grid.spacing_mm, outside);
  std::array<double, 256> top{};
  top.fill(crown_up ? -1e9 : 1e9);
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t n) {
    const double z = grid.centre_P_mm(ijk).z;
    double& best = top[tooth[n]];
    best = crown_up ? std::max(best, z) : std::min(best, z);
  });
  inParallel(grid, [&](std::size_t n, const glm::dvec3& p) {
    if (tooth[n] == 0 || assets::isToothPart(tissue[n])) return;
    const double down_mm = std::abs(p.z - top[tooth[n]]), deep_mm = static_cast<double>(depth_mm[n]);
    tissue[n] = byteOf(down_mm < kCrownUp_mm && deep_mm < kCap_mm ? Tissue::enamel
                       : deep_mm > kPulp_mm                       ? Tissue::pulp
                                                                  : Tissue::dentine);
  });
}

double hounsfieldOf(std::uint8_t tissue) {
  switch (Tissue{tissue}) {
    case Tissue::cortical:
      return 1250.0;
    case Tissue::trabecular:
      return 320.0;
    case Tissue::enamel:
      return 2500.0;
    case Tissue::dentine:
      return 1650.0;
    case Tissue::pulp:
      return 150.0;
    case Tissue::mandibular_canal:
      return 40.0;
    default:
      return 60.0;
  }
}

/// In an ellipse across that leaves the corners of the volume to air.
bool isHead(const glm::dvec3& p) {
  const double x = (p.x - kMiddle_mm) / 80.0, y = (p.y - 95.0) / 88.0;
  return x * x + y * y < 1.0;
}

/// The mouth between the teeth, the throat.
bool isAirway(const glm::dvec3& p) {
  const double x = (p.x - kMiddle_mm) / 12.0, y = (p.y - 118.0) / 8.0;
  return x * x + y * y < 1.0;
}

void addMetal(const VolumeGrid& grid, const std::vector<std::uint8_t>& tissue, const std::vector<std::uint8_t>& tooth,
              std::vector<float>& hu) {
  glm::dvec3 middle(0.0);
  double count = 0.0;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t n) {
    if (tooth[n] == 46 && tissue[n] == byteOf(Tissue::enamel)) middle += grid.centre_P_mm(ijk), count += 1.0;
  });
  middle /= count;
  inParallel(grid, [&](std::size_t n, const glm::dvec3& p) {
    if (tooth[n] == 46 && tissue[n] == byteOf(Tissue::enamel)) {
      hu[n] = 6000.0F;
      return;
    }
    if (std::abs(p.z - middle.z) > 3.5) return;
    const double away = glm::distance(glm::dvec2(p), glm::dvec2(middle)),
                 angle = std::atan2(p.y - middle.y, p.x - middle.x);
    hu[n] += static_cast<float>(450.0 * std::cos(9.0 * angle) * std::exp(-away / 25.0));
  });
}

struct Truth {
  CellMask solid, cortex, skull;
  std::vector<std::uint8_t> tissue, tooth, upper_tooth;
};

Truth truthOn(const VolumeGrid& grid, const assets::ByteImage& image, const Donor& donor, bool has_skull) {
  const glm::ivec3 size = image.grid.size;
  Truth truth;
  // The segmentation's mandible is its cortex alone.
  CellMask solid = maskOf(image, kMandible);
  for (std::size_t n = 0; n < solid.size(); ++n)
    if (image.values[n] == kLowerTeeth || image.values[n] == kCanals) solid[n] = 1;
  const assets::CellBox box = assets::boxOfCells(size, solid).grown(8, size);
  CellMask filled = assets::closedBy(box.size(), assets::croppedTo(box, size, solid), 3.0 / image.grid.spacing_mm);
  for (int axis = 0; axis < 3; ++axis) assets::fillHolesAcross(box.size(), axis, filled);
  assets::forCells(box.size(), [&](glm::ivec3 ijk, std::size_t n) {
    if (filled[n] != 0) solid[assets::indexIn(size, box.low + ijk)] = 1;
  });
  truth.solid = onGrid(image.grid, solid, grid);
  truth.cortex = onGrid(image.grid, maskOf(image, kMandible), grid);
  const CellMask teeth = onGrid(image.grid, maskOf(image, kLowerTeeth), grid);
  const CellMask canal = onGrid(image.grid, maskOf(image, kCanals), grid);
  const std::vector<std::uint8_t> numbers = numberedTeeth(image);
  truth.tissue.assign(grid.voxelCount(), 0);
  truth.tooth.assign(grid.voxelCount(), 0);
  inParallel(grid, [&](std::size_t n, const glm::dvec3& p) {
    if (teeth[n] != 0) truth.tooth[n] = nearestAt(image.grid, numbers, p);
    if (truth.solid[n] != 0)
      truth.tissue[n] = byteOf(canal[n] != 0          ? Tissue::mandibular_canal
                               : truth.cortex[n] != 0 ? Tissue::cortical
                                                      : Tissue::trabecular);
    const Donor::Found molar = donor.at(p);
    if (truth.tooth[n] != 0 || molar.label == 0 || molar.label == byteOf(Tissue::gingiva)) return;
    truth.tissue[n] = molar.label;
    truth.solid[n] = 1;
    if (assets::isToothPart(molar.label)) truth.tooth[n] = molar.fdi;
  });
  labelTeeth(grid, truth.tooth, true, truth.tissue);
  if (!has_skull) return truth;
  truth.skull = onGrid(image.grid, maskOf(image, kSkull), grid);
  truth.upper_tooth = onGrid(image.grid, maskOf(image, kUpperTeeth), grid);
  return truth;
}

}  // namespace

HeadPhantom headPhantom(const std::filesystem::path& patients, const HeadPhantomOptions& options) {
  const assets::ByteImage image =
      assets::readLabels((patients / "cbct_segmentation/PostDentalSurgery_Segmentation.nii.gz").string());
  HeadPhantom phantom;
  const VolumeGrid& from = image.grid;
  const glm::ivec3 size(glm::dvec3(from.size) * from.spacing_mm / options.spacing_mm);
  phantom.grid = {size, options.spacing_mm,
                  from.origin_P_mm + 0.5 * (options.spacing_mm - from.spacing_mm) * glm::dvec3(1.0)};
  const VolumeGrid& grid = phantom.grid;
  Truth truth = truthOn(grid, image, Donor(patients), true);
  std::vector<std::uint8_t> upper_tissue(grid.voxelCount(), 0);
  labelTeeth(grid, truth.upper_tooth, false, upper_tissue);

  // Marrow varies over about a millimetre.
  std::vector<float> texture(from.voxelCount());
  tbb::parallel_for(std::size_t{0}, texture.size(),
                    [&](std::size_t n) { texture[n] = static_cast<float>(nearlyNormal(n)); });
  assets::smoothCells(from.size, 1.1, texture);
  CellMask any_tooth = truth.tooth;
  for (std::size_t n = 0; n < any_tooth.size(); ++n) any_tooth[n] = any_tooth[n] != 0 || upper_tissue[n] != 0 ? 1 : 0;
  const std::vector<float> off_tooth_mm = assets::exactDistance_mm(grid.size, grid.spacing_mm, any_tooth);

  constexpr double kLigament_mm = 0.25, kTexture_hu = 170.0, kTextureSd = 0.123, kSoft_hu = 60.0;
  std::vector<float> hu(grid.voxelCount());
  inParallel(grid, [&](std::size_t n, const glm::dvec3& p) {
    double value = !isHead(p) || isAirway(p) ? -1000.0 : kSoft_hu;
    if (truth.tissue[n] != 0)
      value = hounsfieldOf(truth.tissue[n]);
    else if (upper_tissue[n] != 0)
      value = hounsfieldOf(upper_tissue[n]);
    else if (truth.skull[n] != 0)
      value = 1150.0;
    if (truth.tissue[n] == byteOf(Tissue::trabecular))
      value += kTexture_hu / kTextureSd * std::clamp(sampleAt(from, texture, p), -0.3, 0.3);
    if (any_tooth[n] == 0 && value > kSoft_hu) {
      const double share =
          (kLigament_mm + 0.5 * grid.spacing_mm - static_cast<double>(off_tooth_mm[n])) / grid.spacing_mm;
      value += std::clamp(share, 0.0, 1.0) * (kSoft_hu - value);
    }
    hu[n] = static_cast<float>(value);
  });
  if (options.has_metal) addMetal(grid, truth.tissue, truth.tooth, hu);
  assets::smoothCells(grid.size, 0.28 / grid.spacing_mm, hu);
  phantom.grey.resize(hu.size());
  inParallel(grid, [&](std::size_t n, const glm::dvec3& p) {
    const double x = (p.x - kMiddle_mm) / 80.0, y = (p.y - 95.0) / 88.0, out = std::min(1.0, x * x + y * y);
    const double shaded =
        static_cast<double>(hu[n]) + options.cupping_hu * (out - 0.5) + options.noise_hu * nearlyNormal(n);
    const double stored = options.slope * std::clamp(shaded, -3000.0, 4500.0) + options.offset;
    phantom.grey[n] = static_cast<std::int16_t>(std::lround(std::clamp(stored, -32000.0, 32000.0)));
  });
  phantom.tissue = std::move(truth.tissue);
  phantom.tooth = std::move(truth.tooth);
  phantom.mandible = std::move(truth.solid);
  for (std::size_t n = 0; n < phantom.mandible.size(); ++n)
    if (phantom.tooth[n] != 0) phantom.mandible[n] = 1;
  return phantom;
}

std::vector<std::uint8_t> teethOfRightThirdMolar(const std::filesystem::path& patients) {
  const assets::ByteImage image =
      assets::readLabels((patients / "cbct_segmentation/PostDentalSurgery_Segmentation.nii.gz").string());
  const assets::ByteImage labels = assets::readLabels((patients / "right_third_molar/labels.nrrd").string());
  const std::vector<std::uint8_t> numbers = numberedTeeth(image);
  std::vector<std::uint8_t> tooth(labels.values.size(), 0);
  assets::forVoxels(labels.grid, [&](glm::ivec3 ijk, std::size_t n) {
    if (labels.values[n] == byteOf(Tissue::other_teeth))
      tooth[n] = nearestAt(image.grid, numbers, labels.grid.centre_P_mm(ijk));
    else if (assets::isToothPart(labels.values[n]))
      tooth[n] = 48;
  });
  return tooth;
}

}  // namespace tests
