#include "app/procedure/preparation/given_ideal.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/core.h>

#include "app/procedure/preparation/cavity_form.h"
#include "app/procedure/preparation/margin_line.h"
#include "app/text/usage_error.h"
#include "assets/ct_volume.h"
#include "assets/load_error.h"
#include "assets/mesh/mesh_solid.h"
#include "assets/scan/image_file.h"
#include "assets/trilinear.h"
#include "calibration/record/sha256.h"

namespace app {
namespace {

constexpr double kLeastTaken_mm3 = 1.0, kMostOutside_mm3 = 0.5;
constexpr double kLeastOverlap = 0.2;  ///< of the crown
constexpr double kAllAround = 0.75;    ///< of the directions: a crown
constexpr double kFromBelow_mm = 1.0, kMarginHigh_mm = 0.4, kOverShelf_mm = 1.0, kNearTop_mm = 0.6;
constexpr int kSkin = 2;  ///< voxels between the surfaces of the file and of the tooth
constexpr auto kNeighbour = static_cast<std::uint8_t>(assets::Tissue::other_teeth);

bool endsIn(const std::string& name, std::string_view extension) {
  if (name.size() < extension.size()) return false;
  return std::equal(extension.rbegin(), extension.rend(), name.rbegin(),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

std::string digestOf(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return calibration::sha256Of(bytes.str());
}

BoxBytes ofVolume(const std::string& path, const assets::VolumeGrid& grid) {
  assets::ByteImage image = assets::readSolid(path);
  if (*std::ranges::max_element(image.values) <= 1)
    for (std::uint8_t& value : image.values) value = static_cast<std::uint8_t>(255 * value);
  BoxBytes left(grid);
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double share = assets::trilinearAt(image.grid, grid.centre_P_mm(ijk), [&](glm::ivec3 at) {
      return image.grid.contains(at) ? static_cast<double>(image.values[image.grid.index(at)]) : 0.0;
    });
    left.bytes()[v] = static_cast<std::uint8_t>(share + 0.5);
  });
  return left;
}

BoxBytes ofMesh(const std::string& path, const assets::VolumeGrid& grid) {
  const std::vector<assets::StlTriangle> mesh = assets::readStl(path);
  if (const std::size_t open = assets::openEdges(mesh); open > 0)
    throw assets::LoadError(fmt::format(
        "{}: its surface is not closed, {} of its edges have a face on one side alone: close it first", path, open));
  BoxBytes left(grid);
  try {
    std::ranges::copy(assets::solidOfMesh(mesh, grid), left.bytes().begin());
  } catch (const assets::LoadError& error) {
    throw assets::LoadError(path + ": " + error.what());
  }
  return left;
}

/// Voxels of a box near a chosen one: within `reach` along every axis.
std::vector<std::uint8_t> grown(const assets::VolumeGrid& grid, std::vector<std::uint8_t> chosen, int reach) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::uint8_t> wider = chosen;
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (chosen[v] == 0) return;
      for (int n = -reach; n <= reach; ++n) {
        glm::ivec3 at = ijk;
        at[axis] += n;
        if (grid.contains(at)) wider[grid.index(at)] = 1;
      }
    });
    chosen = std::move(wider);
  }
  return chosen;
}

/// Where a file's tooth ends towards the root: below it nothing is known.
double endOf_mm(const Crown& crown, const BoxBytes& left) {
  double lowest_mm = crown.top_mm;
  assets::forVoxels(left.grid(), [&](glm::ivec3 ijk, std::size_t v) {
    if (left.bytes()[v] >= 128) lowest_mm = std::min(lowest_mm, crown.frame.local(left.grid().centre_P_mm(ijk)).z);
  });
  return lowest_mm + kSkin * left.grid().spacing_mm;
}

/// Where the ideal takes: thicker than a skin, and all that hangs on to that.
std::vector<std::uint8_t> takenFrom(const Crown& crown, const BoxBytes& left) {
  const assets::VolumeGrid& grid = left.grid();
  std::vector<std::uint8_t> stays(grid.voxelCount());
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    stays[v] = crown.isTooth(ijk) && crown.solid.bytes()[v] - left.bytes()[v] >= 128 ? 0 : 1;
  });
  // A place in the air beside takes nothing and does not make the ideal thinner there.
  assets::forVoxels(grid, [&](glm::ivec3, std::size_t v) {
    if (crown.solid.bytes()[v] < 128 && crown.label.bytes()[v] != kNeighbour) stays[v] = 0;
  });
  const std::vector<std::uint8_t> kept = grown(grid, std::move(stays), kSkin);
  std::vector<std::uint8_t> deep(grid.voxelCount());
  for (std::size_t v = 0; v < deep.size(); ++v)
    deep[v] = kept[v] == 0 && crown.solid.bytes()[v] >= 128 && left.bytes()[v] < 128 ? 1 : 0;
  return grown(grid, std::move(deep), kSkin + 1);
}

void refuseMisplaced(const Crown& crown, const BoxBytes& left, const std::string& option) {
  const assets::VolumeGrid& grid = left.grid();
  assets::VoxelSum tooth, ideal, both;
  std::vector<std::uint8_t> is_solid(grid.voxelCount());
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const bool of_tooth = crown.isTooth(ijk), of_ideal = left.bytes()[v] >= 128;
    const auto add = [&](assets::VoxelSum& sum) { sum.count += 1.0, sum.sum += glm::dvec3(ijk); };
    if (of_tooth) add(tooth);
    if (of_ideal) add(ideal);
    if (of_tooth && of_ideal) add(both);
    is_solid[v] = of_tooth || crown.solid.bytes()[v] >= 128 ? 1 : 0;
  });
  if (both.count < kLeastOverlap * tooth.count) {
    if (ideal.count == 0.0)
      throw UsageError(option +
                       ": it stands beside the tooth, nothing of it lies in the crown; give it in the patient's "
                       "frame, mm, as the tooth stands");
    throw UsageError(
        fmt::format("{}: it stands beside the tooth, {:.0f} % of the crown lie in it and its middle is {:.1f} mm off; "
                    "give it in the "
                    "patient's frame, mm, as the tooth stands",
                    option, 100.0 * both.count / tooth.count,
                    grid.spacing_mm * glm::distance(ideal.sum / ideal.count, tooth.sum / std::max(1.0, tooth.count))));
  }
  const std::vector<std::uint8_t> near = grown(grid, std::move(is_solid), kSkin);
  double outside = 0.0;
  for (std::size_t v = 0; v < near.size(); ++v) outside += near[v] == 0 && left.bytes()[v] >= 128 ? 1.0 : 0.0;
  if (outside * grid.voxelVolume_mm3() > kMostOutside_mm3)
    throw UsageError(
        fmt::format("{}: it is bigger than the tooth, {:.1f} mm3 of it lie outside; a preparation only takes", option,
                    outside * grid.voxelVolume_mm3()));
}

}  // namespace

bool isIdealFile(const std::string& name) { return endsIn(name, ".nrrd") || endsIn(name, ".stl"); }

assets::GivenIdeal givenIdeal(BoxBytes left, const Crown& crown, std::string digest, const std::string& option) {
  refuseMisplaced(crown, left, option);
  const std::vector<std::uint8_t> taken = takenFrom(crown, left);
  const assets::VolumeGrid& grid = left.grid();
  const double end_mm = endOf_mm(crown, left);
  double taken_mm3 = 0.0;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const std::uint8_t had = crown.solid.bytes()[v];
    std::uint8_t& byte = left.bytes()[v];
    const bool takes =
        taken[v] != 0 && crown.label.bytes()[v] != kNeighbour && crown.frame.local(grid.centre_P_mm(ijk)).z > end_mm;
    byte = takes ? std::min(had, byte) : had;
    if (crown.isTooth(ijk)) taken_mm3 += (had - byte) / 255.0 * grid.voxelVolume_mm3();
  });
  if (taken_mm3 < kLeastTaken_mm3)
    throw UsageError(fmt::format("{}: it takes {:.1f} mm3 from the tooth, as good as nothing: give the prepared tooth",
                                 option, taken_mm3));
  return {std::move(digest), grid, {left.bytes().begin(), left.bytes().end()}};
}

assets::GivenIdeal readGivenIdeal(const std::string& path, const Crown& crown, const std::string& option) try {
  const assets::VolumeGrid& grid = crown.solid.grid();
  return givenIdeal(endsIn(path, ".stl") ? ofMesh(path, grid) : ofVolume(path, grid), crown, digestOf(path),
                    option + " " + path);
} catch (const assets::LoadError& error) {
  throw UsageError(option + " " + error.what());
}

GivenForm::GivenForm(const Crown& crown, const BoxBytes& ideal) : top_(crown, ideal) {
  rule_ = {.name = assets::kGivenIdeal, .for_people = "an ideal from a file", .kind = IdealKind::free};
  const StumpWalls before(crown, crown.solid, -kFromBelow_mm, crown.top_mm);
  const StumpWalls after(crown, ideal, -kFromBelow_mm, crown.top_mm);
  const auto heights_mm = marginHeights_mm(before, after);
  double sum_mm = 0.0, around = 0.0;
  for (const double height_mm : heights_mm)
    if (!std::isnan(height_mm)) sum_mm += height_mm, around += 1.0;
  if (around < kAllAround * static_cast<double>(heights_mm.size())) {
    if (const auto cavity = cavityRuleOf(crown, ideal)) rule_ = *cavity;
    return;
  }
  const WallForm walls = wallForm(after, heights_mm);
  const MarginLine margin = marginLine(before, heights_mm, walls, sum_mm / around);
  if (!std::isfinite(walls.convergence_rad) || !std::isfinite(margin.mean_mm)) return;
  rule_.kind = IdealKind::crown;
  rule_.margin_height_mm = sum_mm / around;
  rule_.margin_mm = margin.mean_mm;
  rule_.half_angle_rad = 0.5 * walls.convergence_rad;
}

PreparedZone GivenForm::zone(const glm::dvec3& p_mm) const {
  const bool is_crown = rule_.kind == IdealKind::crown;
  if (is_crown && p_mm.z < rule_.margin_height_mm + kMarginHigh_mm) return PreparedZone::margin;
  const double top_mm = top_.at({p_mm.x, p_mm.y});
  if (top_mm == static_cast<double>(OcclusalMap::kNone)) return PreparedZone::axial;
  // Over the shelf of a margin lies what a wall lost; over a floor, a wall beside it.
  if (is_crown)
    return top_mm > rule_.margin_height_mm + kOverShelf_mm && p_mm.z > top_mm - kNearTop_mm ? PreparedZone::occlusal
                                                                                            : PreparedZone::axial;
  return std::abs(p_mm.z - top_mm) < kNearTop_mm ? PreparedZone::occlusal : PreparedZone::axial;
}

}  // namespace app
