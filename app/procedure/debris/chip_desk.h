// Looks for chips (haptics/body/chip_search) on a thread of its own whenever bone or tooth have changed and lie still,
// and orders the servo to let them leave the volumes. Main thread, once a frame; microseconds, where the servo is
// stepped it waits for the search (some 10 ms).
#pragma once

#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "haptics/body/chip_search.h"
#include "haptics/servo/tick.h"

namespace app {

class ChipDesk {
 public:
  /// Before the first tick. Borrows the bodies.
  explicit ChipDesk(const haptics::Bodies& bodies);
  ~ChipDesk();
  ChipDesk(const ChipDesk&) = delete;
  ChipDesk& operator=(const ChipDesk&) = delete;

  /// `bricks`: of the jaw's grid, changed since the last call. `is_applied`: the newest command was in force in
  /// `newest`. The order's serial is the caller's. `waits`: for a servo that is stepped.
  std::optional<haptics::ChipOrder> follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest,
                                           bool is_applied, bool waits);
  /// Chips that have just left the volumes; once each. Null: none. Lives as long as this.
  const haptics::ChipPlan* takeLoosened();

 private:
  struct Brick {
    std::size_t bone;
    glm::ivec3 at;
    haptics::ChipSearch::Brick solid;
  };
  struct Job {
    std::uint64_t digest = 0;  ///< of the bodies that were looked at
    std::future<haptics::ChipPlan> plan;
  };
  void begin(const haptics::Tick& newest);

  const haptics::Bodies& bodies_;
  std::unique_ptr<haptics::FirstBytes> first_;   ///< until the first search
  std::unique_ptr<haptics::ChipSearch> search_;  ///< the job's while one runs
  std::vector<glm::ivec3> changed_;
  std::uint64_t last_digest_ = 0, looked_at_ = 0;
  std::optional<Job> job_;
  std::deque<haptics::ChipPlan> plans_;  ///< of all orders: the servo reads them
  bool asked_ = false;                   ///< an order without its last answer
  bool looks_again_ = false;             ///< what was found holds no more
  const haptics::ChipPlan* loosened_ = nullptr;
};

}  // namespace app
