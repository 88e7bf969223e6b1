// Where the program keeps what it can make again: $XDG_CACHE_HOME/molar, else ~/.cache/molar. May be deleted at any
// time. Any thread; start-up.
#pragma once

#include <filesystem>

namespace app {

std::filesystem::path cacheFolder();

}  // namespace app
