#include "assets/import/tooth_volume.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "assets/import/density_tissue.h"
#include "assets/import/upright_tooth.h"
#include "assets/load_error.h"
#include "assets/scan/image_file.h"
#include "assets/scan/image_header.h"
#include "assets/tooth.h"

namespace assets {
namespace {

constexpr std::uint64_t kMostVoxels = std::uint64_t{64} << 20;
constexpr int kLeastVoxels = 16;                         ///< along every axis
constexpr double kFinest_mm = 0.02, kCoarsest_mm = 0.5;  ///< edges of voxels
constexpr double kLeastTooth_mm3 = 40.0, kMostTooth_mm3 = 3000.0;
constexpr double kShortest_mm = 5.0, kLongest_mm = 40.0;     ///< crown and root
constexpr double kLeastOnLevels = 0.5;                       ///< of the voxels that are not air
constexpr double kLeastEnamel = 0.01, kLeastDentine = 0.05;  ///< of the same
constexpr double kLeastPulp_mm3 = 0.2;
constexpr double kMargin_mm = 1.0;

std::string fixed(double value, int digits) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(digits);
  text << value;
  return text.str();
}
std::string percent(double share) { return fixed(100.0 * share, share < 0.1 ? 1 : 0) + " %"; }

struct Judge {
  const std::string& name;
  const ToothVolumeOptions& options;

  [[noreturn]] void refuse(const std::string& why) const { throw LoadError(name + ": " + why); }

  void header(const ImageHeader& of) const {
    if (of.type != VoxelType::uint8 || of.isRescaled())
      refuse("its values are not plain bytes; a tooth's densities are written as uint8, 0 to 255");
    const glm::ivec3 size = of.geometry.size;
    if (of.voxelCount() > kMostVoxels)
      refuse("it has " + std::to_string(of.voxelCount() >> 20) + " million voxels, more than " +
             std::to_string(kMostVoxels >> 20) + ": give one tooth alone");
    if (std::min({size.x, size.y, size.z}) < kLeastVoxels)
      refuse("it is " + std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z) +
             " voxels, a tooth needs " + std::to_string(kLeastVoxels) + " along every axis");
  }

  void grid(const VolumeGrid& grid) const {
    if (!(grid.spacing_mm >= kFinest_mm && grid.spacing_mm <= kCoarsest_mm))
      refuse("its voxels are " + fixed(grid.spacing_mm, 3) + " mm wide, those of a tooth " + fixed(kFinest_mm, 2) +
             " to " + fixed(kCoarsest_mm, 1) + " mm; check the spacing in its header");
    if (grid.voxelCount() > kMostVoxels)
      refuse("with cubic voxels of " + fixed(grid.spacing_mm, 3) + " mm it has more than " +
             std::to_string(kMostVoxels >> 20) + " million voxels: give one tooth alone");
  }

  /// What the values are, in words for people.
  std::string levels(const std::array<std::size_t, 256>& count) const {
    const ToothLevels& level = options.levels;
    const std::size_t all = std::accumulate(count.begin(), count.end(), std::size_t{0});
    const auto values = std::ranges::count_if(count, [](std::size_t n) { return n > 0; });
    if (values < 2) {
      const auto only = std::ranges::find_if(count, [](std::size_t n) { return n > 0; }) - count.begin();
      refuse("every voxel is " + std::to_string(only) + ": it shows no tooth");
    }
    std::array<std::size_t, 4> on{};
    for (std::size_t value = 0; value < count.size(); ++value)
      for (std::size_t n = 0; n < level.size(); ++n)
        if (std::abs(static_cast<int>(value) - level[n]) <= kOnLevel) on[n] += count[value];
    const std::string wanted = "air " + std::to_string(level[0]) + ", pulp " + std::to_string(level[1]) + ", dentine " +
                               std::to_string(level[2]) + ", enamel " + std::to_string(level[3]);
    const std::string way_out = "; --levels AIR,PULP,DENTINE,ENAMEL names others";
    if (on[0] == 0) refuse("no voxel is air (" + std::to_string(level[0]) + "): it shows no whole tooth" + way_out);
    const auto matter = static_cast<double>(all - on[0]);
    if (matter == 0.0) refuse("all of it is air (" + std::to_string(level[0]) + "): it shows no tooth" + way_out);
    const auto share = [&](std::size_t n) { return static_cast<double>(on[n]) / matter; };
    const double on_levels = share(1) + share(2) + share(3);
    if (on_levels < kLeastOnLevels)
      refuse("its values are no density levels (" + wanted + "): " + percent(on_levels) + " of what is no air has one" +
             way_out);
    if (share(3) < kLeastEnamel)
      refuse("hardly any of it is enamel (" + std::to_string(level[3]) + "): where its crown is cannot be told" +
             way_out);
    if (share(2) < kLeastDentine) refuse("hardly any of it is dentine (" + std::to_string(level[2]) + ")" + way_out);
    return "levels judged by their voxels: " + wanted + "; of what is no air pulp " + percent(share(1)) + ", dentine " +
           percent(share(2)) + ", enamel " + percent(share(3)) + ", between them " +
           percent(std::max(0.0, 1.0 - on_levels));
  }

  void size(const CtVolume& ct) const {
    glm::ivec3 low(ct.grid.size), high(-1);
    std::size_t voxels = 0;
    forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (ct.label[v] == 0) return;
      low = glm::min(low, ijk), high = glm::max(high, ijk);
      ++voxels;
    });
    const double mm3 = static_cast<double>(voxels) * ct.grid.voxelVolume_mm3();
    const glm::ivec3 size = high - low + 1;
    const double long_mm = ct.grid.spacing_mm * std::max({size.x, size.y, size.z});
    if (mm3 < kLeastTooth_mm3 || mm3 > kMostTooth_mm3 || long_mm < kShortest_mm || long_mm > kLongest_mm)
      refuse("it would be a tooth of " + fixed(mm3, 0) + " mm3 and " + fixed(long_mm, 1) + " mm length, teeth have " +
             fixed(kLeastTooth_mm3, 0) + " to " + fixed(kMostTooth_mm3, 0) + " mm3 and " + fixed(kShortest_mm, 0) +
             " to " + fixed(kLongest_mm, 0) + " mm; check the spacing in its header");
  }
};

/// Cut to the tooth and a margin of air, which may lie beyond what the file holds.
void pad(VolumeGrid& grid, std::vector<std::uint8_t>& density, int air) {
  glm::ivec3 low(grid.size), high(-1);
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (density[v] <= air + kOnLevel) return;
    low = glm::min(low, ijk), high = glm::max(high, ijk);
  });
  const int margin = static_cast<int>(std::ceil(kMargin_mm / grid.spacing_mm));
  const VolumeGrid padded{high - low + 1 + 2 * margin, grid.spacing_mm, grid.centre_P_mm(low - margin)};
  std::vector<std::uint8_t> within(padded.voxelCount(), static_cast<std::uint8_t>(air));
  forVoxels(low, high + 1,
            [&](glm::ivec3 ijk) { within[padded.index(ijk - low + margin)] = density[grid.index(ijk)]; });
  grid = padded, density = std::move(within);
}

}  // namespace

ToothVolume toothVolume(VolumeGrid grid, std::vector<std::uint8_t> density, const ToothVolumeOptions& options,
                        const std::string& name) {
  const Judge judge{name, options};
  judge.grid(grid);
  ToothVolume tooth;
  std::array<std::size_t, 256> count{};
  for (const std::uint8_t value : density) ++count[value];
  tooth.remarks.push_back(judge.levels(count));
  pad(grid, density, options.levels[0]);

  const DensityTissue tissue = densityTissue(grid, density, options.levels);
  if (tissue.largest_share < 0.95)
    judge.refuse("it holds several pieces, the largest " + percent(tissue.largest_share) +
                 " of all: give one tooth alone");
  if (tissue.largest_share < 1.0)
    tooth.remarks.push_back("specks beside the tooth were left out, " + percent(1.0 - tissue.largest_share) + " of it");
  tooth.ct.grid = grid;
  tooth.ct.label = tissue.label, tooth.ct.solid = tissue.solid;

  judge.size(tooth.ct);

  // Which end is the crown.
  const CrownSide crown = crownSide(tooth.ct);
  if (!crown.is_plain) judge.refuse("enamel and pulp do not say which of its ends is the crown");
  const int up = isUpper(options.fdi) ? -1 : 1;
  const std::string wanted = std::string(isUpper(options.fdi) ? "an upper" : "a lower") + " tooth's points " +
                             (up > 0 ? "up (+z)" : "down (-z)");
  if (crown.axis != 2 || crown.sign != up) {
    const std::string stands = crown.axis == 2 ? "stands upside down" : "lies on its side";
    const std::string points = std::string("its crown points to ") + (crown.sign > 0 ? "+" : "-") + "xyz"[crown.axis];
    if (!options.turns_upright)
      judge.refuse("the tooth " + stands + ": " + points + ", " + wanted +
                   "; turn the file, let --upright turn it, or name another tooth by --tooth-number");
    turnUpright(tooth.ct, crown, up);
    tooth.remarks.push_back("the tooth " + (crown.axis == 2 ? std::string("stood upside down") : "lay on its side") +
                            " and was turned: " + points + ", " + wanted +
                            "; the file of an ideal has to be turned alike");
  }
  numberSingleTooth(tooth.ct, options.fdi);
  const auto pulp = std::ranges::count(tooth.ct.label, static_cast<std::uint8_t>(Tissue::pulp));
  tooth.has_pulp = static_cast<double>(pulp) * grid.voxelVolume_mm3() >= kLeastPulp_mm3;
  if (!tooth.has_pulp) tooth.remarks.push_back("it has no pulp: its root canals cannot be treated");
  tooth.ct.hounsfield.resize(tooth.ct.solid.size());
  constexpr double kAir_HU = -1000.0;
  for (std::size_t v = 0; v < tooth.ct.solid.size(); ++v)
    tooth.ct.hounsfield[v] = static_cast<std::int16_t>(kAir_HU + (properties(tooth.ct.label[v]).hounsfield - kAir_HU) *
                                                                     tooth.ct.solid[v] / 255.0);
  return tooth;
}

ToothVolume readToothVolume(const std::string& path, const ToothVolumeOptions& options) {
  const Judge judge{path, options};
  const ImageHeader header = readImageHeader(path);
  judge.header(header);
  ByteImage image = readSolid(path);
  ToothVolume tooth = toothVolume(image.grid, std::move(image.values), options, path);
  if (!header.orientation_known)
    tooth.remarks.emplace_back("the file states no orientation; assumed LPS (left-posterior-superior)");
  return tooth;
}

}  // namespace assets
