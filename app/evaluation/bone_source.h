// Where an evaluation learns what the bone is like in each tick: rules that name O1 to O11 wait for it. Main thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/study/session_log.h"

namespace app {

class BoneSource {
 public:
  virtual ~BoneSource() = default;

  /// Once the recording is there, by the name of its file, before the first tick.
  virtual void start(const std::string& recording) = 0;
  /// Takes what has come. `newest`: tick that the servo has made; it is waited for so long, at most.
  virtual void update(std::uint64_t newest, std::chrono::milliseconds most_wait) = 0;
  /// Ticks of which the values are known, from the first on.
  virtual std::uint64_t followed() const = 0;
  /// In a tick that is followed; asked in the order of ticks. None: it cannot be told.
  virtual std::optional<double> value(std::string_view id, std::uint64_t tick) = 0;
  /// Nothing comes any more.
  virtual bool isLost() const = 0;

  /// For the event log, since the last call.
  struct News {
    std::string type;
    std::vector<std::pair<std::string, LogValue>> data;
  };
  virtual std::vector<News> takeNews() = 0;
};

}  // namespace app
