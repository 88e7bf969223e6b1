// A tooth that is prepared for a restoration: which one, how it stands, and the name of the ideal it is measured
// against. Frame P, mm. Plain data; any thread.
#pragma once

#include <string>

#include "assets/tooth_canals.h"

namespace assets {

struct PreparedTooth {
  int fdi = 0;
  ToothFrame frame;
  std::string ideal;  ///< "crown:all-ceramic"
};

}  // namespace assets
