#include "app/evaluation/console/page_files.h"

#include <algorithm>

namespace app {
namespace {

/// Those of console/web, written by the build.
constexpr PageFile kPageFiles[] = {
#include "page_files.inc"
};

}  // namespace

std::string_view PageFile::kind() const {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (name.ends_with(".svg")) return "image/svg+xml";
  return "text/plain; charset=utf-8";
}

const PageFile* pageFileAt(std::string_view path) {
  if (!path.starts_with('/')) return nullptr;
  path.remove_prefix(1);
  if (path.empty() || path == "participant") path = "index.html";
  const auto found = std::ranges::find(kPageFiles, path, &PageFile::name);
  return found == std::end(kPageFiles) ? nullptr : found;
}

}  // namespace app
