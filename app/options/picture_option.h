// Options of drawing, the same for `see` and `rehearse`: `--renderer`, `--mode`, `--layers`, `--face-opacity`,
// `--antialias`. Start-up only.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/frame.h"
#include "render/render_options.h"

namespace app {

class CommandLine;

/// Layers besides tooth and bone: one table for `--layers`, scripts and the instructor's window.
struct PictureLayer {
  std::string_view name;   ///< on the command line and in scripts
  std::string_view label;  ///< in the instructor's window
  bool render::Layers::*on;
};

inline constexpr std::array<PictureLayer, 13> kPictureLayers = {{
    {"gum", "Gum", &render::Layers::gingiva},
    {"canal", "Mandibular canal", &render::Layers::mandibular_canal},
    {"clearance", "Clearance bands", &render::Layers::clearance},
    {"plan", "Planned cut", &render::Layers::planned_cut},
    {"ghost", "Ghost tool", &render::Layers::ghost_tool},
    {"slices", "CT slices", &render::Layers::slices},
    {"ring", "Ring of the gap", &render::Layers::gap_ring},
    {"obstacles", "Bone in the way", &render::Layers::obstacles},
    {"clear-tooth", "Clear tooth", &render::Layers::clear_tooth},
    {"tip", "File's tip", &render::Layers::tip_inset},
    {"deviation", "Off the ideal", &render::Layers::deviation},
    {"insertion", "Way of insertion", &render::Layers::insertion},
    {"marks", "Marks of paper", &render::Layers::marks},
}};

/// Layers that show what a surgeon cannot see: not in an assessment.
constexpr bool isHelp(const PictureLayer& layer) {
  return layer.name == "canal" || layer.name == "clearance" || layer.name == "plan" || layer.name == "obstacles" ||
         layer.name == "clear-tooth" || layer.name == "tip" || layer.name == "deviation" || layer.name == "insertion";
}

class PictureOption {
 public:
  explicit PictureOption(render::Antialias antialias = render::Antialias::none);

  void addTo(CommandLine& command);
  /// Empty: automatic.
  std::optional<render::Backend> backend() const;
  /// Sets view mode, layers and quality. Throws UsageError.
  void apply(render::Frame& frame) const;
  /// The first of those asked for that isHelp(); empty: none.
  std::string help() const;

 private:
  std::string renderer_ = "auto", mode_ = "iso", antialias_;
  std::vector<std::string> layers_;
  double face_opacity_ = 1.0;
};

}  // namespace app
