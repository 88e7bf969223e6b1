// CPU time per frame of the CPU ray caster, beside VTK's in the same run, and how it grows. Off screen; where VTK is to
// be compared it needs an X server for its windows:
//   xvfb-run -a build/release/tests/render/render_bench [exactness] [table] [glsl] [pixels] [growth] [table256]
//   [table512], or one of iso, dvr, pictures DIR
// All threads of the process count (getrusage), so that other work on the machine disturbs least. Of each case the
// median over frames of an orbit, ours and VTK's in turn three times.
#include <sys/sysinfo.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/frame_renderer.h"
#include "render/gpu/offscreen_context.h"
#include "tests/bench/cpu_time.h"
#include "tests/bench/render/cpu_view.h"
#include "tests/bench/render/synthetic_head.h"
#ifdef MOLAR_BENCH_VTK
#include "tests/bench/render/vtk_peers.h"
#endif

namespace {

using namespace bench;
using render::Eye;
using render::ViewMode;

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

template <class Work>
double costOf_ms(Work work) {
  const double began = cpu_ms();
  work();
  return cpu_ms() - began;
}

/// 7 degrees a frame around the head, 190 mm away.
render::Camera cameraAt(int frame) {
  const double turn = glm::radians(-70.0 + 7.0 * (frame % 20));
  const glm::dvec3 middle(0.5 * kHead_mm);
  return {.eye_P_mm = middle + glm::dvec3(190.0 * std::sin(turn), -190.0 * std::cos(turn), 15.0),
          .look_at_P_mm = middle,
          .up_P = {0.0, 0.0, 1.0}};
}

/// A head as VTK has it and as we have it, carved alike.
struct Head {
  explicit Head(int voxels)
      : grid(headGrid(voxels)), hounsfield(syntheticHead(grid)), solid(solidOfAll()), view(grid, solid) {}

  std::vector<std::uint8_t> solidOfAll() const {
    std::vector<std::uint8_t> all(hounsfield.size());
    std::transform(hounsfield.begin(), hounsfield.end(), all.begin(), [](int hu) { return solidOf(hu); });
    return all;
  }

  /// The bur's ball becomes air, in both; the bricks that changed.
  std::vector<glm::ivec3> carve(int frame) {
    const glm::dvec3 centre = grid.indexFromPoint(burCentre_mm(frame));
    const double radius = kBur_mm / grid.spacing_mm;
    const glm::ivec3 low = glm::max(glm::ivec3(centre - radius - 1.0), glm::ivec3(0));
    const glm::ivec3 high = glm::min(glm::ivec3(centre + radius + 2.0), grid.size - 1);
    for (int k = low.z; k <= high.z; ++k)
      for (int j = low.y; j <= high.y; ++j)
        for (int i = low.x; i <= high.x; ++i) {
          const double gone = std::clamp(0.5 + radius - glm::length(glm::dvec3(i, j, k) - centre), 0.0, 1.0);
          std::int16_t& hu = hounsfield[grid.index({i, j, k})];
          hu = static_cast<std::int16_t>(std::lround(hu + gone * (-1000.0 - hu)));
          solid[grid.index({i, j, k})] = solidOf(hu);
        }
    std::vector<glm::ivec3> bricks;
    for (int k = low.z / 8; k <= high.z / 8; ++k)
      for (int j = low.y / 8; j <= high.y / 8; ++j)
        for (int i = low.x / 8; i <= high.x / 8; ++i) bricks.push_back({i, j, k});
    return bricks;
  }
  void showCarved(const std::vector<glm::ivec3>& bricks) {
    for (const glm::ivec3& brick : bricks) {
      std::array<std::uint8_t, render::Occupancy::kBrickValues> values{};
      for (std::size_t n = 0; n < values.size(); ++n) {
        const glm::ivec3 v = 8 * brick + glm::ivec3(n % 8, n / 8 % 8, n / 64);
        if (grid.contains(v)) values[n] = solid[grid.index(v)];
      }
      view.updateBrick(brick, values);
    }
    view.prepare();
  }

  assets::VolumeGrid grid;
  std::vector<std::int16_t> hounsfield;
  std::vector<std::uint8_t> solid;
  CpuView view;
};

Head& headOf(int voxels) {
  static std::map<int, std::unique_ptr<Head>> heads;
  std::unique_ptr<Head>& head = heads[voxels];
  if (head == nullptr) {
    heads.clear();
    heads[voxels] = std::make_unique<Head>(voxels);
    return *heads[voxels];
  }
  return *head;
}

struct Case {
  int voxels;
  glm::ivec2 px;
  bool is_iso, is_stereo, is_carving;
  double target;
};

/// As the project's goals name them; 0: none is set.
const Case kCases[] = {
    {256, {640, 480}, false, false, false, 0.08}, {256, {640, 480}, false, true, false, 0.08},
    {256, {640, 480}, false, false, true, 0.015}, {256, {640, 480}, true, false, false, 0.0},
    {256, {640, 480}, true, false, true, 0.05},   {256, {1280, 1024}, false, false, false, 0.0},
    {512, {640, 480}, false, false, false, 0.0},  {512, {640, 480}, false, false, true, 0.003},
    {512, {640, 480}, true, false, true, 0.015},  {512, {1280, 1024}, false, false, false, 0.05},
};

void drawOurs(const Head& head, const Case& c, int frame, CpuView::Image& image) {
  image.px = c.px;
  const ViewMode mode = c.is_iso ? ViewMode::iso : ViewMode::dvr;
  if (c.is_stereo)
    for (const Eye eye : {Eye::left, Eye::right}) head.view.draw(cameraAt(frame), eye, mode, image);
  else
    head.view.draw(cameraAt(frame), Eye::cyclopean, mode, image);
}

/// `only_voxels`: 0 for all.
void table(int only_voxels) {
  std::printf("CPU ms per frame\n%-44s %9s %9s %8s %8s\n", "case", "ours", "VTK", "ratio", "target");
  for (const Case& c : kCases) {
    if (only_voxels != 0 && c.voxels != only_voxels) continue;
    Head& head = headOf(c.voxels);
    std::vector<double> ours_ms, theirs_ms;
    CpuView::Image image;
    drawOurs(head, c, 0, image);
#ifdef MOLAR_BENCH_VTK
    VtkPeer vtk(c.is_iso ? VtkPeer::Kind::triangles : VtkPeer::Kind::fixed_point, head.grid, head.hounsfield, c.px);
    vtk.draw(cameraAt(0), 0.0);
    const int theirs = c.is_carving && c.voxels > 256 ? 1 : 4;
#endif
    int frame = 0;
    for (int round = 0; round < 3; ++round) {
#ifdef MOLAR_BENCH_VTK
      for (int n = 0; n < theirs; ++n, ++frame) {
        std::vector<glm::ivec3> bricks;
        if (c.is_carving) bricks = head.carve(frame);
        theirs_ms.push_back(costOf_ms([&] {
          if (c.is_carving) vtk.edited();
          if (c.is_stereo) {
            vtk.draw(cameraAt(frame), -31.5);
            vtk.draw(cameraAt(frame), 31.5);
          } else {
            vtk.draw(cameraAt(frame), 0.0);
          }
        }));
        if (c.is_carving) head.showCarved(bricks);
      }
#endif
      for (int n = 0; n < 8; ++n, ++frame) {
        std::vector<glm::ivec3> bricks;
        if (c.is_carving) bricks = head.carve(frame);
        ours_ms.push_back(costOf_ms([&] {
          if (c.is_carving) head.showCarved(bricks);
          drawOurs(head, c, frame, image);
        }));
      }
    }
    char name[96];
    std::snprintf(name, sizeof name, "%d^3 %dx%d %s%s%s", c.voxels, c.px.x, c.px.y, c.is_iso ? "iso" : "DVR",
                  c.is_stereo ? " stereo" : "", c.is_carving ? " carving" : "");
    const double ours = median(ours_ms), theirs_median = median(theirs_ms);
    std::printf("%-44s %9.1f ", name, ours);
    if (theirs_ms.empty())
      std::printf("%9s %8s", "-", "-");
    else
      std::printf("%9.1f %8.4f", theirs_median, ours / theirs_median);
    if (c.target > 0.0)
      std::printf(" %8.3f%s\n", c.target, theirs_ms.empty() ? "" : ours / theirs_median <= c.target ? "" : "  MISSED");
    else
      std::printf("\n");
    std::fflush(stdout);
  }
}

/// Median over an orbit.
double orbit_ms(const Head& head, const Case& c, int frames = 10) {
  std::vector<double> all;
  CpuView::Image image;
  drawOurs(head, c, 0, image);
  for (int frame = 0; frame < frames; ++frame) all.push_back(costOf_ms([&] { drawOurs(head, c, 2 * frame, image); }));
  return median(all);
}

double megabytesOf(const render::SolidCells& cells) {
  const auto bricks = static_cast<std::size_t>(cells.bricks().x * cells.bricks().y * cells.bricks().z);
  const auto stored =
      std::count_if(cells.table(), cells.table() + bricks, [](std::int32_t entry) { return entry > 0; });
  return 1e-6 * static_cast<double>(4 * render::SolidCells::kBrickWords * stored) + 1e-5 * static_cast<double>(bricks);
}

void growth() {
  std::printf("\ncost against voxels, 640x480\n%8s %10s %10s %12s %12s\n", "voxels", "iso ms", "DVR ms", "edit us",
              "cells MB");
  for (const int voxels : {128, 256, 512, 1024}) {
    struct sysinfo memory {};
    sysinfo(&memory);
    const double free_GB = static_cast<double>(memory.freeram + memory.bufferram) * memory.mem_unit / 1e9;
    if (const double needs_GB = 14.0 * std::pow(voxels / 1024.0, 3.0); needs_GB > free_GB) {
      std::printf("%7d^3 would need %.0f GB, and %.0f GB are free\n", voxels, needs_GB, free_GB);
      continue;
    }
    Head& head = headOf(voxels);
    const double iso = orbit_ms(head, {voxels, {640, 480}, true, false, false, 0.0});
    const double dvr = orbit_ms(head, {voxels, {640, 480}, false, false, false, 0.0});
    std::vector<double> edits;
    for (int frame = 0; frame < 40; ++frame) {
      const std::vector<glm::ivec3> bricks = head.carve(frame);
      edits.push_back(costOf_ms([&] { head.showCarved(bricks); }) * 1e3);
    }
    double edit_us = 0.0;
    for (const double us : edits) edit_us += us / static_cast<double>(edits.size());
    std::printf("%7d^3 %10.1f %10.1f %12.0f %12.1f\n", voxels, iso, dvr, edit_us, megabytesOf(head.view.cells()));
    std::fflush(stdout);
  }
}

/// And by instruction set.
void pixels() {
  std::printf("\ncost against pixels, 256^3\n%12s %10s %10s\n", "pixels", "iso ms", "DVR ms");
  Head& head = headOf(256);
  for (const glm::ivec2 px :
       {glm::ivec2(320, 240), glm::ivec2(640, 480), glm::ivec2(1280, 1024), glm::ivec2(1920, 1080)})
    std::printf("%7dx%-4d %10.1f %10.1f\n", px.x, px.y, orbit_ms(head, {256, px, true, false, false, 0.0}),
                orbit_ms(head, {256, px, false, false, false, 0.0}));
  std::printf("\ninstruction sets, 256^3 640x480\n%12s %10s %10s\n", "", "iso ms", "DVR ms");
  for (const auto& [set, name] :
       {std::pair(assets::InstructionSet::portable, "portable"), std::pair(assets::InstructionSet::avx2, "AVX2"),
        std::pair(assets::InstructionSet::avx512, "AVX-512")}) {
    if (!assets::available(set)) continue;
    head.view.set = set;
    std::printf("%12s %10.1f %10.1f\n", name, orbit_ms(head, {256, {640, 480}, true, false, false, 0.0}),
                orbit_ms(head, {256, {640, 480}, false, false, false, 0.0}));
  }
  head.view.set = assets::chosenInstructionSet();
}

#ifdef MOLAR_BENCH_VTK
/// Our whole look by GLSL (normals, soft shade, shadow of the lamp) beside VTK's GPU mapper with its own, on one
/// driver.
void glsl() {
  std::printf("\nGLSL, 256^3 640x480, CPU ms per frame of a software rasteriser\n%-12s %9s %9s %8s %8s\n", "case",
              "ours", "VTK", "ratio", "target");
  Head& head = headOf(256);
  for (const bool is_iso : {true, false}) {
    std::vector<double> ours_ms, theirs_ms;
    {
      // Gone before VTK makes its own: one thread, one context.
      render::OffscreenContext context;
      render::FrameRenderer renderer(head.grid, head.solid, {});
      for (int frame = 0; frame < 9; ++frame) {
        render::Frame view;
        view.rig = render::cameraRig(cameraAt(frame), {640, 480});
        view.mode = is_iso ? ViewMode::iso : ViewMode::dvr;
        view.tool_visible = false;
        const double ours = costOf_ms([&] {
          renderer.renderEye(view, Eye::cyclopean);
          renderer.readDistance(Eye::cyclopean);
        });
        if (frame > 0) ours_ms.push_back(ours);
      }
    }
    VtkPeer vtk(is_iso ? VtkPeer::Kind::gpu_iso : VtkPeer::Kind::gpu_dvr, head.grid, head.hounsfield, {640, 480});
    for (const int frame : {0, 3, 6}) {
      const double theirs = costOf_ms([&] { vtk.draw(cameraAt(frame), 0.0); });
      if (frame > 0) theirs_ms.push_back(theirs);
    }
    const double ratio = median(ours_ms) / median(theirs_ms);
    std::printf("%-12s %9.0f %9.0f %8.3f %8.3f%s\n", is_iso ? "iso" : "DVR", median(ours_ms), median(theirs_ms), ratio,
                0.1, ratio <= 0.1 ? "" : "  MISSED");
    std::fflush(stdout);
  }
}
#endif

double difference(const CpuView::Image& a, const CpuView::Image& b) {
  double most = 0.0;
  for (std::size_t n = 0; n < a.r.size(); ++n)
    for (const auto channel : {&CpuView::Image::r, &CpuView::Image::g, &CpuView::Image::b})
      most = std::max(most, static_cast<double>(std::abs((a.*channel)[n] - (b.*channel)[n])));
  return most;
}

void exactness() {
  std::printf("\nlargest difference of a picture, of full light\n");
  Head& head = headOf(256);
  for (const bool is_iso : {true, false}) {
    double skipping = 0.0, sets = 0.0, brute_ms = 0.0;
    for (const int frame : {0, 7, 19}) {
      const Case c{256, {320, 240}, is_iso, false, false, 0.0};
      CpuView::Image fast, brute, portable;
      drawOurs(head, c, frame, fast);
      head.view.skip_empty_space = false;
      brute_ms = costOf_ms([&] { drawOurs(head, c, frame, brute); });
      head.view.skip_empty_space = true;
      head.view.set = assets::InstructionSet::portable;
      drawOurs(head, c, frame, portable);
      head.view.set = assets::chosenInstructionSet();
      skipping = std::max(skipping, difference(fast, brute));
      sets = std::max(sets, difference(fast, portable));
    }
    std::printf("%s: skipping against brute force %g (brute force costs %.0f ms), best set against portable %g\n",
                is_iso ? "iso" : "DVR", skipping, brute_ms, sets);
  }
}

void write(const std::string& path, const CpuView::Image& image) {
  std::ofstream file(path, std::ios::binary);
  file << "P6 " << image.px.x << ' ' << image.px.y << " 255\n";
  for (int y = image.px.y - 1; y >= 0; --y)
    for (int x = 0; x < image.px.x; ++x) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.px.x) + static_cast<std::size_t>(x);
      for (const float light : {image.r[at], image.g[at], image.b[at]})
        file.put(static_cast<char>(
            std::lround(255.0 * std::pow(std::clamp(static_cast<double>(light), 0.0, 1.0), 1 / 2.2))));
    }
}

void pictures(const std::string& folder) {
  Head& head = headOf(256);
  for (const bool is_iso : {true, false}) {
    CpuView::Image image;
    drawOurs(head, {256, {640, 480}, is_iso, false, false, 0.0}, 9, image);
    write(folder + (is_iso ? "/ours_iso.ppm" : "/ours_dvr.ppm"), image);
#ifdef MOLAR_BENCH_VTK
    VtkPeer vtk(is_iso ? VtkPeer::Kind::triangles : VtkPeer::Kind::fixed_point, head.grid, head.hounsfield, {640, 480});
    vtk.draw(cameraAt(9), 0.0);
    const std::vector<std::uint8_t> rgb = vtk.picture();
    std::ofstream file(folder + (is_iso ? "/vtk_iso.ppm" : "/vtk_dvr.ppm"), std::ios::binary);
    file << "P6 640 480 255\n";
    for (int y = 479; y >= 0; --y)
      file.write(reinterpret_cast<const char*>(&rgb[static_cast<std::size_t>(y) * 1920]), 1920);
#endif
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string_view> words(argv + 1, argv + argc);
  const auto wants = [&](std::string_view word) {
    return words.empty() || std::find(words.begin(), words.end(), word) != words.end();
  };
#ifndef MOLAR_BENCH_VTK
  std::printf("built without VTK (libvtk9-dev): ours alone\n");
#endif
  if (wants("exactness")) exactness();
  if (wants("table")) table(0);
  for (const int voxels : {256, 512})
    if (!words.empty() && wants("table" + std::to_string(voxels))) table(voxels);
#ifdef MOLAR_BENCH_VTK
  if (wants("glsl")) glsl();
#endif
  if (wants("pixels")) pixels();
  if (wants("growth")) growth();
  if (words.size() == 1 && (words[0] == "iso" || words[0] == "dvr"))
    std::printf("%.1f ms\n", orbit_ms(headOf(256), {256, {640, 480}, words[0] == "iso", false, false, 0.0}, 100));
  if (words.size() == 2 && words[0] == "pictures") pictures(std::string(words[1]));
}
