#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

#include <fmt/core.h>

#include "app/debrief/debrief_plan.h"
#include "app/debrief/debrief_scene.h"
#include "app/text/elapsed.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "app/view/renderer_choice.h"
#include "app/view/snapshot.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"
#include "render/gpu/offscreen_context.h"

namespace app {
namespace {

std::vector<std::string> pictureNames(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < count; ++n) names.push_back(fmt::format("frame_{:05}.png", n));
  return names;
}

}  // namespace

int exportDebrief(const DebriefPlan& plan, const DebriefExport& wanted) {
  std::optional<calibration::OutputFile> snapshot;
  std::optional<calibration::OutputFolder> clip;
  std::vector<std::string> names;
  if (!wanted.snapshot.empty()) snapshot.emplace(wanted.snapshot, wanted.overwrite);
  if (!wanted.clip.empty()) {
    const double pictures = std::floor((wanted.to_s - wanted.from_s) * wanted.frames_per_s) + 1.0;
    if (!(pictures >= 1.0) || pictures > static_cast<double>(kMostClipPictures))
      throw UsageError(
          fmt::format("--clip {}: --from {:.1f} --to {:.1f} s are no part of a session with up to {} pictures",
                      wanted.clip, wanted.from_s, wanted.to_s, kMostClipPictures));
    names = pictureNames(static_cast<std::size_t>(pictures));
    clip.emplace(wanted.clip, wanted.overwrite, pictureNames(kMostClipPictures));
  }

  std::optional<render::OffscreenContext> context;  // outlives what is drawn with it
  DebriefScene scene(plan);
  for (const auto& run : scene.runs()) run->bookmarks();  // a broken file is told before a long run
  render::RenderOptions options;
  options.backend = rendererWithoutWindow(plan.backend, context, printMessage);
  options.samples = 2;
  const auto begun = std::chrono::steady_clock::now();
  scene.prepareTo(std::max(snapshot ? plan.at_s : 0.0, clip ? wanted.to_s : 0.0));
  const double prepared_s = secondsBetween(begun, std::chrono::steady_clock::now());
  if (clip && wanted.from_s > scene.length_s())
    throw UsageError(fmt::format("--from {:.1f}: the session has {:.1f} s", wanted.from_s, scene.length_s()));
  scene.open(options);
  for (const auto& run : scene.runs())
    for (const std::string& remark : run->remarks()) printMessage(run->name() + ": " + remark);
  if (snapshot) {
    scene.goTo(plan.at_s);
    scene.draw(plan.size_px, {});
    savePng(scene.image(), *snapshot);
    std::printf("picture at %.3f s written\n", std::min(plan.at_s, scene.length_s()));
    if (plan.choice.edges)
      for (const std::optional<double>& edges_mm : scene.edges_mm())
        std::puts(edges_mm ? fmt::format("sharp edges {:.0f} mm", *edges_mm).c_str()
                           : "sharp edges: none are told before a piece of the tooth is out");
  }
  for (std::size_t n = 0; n < names.size(); ++n) {
    scene.goTo(wanted.from_s + static_cast<double>(n) / wanted.frames_per_s);
    scene.draw(plan.size_px, {});
    const render::Image image = scene.image();
    calibration::writePng(clip->temporaryPath() + "/" + names[n], {image.w, image.h}, image.rgba);
  }
  if (clip) {
    clip->commit();
    std::printf("%zu pictures written, %g a second\n", names.size(), wanted.frames_per_s);
  }
  std::printf("run again in %.1f s\n", prepared_s);
  return 0;
}

}  // namespace app
