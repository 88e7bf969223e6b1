// How a picture is drawn, as people name it: `--renderer auto/gl-fragment/gl-compute/cpu`, `--mode iso/dvr/mesh`,
// `--layers canal,clearance,plan,ghost`, `--face-opacity`, `--antialias none/edges`. The same words for `see` and
// `rehearse`. Start-up only.
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
  /// Empty: what suits the machine.
  std::optional<render::Backend> backend() const;
  /// View mode, layers and quality. Throws UsageError.
  void apply(render::Frame& frame) const;

 private:
  std::string renderer_ = "auto", mode_ = "iso", antialias_;
  std::vector<std::string> layers_;
  double face_opacity_ = 1.0;
};

}  // namespace app
