#include "app/options/picture_option.h"

#include <algorithm>
#include <map>

#include "app/text/command_line.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

using render::Antialias;
using render::Backend;
using render::Layers;
using render::ViewMode;

const std::map<std::string, std::optional<Backend>> kBackends{{"auto", std::nullopt},
                                                              {"gl", Backend::gl_fragment},
                                                              {"gl-fragment", Backend::gl_fragment},
                                                              {"gl-compute", Backend::gl_compute},
                                                              {"cpu", Backend::cpu}};
const std::map<std::string, ViewMode> kModes{
    {"iso", ViewMode::iso}, {"dvr", ViewMode::dvr}, {"mesh", ViewMode::mesh}, {"clear", ViewMode::clear}};
const std::map<std::string, Antialias> kAntialias{{"none", Antialias::none}, {"edges", Antialias::edges}};

/// Layers that are off by default.
std::map<std::string, bool Layers::*> optionalLayers() {
  std::map<std::string, bool Layers::*> named;
  for (const PictureLayer& layer : kPictureLayers)
    if (!(Layers{}.*layer.on)) named.emplace(layer.name, layer.on);
  return named;
}
const std::map<std::string, bool Layers::*> kLayers = optionalLayers();

template <class T>
std::vector<std::string> namesOf(const std::map<std::string, T>& named) {
  std::vector<std::string> names;
  for (const auto& [name, value] : named) names.push_back(name);
  return names;
}

}  // namespace

PictureOption::PictureOption(Antialias antialias) : antialias_(antialias == Antialias::edges ? "edges" : "none") {}

void PictureOption::addTo(CommandLine& command) {
  command
      .option("--renderer", renderer_,
              "gl-fragment, gl-compute, cpu (without OpenGL); auto: cpu where there is no graphics card")
      .oneOf(namesOf(kBackends))
      .showsDefault();
  command
      .option("--mode", mode_,
              "Tooth and bone as iso (surface), dvr (translucent), clear (a tooth as glass) or mesh (triangles)")
      .oneOf(namesOf(kModes))
      .showsDefault();
  command
      .option(
          "--layers", layers_,
          "Shown besides: canal, clearance (bands around it), plan (bone to go), ghost (the hand), slices (CT); of "
          "a root-canal file: clear-tooth (as glass), tip (magnified); of a preparation: deviation (off the ideal), "
          "insertion (its way, undercut)")
      .separatedByCommas()
      .oneOf(namesOf(kLayers));
  command.option("--face-opacity", face_opacity_, "The face faded: 1 whole, 0 away").from(0.0, 1.0).showsDefault();
  command.option("--antialias", antialias_, "Silhouettes: none or edges").oneOf(namesOf(kAntialias)).showsDefault();
}

std::optional<Backend> PictureOption::backend() const {
  const std::optional<Backend> requested = kBackends.at(renderer_);
  // Triangles of bone are OpenGL's.
  return !requested && kModes.at(mode_) == ViewMode::mesh ? Backend::gl_fragment : requested;
}

std::string PictureOption::help() const {
  for (const PictureLayer& layer : kPictureLayers)
    if (isHelp(layer) && std::ranges::find(layers_, layer.name) != layers_.end()) return std::string(layer.name);
  return "";
}

void PictureOption::apply(render::Frame& frame) const {
  if (kModes.at(mode_) == ViewMode::mesh && kBackends.at(renderer_) == Backend::cpu)
    throw UsageError(
        "--mode mesh: triangles are drawn by OpenGL, use --mode iso (the same surface) or --renderer gl-fragment");
  frame.mode = kModes.at(mode_);
  for (const std::string& layer : layers_) frame.layers.*kLayers.at(layer) = true;
  frame.layers.face_opacity = static_cast<float>(face_opacity_);
  frame.quality.antialias = kAntialias.at(antialias_);
}

}  // namespace app
