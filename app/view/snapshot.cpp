#include "app/view/snapshot.h"

#include <filesystem>
#include <string>

#include "calibration/png_file.h"

namespace app {
namespace {

/// `folder/name.png` with a word before the ending: `folder/name_left.png`.
std::string withWord(const std::string& path, const std::string& word) {
  const std::filesystem::path p(path);
  return (p.parent_path() / (p.stem().string() + "_" + word + ".png")).string();
}

}  // namespace

void savePng(const render::Image& image, calibration::OutputFile& file) {
  calibration::writePng(file.temporaryPath(), {image.w, image.h}, image.rgba);
  file.commit();
}

StereoSnapshot::StereoSnapshot(const std::string& path, bool overwrite)
    : left_(withWord(path, "left"), overwrite), right_(withWord(path, "right"), overwrite) {}

void StereoSnapshot::take(render::FrameRenderer& renderer, const render::Frame& frame) {
  renderer.renderEye(frame, render::Eye::left);
  renderer.renderEye(frame, render::Eye::right);
  renderer.throwIfError();
  savePng(renderer.readEye(render::Eye::left), left_);
  savePng(renderer.readEye(render::Eye::right), right_);
}

}  // namespace app
