#include "app/debrief/moment_pictures.h"

#include <limits>

#include "app/debrief/debrief_scene.h"
#include "assets/tooth.h"

namespace app {
namespace {

constexpr glm::ivec2 kPicture_px{480, 400};
constexpr double kLoupes = 9.0;
constexpr double kAside_px = 260.0, kDown_px = 120.0;  ///< of a drag that turns the jaw, 0.15° each
constexpr double kAfter_s = 0.5e-3;                    ///< with the tick of the moment itself

}  // namespace

RunAgain momentPictures(const std::string& session, const std::string& patient_folder,
                        const std::vector<ToldMoment>& moments) {
  DebriefPlan plan;
  plan.sessions = {session};
  plan.patient = patient_folder;
  plan.size_px = kPicture_px;
  plan.loupes = kLoupes;
  DebriefScene scene(plan);
  render::RenderOptions options;
  options.backend = render::Backend::cpu;
  options.samples = 2;
  if (!moments.empty()) scene.open(options);

  // To the cheek of either side.
  const assets::Patient& patient = scene.runs().front()->patient();
  const auto& site = patient.site;
  const double aside_px = site && assets::isRight(site->fdi) ? kAside_px : -kAside_px;
  RunAgain again;
  SessionMoments& at = scene.runs().front()->moments();
  for (const ToldMoment& moment : moments) {
    scene.prepareTo(moment.t_s);
    scene.goTo(moment.t_s + kAfter_s);
    MomentPicture& picture = again.moments.emplace_back(MomentPicture{moment, 0.0, {}});
    picture.force_N = glm::length(at.tick().law_force_P_N.xyz);
    scene.choice.has_line = true;
    scene.choice.layers.mandibular_canal = false;
    scene.choice.layers.face_opacity = 1.0F;
    scene.choice.layers.gingiva = true;
    scene.draw(kPicture_px, {});
    picture.views.push_back({"from the usual place before the patient", scene.image()});
    scene.choice.has_line = false;
    scene.choice.layers.mandibular_canal = true;
    scene.choice.layers.face_opacity = 0.0F;
    scene.choice.layers.gingiva = false;
    scene.turn({aside_px, kDown_px});
    scene.draw(kPicture_px, {});
    scene.backToFirst();
    const bool has_canal = !patient.mandibular_canal_P_mm.empty();
    picture.views.push_back(
        {std::string("the jaw alone, from aside") + (has_canal ? ", with the canal" : ""), scene.image()});
  }
  scene.prepareTo(std::numeric_limits<double>::infinity());
  scene.goTo(std::numeric_limits<double>::infinity());
  again.remarks = scene.runs().front()->remarks();
  again.in_mouth = at.bodies().solidInMouth();
  return again;
}

}  // namespace app
