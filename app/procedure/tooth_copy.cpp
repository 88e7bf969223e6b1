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
  const haptics::Filling* const filling = bodies.filling();
  if (filling == nullptr) return;
  for (const glm::ivec3& brick : bricks) {
    const haptics::FillingBrick one = filling->copyBrick(brick);
    if (filling_.laid.empty() && one.laid == decltype(one.laid){}) continue;
    for (std::vector<std::uint8_t>* volume : {&filling_.laid, &filling_.tissue, &filling_.increment})
      if (volume->empty()) volume->assign(grid_.voxelCount(), 0);
    const glm::ivec3 low = kBrick * brick;
    std::size_t n = 0;
    assets::forVoxels(low, low + kBrick, [&](glm::ivec3 ijk) {
      const std::size_t from = n++;
      if (!bodies.grid().contains(ijk)) return;
      const std::size_t v = grid_.index(ijk);
      filling_.laid[v] = one.laid[from], filling_.tissue[v] = one.tissue[from];
      filling_.increment[v] = one.increment[from];
    });
  }
}

bool StrokePause::isDue(const haptics::Tick& newest, bool has_changed) {
  if (newest.drilling || newest.filling.works || newest.file.stay == haptics::FileStay::wall) busy_s_ = newest.t_s;
  const bool rests = newest.t_s - busy_s_ > kRest_s;
  if (!has_changed || newest.t_s - measured_s_ < (rests ? kBetween_s : kBetweenAtWork_s)) return false;
  measured_s_ = newest.t_s;
  return true;
}

}  // namespace app
