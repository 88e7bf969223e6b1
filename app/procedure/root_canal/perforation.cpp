#include "app/procedure/root_canal/perforation.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

#include "assets/tissue.h"

namespace app {
namespace {

constexpr std::uint8_t kHalf = 128;
constexpr double kCervix_mm = 0.0;       ///< of the tooth's frame: above it a hole is the way in
constexpr double kApexReach_mm = 1.0;    ///< around a foramen
constexpr double kAccessReach_mm = 1.0;  ///< down a canal: above it belongs to the access
constexpr int kTogether_voxels = 2;      ///< faces that near are one hole

constexpr std::array<glm::ivec3, 6> kBeside{glm::ivec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},
                                            {0, -1, 0},          {0, 0, 1},  {0, 0, -1}};

/// Bits of voxels, a word a block.
class VoxelSet {
 public:
  explicit VoxelSet(const assets::VolumeGrid& grid)
      : grid_(grid), blocks_(grid.size / 4), words_(assets::countIn(blocks_)) {}

  bool has(glm::ivec3 ijk) const { return grid_.contains(ijk) && (word(ijk) >> FineSolid::within(ijk) & 1u) != 0; }
  void add(glm::ivec3 ijk) { words_[assets::indexIn(blocks_, ijk / 4)] |= std::uint64_t{1} << FineSolid::within(ijk); }

 private:
  std::uint64_t word(glm::ivec3 ijk) const { return words_[assets::indexIn(blocks_, ijk / 4)]; }

  assets::VolumeGrid grid_;
  glm::ivec3 blocks_;
  std::vector<std::uint64_t> words_;
};

struct OpenVoxel {
  glm::ivec3 ijk;
  glm::dvec3 outward{0.0};  ///< sum of its open faces, in voxels
};

/// Voxels of the tooth's air that border on what is not the tooth and were solid.
std::vector<OpenVoxel> openVoxels(const ToothBlocks& before, const FineSolid& after, const assets::ToothFrame& frame) {
  const assets::VolumeGrid& grid = before.grid();
  VoxelSet air(grid), seen(grid);
  std::vector<glm::ivec3> front;
  assets::forVoxels(glm::ivec3(0), grid.size / 4, [&](glm::ivec3 block) {
    const FineSolid::Block label = before.labels(block), solid = after.block(block);
    if (label.bytes == nullptr && !assets::isToothPart(label.same)) return;
    if (solid.bytes == nullptr && solid.same >= kHalf) return;
    std::size_t v = 0;
    assets::forVoxels(4 * block, 4 * block + 4, [&](glm::ivec3 ijk) {
      const std::uint8_t tissue = label.at(v), w = solid.at(v);
      ++v;
      if (!assets::isToothPart(tissue) || w >= kHalf) return;
      air.add(ijk);
      if (assets::Tissue{tissue} != assets::Tissue::pulp) return;
      seen.add(ijk);
      front.push_back(ijk);
    });
  });

  std::vector<OpenVoxel> open;
  while (!front.empty()) {
    const glm::ivec3 ijk = front.back();
    front.pop_back();
    OpenVoxel voxel{ijk};
    for (const glm::ivec3& way : kBeside) {
      const glm::ivec3 next = ijk + way;
      if (!grid.contains(next)) continue;
      if (air.has(next)) {
        if (seen.has(next)) continue;
        seen.add(next);
        front.push_back(next);
      } else if (!assets::isToothPart(before.label(next))) {
        voxel.outward += glm::dvec3(way);
      }
    }
    if (voxel.outward == glm::dvec3(0.0) || before.voxel(ijk) < kHalf) continue;
    if (frame.local(grid.centre_P_mm(ijk)).z < kCervix_mm) open.push_back(voxel);
  }
  return open;
}

PerforationKind kindOf(const assets::ToothCanals& tooth, const glm::dvec3& p_P) {
  double least_mm = std::numeric_limits<double>::max(), along_mm = 0.0;
  for (const assets::ToothCanal& canal : tooth.canals) {
    if (glm::distance(p_P, canal.foramen_P_mm()) < kApexReach_mm) return PerforationKind::apex;
    for (const assets::CanalPlace& place : canal.places)
      if (const double mm = glm::distance(p_P, place.p_P_mm); mm < least_mm) least_mm = mm, along_mm = place.along_mm;
  }
  return along_mm < kAccessReach_mm ? PerforationKind::access : PerforationKind::strip;
}

}  // namespace

std::string_view nameOf(PerforationKind kind) {
  constexpr std::array<std::string_view, 3> kNames{"access", "strip", "apex"};
  return kNames[static_cast<std::size_t>(kind)];
}

bool mayBePerforated(const ToothBlocks& before, const FineSolid& after, const assets::ToothFrame& frame,
                     glm::ivec3 block) {
  const assets::VolumeGrid& grid = before.grid();
  const FineSolid::Block label = before.labels(block), was = before.block(block), is = after.block(block);
  bool may = false;
  std::size_t v = 0;
  assets::forVoxels(4 * block, 4 * block + 4, [&](glm::ivec3 ijk) {
    const std::size_t at = v++;
    if (may || !assets::isToothPart(label.at(at)) || was.at(at) < kHalf || is.at(at) >= kHalf) return;
    if (!(frame.local(grid.centre_P_mm(ijk)).z < kCervix_mm)) return;
    for (const glm::ivec3& way : kBeside)
      may = may || (grid.contains(ijk + way) && !assets::isToothPart(before.label(ijk + way)));
  });
  return may;
}

std::vector<Perforation> perforations(const ToothBlocks& before, const FineSolid& after,
                                      const assets::ToothCanals& tooth) {
  const assets::VolumeGrid& grid = before.grid();
  const std::vector<OpenVoxel> open = openVoxels(before, after, tooth.frame);
  std::unordered_map<std::size_t, std::size_t> at;  // of each, by its voxel
  for (std::size_t n = 0; n < open.size(); ++n) at.emplace(grid.index(open[n].ijk), n);

  std::vector<Perforation> holes;
  std::vector<bool> counted(open.size());
  for (std::size_t first = 0; first < open.size(); ++first) {
    if (counted[first]) continue;
    counted[first] = true;
    std::vector<std::size_t> front{first};
    glm::dvec3 area(0.0), sum(0.0);
    double count = 0.0;
    while (!front.empty()) {
      const OpenVoxel& one = open[front.back()];
      front.pop_back();
      area += one.outward;
      sum += grid.centre_P_mm(one.ijk);
      count += 1.0;
      assets::forVoxels(one.ijk - kTogether_voxels, one.ijk + kTogether_voxels + 1, [&](glm::ivec3 near) {
        if (!grid.contains(near)) return;
        const auto found = at.find(grid.index(near));
        if (found == at.end() || counted[found->second]) return;
        counted[found->second] = true;
        front.push_back(found->second);
      });
    }
    const glm::dvec3 middle = sum / count;
    holes.push_back({kindOf(tooth, middle), glm::length(area) * grid.spacing_mm * grid.spacing_mm, middle});
  }
  std::ranges::sort(holes, std::ranges::greater{}, &Perforation::area_mm2);
  return holes;
}

}  // namespace app
