// Every named case, as the surgeon finds it: the whole cut is seen by both eyes, and the scripted hand exposes the
// crown with it. Coarse voxels, the CPU renderer, stepped time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "app/case/case.h"
#include "app/case/enamel_exposure.h"
#include "app/case/gutter_plan.h"
#include "app/case/handpiece_direction.h"
#include "app/case/patient_placement.h"
#include "app/case/patient_source.h"
#include "app/device/pose_sources.h"
#include "app/session/soft_touches.h"
#include "app/view/patient_renderer.h"
#include "assets/cut_field.h"
#include "assets/import/scan_import.h"
#include "assets/scenery/gingiva_surface.h"
#include "assets/scenery/soft_tissue_distance.h"
#include "haptics/body/bodies.h"
#include "haptics/device/simulated/scripted_device.h"
#include "haptics/servo/servo.h"
#include "render/display/eye_projection.h"
#include "tests/shared_data.h"

namespace app {
namespace {

constexpr double kVoxel_mm = 0.5;
constexpr double kHeldShare = 0.1;  ///< of the time, by soft tissue
constexpr double kHeldInTrismus = 0.15;
constexpr double kSeenWithin_mm = 1.2;  ///< about two voxels: the drawn surface lies between their centres

assets::Patient coarsePatient(const Case& one, double opening_mm = assets::kUsualOpening_mm) {
  setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
  assets::JawParameters jaw = one.jaw;
  jaw.spacing_mm = kVoxel_mm;
  jaw.opening_mm = opening_mm;
  return builtInPatient(jaw);
}

struct Scene {
  assets::Patient patient;
  assets::PlannedCut cut;
  assets::SoftTissueField soft;
  haptics::Tool tool;
  calibration::Rig rig = calibration::desktopRig({640, 400}, calibration::kDeskMonitorWidth_mm / 4.0);

  explicit Scene(assets::Patient of, const assets::FacePose& X_PF = assets::kFaceAxes_PF) : patient(std::move(of)) {
    cut = planGutter(patient, kUsualBurRadius_mm).value_or(assets::PlannedCut{});
    rig.X_WP = placePatientAtSite(patient, X_PF);
    tool.head.radius_mm = kUsualBurRadius_mm;
    tool.shaft = haptics::standardShaft(tool.head);
    const assets::SoftTissueRegion region{patient.focus_P_mm()};
    soft = assets::softTissueField(assets::softTissueSurfaces(patient.gingiva, patient.face, region), region);
    cut.shaft_P = handpieceDirection_P(cut, patient.ct, soft, tool);
  }
};

/// Where the planned bone is met on the way in.
std::vector<glm::dvec3> planSurface_P_mm(const Scene& scene) {
  const assets::CtVolume& ct = scene.patient.ct;
  const assets::CutField field(scene.cut, 1.0);
  const double voxel_mm = ct.grid.spacing_mm;
  const glm::dvec3 out = glm::normalize(scene.cut.outward_P);
  std::vector<glm::dvec3> surface;
  const auto is_solid = [&](const glm::dvec3& p) {
    const glm::ivec3 ijk(glm::round(ct.grid.indexFromPoint(p)));
    return ct.grid.contains(ijk) && ct.solid[ct.grid.index(ijk)] >= assets::kHalfSolid;
  };
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    if (ct.solid[v] < assets::kHalfSolid || assets::isTooth(ct.label[v]) || !field.contains(p)) return;
    for (double way_mm = 1.5 * voxel_mm; way_mm < 14.0; way_mm += 0.5 * voxel_mm)
      if (is_solid(p + way_mm * out)) return;
    surface.push_back(p);
  });
  return surface;
}

/// Share of the places that nothing hides from an eye.
double seenShare(const std::vector<glm::dvec3>& places_P_mm, const render::DistanceImage& distance,
                 const render::EyeView& view, const calibration::Pose<calibration::World, calibration::Patient>& X_WP) {
  int seen = 0;
  for (const glm::dvec3& p : places_P_mm) {
    const calibration::Point<calibration::World> at = X_WP * calibration::Point<calibration::Patient>{p};
    const glm::dvec4 clip = view.clip_from_W * glm::dvec4(at.mm, 1.0);
    const int x = static_cast<int>((0.5 + 0.5 * clip.x / clip.w) * distance.w);
    const int y = static_cast<int>((0.5 - 0.5 * clip.y / clip.w) * distance.h);
    if (x < 0 || y < 0 || x >= distance.w || y >= distance.h) continue;
    const double drawn_mm = double{distance.mm[static_cast<std::size_t>(y * distance.w + x)]};
    seen += drawn_mm == 0.0 || drawn_mm > glm::distance(at.mm, view.eye_W.mm) - kSeenWithin_mm;
  }
  return places_P_mm.empty() ? 0.0 : static_cast<double>(seen) / static_cast<double>(places_P_mm.size());
}

/// Handpiece away, by the renderer's distances.
void expectWholePlanSeen(const Scene& scene, const std::string& what, double face_window_mm = 0.0) {
  const std::vector<glm::dvec3> surface = planSurface_P_mm(scene);
  ASSERT_GT(surface.size(), 100u);
  render::RenderOptions how;
  how.backend = render::Backend::cpu;
  const auto renderer = patientRenderer(scene.patient, {}, scene.cut, scene.patient.ct.solid, how);
  render::Frame frame;
  frame.rig = scene.rig;
  frame.tool_visible = false;
  frame.site_P = {scene.patient.focus_P_mm()};
  frame.face_window_mm = face_window_mm;
  for (const render::Eye eye : {render::Eye::left, render::Eye::right}) {
    renderer->renderEye(frame, eye);
    const double share = seenShare(surface, renderer->readDistance(eye), eyeView(scene.rig, eye), scene.rig.X_WP);
    testing::Test::RecordProperty(eye == render::Eye::left ? "seen_left" : "seen_right", std::to_string(share));
    EXPECT_GE(share, 0.95) << what << (eye == render::Eye::left ? ", left eye" : ", right eye");
  }
}

void expectExposedByTheScriptedHand(const Scene& scene, const std::string& what, double held_share = kHeldShare) {
  const assets::CtVolume& ct = scene.patient.ct;
  const EnamelExposure exposure(ct, ct.solid, *scene.patient.site, scene.cut);
  ASSERT_GT(exposure.planned_mm2(), 10.0);
  EXPECT_EQ(exposure.share(ct.solid), 0.0);

  haptics::Bodies bone(ct.grid, ct.solid, ct.label);
  haptics::Servo servo(bone, &scene.soft);
  haptics::ScriptedDevice device(scene.cut, cuttingMotion(scene.cut, scene.rig));
  haptics::Command command;
  command.tool = scene.tool;
  SoftTouchCounter touches;
  calibration::Vector<calibration::Patient> force;
  for (int tick = 0; tick < static_cast<int>(device.duration_s() * 500.0); ++tick) {
    const haptics::HandleState state = device.exchange({{force.xyz}, {}}, 2e-3);
    haptics::HandSample hand;
    hand.X_PT = {state.X_DH.rotation, state.X_DH.translation_mm};
    hand.velocity_P_mm_per_s.xyz = state.velocity_D_mm_per_s.xyz;
    hand.drill_pedal = state.pedal;
    const haptics::Tick done = servo.step(hand, command, 2e-3);
    force = done.commanded_force_P_N;
    touches.add(done);
  }
  const double share = exposure.share(bone.solidInGridOrder());
  testing::Test::RecordProperty("exposed", std::to_string(share));
  EXPECT_GE(share, 0.6) << what;
  double held_s = 0.0;
  for (const SoftTouches::Count& count : touches.counts().touched) held_s += count.seconds;
  testing::Test::RecordProperty("held_s", std::to_string(held_s));
  EXPECT_LT(held_s, held_share * device.duration_s()) << what;
}

/// Areas of what hangs together, the largest first; corners at one place are one.
std::vector<double> pieceAreas_mm2(const assets::MeshModel& model) {
  std::map<std::array<float, 3>, std::size_t> places;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<double> areas_mm2;
  for (const assets::MeshPart& part : model.parts)
    for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
      const auto corner = [&](std::size_t n) { return part.position_mm[part.triangles[t + n]]; };
      const auto place = [&](std::size_t n) {
        const glm::vec3 p = corner(n);
        return places.try_emplace({p.x, p.y, p.z}, places.size()).first->second;
      };
      triangles.push_back({place(0), place(1), place(2)});
      areas_mm2.push_back(0.5 * glm::length(glm::dvec3(glm::cross(corner(1) - corner(0), corner(2) - corner(0)))));
    }
  std::vector<std::size_t> root(places.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto root_of = [&](std::size_t place) {
    while (root[place] != place) place = root[place] = root[root[place]];
    return place;
  };
  for (const auto& [a, b, c] : triangles) root[root_of(a)] = root_of(b), root[root_of(b)] = root_of(c);
  std::map<std::size_t, double> piece_mm2;
  for (std::size_t t = 0; t < triangles.size(); ++t) piece_mm2[root_of(triangles[t][0])] += areas_mm2[t];
  std::vector<double> largest_first;
  for (const auto& [piece, mm2] : piece_mm2) largest_first.push_back(mm2);
  std::ranges::sort(largest_first, std::ranges::greater());
  return largest_first;
}

class EveryCase : public testing::TestWithParam<std::string> {};

/// As it is drawn, with the flap raised: no papilla is left in the air without the gingiva it stood on. The flap is one
/// sheet, or two where the ramus parts it, folded over just above the gingiva.
TEST_P(EveryCase, HasItsGingivaInOnePieceAndItsFlapInSheets) {
  const assets::Patient patient = coarsePatient(*caseNamed(GetParam()));
  const assets::MeshModel drawn = assets::gingivaSurface(patient.ct, planGutter(patient, kUsualBurRadius_mm));
  ASSERT_EQ(drawn.parts.size(), 2u) << "gingiva and flap";
  const std::vector<double> areas_mm2 = pieceAreas_mm2(drawn);
  EXPECT_GT(areas_mm2.at(0), 3000.0) << "the gingiva";
  EXPECT_THAT(areas_mm2, testing::SizeIs(testing::Le(3))) << "and the sheets of its flap";
  EXPECT_THAT(areas_mm2, testing::Each(testing::Ge(50.0))) << "mm², no crumb";
}

TEST_P(EveryCase, ShowsTheWholePlanToBothEyes) {
  expectWholePlanSeen(Scene(coarsePatient(*caseNamed(GetParam()))), GetParam());
}

/// Through the open mouth: against gingiva, lips, cheek and tongue, which hardly touch the instrument.
TEST_P(EveryCase, IsExposedByTheScriptedHand) {
  expectExposedByTheScriptedHand(Scene(coarsePatient(*caseNamed(GetParam()))), GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, EveryCase, testing::ValuesIn(caseNames()), [](const auto& one) {
  std::string name = one.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

/// The usual case in a mouth that opens little, as usual and widely: the way in to the plan stays free.
class EveryOpening : public testing::TestWithParam<int> {};

TEST_P(EveryOpening, ShowsTheWholePlanToBothEyes) {
  expectWholePlanSeen(Scene(coarsePatient(usualCase(), GetParam())), std::to_string(GetParam()) + " mm");
}

TEST_P(EveryOpening, LetsTheScriptedHandExposeTheCrown) {
  const bool is_trismus = GetParam() < 35;
  expectExposedByTheScriptedHand(Scene(coarsePatient(usualCase(), GetParam())), std::to_string(GetParam()) + " mm",
                                 is_trismus ? kHeldInTrismus : kHeldShare);
}

INSTANTIATE_TEST_SUITE_P(Mouth, EveryOpening, testing::Values(25, 37, 50));

/// As `molar import` makes it, without and with a face around it.
class CaseRealData : public testing::Test {
 protected:
  void SetUp() override {
    MOLAR_NEEDS(folder_);
    patient_ = assets::importScan(folder_, {}).patient;
    patient_.gingiva = assets::gingivaSurface(patient_.ct, planGutter(patient_, kUsualBurRadius_mm));
  }
  const std::string folder_ = tests::sharedData("patients/right_third_molar");
  assets::Patient patient_;
};

TEST_F(CaseRealData, ShowsTheWholePlanOfARealJawToBothEyes) { expectWholePlanSeen(Scene(patient_), "real jaw"); }

TEST_F(CaseRealData, ShowsTheWholePlanOfARealJawInAFaceToBothEyes) {
  const std::string face = tests::sharedData("faces/ict/ict_open_no_teeth.glb");
  MOLAR_NEEDS(face);
  const assets::FacePose X_PF = replaceFace(patient_, face);
  constexpr double kWindow_mm = 24.0;  // as molar rehearse cuts a foreign face away
  expectWholePlanSeen(Scene(patient_, X_PF), "real jaw in a face", kWindow_mm);
}

}  // namespace
}  // namespace app
