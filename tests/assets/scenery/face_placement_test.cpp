#include "assets/scenery/face_placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "assets/import/tooth_site.h"
#include "assets/load_error.h"
#include "assets/mesh/gltf_file.h"
#include "assets/scan/image_file.h"
#include "assets/synthetic/face_teeth.h"
#include "tests/shared_data.h"

namespace assets {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A lower arch of ball-shaped crowns in F, and the same arch voxelised in P by a known pose.
struct Phantom {
  std::vector<FaceTooth> teeth;
  FacePose X_PF;
  CtVolume ct;
  std::optional<OperativeSite> site;
};

/// Balls at the face's teeth, by its pose.
void voxelise(Phantom& out);

Phantom phantom() {
  Phantom out;
  for (int n = 1; n <= 8; ++n) {
    const double x = 27.0 * std::sin(0.2 * n - 0.1);
    const double z = 100.0 - 7.4 * n * (0.35 + 0.08 * n);
    out.teeth.push_back({30 + n, {x, -50.0, z}});
    out.teeth.push_back({40 + n, {-x, -50.0, z}});
  }
  const glm::dquat tilt = glm::angleAxis(0.3, glm::normalize(glm::dvec3(1.0, 0.2, -0.1)));
  out.X_PF = {glm::normalize(kFaceAxes_PF.rotation * tilt), glm::dvec3(60.0, 140.0, 80.0)};
  voxelise(out);
  return out;
}

void voxelise(Phantom& out) {
  // Around them all.
  glm::dvec3 low(1e9), high(-1e9);
  for (const FaceTooth& tooth : out.teeth) {
    const glm::dvec3 at = (out.X_PF * calibration::Point<calibration::Face>{tooth.open_F_mm}).mm;
    low = glm::min(low, at - 10.0), high = glm::max(high, at + 10.0);
  }
  out.ct.grid = {glm::ivec3(glm::ceil((high - low) / 0.6)), 0.6, low};
  out.ct.label.assign(out.ct.grid.voxelCount(), 0);
  for (const FaceTooth& tooth : out.teeth) {
    const bool third_molar = tooth.fdi == 48;
    if (tooth.fdi == 38) continue;
    const glm::dvec3 centre = (out.X_PF * calibration::Point<calibration::Face>{tooth.open_F_mm}).mm;
    const glm::ivec3 c(glm::round(out.ct.grid.indexFromPoint(centre)));
    for (int k = -6; k <= 6; ++k) {
      for (int j = -6; j <= 6; ++j) {
        for (int i = -6; i <= 6; ++i) {
          const glm::ivec3 at = c + glm::ivec3(i, j, k);
          if (!out.ct.grid.contains(at) || glm::distance(out.ct.grid.centre_P_mm(at), centre) > 3.0) continue;
          out.ct.label[out.ct.grid.index(at)] =
              static_cast<std::uint8_t>(third_molar ? Tissue::enamel : Tissue::other_teeth);
        }
      }
    }
    if (third_molar) out.site = {48, centre, {0, 0, 1}};
  }
}

TEST(FacePlacement, FindsTheKnownPoseOfAPhantom) {
  const Phantom p = phantom();
  const FacePlacement placement = fitFace(p.ct, p.site, p.teeth);
  EXPECT_LT(placement.rms_mm, 0.3);
  EXPECT_GE(placement.teeth, 10);
  EXPECT_GT(std::abs(glm::dot(placement.X_PF.rotation, p.X_PF.rotation)), std::cos(0.5 * 0.02));
  for (const FaceTooth& tooth : p.teeth) {
    const calibration::Point<calibration::Face> at{tooth.open_F_mm};
    EXPECT_LT(glm::distance((placement.X_PF * at).mm, (p.X_PF * at).mm), 0.5);
  }
}

TEST(FacePlacement, FindsThePoseWithoutASite) {
  Phantom p = phantom();
  p.site.reset();
  const FacePlacement placement = fitFace(p.ct, p.site, p.teeth);
  EXPECT_LT(placement.rms_mm, 0.3);
  EXPECT_GT(std::abs(glm::dot(placement.X_PF.rotation, p.X_PF.rotation)), std::cos(0.5 * 0.02));
}

// Teeth without numbers over numbered ones are the upper jaw's, where the mouth is closed.
TEST(FacePlacement, UpperTeethOfAClosedMouthMoveNothing) {
  Phantom p = phantom();
  std::ranges::transform(p.ct.label, std::back_inserter(p.ct.tooth), [](std::uint8_t label) -> std::uint8_t {
    return Tissue{label} == Tissue::other_teeth ? 46 : Tissue{label} == Tissue::enamel ? 48 : 0;
  });
  // A number for each tooth, by the nearest.
  forVoxels(p.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (p.ct.tooth[v] != 46) return;
    const glm::dvec3 at = p.ct.grid.centre_P_mm(ijk);
    p.ct.tooth[v] = static_cast<std::uint8_t>(
        std::ranges::min(p.teeth, {}, [&](const FaceTooth& tooth) {
          return glm::distance((p.X_PF * calibration::Point<calibration::Face>{tooth.open_F_mm}).mm, at);
        }).fdi);
  });
  const FacePlacement open = fitFace(p.ct, p.site, p.teeth);
  const glm::dvec3 up_P = p.X_PF.rotation * glm::dvec3(0.0, 1.0, 0.0);
  const std::vector<std::uint8_t> lower = p.ct.tooth;
  forVoxels(p.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::ivec3 below(glm::floor(p.ct.grid.indexFromPoint(p.ct.grid.centre_P_mm(ijk) - 8.0 * up_P) + 0.5));
    if (p.ct.label[v] == 0 && p.ct.grid.contains(below) && lower[p.ct.grid.index(below)] != 0)
      p.ct.label[v] = static_cast<std::uint8_t>(Tissue::other_teeth);
  });
  const FacePlacement closed = fitFace(p.ct, p.site, p.teeth);
  EXPECT_LT(closed.rms_mm, 0.3);
  for (const FaceTooth& tooth : p.teeth) {
    const calibration::Point<calibration::Face> at{tooth.open_F_mm};
    EXPECT_LT(glm::distance((closed.X_PF * at).mm, (open.X_PF * at).mm), 0.1) << tooth.fdi;
    EXPECT_LT(glm::distance((closed.X_PF * at).mm, (p.X_PF * at).mm), 0.5) << tooth.fdi;
  }
}

// The built-in face finds its own teeth: a jaw of them in any pose.
TEST(FacePlacement, TheBuiltInFaceIsPlacedByItsTeeth) {
  Phantom p = phantom();
  p.teeth = builtInFaceTeeth();
  ASSERT_EQ(p.teeth.size(), 16u);
  voxelise(p);
  const FacePlacement placement = fitFace(p.ct, p.site, p.teeth);
  EXPECT_LT(placement.rms_mm, 0.4);
  for (const FaceTooth& tooth : p.teeth) {
    const calibration::Point<calibration::Face> at{tooth.open_F_mm};
    EXPECT_LT(glm::distance((placement.X_PF * at).mm, (p.X_PF * at).mm), 0.8) << tooth.fdi;
  }
}

TEST(FacePlacement, FaceTeethGoWhereTheScanHasItsOwn) {
  const std::vector<FaceTooth> teeth = builtInFaceTeeth();
  const FacePlacement placed{kFaceAxes_PF, 0.0, 0.0, 16};
  MeshModel face;
  face.parts.resize(2);
  face.parts[0].name = "LowerTeeth", face.parts[1].name = "UpperTeeth";
  std::vector<glm::dvec3> own_P_mm;
  for (const FaceTooth& tooth : teeth) {
    const glm::dvec3 at = (kFaceAxes_PF * calibration::Point<calibration::Face>{tooth.open_F_mm}).mm;
    if (tooth.fdi > 40) own_P_mm.push_back(at + glm::dvec3(1.0, 1.0, -3.0));
    for (MeshPart& part : face.parts)
      for (int corner = 0; corner < 3; ++corner) {
        part.triangles.push_back(static_cast<std::uint32_t>(part.position_mm.size()));
        part.position_mm.emplace_back(at);
      }
  }
  dropTeeth(face, placed, teeth, own_P_mm);
  ASSERT_EQ(face.parts.size(), 2u);
  EXPECT_EQ(face.parts[1].triangles.size(), 48u);
  EXPECT_GE(face.parts[0].triangles.size(), 21u);
  for (const std::uint32_t corner : face.parts[0].triangles) EXPECT_GT(face.parts[0].position_mm[corner].x, 0.0F);
}

TEST(FacePlacement, ReportsWhatIsMissing) {
  const Phantom p = phantom();
  const auto refusal = [&](const CtVolume& ct, std::vector<FaceTooth> teeth) -> std::string {
    try {
      fitFace(ct, p.site, teeth);
      return "";
    } catch (const LoadError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refusal(p.ct, {}), HasSubstr("on the other side"));
  CtVolume empty = p.ct;
  std::ranges::fill(empty.label, std::uint8_t{0});
  EXPECT_THAT(refusal(empty, p.teeth), HasSubstr("too few"));
}

TEST(FacePlacement, RefusesADamagedListOfTeeth) {
  const fs::path path = fs::temp_directory_path() / "molar_teeth_test.json";
  const std::string good = R"("open_mean_m":[0.1,0.2,0.3])";
  for (const std::string& text :
       {std::string(""), std::string("[]"), std::string("{}"), std::string(R"({"LR8":3})"),
        std::string(R"({"LR8":{"open_mean_m":[0.1,0.2]}})"), std::string(R"({"LR8":{"open_mean_m":[0.1,0.2,"x"]}})"),
        std::string(R"({"LR8":{"open_mean_m":[100,0,0]}})"), "{\"LR8\":{" + good + "}}", std::string(100'000, '[')}) {
    std::ofstream(path) << text;
    EXPECT_THROW(readFaceTeeth(path.string()), LoadError) << text.substr(0, 60);
  }
  std::ofstream(path) << "{\"LR8\":{" << good << "},\"LR7\":{" << good << "},\"LL1\":{" << good << "},\"LL2\":{" << good
                      << "},\"UL2\":{" << good << "},\"comment\":1}";
  EXPECT_EQ(readFaceTeeth(path.string()).size(), 4u);
  fs::remove(path);
  EXPECT_THROW(readFaceTeeth(path.string()), LoadError);
}

// Whether a ray from a point hits the model.
bool meets(const MeshModel& model, const glm::dvec3& from, const glm::dvec3& direction) {
  for (const MeshPart& part : model.parts) {
    for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
      const auto corner = [&](std::size_t i) { return glm::dvec3(part.position_mm[part.triangles[t + i]]); };
      const glm::dvec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a, h = glm::cross(direction, ac);
      const double det = glm::dot(ab, h);
      if (std::abs(det) < 1e-12) continue;
      const glm::dvec3 s = from - a, q = glm::cross(s, ab);
      const double u = glm::dot(s, h) / det, v = glm::dot(direction, q) / det;
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && glm::dot(ac, q) / det > 0.0) return true;
    }
  }
  return false;
}

TEST(FacePlacementRealData, PlacesARealJawInTheMouth) {
  const fs::path patient = tests::sharedData("patients/right_third_molar"), face = tests::sharedData("faces/ict");
  MOLAR_NEEDS(patient);
  MOLAR_NEEDS(face);
  const ByteImage labels = readLabels((patient / "labels.nrrd").string());
  CtVolume ct{labels.grid, {}, labels.values, {}, {}};
  numberThirdMolar(ct);
  const auto site = siteAtTooth(ct, 48);
  const FacePlacement placement = fitFace(ct, site, readFaceTeeth((face / "teeth.json").string()));
  RecordProperty("rms_mm", std::to_string(placement.rms_mm));
  RecordProperty("teeth", placement.teeth);
  RecordProperty("at_site_mm", std::to_string(placement.at_site_mm));
  EXPECT_LT(placement.rms_mm, 2.0);
  EXPECT_LT(placement.at_site_mm, 12.0);
  EXPECT_GE(placement.teeth, 6);

  // Teeth inside the skin's box; a ray to the side, forward or down from bone meets the skin.
  MeshModel skin = modelInPatientFrame(readGltf((face / "ict_open_no_teeth.glb").string()), placement.X_PF);
  std::erase_if(skin.parts, [](const MeshPart& part) { return part.name != "Face" && part.name != "HeadAndNeck"; });
  ASSERT_EQ(skin.parts.size(), 2u);
  glm::vec3 low(1e9f);
  glm::vec3 high(-1e9f);
  for (const glm::vec3& p : skin.parts[0].position_mm) low = glm::min(low, p), high = glm::max(high, p);
  const double middle_x = 0.5 * (low.x + high.x);
  int sampled = 0;
  int outside = 0;
  int teeth_outside = 0;
  for (int k = 0; k < ct.grid.size.z; k += 3) {
    for (int j = 0; j < ct.grid.size.y; j += 3) {
      for (int i = 0; i < ct.grid.size.x; i += 3) {
        const auto label = static_cast<Tissue>(ct.label[ct.grid.index({i, j, k})]);
        const glm::dvec3 p = ct.grid.centre_P_mm({i, j, k});
        if (label == Tissue::other_teeth) {
          teeth_outside +=
              glm::any(glm::lessThan(p, glm::dvec3(low))) || glm::any(glm::greaterThan(p, glm::dvec3(high)));
        }
        if (label != Tissue::cortical || (i + j + k) % 5 != 0) continue;
        ++sampled;
        outside += meets(skin, p, {p.x < middle_x ? -1.0 : 1.0, 0.02, 0.01}) ? 0 : 1;
      }
    }
  }
  RecordProperty("bone_outside_percent", std::to_string(100.0 * outside / sampled));
  EXPECT_EQ(teeth_outside, 0);
  EXPECT_GT(sampled, 300);
  EXPECT_LT(outside, sampled / 20);
}

}  // namespace
}  // namespace assets
