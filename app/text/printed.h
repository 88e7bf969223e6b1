// printf into a string, as long as it becomes: a line of a summary or a panel. Any thread.
#pragma once

#include <string>

namespace app {

[[gnu::format(printf, 1, 2)]] std::string printed(const char* format, ...);

}  // namespace app
