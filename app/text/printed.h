// Numbers in text: printf into a string, as long as it becomes; a number as a person writes it. Any thread.
#pragma once

#include <string>

namespace app {

[[gnu::format(printf, 1, 2)]] std::string printed(const char* format, ...);

/// At most six decimals, no zeros behind.
std::string shortText(double value);

}  // namespace app
