// Options of drawing, the same for `see` and `rehearse`: `--renderer`, `--mode`, `--layers`, `--face-opacity`,
// `--antialias`. Start-up only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/frame.h"
#include "render/render_options.h"

namespace app {

class CommandLine;

class PictureOption {
 public:
  explicit PictureOption(render::Antialias antialias = render::Antialias::none);

  void addTo(CommandLine& command);
  /// Empty: automatic.
  std::optional<render::Backend> backend() const;
  /// Sets view mode, layers and quality. Throws UsageError.
  void apply(render::Frame& frame) const;

 private:
  std::string renderer_ = "auto", mode_ = "iso", antialias_;
  std::vector<std::string> layers_;
  double face_opacity_ = 1.0;
};

}  // namespace app
