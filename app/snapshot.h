// Pictures of both eyes as files, `name_left.png` and `name_right.png`: claimed before the work, whole or not there.
// Any thread; milliseconds.
#pragma once

#include <string>

#include "assets/output_file.h"
#include "render/picture.h"

namespace app {

void savePng(const render::Picture& picture, assets::OutputFile& file);

class EyePictures {
 public:
  /// Refuses (LoadError) what is there already, unless `overwrite`.
  EyePictures(const std::string& path, bool overwrite);
  void save(const render::Picture& left, const render::Picture& right);

 private:
  assets::OutputFile left_, right_;
};

}  // namespace app
