#include "assets/synthetic/jaw.h"

#include <tbb/blocked_range3d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <sstream>
#include <string_view>

#include "assets/load_error.h"
#include "assets/scan/solid_fraction.h"
#include "assets/synthetic/jaw_anatomy.h"
#include "assets/synthetic/scanner.h"

namespace assets {
namespace {

// Scanned box in J, with 3 mm of air around bone and gingiva.
constexpr BoundingBox kScanBox{{4.0, 0.5, -43.25}, {49.3, 71.0, 14.25}};

void require(bool fine, std::string_view what, double value, std::string_view range) {
  if (fine) return;
  std::ostringstream line;
  line << "synthetic jaw: " << what << ' ' << value << " is out of range; give " << range;
  throw LoadError(line.str());
}

void validate(const JawParameters& p) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  require(within(p.winter_angle_deg, -79.0, 100.0), "Winter angle in degrees", p.winter_angle_deg, "-79 to 100");
  require(within(p.depth_mm, 0.0, 12.0), "depth in mm", p.depth_mm, "0 to 12");
  require(within(p.mandibular_canal_distance_mm, 0.0, 6.0), "canal distance in mm", p.mandibular_canal_distance_mm,
          "0 to 6");
  require(within(p.spacing_mm, 0.15, 1.0), "voxel size in mm", p.spacing_mm, "0.15 to 1");
  require(within(p.opening_mm, kLeastOpening_mm, kMostOpening_mm), "opening of the mouth in mm", p.opening_mm,
          "25 to 50");
}

std::string_view winterClass(double angle_deg) {
  if (angle_deg <= -10.5) return "disto-angular";
  if (angle_deg < 10.5) return "vertical";
  return angle_deg < 79.5 ? "mesio-angular" : "horizontal";
}

std::string titleOf(const JawParameters& p) {
  std::ostringstream title;
  title << "built-in patient, " << (p.right_side ? "right" : "left") << ", " << winterClass(p.winter_angle_deg) << ' '
        << std::lround(p.winter_angle_deg) << "°";
  return title.str();
}

/// J to P and back: the right side is mirrored.
glm::dvec3 mirrored(const glm::dvec3& v, bool right_side) { return {right_side ? -v.x : v.x, v.y, v.z}; }

VolumeGrid gridOf(const JawParameters& p) {
  VolumeGrid grid;
  grid.spacing_mm = p.spacing_mm;
  grid.size = glm::ivec3(glm::ceil((kScanBox.high_mm - kScanBox.low_mm) / p.spacing_mm));
  const double width_mm = p.spacing_mm * (grid.size.x - 1);
  grid.origin_P_mm = kScanBox.low_mm;
  if (p.right_side) grid.origin_P_mm.x = -(kScanBox.low_mm.x + width_mm);
  return grid;
}

/// Scans brick by brick; bricks without tissue get air and noise.
void scan(const JawAnatomy& anatomy, const JawParameters& p, CtVolume& ct, const ReportProgress& report) {
  const glm::ivec3 size = ct.grid.size;
  const double edge_mm = edgeSpread_mm(p.spacing_mm);
  const TrabecularTexture texture(p.seed + 100, edge_mm);
  const double air_hu = properties(0).hounsfield;
  const double brick_radius_mm = 0.5 * std::sqrt(3.0) * kBrickVoxels * p.spacing_mm;

  const auto scan_brick = [&](glm::ivec3 brick) {
    const glm::ivec3 low = brick * kBrickVoxels, high = glm::min(low + kBrickVoxels, size);
    const glm::dvec3 middle_J =
        kScanBox.low_mm + p.spacing_mm * (glm::dvec3(low) + 0.5 * static_cast<double>(kBrickVoxels - 1));
    const NearbyStructures nearby = anatomy.nearby(middle_J, brick_radius_mm);
    std::array<ArchLine, kBrickVoxels * kBrickVoxels> lines;
    for (int k = low.z; k < high.z; ++k)
      for (int j = low.y; j < high.y; ++j)
        for (int i = low.x; i < high.x; ++i) {
          // Noise is a function of the index in J, so that both sides are exact mirror images.
          const std::uint64_t index = (static_cast<std::uint64_t>(k) << 42) | (static_cast<std::uint64_t>(j) << 21) |
                                      static_cast<std::uint64_t>(i);
          double grey_hu = air_hu;
          const std::size_t voxel = ct.grid.index({p.right_side ? size.x - 1 - i : i, j, k});
          if (nearby.any) {
            const glm::dvec3 p_J = kScanBox.low_mm + p.spacing_mm * glm::dvec3(i, j, k);
            ArchLine& line = lines[static_cast<std::size_t>((j - low.y) * kBrickVoxels + i - low.x)];
            const TissueDistances distances = anatomy.at(p_J, nearby, line);
            const Tissue tissue = tissueAt(distances);
            ct.label[voxel] = static_cast<std::uint8_t>(tissue);
            if (const int position = toothAt(distances, tissue))
              ct.tooth[voxel] = static_cast<std::uint8_t>((p.right_side ? 40 : 30) + position);
            grey_hu = greyValue_hu(distances, p_J, texture, edge_mm);
          }
          ct.hounsfield[voxel] = static_cast<std::int16_t>(std::lround(grey_hu + scannerNoise_hu(p.seed, index)));
        }
  };

  const glm::ivec3 bricks = ct.grid.bricks();
  std::atomic<int> done{0};
  tbb::parallel_for(tbb::blocked_range3d<int>(0, bricks.z, 0, bricks.y, 0, bricks.x), [&](const auto& range) {
    for (int z = range.pages().begin(); z < range.pages().end(); ++z)
      for (int y = range.rows().begin(); y < range.rows().end(); ++y)
        for (int x = range.cols().begin(); x < range.cols().end(); ++x) {
          scan_brick({x, y, z});
          if (report) report(static_cast<double>(++done) / (bricks.x * bricks.y * bricks.z));
        }
  });
}

/// None if the third molar has no voxel.
std::optional<OperativeSite> siteOf(const CtVolume& ct, const JawAnatomy& anatomy, bool right_side) {
  const auto [count, sum] = voxelSum(ct.grid, [&](std::size_t voxel) {
    const auto tissue = static_cast<Tissue>(ct.label[voxel]);
    return tissue == Tissue::enamel || tissue == Tissue::dentine;
  });
  if (count == 0.0) return std::nullopt;
  return OperativeSite{right_side ? 48 : 38, ct.grid.origin_P_mm + ct.grid.spacing_mm * sum / count,
                       mirrored(anatomy.thirdMolar().axes_J[2], right_side)};
}

}  // namespace

Patient syntheticJaw(const JawParameters& parameters, const ReportProgress& report) {
  validate(parameters);
  const JawAnatomy anatomy(parameters);

  Patient patient;
  patient.title = titleOf(parameters);
  patient.ct.grid = gridOf(parameters);
  patient.ct.hounsfield.resize(patient.ct.grid.voxelCount());
  patient.ct.label.resize(patient.ct.grid.voxelCount());
  patient.ct.tooth.resize(patient.ct.grid.voxelCount());
  scan(anatomy, parameters, patient.ct, report);
  patient.ct.solid = classify(patient.ct.grid, patient.ct.hounsfield, patient.classification);

  patient.site = siteOf(patient.ct, anatomy, parameters.right_side);
  patient.mandibular_canal_radius_mm = MandibularCanalPath::kRadius_mm;
  // The line ends with the bone: at the mental foramen and at the posterior cut.
  for (const glm::dvec3& p_J : anatomy.mandibularCanal().points_J_mm())
    if (anatomy.at(p_J, anatomy.nearby(p_J, 0.0)).mandibular_canal < -0.5)
      patient.mandibular_canal_P_mm.push_back(mirrored(p_J, parameters.right_side));
  return patient;
}

}  // namespace assets
