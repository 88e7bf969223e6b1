// Saves every different page of a wizard once, as numbered PNG files in a folder, for documentation. Any one thread.
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
  /// Creates the folder. Throws UsageError if it is not empty or cannot be created.
  explicit PageAlbum(std::filesystem::path folder);

  /// Draws and saves a page unless a similar one was saved. Throws CalibrationError.
  void keep(const WizardView& view, const std::function<render::Image()>& draw);
  int count() const { return count_; }

 private:
  std::filesystem::path folder_;
  std::set<std::string> kept_;
  int count_ = 0;
};

}  // namespace app
