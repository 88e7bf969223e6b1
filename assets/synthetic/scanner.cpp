#include "assets/synthetic/scanner.h"

#include <algorithm>
#include <cmath>

namespace assets {
namespace {

double meanOf(Tissue tissue) { return properties(static_cast<std::uint8_t>(tissue)).hounsfield; }

/// Share of the blurred voxel inside a surface at this distance.
double coverage(double distance_mm, double edge_spread_mm) {
  const double reach = distance_mm / edge_spread_mm;
  if (reach > 4.0) return 0.0;
  if (reach < -4.0) return 1.0;
  return 0.5 * std::erfc(reach / std::sqrt(2.0));
}

}  // namespace

double edgeSpread_mm(double spacing_mm) {
  return std::sqrt(kPointSpread_mm * kPointSpread_mm + spacing_mm * spacing_mm / 12.0);
}

Tissue tissueAt(const TissueDistances& d) {
  if (d.third_molar.pulp < 0.0) return Tissue::pulp;
  if (d.third_molar.core < 0.0) return Tissue::dentine;
  if (d.third_molar.outer < 0.0) return Tissue::enamel;
  if (d.other_tooth.outer < 0.0) return Tissue::other_teeth;
  if (d.ligament < 0.0) return Tissue::ligament;
  if (d.mandibular_canal < 0.0) return Tissue::mandibular_canal;
  if (d.trabecular < 0.0) return Tissue::trabecular;
  if (d.bone < 0.0) return Tissue::cortical;
  if (d.gingiva < 0.0) return Tissue::gingiva;
  return Tissue::unlabelled;
}

int toothAt(const TissueDistances& d, Tissue tissue) {
  switch (tissue) {
    case Tissue::enamel:
    case Tissue::dentine:
    case Tissue::pulp:
      return 8;
    case Tissue::other_teeth:
      return d.other_position;
    default:
      return 0;
  }
}

double greyValue_hu(const TissueDistances& d, const glm::dvec3& p_J, const TrabecularTexture& texture,
                    double edge_spread_mm) {
  double filled = 0.0, sum_hu = 0.0;
  // An enclosing surface adds only its rim.
  const auto enclose = [&](double distance_mm, double hounsfield) {
    const double share = coverage(distance_mm, edge_spread_mm) - filled;
    if (share <= 0.0) return;
    sum_hu += share * hounsfield;
    filled += share;
  };
  enclose(d.third_molar.pulp, meanOf(Tissue::pulp));
  enclose(d.third_molar.core, meanOf(Tissue::dentine));
  enclose(d.third_molar.outer, meanOf(Tissue::enamel));
  enclose(d.other_tooth.pulp, meanOf(Tissue::pulp));
  enclose(d.other_tooth.core, meanOf(Tissue::dentine));
  enclose(d.other_tooth.outer, meanOf(Tissue::enamel));
  enclose(d.ligament, meanOf(Tissue::ligament));

  // Canal and trabecular bone lie next to the teeth, not around them: their shares add.
  const auto adjoin = [&](double distance_mm, double hounsfield) {
    const double share = std::min(coverage(distance_mm, edge_spread_mm), 1.0 - filled);
    sum_hu += share * hounsfield;
    filled += share;
  };
  adjoin(d.mandibular_canal, meanOf(Tissue::mandibular_canal));
  if (d.trabecular < 4.0 * edge_spread_mm) adjoin(d.trabecular, texture.hounsfield(p_J));
  enclose(d.bone, meanOf(Tissue::cortical));
  enclose(d.gingiva, meanOf(Tissue::gingiva));
  return sum_hu + (1.0 - filled) * meanOf(Tissue::unlabelled);
}

double scannerNoise_hu(std::uint64_t seed, std::uint64_t voxel) {
  // Sum of eight uniform 16-bit parts of two hashes, close to Gaussian up to four sd.
  const std::uint64_t first = mixBits(seed * 0x9e3779b97f4a7c15ull + voxel), second = mixBits(first);
  double sum = 0.0;
  for (int part = 0; part < 4; ++part) {
    sum += static_cast<double>(first >> (16 * part) & 0xffffu);
    sum += static_cast<double>(second >> (16 * part) & 0xffffu);
  }
  const double centred = sum / 65536.0 - 4.0 + 4.0 / 65536.0;
  return kScannerNoise_hu * centred * std::sqrt(12.0 / 8.0);
}

}  // namespace assets
