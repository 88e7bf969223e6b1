// The apex locator of a root-canal treatment while it goes on: read once a frame at the newest tick, shown in tenths of
// a millimetre, told again when that changes. Main thread; some µs a frame.
#pragma once

#include <optional>
#include <string>

#include "app/procedure/root_canal/apex_locator.h"
#include "app/session/locator_event.h"
#include "haptics/servo/tick.h"

namespace app {

class LocatorWatch {
 public:
  /// Both borrowed.
  LocatorWatch(const assets::ToothCanals& tooth, const assets::CtVolume& scan, ApexLocator::Mode mode,
               std::uint64_t seed);

  /// For the recording, first.
  const std::string& settings() const { return settings_; }
  /// True: the display has changed. `is_metal`: what is in the canal; gutta-percha does not conduct.
  bool follow(const haptics::Tick& tick, bool is_dry, bool is_metal = true);
  /// None: no file is in a canal.
  const std::optional<LocatorTold>& told() const { return told_; }

 private:
  const assets::ToothCanals& tooth_;
  ApexLocator locator_;
  std::string settings_;
  std::optional<LocatorTold> told_;
};

}  // namespace app
