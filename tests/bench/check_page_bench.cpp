// How fast the check page answers a hand: a slice, a dab of the brush, the canal under a hand, a click on one tooth,
// a whole picture. check_page_bench [SPACING_MM]: a jaw in closed form (tests/assets/segment/arch_phantom.h) in voxels
// of that size. Seconds of the wall clock; the least of several.

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "app/check_page/check_run.h"
#include "app/check_page/painted_jaw.h"
#include "assets/segment/canal_search.h"
#include "tests/app/check_page/phantom_patient.h"

namespace {

using Clock = std::chrono::steady_clock;

/// Least and most of several, ms.
template <class Work>
void print(const char* name, double goal_ms, int times, const Work& work) {
  double least = 1e9, most = 0.0;
  for (int n = 0; n < times; ++n) {
    const Clock::time_point start = Clock::now();
    work(n);
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    least = std::min(least, ms), most = std::max(most, ms);
  }
  fmt::print("{:44} {:7.2f} ms, at most {:7.2f} (goal {:g})\n", name, least, most, goal_ms);
}

}  // namespace

int main(int argc, char** argv) {
  const double spacing_mm = argc > 1 ? std::atof(argv[1]) : 0.4;
  const tests::ArchPhantom phantom = tests::archPhantom({.spacing_mm = spacing_mm});
  const assets::Patient patient = tests::phantomPatient(phantom);
  fmt::print("{} x {} x {} voxels of {} mm\n", phantom.grid.size.x, phantom.grid.size.y, phantom.grid.size.z,
             spacing_mm);

  app::JawViews views(patient, app::whatOf(patient.ct));
  const auto place = [&](int n) { return patient.focus_P_mm() + glm::dvec3(0.0, 0.0, 0.3 * n - 1.5); };
  for (const auto& [view, name] : {std::pair{app::JawView::axial, "slice parallel to the bite, 512 x 512"},
                                   std::pair{app::JawView::across, "slice across the arch, 512 x 512"},
                                   std::pair{app::JawView::along, "slice along the arch, 512 x 512"}})
    print(name, 4.0, 10, [&, view = view](int n) { views.picture(view, place(n), {}, {}, {512, 512}); });
  print("panoramic view, 560 x 330", 40.0, 5, [&](int) {
    views.picture(app::JawView::panoramic, place(0), {}, {}, {560, 330});
  });
  print("three dimensions, 430 x 330", 40.0, 5, [&](int n) {
    views.picture(app::JawView::solid, place(n), {}, {}, {430, 330});
  });

  assets::JawFinder finder(phantom.grid, assets::greyToSearch(patient.ct));
  app::PaintedJaw painted(patient.ct, {});
  painted.take(finder.withClicks({}));
  const auto show = [&](const glm::ivec3& ijk, assets::VoxelLabel now) { views.takeVoxel(ijk, now.label, now.tooth); };
  for (const double radius_mm : {1.5, 5.0}) {
    assets::BrushStroke stroke;
    stroke.radius_mm = radius_mm, stroke.as = 48;
    const std::string name = fmt::format("dab of the brush, radius {} mm", radius_mm);
    print(name.c_str(), 8.0, 12, [&](int n) {
      stroke.way_P_mm.push_back(place(0) + glm::dvec3(0.5 * n, 0.0, 0.0));
      painted.dab(stroke, stroke.way_P_mm.size() - 1, show);
    });
    print("  undone", 16.0, 1, [&](int) { painted.leaveStroke(show); });
  }

  const assets::HalfJaw half = finder.halfOf(true);
  const assets::JawSegmentation found = finder.withClicks({});
  for (const assets::CanalProposal& canal : found.canals) {
    if (!canal.is_right) continue;
    const std::vector<glm::dvec3> points{canal.line_P_mm.front(), canal.line_P_mm[canal.line_P_mm.size() / 2],
                                         canal.line_P_mm.back()};
    print("canal through three points, under a hand", 50.0, 10, [&](int) { assets::quickCanal(half, points); });
  }
  // Where the time of a click goes, and one of the canals' without it.
  Clock::time_point begun = Clock::now();
  std::string stage;
  const auto next = [&](std::string_view name) {
    const Clock::time_point now = Clock::now();
    if (!stage.empty())
      fmt::print("    {:16} {:7.2f} ms\n", stage, std::chrono::duration<double, std::milli>(now - begun).count());
    stage = name, begun = now;
  };
  const auto row = std::ranges::find(found.teeth, 48, &assets::FoundTooth::fdi);
  if (row != found.teeth.end()) {
    print("a number on one tooth, computed", 300.0, 2, [&](int n) {
      finder.withClicks({{{assets::ToothEdit::number, {row->centre_P_mm, {}}, n % 2 == 0 ? 48 : 47}}, {}});
    });
    finder.withClicks({});
    double until_shown_ms = 0.0;
    print("one tooth dropped, with its canal", 1000.0, 1, [&](int) {
      const Clock::time_point start = Clock::now();
      stage = "edited teeth", begun = start;
      finder.withClicks({{{assets::ToothEdit::no_tooth, {row->centre_P_mm, {}}, 0}}, {}}, next,
                        [&](const assets::JawSegmentation&) {
                          until_shown_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
                        });
      next("");
    });
    fmt::print("{:44} {:7.2f} ms (goal 300)\n", "  of it until the teeth are shown", until_shown_ms);
    const auto other = std::ranges::find(found.teeth, 47, &assets::FoundTooth::fdi);
    if (other != found.teeth.end()) {
      finder.withClicks({});
      const assets::ToothClick join{assets::ToothEdit::same_tooth, {row->centre_P_mm, other->centre_P_mm}, 0},
          divide{assets::ToothEdit::two_teeth, {row->centre_P_mm, other->centre_P_mm}, 0};
      const auto until_shown = [&](const assets::JawClicks& clicks) {
        try {
          finder.withClicks(clicks, {}, [](const assets::JawSegmentation&) { throw 0; });
        } catch (int) {
        }
      };
      print("two pieces joined, until they are shown", 300.0, 1, [&](int) { until_shown({{join}, {}}); });
      print("one piece divided, until it is shown", 300.0, 1, [&](int) { until_shown({{join, divide}, {}}); });
    }
  }

  const tests::PhantomFolder folder("molar_check_bench_", patient);
  app::CheckRun run(folder.path(), [](const std::string&) {});
  run.finish();
  constexpr glm::ivec2 kWindow_px{1280, 800};
  run.picture(kWindow_px);
  print("whole picture, nothing new", 16.0, 5, [&](int) { run.picture(kWindow_px); });
  run.handle(render::LetterTyped{U'b'}, kWindow_px);
  const glm::dvec2 at = run.placeOf(app::JawView::axial, run.menu().cursor_P_mm(), kWindow_px);
  run.handle(render::PointerMoved{at, {}, render::MouseButton::none}, kWindow_px);
  run.handle(render::ButtonPressed{render::MouseButton::left, true}, kWindow_px);
  print("brush moved and the whole picture drawn", 16.0, 10, [&](int n) {
    run.handle(render::PointerMoved{at + glm::dvec2(2.0 * n, 0.0), {}, render::MouseButton::left}, kWindow_px);
    run.picture(kWindow_px);
  });
  run.handle(render::ButtonPressed{render::MouseButton::left, false}, kWindow_px);
  print("brush let go, all views drawn", 100.0, 1, [&](int) { run.picture(kWindow_px); });
  return 0;
}
