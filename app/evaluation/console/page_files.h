// The files of the page, compiled into the program. Any thread.
#pragma once

#include <string_view>

namespace app {

struct PageFile {
  std::string_view name, text;

  /// "text/html; charset=utf-8", by its ending.
  std::string_view kind() const;
};

/// "/" is index.html, as is "/participant"; "/page.css". Null: there is none.
const PageFile* pageFileAt(std::string_view path);

}  // namespace app
