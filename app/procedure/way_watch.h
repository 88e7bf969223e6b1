// Asks while a rehearsal goes on what keeps the pieces of the tooth in (way_search): one second after the last change,
// once a piece has come off it or the tooth as a whole was asked for, and at once when it is asked. On a thread of its
// own, from a copy of the bodies; a newer question replaces an older one, and what was found of bodies that have
// changed since is dropped. For display and record: the servo never hears of it. Main thread, once a frame; a question
// costs it the copy of the pieces (2 to 8 ms each), and where the servo is stepped it waits for the answer. The end
// waits some tenths of a second at most for a search to stop. Frame P, mm.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "app/procedure/way_search.h"

namespace app {

class WayWatch {
 public:
  /// Before the first tick; the bodies have a tooth and the patient a site. Borrows both.
  WayWatch(const assets::Patient& patient, const haptics::Bodies& bodies);
  ~WayWatch();
  WayWatch(const WayWatch&) = delete;
  WayWatch& operator=(const WayWatch&) = delete;

  /// The surgeon wants to know now; from now on the tooth as a whole is looked at, too.
  void ask();
  /// `bricks`: of the jaw's grid, changed since the last call. `alone`: without being asked, too.
  void follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, bool alone, bool waits);

  /// Or will be soon: an answer is owed.
  bool isLooking() const { return looking_ || wants_now_; }
  /// Once for each answer.
  std::optional<WayRecord> takeNews() { return std::exchange(news_, std::nullopt); }
  /// Of the last answer; none: there was none, or no piece is left.
  const std::optional<WayRecord>& newest() const { return told_; }
  /// The bone to take away, what was cut since left out.
  const std::vector<glm::dvec3>& bone_P_mm() const { return bone_P_mm_; }
  double voxel_mm() const { return voxel_mm_; }

 private:
  struct Brick {
    glm::ivec3 at;
    std::array<std::uint8_t, 512> solid;
  };
  struct Question {
    std::uint64_t digest = 0;
    bool was_asked = false;
    std::size_t pieces = 0;
    BodiesCopy bodies;  ///< without the jaw
  };
  struct Answer {
    std::uint64_t digest = 0;
    WayFindings found;
  };

  bool isDue(const haptics::Tick& newest, bool alone) const;
  void stopSearch();
  void begin(const haptics::Tick& newest);
  void takeAnswer(const haptics::Tick& newest);
  void leaveOutCut(std::span<const glm::ivec3> bricks);
  void forget();
  void run();

  const haptics::Bodies& bodies_;
  WaySearch search_;
  std::vector<glm::ivec3> changed_;       ///< since the last question, each once
  std::vector<char> is_changed_;          ///< by brick
  std::optional<std::uint64_t> looking_;  ///< for bodies of this digest
  std::uint64_t last_digest_ = 0, answered_ = 0;
  double changed_s_ = 0.0;
  bool wants_now_ = false, wants_whole_ = false;
  std::optional<WayRecord> told_, news_;
  std::vector<glm::dvec3> bone_P_mm_;
  double voxel_mm_ = 0.0;

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  std::vector<Brick> bricks_;  ///< for the worker's copy of the jaw
  std::optional<Question> question_;
  std::optional<Answer> answer_;
  std::stop_source stop_;  ///< of the search that runs
  bool ending_ = false;
  std::vector<std::uint8_t> jaw_;  ///< the worker's
  std::thread thread_;
};

}  // namespace app
