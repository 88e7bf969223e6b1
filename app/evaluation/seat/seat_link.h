// The rehearsal's end of its seat: starts the process, takes its words, starts another where it is gone or talks
// nonsense, and gives up after kMostStarts. Costs the rehearsal a read a frame; nothing that the seat does reaches the
// servo. Main thread. Linux.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/evaluation/bone_source.h"
#include "app/evaluation/seat/seat_words.h"
#include "app/session/input_feed.h"

namespace app {

class SeatLink : public BoneSource {
 public:
  static constexpr int kMostStarts = 5;

  /// Borrows the feed. `program`: that is started as `PROGRAM seat …`.
  SeatLink(const InputFeed& feed, std::vector<std::string> ids, std::string program = "/proc/self/exe");
  /// Ends the process.
  ~SeatLink() override;
  SeatLink(const SeatLink&) = delete;
  SeatLink& operator=(const SeatLink&) = delete;

  void start(const std::string& recording) override;
  void update(std::uint64_t newest, std::chrono::milliseconds most_wait) override;
  std::uint64_t followed() const override { return book_.followed(); }
  std::optional<double> value(std::string_view id, std::uint64_t tick) override { return book_.value(id, tick); }
  bool isLost() const override { return is_lost_; }
  std::vector<News> takeNews() override;

  /// So far. Lag: ticks that the servo was ahead at each update(), once the seat had come up to it.
  struct Figures {
    std::uint64_t lag_p50_ticks = 0, lag_p99_ticks = 0;
    double processor_s = 0.0;
    int starts = 0, taken_over = 0;  ///< processes, and those of them that went on for one that died
  };
  Figures figures() const;
  /// The process that was started; 0: none. Others work in its group.
  int process() const { return process_; }

 private:
  using Clock = std::chrono::steady_clock;
  void launch();
  void end();
  void begin(std::string why);
  void giveUp();
  void receive();
  void watch(std::uint64_t newest);
  void tellNews();

  const InputFeed& feed_;
  SeatBook book_;
  std::string program_;
  int recording_ = -1, words_ = -1, states_ = -1, process_ = 0;
  bool trusts_states_ = true;  ///< until a process that knew one fell before it had said anything
  int starts_ = 0;
  bool is_lost_ = false, has_told_deviation_ = false, has_spoken_ = false;
  std::uint64_t begun_told_ = 0, taken_told_ = 0, followed_at_launch_ = 0;
  Clock::time_point heard_{};
  bool is_up_ = false, is_missed_ = false;
  std::vector<std::uint32_t> lags_;
  std::vector<News> news_;
};

}  // namespace app
