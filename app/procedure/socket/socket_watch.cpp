#include "app/procedure/socket/socket_watch.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "app/case/impaction_measures.h"
#include "assets/scan/tooth_division.h"

namespace app {
namespace {

constexpr double kBetweenLooks_s = 1.0;

std::array<bool, haptics::kMaxPieces> outOf(const haptics::Tick& tick) {
  std::array<bool, haptics::kMaxPieces> out{};
  for (std::size_t n = 0; n < tick.pieces; ++n) out[n] = haptics::Bodies::isAside(tick.X_PQ[n]);
  return out;
}

/// Without the operated tooth.
std::vector<std::uint8_t> jawOf(const assets::Patient& patient, std::span<const std::uint8_t> solid) {
  const assets::CtVolume& ct = patient.ct;
  const auto is_tooth = assets::voxelsOfTooth(ct, patient.operatedTooth());
  return assets::divideByTooth(ct.grid, solid, ct.label, is_tooth).jaw.solid;
}

}  // namespace

SiteDirections siteDirections(const assets::Patient& patient) {
  const ArchFrame frame = archFrame(patient);
  return {-frame.buccal_P, frame.up_P};
}

/// What a look reads.
struct SocketWatch::Copy {
  const assets::Patient& patient;
  SiteDirections directions;
  std::vector<std::uint8_t> before, before_jaw, jaw, tooth;

  SocketFindings check() const {
    return checkSocket({patient.ct.grid, patient.ct.label, before, before_jaw, jaw, tooth}, directions);
  }
};

SocketWatch::SocketWatch(const assets::Patient& patient, std::span<const std::uint8_t> before,
                         const haptics::Bodies& bodies)
    : copy_(std::make_unique<Copy>(Copy{patient,
                                        siteDirections(patient),
                                        {before.begin(), before.end()},
                                        jawOf(patient, before),
                                        bodies.jaw().solidInGridOrder(),
                                        {}})),
      bodies_(bodies) {}

SocketWatch::~SocketWatch() {
  if (looking_.valid()) looking_.wait();
}

void SocketWatch::look(const haptics::Tick& newest) {
  const assets::VolumeGrid& grid = bodies_.grid();
  for (const glm::ivec3& brick : std::exchange(changed_, {})) {
    std::array<std::uint8_t, 512> bytes{};
    bodies_.jaw().copyBrick(brick, bytes);
    std::size_t n = 0;
    assets::forVoxels(glm::ivec3(0), glm::ivec3(assets::kBrickVoxels), [&](glm::ivec3 at) {
      const glm::ivec3 ijk = assets::kBrickVoxels * brick + at;
      if (grid.contains(ijk)) copy_->jaw[grid.index(ijk)] = bytes[n];
      ++n;
    });
  }
  copy_->tooth.assign(grid.voxelCount(), 0);
  for (std::size_t piece = 0; piece < newest.pieces; ++piece) {
    if (haptics::Bodies::isAside(newest.X_PQ[piece])) continue;
    const haptics::CarvedBone& bone = bodies_.bones()[piece + 1];
    const std::vector<std::uint8_t> solid = bone.copyBox(glm::ivec3(0), bone.grid().size);
    const glm::ivec3 first = bodies_.firstBrick() * assets::kBrickVoxels;
    assets::forVoxels(bone.grid(), [&](glm::ivec3 ijk, std::size_t v) {
      if (solid[v] == 0 || !grid.contains(first + ijk)) return;
      std::uint8_t& here = copy_->tooth[grid.index(first + ijk)];
      here = static_cast<std::uint8_t>(std::min(255, here + solid[v]));
    });
  }
  looked_s_ = newest.t_s;
  looking_ = std::async(std::launch::async, [copy = copy_.get()] { return copy->check(); });
}

void SocketWatch::follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, bool waits) {
  changed_.insert(changed_.end(), bricks.begin(), bricks.end());
  if (looking_.valid()) {
    if (looking_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    newest_ = looking_.get();
  }
  const auto out = outOf(newest);
  if (std::ranges::none_of(out, std::identity{})) {
    newest_.reset();
    was_out_ = {};
    return;
  }
  const bool is_new = out != was_out_ || pieces_ != newest.pieces || !changed_.empty();
  if (!is_new || (looked_s_ && newest.t_s - *looked_s_ < kBetweenLooks_s)) return;
  was_out_ = out;
  pieces_ = newest.pieces;
  look(newest);
  if (waits) newest_ = looking_.get();
}

const std::optional<SocketFindings>& SocketWatch::finish(std::span<const glm::ivec3> bricks,
                                                         const haptics::Tick& newest) {
  if (looking_.valid()) newest_ = looking_.get();
  looked_s_.reset();
  follow(bricks, newest, true);
  return newest_;
}

}  // namespace app
