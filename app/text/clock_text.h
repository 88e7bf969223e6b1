// A length of time as a clock shows it. Any thread; pure.
#pragma once

#include <string>

namespace app {

/// "1:05"; minutes go on beyond an hour: "61:00".
std::string clockText(double time_s);

}  // namespace app
