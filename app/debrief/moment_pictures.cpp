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

DebriefPlan pictured(const std::string& session, const std::string& patient_folder) {
  DebriefPlan plan;
  plan.sessions = {session};
  plan.patient = patient_folder;
  plan.size_px = kPicture_px;
  plan.loupes = kLoupes;
  return plan;
}

MomentPicture pictureAt(DebriefScene& scene, const ToldMoment& moment) {
  const DebriefRun& run = *scene.runs().front();
  const assets::Patient& patient = run.patient();
  const bool has_canal = !patient.mandibular_canal_P_mm.empty();
  // To the cheek of either side.
  const double aside_px = patient.site && assets::isRight(patient.site->fdi) ? kAside_px : -kAside_px;
  scene.goTo(moment.t_s + kAfter_s);
  MomentPicture picture{moment, glm::length(run.moments().tick().law_force_P_N.xyz), {}};
  scene.choice.has_line = true;
  scene.choice.layers.mandibular_canal = false;
  scene.choice.layers.face_opacity = 1.0F;
  scene.choice.layers.gingiva = true;
  scene.draw(kPicture_px, {});
  picture.views.push_back({"the surgeon's view", scene.image()});
  scene.choice.has_line = false;
  scene.choice.layers.mandibular_canal = has_canal;
  scene.choice.layers.face_opacity = 0.0F;
  scene.choice.layers.gingiva = false;
  scene.turn({aside_px, kDown_px});
  scene.draw(kPicture_px, {});
  scene.backToFirst();
  picture.views.push_back(
      {std::string("bone and teeth alone, from the cheek") + (has_canal ? ", with the mandibular canal" : ""),
       scene.image()});
  return picture;
}

}  // namespace

SessionReview reviewWithPictures(const std::string& session, const std::string& patient_folder) {
  DebriefScene scene(pictured(session, patient_folder));
  scene.prepareTo(std::numeric_limits<double>::infinity());
  DebriefRun& run = *scene.runs().front();
  const auto draw = [&scene](const std::vector<ToldMoment>& moments) {
    render::RenderOptions options;
    options.backend = render::Backend::cpu;
    options.samples = 2;
    if (!moments.empty()) scene.open(options);
    std::vector<MomentPicture> pictures;
    for (const ToldMoment& moment : moments) pictures.push_back(pictureAt(scene, moment));
    return pictures;
  };
  return reviewOf(session, {run.moments().start(), run.knowsPatient() ? &run.patient() : nullptr, run.risks(),
                            run.moments().boneLeft(), run.remarks(), draw, patient_folder});
}

}  // namespace app
