#include "app/psychophysics/trial_order.h"

namespace app {
namespace {

constexpr std::size_t kOrderBlock = 8;

}  // namespace

TrialOrder::TrialOrder(const Protocol& protocol, std::uint64_t seed) : rng_(seed, 1) {
  if (protocol.method == Method::staircase) {
    for (const double start : protocol.levels) tracks_.emplace_back(protocol.staircase, start);
    most_ = static_cast<int>(tracks_.size()) * protocol.staircase.max_trials;
    return;
  }
  const std::vector<double> levels = protocol.method == Method::constant ? protocol.levels : std::vector<double>{0.0};
  // With an odd number of repetitions the extra one alternates between the orders, level by level.
  bool odd_first = rng_.coin(0.5);
  for (int done = 0; done < protocol.trials; done += 2) {
    std::vector<PlannedTrial> block;
    for (const double level : levels) {
      if (done + 1 < protocol.trials) {
        block.push_back({level, 0, false});
        block.push_back({level, 0, true});
      } else {
        block.push_back({level, 0, odd_first});
        odd_first = !odd_first;
      }
    }
    rng_.shuffle(block);
    planned_.insert(planned_.end(), block.begin(), block.end());
  }
  most_ = static_cast<int>(planned_.size());
}

bool TrialOrder::nextOrder() {
  if (orders_.empty()) {
    std::vector<char> block(kOrderBlock);
    for (std::size_t i = 0; i < kOrderBlock; ++i) block[i] = static_cast<char>(i % 2);
    rng_.shuffle(block);
    orders_.assign(block.begin(), block.end());
  }
  const bool first = orders_.back();
  orders_.pop_back();
  return first;
}

std::optional<PlannedTrial> TrialOrder::next() {
  if (tracks_.empty()) {
    if (given_ == planned_.size()) return std::nullopt;
    return planned_[given_++];
  }
  std::vector<std::size_t> running;
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (!tracks_[i].over()) running.push_back(i);
  if (running.empty()) return std::nullopt;
  track_ = running[rng_.below(running.size())];
  return PlannedTrial{tracks_[track_].level(), track_, nextOrder()};
}

bool TrialOrder::answer(bool comparison_harder) {
  return !tracks_.empty() && tracks_[track_].answer(comparison_harder);
}

}  // namespace app
