// Pictures as files: PNG through a temporary, so a snapshot is whole or not there. Any thread; milliseconds.
#pragma once

#include <string>

#include "render/picture.h"

namespace app {

void savePng(const render::Picture& picture, const std::string& path, bool overwrite);

/// `folder/name.png` with a word before the ending: `folder/name_left.png`.
std::string withSuffix(const std::string& path, const std::string& word);

}  // namespace app
