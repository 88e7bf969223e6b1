// Every page of a wizard that was shown, once, as numbered PNG pictures in a folder: for documentation and for whoever
// wants to see a procedure without a display. Any one thread.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include "app/calibrate/wizard_view.h"
#include "render/image.h"

namespace app {

class PageAlbum {
 public:
  /// Makes the folder. Throws UsageError when there is something in it already, or it can not be had.
  explicit PageAlbum(std::filesystem::path folder);

  /// Draws and saves it where no page like this was saved before. Throws CalibrationError.
  void keep(const WizardView& view, const std::function<render::Image()>& draw);
  int count() const { return count_; }

 private:
  std::filesystem::path folder_;
  std::set<std::string> kept_;
  int count_ = 0;
};

}  // namespace app
