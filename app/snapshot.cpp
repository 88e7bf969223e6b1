#include "app/snapshot.h"

#include <filesystem>

#include "assets/output_file.h"
#include "calibration/picture_file.h"

namespace app {

void savePng(const render::Picture& picture, const std::string& path, bool overwrite) {
  assets::OutputFile out(path, overwrite);
  calibration::writePng(out.temporaryPath(), {picture.w, picture.h}, picture.rgba);
  out.commit();
}

std::string withSuffix(const std::string& path, const std::string& word) {
  const std::filesystem::path p(path);
  return (p.parent_path() / (p.stem().string() + "_" + word + p.extension().string())).string();
}

}  // namespace app
