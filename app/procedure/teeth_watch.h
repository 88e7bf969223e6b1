// Follows a tooth, or a piece of it, while it is cut, on a thread of its own: bricks in, pieces and bridges out, and
// what comes off when it has fallen apart, or when its bridge breaks. All but the destructor from one thread, not the
// servo's; all but settle() return at once. At most 20 looks a second; bridges on every look, but at most every fourth
// while bricks keep coming. The newest bytes of a brick win, so a slow look leaves nothing out. What it finds depends
// on the bytes alone; how often it looks does not change what a replay recomputes.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "haptics/body/break_plan.h"
#include "haptics/body/split_plan.h"
#include "haptics/body/tooth_survey.h"
#include "haptics/latest.h"

namespace app {

class TeethWatch {
 public:
  struct Report {
    std::uint64_t serial = 0;  ///< counts the looks; 0: none so far
    bool has_bridges = false;
    haptics::ToothFindings findings;
  };
  using Brick = std::array<std::uint8_t, 512>;

  /// `solid` and `label` in the order of the grid: the tooth that counts as whole; label may be empty.
  TeethWatch(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::vector<std::uint8_t> label = {});
  ~TeethWatch();
  TeethWatch(const TeethWatch&) = delete;
  TeethWatch& operator=(const TeethWatch&) = delete;

  /// A changed brick, i fastest.
  void give(glm::ivec3 brick, const Brick& solid);
  const Report& newest() { return newest_.read(); }
  /// What was given is all that has changed in the body up to the state of this digest.
  void confirm(std::uint64_t digest);
  struct Parting {
    haptics::SplitPlan plan;
    std::uint64_t digest = 0;  ///< as confirmed
  };
  /// Once for each confirmed state in which the body is in two or more pieces.
  std::unique_ptr<Parting> takeParting();
  /// Whether breaks are planned from now on: of a confirmed body in one piece, its weakest bridge, in single voxels.
  void planBreaks(bool wanted);
  /// Once for each body with a bridge.
  std::unique_ptr<haptics::BreakPlan> takeBreak();
  /// Waits until everything given and confirmed was looked at, bridges included.
  void settle();

 private:
  void run();
  bool mayPart() const { return confirmed_ && given_.empty() && *confirmed_ != parted_; }
  bool mayBreak() const { return plans_breaks_ && confirmed_ && given_.empty() && content_ != break_of_; }
  void lookForParting(std::unique_lock<std::mutex>& lock);
  void lookForBreak(std::unique_lock<std::mutex>& lock);

  haptics::ToothSurvey survey_;
  std::vector<std::uint8_t> label_;
  glm::ivec3 bricks_;
  haptics::Latest<Report> newest_;

  std::mutex mutex_;
  std::condition_variable wake_, settled_;
  std::map<std::size_t, std::pair<glm::ivec3, Brick>> given_;  ///< by brick
  std::optional<std::uint64_t> confirmed_;                     ///< for all that was given
  std::uint64_t parted_ = 0;  ///< confirmed digest for which it was looked whether the body falls apart
  std::unique_ptr<Parting> parting_;
  bool plans_breaks_ = false;
  std::uint64_t content_ = 1, break_of_ = 0;  ///< counts what was given; for which of that a break was looked for
  std::unique_ptr<haptics::BreakPlan> break_;
  bool stopping_ = false, is_looking_ = false, owes_bridges_ = false, hurry_ = false;
  std::thread thread_;
};

}  // namespace app
