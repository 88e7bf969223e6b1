#include "assets/segment/jaw_arch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace assets {
namespace {

constexpr float kDense_hu = 1550.0F;
constexpr double kJoin_mm = 2.1, kLeastPiece_mm3 = 150.0, kLeastRow_mm3 = 500.0, kHalfSlab_mm = 22.0;
constexpr double kLeastWidth_mm = 38.0, kLeastDepth_mm = 18.0, kFrontInMiddle = 0.25;
constexpr std::size_t kLeastCells = 8;

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double percentileOf(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::ranges::nth_element(values, at);
  return *at;
}

/// The largest dense piece, and the other half of a gapped row.
CellMask denseRow(const VolumeGrid& cells, const std::vector<float>& smooth_hu) {
  constexpr std::size_t kMostPieces = 6;
  CellMask dense(smooth_hu.size());
  std::ranges::transform(smooth_hu, dense.begin(), [](float hu) -> std::uint8_t { return hu > kDense_hu ? 1 : 0; });
  const double reach = kJoin_mm / cells.spacing_mm;
  const CellBox box = boxOfCells(cells.size, dense).grown(static_cast<int>(reach) + 1, cells.size);
  if (box.isEmpty()) return dense;
  const CellPieces pieces = piecesOfCells(box.size(), grownBy(box.size(), croppedTo(box, cells.size, dense), reach));
  const auto piece_of = [&](glm::ivec3 in_box) {
    return static_cast<std::size_t>(pieces.of[indexIn(box.size(), in_box)]);
  };
  std::vector<double> volume_mm3(pieces.cells.size(), 0.0);
  forCells(box.size(), [&](glm::ivec3 ijk, std::size_t) {
    if (dense[cells.index(box.low + ijk)] != 0) volume_mm3[piece_of(ijk)] += cells.voxelVolume_mm3();
  });
  std::vector<std::size_t> by_volume(volume_mm3.size());
  std::iota(by_volume.begin(), by_volume.end(), std::size_t{0});
  std::ranges::stable_sort(by_volume, std::greater<>(), [&](std::size_t n) { return volume_mm3[n]; });
  std::vector<std::uint8_t> is_taken(volume_mm3.size(), 0);
  for (std::size_t n = 0; n < std::min(kMostPieces, by_volume.size()); ++n)
    is_taken[by_volume[n]] = n == 0 || volume_mm3[by_volume[n]] > kLeastPiece_mm3 ? 1 : 0;
  forCells(box.size(), [&](glm::ivec3 ijk, std::size_t) {
    if (is_taken[piece_of(ijk)] == 0) dense[cells.index(box.low + ijk)] = 0;
  });
  return dense;
}

/// Values by bin: unknown ones between known ones, ends held, smoothed over `sigma` bins.
std::array<double, kArchBins> smoothed(const std::array<double, kArchBins>& values,
                                       const std::array<bool, kArchBins>& is_known, double sigma) {
  std::array<double, kArchBins> whole = values, out{};
  int before = -1;
  for (int bin = 0; bin < kArchBins; ++bin) {
    if (!is_known[static_cast<std::size_t>(bin)]) continue;
    for (int between = before + 1; between < bin; ++between) {
      const double share = before < 0 ? 1.0 : static_cast<double>(between - before) / (bin - before);
      const double low = before < 0 ? values[static_cast<std::size_t>(bin)] : values[static_cast<std::size_t>(before)];
      whole[static_cast<std::size_t>(between)] = low + share * (values[static_cast<std::size_t>(bin)] - low);
    }
    before = bin;
  }
  for (int bin = before + 1; bin < kArchBins && before >= 0; ++bin)
    whole[static_cast<std::size_t>(bin)] = values[static_cast<std::size_t>(before)];
  const int reach = static_cast<int>(4.0 * sigma + 0.5);
  for (int bin = 0; bin < kArchBins; ++bin) {
    double sum = 0.0, weights = 0.0;
    for (int d = -reach; d <= reach; ++d) {
      const double weight = std::exp(-0.5 * d * d / (sigma * sigma));
      sum += weight * whole[static_cast<std::size_t>(std::clamp(bin + d, 0, kArchBins - 1))];
      weights += weight;
    }
    out[static_cast<std::size_t>(bin)] = sum / weights;
  }
  return out;
}

/// Where the foremost twentieth of the row lies between its right (0) and left (1) end.
double frontShare(const std::vector<glm::dvec3>& row, double low_x, double high_x, std::vector<double> y) {
  const double front_y = percentileOf(std::move(y), 0.05);
  double sum = 0.0, count = 0.0;
  for (const glm::dvec3& p : row)
    if (p.y <= front_y) sum += p.x, count += 1.0;
  return (sum / count - low_x) / (high_x - low_x);
}

/// A row that bends back on both sides of its front has its middle there; of one side it is at that side's front end.
void placeCentre(const std::vector<glm::dvec3>& row, JawArch& arch) {
  std::vector<double> x, y;
  for (const glm::dvec3& p : row) x.push_back(p.x), y.push_back(p.y);
  arch.centre_P_mm.y = std::max(percentileOf(y, 0.97), percentileOf(y, 0.01) + kLeastDepth_mm);
  const double low = percentileOf(x, 0.01), high = percentileOf(x, 0.99);
  const double front = frontShare(row, low, high, y);
  arch.is_one_sided = high - low < kLeastWidth_mm || std::abs(front - 0.5) > kFrontInMiddle;
  arch.centre_P_mm.x = !arch.is_one_sided ? medianOf(x) : front > 0.5 ? high : low;
}

}  // namespace

double JawArch::angleOf(const glm::dvec3& p_P_mm) const {
  return std::atan2(p_P_mm.x - centre_P_mm.x, centre_P_mm.y - p_P_mm.y);
}

int JawArch::binOf(double angle_rad) {
  const double share = 0.5 * (angle_rad / kArchEnd_rad + 1.0);
  return std::clamp(static_cast<int>(std::floor(share * kArchBins)), 0, kArchBins - 1);
}

double JawArch::outside_mm(const glm::dvec3& p_P_mm) const {
  return glm::distance(glm::dvec2(p_P_mm), centre_P_mm) - radius_mm[static_cast<std::size_t>(binOf(angleOf(p_P_mm)))];
}

glm::dvec2 JawArch::pointAt(int bin, double outside_mm) const {
  const double angle = angleAt(bin), from_centre_mm = radius_mm[static_cast<std::size_t>(bin)] + outside_mm;
  return centre_P_mm + from_centre_mm * glm::dvec2(std::sin(angle), -std::cos(angle));
}

std::optional<JawArch> findJawArch(const VolumeGrid& cells, const std::vector<float>& smooth_hu) {
  JawArch arch;
  arch.dense = denseRow(cells, smooth_hu);
  std::vector<glm::dvec3> row;
  forVoxels(cells, [&](glm::ivec3 ijk, std::size_t n) {
    if (arch.dense[n] != 0) row.push_back(cells.centre_P_mm(ijk));
  });
  if (static_cast<double>(row.size()) * cells.voxelVolume_mm3() < kLeastRow_mm3) return std::nullopt;

  // Teeth lie in one plane; other dense tissue may not.
  std::vector<double> heights;
  for (const glm::dvec3& p : row) heights.push_back(p.z);
  const double middle = medianOf(std::move(heights));
  std::erase_if(row, [middle](const glm::dvec3& p) { return std::abs(p.z - middle) >= kHalfSlab_mm; });
  placeCentre(row, arch);

  std::array<std::vector<double>, kArchBins> radii, z;
  for (const glm::dvec3& p : row) {
    const double angle = arch.angleOf(p);
    if (std::abs(angle) > kArchEnd_rad) continue;
    const auto bin = static_cast<std::size_t>(JawArch::binOf(angle));
    radii[bin].push_back(glm::distance(glm::dvec2(p), arch.centre_P_mm));
    z[bin].push_back(p.z);
  }
  std::array<double, kArchBins> radius_mm{}, z_mm{};
  for (std::size_t bin = 0; bin < kArchBins; ++bin) {
    arch.has_teeth[bin] = radii[bin].size() > kLeastCells;
    if (arch.has_teeth[bin]) radius_mm[bin] = medianOf(radii[bin]), z_mm[bin] = medianOf(z[bin]);
  }
  if (std::ranges::none_of(arch.has_teeth, [](bool has) { return has; })) return std::nullopt;
  arch.radius_mm = smoothed(radius_mm, arch.has_teeth, 2.0);
  arch.dense_z_P_mm = smoothed(z_mm, arch.has_teeth, 4.0);
  return arch;
}

}  // namespace assets
