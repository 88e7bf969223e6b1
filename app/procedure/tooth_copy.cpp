#include "app/procedure/tooth_copy.h"

#include <array>

namespace app {
namespace {

constexpr int kBlock = 4, kBrick = assets::kBrickVoxels;
constexpr double kRest_s = 0.4, kBetween_s = 1.0, kBetweenAtWork_s = 10.0;

}  // namespace

ToothCopy::ToothCopy(const assets::CtVolume& scan, std::span<const std::uint8_t> before) : grid_(scan.grid) {
  grid_.size = (scan.grid.size + (kBlock - 1)) / kBlock * kBlock;
  before_.assign(grid_.voxelCount(), 0);
  label_.assign(grid_.voxelCount(), 0);
  assets::forVoxels(scan.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const std::size_t to = grid_.index(ijk);
    before_[to] = before[v], label_[to] = scan.label[v];
  });
  now_ = before_;
}

void ToothCopy::take(const haptics::Bodies& bodies, std::span<const glm::ivec3> bricks) {
  for (const glm::ivec3& brick : bricks) {
    std::array<std::uint8_t, 512> bytes{};
    bodies.jaw().copyBrick(brick, bytes);
    const glm::ivec3 low = kBrick * brick;
    std::size_t n = 0;
    assets::forVoxels(low, low + kBrick, [&](glm::ivec3 ijk) {
      if (bodies.grid().contains(ijk)) now_[grid_.index(ijk)] = bytes[n];
      ++n;
    });
  }
}

bool StrokePause::isDue(const haptics::Tick& newest, bool has_changed) {
  if (newest.drilling || newest.file.stay == haptics::FileStay::wall) busy_s_ = newest.t_s;
  const bool rests = newest.t_s - busy_s_ > kRest_s;
  if (!has_changed || newest.t_s - measured_s_ < (rests ? kBetween_s : kBetweenAtWork_s)) return false;
  measured_s_ = newest.t_s;
  return true;
}

}  // namespace app
