// Follows a tooth while it is cut, on a thread of its own: bricks in, pieces and bridges out. give() and newest() from
// one thread, not the servo's; both return at once. At most 20 looks a second; bridges on every look, but at most every
// fourth while bricks keep coming. The newest bytes of a brick win, so a slow look leaves nothing out.
// What it finds depends on the bytes alone; how often it looks does not change what a replay recomputes.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <thread>
#include <utility>

#include "haptics/body/tooth_survey.h"
#include "haptics/latest.h"

namespace app {

class TeethWatch {
 public:
  struct Report {
    std::uint64_t serial = 0;  ///< counts the looks; 0: none so far
    std::uint64_t digest = 0;  ///< of the body, as given with the newest brick looked at
    bool has_bridges = false;
    haptics::ToothFindings findings;
  };
  using Brick = std::array<std::uint8_t, 512>;

  /// `solid` in the order of the grid: the tooth that counts as whole.
  TeethWatch(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid);
  ~TeethWatch();
  TeethWatch(const TeethWatch&) = delete;
  TeethWatch& operator=(const TeethWatch&) = delete;

  /// A changed brick (i fastest) of the body with this digest.
  void give(glm::ivec3 brick, const Brick& solid, std::uint64_t digest);
  const Report& newest() { return newest_.read(); }
  /// Waits until everything given was looked at, bridges included.
  void settle();

 private:
  void run();

  haptics::ToothSurvey survey_;
  glm::ivec3 bricks_;
  haptics::Latest<Report> newest_;

  std::mutex mutex_;
  std::condition_variable wake_, settled_;
  std::map<std::size_t, std::pair<glm::ivec3, Brick>> given_;  ///< by brick
  std::uint64_t digest_ = 0;
  bool stopping_ = false, is_looking_ = false, owes_bridges_ = false, hurry_ = false;
  std::thread thread_;
};

}  // namespace app
