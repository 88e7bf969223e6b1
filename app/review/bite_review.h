// The bites on articulating paper of a recorded tooth preparation, done again: the session is run again up to each, and
// the tooth that stands there bites. Any one thread; the CPU time of the servo steps for each bite. Throws
// SessionError, UsageError.
#pragma once

#include <string>
#include <vector>

#include "app/session/bite_event.h"

namespace app {

struct BiteAgain {
  BiteRecord recorded, again;
};

/// In order.
std::vector<BiteAgain> bitesAgain(const std::string& path);

}  // namespace app
