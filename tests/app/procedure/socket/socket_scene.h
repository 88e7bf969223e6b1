// A block of bone with a square tooth in it and a canal under the tooth: for findings by hand. Frame P, mm: up is z,
// the tongue at +x.
#pragma once

#include <cstdint>
#include <vector>

#include "app/procedure/socket/socket_check.h"
#include "assets/tissue.h"

namespace app::test {

struct SocketScene {
  struct Box {
    glm::dvec3 low, high;
    bool contains(const glm::dvec3& p) const {
      return glm::all(glm::greaterThan(p, low)) && glm::all(glm::lessThan(p, high));
    }
  };
  static constexpr double kVoxel_mm = 0.25;
  /// Bone 3 mm thick to cheek and tongue of the tooth, 1 mm from tooth to canal.
  static constexpr Box kBone{{-6.0, -10.0, -16.0}, {6.0, 10.0, 0.0}}, kTooth{{-3.0, -3.0, -10.0}, {3.0, 3.0, 2.0}},
      kCanal{{-1.0, -20.0, -13.0}, {1.0, 20.0, -11.0}};

  assets::VolumeGrid grid{{64, 96, 96}, kVoxel_mm, {-8.0 + 0.125, -12.0 + 0.125, -18.0 + 0.125}};
  std::vector<std::uint8_t> label = std::vector<std::uint8_t>(grid.voxelCount()), before = label, jaw = label,
                            before_jaw = label, tooth = label;

  SocketScene() {
    fill(label, kBone, static_cast<std::uint8_t>(assets::Tissue::cortical));
    fill(label, kCanal, static_cast<std::uint8_t>(assets::Tissue::mandibular_canal));
    fill(label, kTooth, static_cast<std::uint8_t>(assets::Tissue::dentine));
    fill(jaw, kBone, 255);
    fill(jaw, kCanal, 0);
    fill(jaw, kTooth, 0);
    before = before_jaw = jaw;
    fill(before, kTooth, 255);
  }
  void fill(std::vector<std::uint8_t>& values, const Box& box, std::uint8_t value) const {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (box.contains(grid.centre_P_mm(ijk))) values[v] = value;
    });
  }
  void drill(const Box& box) { fill(jaw, box, 0); }
  SocketFindings found() const {
    return checkSocket({grid, label, before, before_jaw, jaw, tooth}, {{1, 0, 0}, {0, 0, 1}});
  }
};

}  // namespace app::test
