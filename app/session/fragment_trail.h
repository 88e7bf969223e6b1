// What broken files have left in a tooth, from the ticks of a servo that runs or is run again: recorded ticks have no
// nodes (fragments_event tells of those). All ticks in order. An undo takes a fragment back, a redo leaves it again.
// Frame P. Any thread; nanoseconds a tick.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "assets/metal_fragment.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/canal_file.h"

namespace app {

class FragmentTrail {
 public:
  /// What lay in the tooth before the first tick.
  explicit FragmentTrail(std::vector<assets::MetalFragment> before = {})
      : all_(std::move(before)), lying_(all_.size()) {}

  /// `file`: in the hand. True: lying() has changed.
  bool follow(const haptics::Tick& tick, const haptics::CanalFile& file);

  /// In the order in which they broke.
  std::span<const assets::MetalFragment> lying() const { return std::span(all_).first(lying_); }

 private:
  std::vector<assets::MetalFragment> all_;  ///< also what may be redone
  std::size_t lying_ = 0;
};

/// What broke off in a tick in which a file breaks; none: it is no such tick.
std::optional<assets::MetalFragment> brokenOff(const haptics::Tick& tick, const haptics::CanalFile& file);

}  // namespace app
