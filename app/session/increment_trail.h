// When the increments of a filling were begun, from the ticks of a session: how old they are where it ends, for one
// that goes on from there. All ticks in order. Plain; any thread; nanoseconds a tick.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "haptics/servo/tick.h"

namespace app {

class IncrementTrail {
 public:
  /// Ages before the first tick, by increment from 1.
  explicit IncrementTrail(const std::vector<double>& age_s = {}) {
    for (const double one_s : age_s) begun_s_.push_back(-one_s);
  }

  void follow(const haptics::Tick& tick) {
    while (begun_s_.size() < tick.filling.increment) begun_s_.push_back(tick.t_s);
  }

  /// At a time of the session, s.
  std::vector<double> ages_s(double t_s) const {
    std::vector<double> ages_s;
    for (const double begun_s : begun_s_) ages_s.push_back(t_s - begun_s);
    return ages_s;
  }

 private:
  std::vector<double> begun_s_;
};

}  // namespace app
