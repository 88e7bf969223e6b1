#include "app/case/cache_folder.h"

#include <cstdlib>

namespace app {

std::filesystem::path cacheFolder() {
  namespace fs = std::filesystem;
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  if (cache && *cache) return fs::path(cache) / "molar";
  return home && *home ? fs::path(home) / ".cache" / "molar" : fs::temp_directory_path() / "molar-cache";
}

}  // namespace app
