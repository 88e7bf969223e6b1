// The tooth of a root-canal treatment chosen by pointing: the patient's jaw in a window, the tooth under the pointer
// marked, its canals on a card, a click takes it. Main thread; as long as the surgeon takes. Throws what loading and
// windows throw.
#pragma once

#include <optional>

#include "app/commands/rehearse_options.h"

namespace app {

/// FDI number; none: left.
std::optional<int> chooseTooth(const RehearseOptions& options);

}  // namespace app
