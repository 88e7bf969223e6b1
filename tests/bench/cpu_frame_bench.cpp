// What a stereo frame costs on the CPU: milliseconds of CPU over all threads (getrusage) and of the wall, medians, for
// the surgeon's view of a patient, and where they go, by leaving one thing out at a time. The share of CPU is that of
// "all of it" in the same run.
// cpu_frame_bench [--patient FOLDER] [--face FILE.glb] [--size WxH] [--frames N]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/case/patient_placement.h"
#include "app/case/patient_source.h"
#include "app/device/second_hand.h"
#include "app/view/brick_upload.h"
#include "app/view/patient_renderer.h"
#include "assets/instrument/dental_mirror.h"
#include "assets/patient/patient_folder.h"
#include "assets/synthetic/face.h"
#include "assets/tooth.h"
#include "haptics/body/bodies.h"
#include "render/eye_block.h"
#include "render/frame_renderer.h"
#include "render/quality_ladder.h"
#include "tests/bench/cpu_time.h"

namespace {

using bench::cpu_ms;

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

// CPU time of a frame with everything; 0 before it is known.
double whole_ms = 0.0;

void print(const char* what, double frame_ms) {
  std::printf("%-34s %6.1f ms CPU", what, frame_ms);
  if (whole_ms > 0.0) std::printf("  %5.2f of all", frame_ms / whole_ms);
}

double measure(const char* what, render::FrameRenderer& renderer, render::Frame frame, int frames) {
  std::vector<double> cpu, wall;
  for (int n = 0; n < frames; ++n) {
    frame.bur_angle_rad = 0.1 * n;
    const double c = cpu_ms(), w = wall_ms();
    renderer.render(frame);
    cpu.push_back(cpu_ms() - c);
    wall.push_back(wall_ms() - w);
  }
  print(what, median(cpu));
  std::printf("  %6.1f ms wall\n", median(wall));
  return median(cpu);
}

/// As many as can be drawn, on the gingiva around the site.
render::SoftMarks manyMarks(const glm::dvec3& site_P_mm, const assets::MeshModel& gingiva_P) {
  render::SoftMarks marks;
  for (const assets::MeshPart& part : gingiva_P.parts)
    for (std::size_t v = 0; v < part.position_mm.size(); v += 211) {
      const glm::dvec3 place(part.position_mm[v]);
      if (glm::distance(place, site_P_mm) > 20.0) continue;
      if (marks.cuts.size() < render::kMostSoftCuts) marks.cuts.push_back({{place}, {place}, 1.0});
      if (marks.reddened.size() < render::kMostReddened) marks.reddened.push_back({{place}, 3.5, 0.8});
    }
  return marks;
}

/// The tooth 6 mm out of the jaw and tilted, lying and moving, against the same view with it at rest, and its first
/// frame.
void measurePiece(const assets::Patient& patient, render::FrameRenderer& renderer, render::Frame frame, int frames) {
  haptics::Bodies bodies(patient.ct.grid, patient.ct.solid, patient.ct.label,
                         assets::voxelsOfTooth(patient.ct, patient.operatedTooth()));
  app::BrickUploader uploader;
  const auto bring = [&] { uploader.upload(bodies, frame.pieces, renderer); };
  double c = cpu_ms();
  bring();
  std::printf("%-34s %6.1f ms CPU\n", "the tooth for the renderer, once", cpu_ms() - c);
  const glm::dquat tilt = glm::angleAxis(0.35, glm::dvec3(0, 1, 0));
  const glm::dvec3 site = patient.focus_P_mm();
  const auto place = [&](double up_mm) { frame.pieces[0] = {tilt, site - tilt * site + glm::dvec3(0, 0, up_mm)}; };
  std::vector<double> first, lying, out, moving;
  for (int n = 0; n < frames; ++n) {
    const auto timed = [&](std::vector<double>& to) {
      c = cpu_ms();
      bring();
      renderer.render(frame);
      to.push_back(cpu_ms() - c);
    };
    frame.pieces[0].reset();
    bring();
    renderer.render(frame);
    timed(lying);
    place(6.0);
    timed(first);
    timed(out);
    place(6.0 + 0.01 * n);
    timed(moving);
  }
  const double at_rest_ms = median(lying);
  std::printf("%-34s %6.1f ms CPU\n", "the tooth at rest", at_rest_ms);
  const auto against = [&](const char* what, const std::vector<double>& cpu) {
    std::printf("%-34s %6.1f ms CPU  %5.2f of at rest\n", what, median(cpu), median(cpu) / at_rest_ms);
  };
  against("the tooth out of the jaw", out);
  against("the same, moving", moving);
  against("the frame in which it leaves", first);
  frame.pieces[0].reset();
  bring();
}

}  // namespace

int main(int count, char** words) {
  std::map<std::string, std::string> options{{"--size", "640x480"}, {"--frames", "21"}};
  for (int i = 1; i + 1 < count; i += 2) options[words[i]] = words[i + 1];
  glm::ivec2 px(640, 480);
  std::sscanf(options["--size"].c_str(), "%dx%d", &px.x, &px.y);
  const int frames = std::max(std::stoi(options["--frames"]), 1);

  // The surgeon's view, as `molar rehearse` has it.
  assets::Patient patient =
      options.contains("--patient") ? assets::loadPatient(options["--patient"]) : app::builtInPatient({});
  assets::FacePose X_PF = assets::kFaceAxes_PF;
  if (options.contains("--face")) X_PF = app::replaceFace(patient, options["--face"]);
  calibration::Rig rig = calibration::desktopRig(px, 531.0 / 4.0);
  const calibration::Vector<calibration::Patient> eye_P{assets::surgeonEyeDirection(patient.operatedTooth())};
  const calibration::Vector<calibration::Face> eye_F = assets::kFaceAxes_PF.inverse() * eye_P, up_F{{0.0, 1.0, 0.0}};
  rig.X_WP = app::placePatient({patient.focus_P_mm()}, X_PF * eye_F, X_PF * up_F);

  const auto renderer = app::patientRenderer(patient, {}, {}, patient.ct.solid, {.backend = render::Backend::cpu});
  render::Frame frame;
  frame.rig = rig;
  frame.display = render::DisplayMode::side_by_side_full;
  frame.site_P = {patient.focus_P_mm()};
  frame.X_PT = {glm::dquat(1, 0, 0, 0), patient.focus_P_mm() + 8.0 * eye_P.xyz};
  frame.face_window_mm = options.contains("--face") ? 24.0 : 0.0;
  std::printf("both eyes %dx%d, %s, face %s\n", px.x, px.y,
              options.contains("--patient") ? options["--patient"].c_str() : "built-in patient",
              options.contains("--face") ? options["--face"].c_str() : "its own");

  measure("(first)", *renderer, frame, 1);
  whole_ms = measure("all of it", *renderer, frame, frames);
  double aside_mm = 0.0;
  const auto moving = [&](render::FrameRenderer& r, render::Frame f) {
    f.rig.left_eye.mm.x += aside_mm += 0.01;
    f.rig.right_eye.mm.x += aside_mm;
    r.render(f);
  };
  const auto measure_moving = [&](const char* what, const render::Frame& f) {
    std::vector<double> cpu;
    for (int n = 0; n < frames; ++n) {
      const double c = cpu_ms();
      moving(*renderer, f);
      cpu.push_back(cpu_ms() - c);
    }
    print(what, median(cpu));
    std::puts("");
  };
  measure_moving("the eyes moving", frame);
  const auto without = [&](const char* what, const std::function<void(render::Frame&)>& change) {
    render::Frame changed = frame;
    change(changed);
    measure(what, *renderer, changed, frames);
  };
  without("edges antialiased", [](render::Frame& f) { f.quality.antialias = render::Antialias::edges; });
  // As drawn while it moves, and enlarged.
  without("at half the resolution", [](render::Frame& f) { f.quality = render::kQualitySteps[5].quality; });
  without("at a third of the resolution", [](render::Frame& f) { f.quality = render::kQualitySteps[6].quality; });
  without("without ambient shade", [](render::Frame& f) { f.quality.ambient_occlusion = false; });
  without("without the lamp's shadow", [](render::Frame& f) { f.quality.lamp_shadow = false; });
  without("without either", [](render::Frame& f) { f.quality.ambient_occlusion = f.quality.lamp_shadow = false; });
  without("with water, blood, dust and spray", [](render::Frame& f) { f.field = {f.site_P, 8.0, 0.8, 0.6, 0.4, 0.8}; });
  const render::SoftMarks marks = manyMarks(frame.site_P.mm, patient.gingiva);
  for (int pair = 0; pair < 3; ++pair) {
    without("without marks on soft tissue", [](render::Frame&) {});
    without("with all of them", [&](render::Frame& f) { f.marks = marks; });
  }
  frame.gap = renderer->gap(frame);
  without("with the ring of the gap", [](render::Frame&) {});
  frame.gap.reset();
  without("without the tool's shade", [](render::Frame& f) { f.quality.tool_shadow = false; });
  {
    constexpr int kPoses = 500;
    const double c = cpu_ms();
    double sum_mm = 0.0;
    for (int n = 0; n < kPoses; ++n) {
      render::Frame moved = frame;
      moved.X_PT.translation_mm = patient.focus_P_mm() + (8.0 + 20.0 * n / kPoses) * eye_P.xyz;
      if (const auto gap = renderer->gap(moved)) sum_mm += gap->mm;
    }
    std::printf("%-34s %6.3f ms CPU  (mean gap %.2f mm)\n", "the gap to the bone, per pose", (cpu_ms() - c) / kPoses,
                sum_mm / kPoses);
  }
  without("without face", [](render::Frame& f) { f.layers.face_opacity = 0.0f; });
  without("without face and gum", [](render::Frame& f) {
    f.layers.face_opacity = 0.0f;
    f.layers.gingiva = false;
  });
  without("face faded by half", [](render::Frame& f) { f.layers.face_opacity = 0.5f; });
  frame.layers.face_opacity = 0.5f;
  measure_moving("face faded, the eyes moving", frame);
  frame.layers.face_opacity = 1.0f;
  without("with clearance and plan", [](render::Frame& f) { f.layers.clearance = f.layers.planned_cut = true; });
  without("with all guides and a held tool", [](render::Frame& f) {
    f.layers.clearance = f.layers.planned_cut = f.layers.mandibular_canal = f.layers.ghost_tool = true;
    f.X_PT_at_hand = f.X_PT;
    f.X_PT_at_hand.translation_mm.z -= 2.0;
  });
  renderer->setSecondInstrument(assets::dentalMirror());
  without("with a mirror in the other hand", [&](render::Frame& f) {
    f.second_visible = true;
    f.X_PO = {glm::dquat(1, 0, 0, 0), patient.focus_P_mm() + 20.0 * eye_P.xyz};
  });
  {
    // As the scripted hand holds it: the tooth is seen in it.
    const auto hold = app::scriptedHold(app::SecondTool::mirror, assets::isRight(patient.operatedTooth()));
    const auto X_PW = rig.X_WP.inverse();
    frame.second_visible = true;
    frame.X_PO = {X_PW.rotation * hold.rotation, patient.focus_P_mm() + X_PW.rotation * hold.translation_mm};
    const double metal_ms = measure("the mirror at the tooth, as metal", *renderer, frame, frames);
    without("what it reflects", [](render::Frame& f) { f.second_glass = app::glassOf(app::SecondTool::mirror); });
    render::Frame reflecting = frame;
    reflecting.second_glass = app::glassOf(app::SecondTool::mirror);
    const double glass_ms = measure("the same again", *renderer, reflecting, frames);
    const auto box = render::glassBox(reflecting, render::eyeView(rig, render::Eye::cyclopean), px);
    std::printf("a mirror that reflects: %.2f of one that does not; box of the glass %.1f %% of the picture\n",
                glass_ms / metal_ms, 100.0 * box.size_px.x * box.size_px.y / (px.x * px.y));
    frame.second_visible = false;
  }
  renderer->setSecondInstrument({});
  measurePiece(patient, *renderer, frame, frames);
  renderer->setGuides({});
  measure("the first again, guides not known", *renderer, frame, frames);
  without("translucent bone", [](render::Frame& f) { f.mode = render::ViewMode::dvr; });
  without("steps of a voxel", [](render::Frame& f) { f.quality.step_voxels = 1.0; });
}
