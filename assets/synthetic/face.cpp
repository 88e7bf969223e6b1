#include "assets/synthetic/face.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "assets/load_error.h"
#include "assets/synthetic/cheek_retractor.h"
#include "assets/synthetic/drape_shape.h"
#include "assets/synthetic/face_colours.h"
#include "assets/synthetic/face_frames.h"
#include "assets/synthetic/facial_hair.h"
#include "assets/synthetic/head_shape.h"
#include "assets/synthetic/mouth_interior.h"
#include "assets/synthetic/surface_mesher.h"
#include "assets/tooth.h"

namespace assets {
namespace {

using glm::dvec3;

// Depth under the cloth at which skin and mouth end.
constexpr double kTucked_mm = 9.0;
constexpr BoundingBox kFaceBox{{-80, -60, -80}, {80, 120, 170}};
constexpr BoundingBox kMouthBox{{-45, -16, -50}, {45, 100, 80}};
constexpr BoundingBox kCapBox{{-100, -60, 0}, {100, 240, 240}};
constexpr BoundingBox kDrapeBox{{-150, -40, -150}, {150, 190, 10}};

MeshPart coloured(MeshPart part, const std::string& name, const Material& material,
                  const std::function<glm::vec3(const dvec3& p, const dvec3& n)>& colour_at) {
  part.name = name;
  part.material = material;
  part.colour.resize(part.position_mm.size());
  tbb::parallel_for(std::size_t{0}, part.colour.size(), [&](std::size_t n) {
    part.colour[n] = glm::vec4(colour_at(part.position_mm[n], part.normal[n]), 1.0f);
  });
  return part;
}

// The wanted triangles with the vertices they use.
MeshPart selected(const MeshPart& from, const std::vector<bool>& wanted) {
  MeshPart to;
  to.name = from.name;
  to.material = from.material;
  std::vector<std::uint32_t> renumbered(from.position_mm.size(), UINT32_MAX);
  for (std::size_t t = 0; t < from.triangles.size() / 3; ++t) {
    if (!wanted[t]) continue;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t old = from.triangles[3 * t + corner];
      if (renumbered[old] == UINT32_MAX) {
        renumbered[old] = static_cast<std::uint32_t>(to.position_mm.size());
        to.position_mm.push_back(from.position_mm[old]);
        to.normal.push_back(from.normal[old]);
        to.colour.push_back(from.colour[old]);
      }
      to.triangles.push_back(renumbered[old]);
    }
  }
  return to;
}

// Skin and the lining of the mouth: one surface, two materials.
void addFace(MeshModel& model, const HeadShape& head, const FaceColours& colours, double voxel_mm,
             const ReportProgress& report) {
  const auto visible = [&](const dvec3& p) {
    const double under_cap = depthUnderCap_mm(head.opening().skullFromMandible(p));
    const double hidden = std::max({under_cap - kTucked_mm, depthUnderDrape_mm(p) - kTucked_mm, p.y - 112.0});
    return hidden > 25.0 ? hidden : std::max(head.distance_mm(p), hidden);
  };
  const MeshPart whole =
      coloured(meshOf(visible, kFaceBox, voxel_mm, 0.002, report), "Face", {glm::vec4(1.0f), 0.52f, 0.0f},
               [&](const dvec3& p, const dvec3& n) { return colours.head(p, n); });
  std::vector<bool> wet(whole.triangles.size() / 3);
  for (std::size_t t = 0; t < wet.size(); ++t) wet[t] = colours.isWet(whole.position_mm[whole.triangles[3 * t]]);
  model.parts.push_back(selected(whole, wet));
  model.parts.back().name = "Mouth";
  model.parts.back().material.roughness = 0.3f;
  wet.flip();
  model.parts.push_back(selected(whole, wet));
}

MeshPart cloth(MeshPart part, const std::string& name) {
  return coloured(std::move(part), name, {{0.035f, 0.21f, 0.175f, 1.0f}, 0.9f, 0.0f}, [](const dvec3& p, const dvec3&) {
    const double weave = 1.0 + 0.05 * std::sin(0.21 * p.x + 0.13 * p.y) * std::sin(0.17 * p.z - 0.11 * p.x);
    return glm::vec3(static_cast<float>(weave));
  });
}

void mirror(MeshModel& model) {
  for (MeshPart& part : model.parts) {
    for (glm::vec3& p : part.position_mm) p.x = -p.x;
    for (glm::vec3& n : part.normal) n.x = -n.x;
    for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3)
      std::swap(part.triangles[t + 1], part.triangles[t + 2]);
  }
}

void requireInRange(const FaceParameters& parameters) {
  if (parameters.tooth_fdi != 48 && parameters.tooth_fdi != 38) {
    throw LoadError("face: tooth " + std::to_string(parameters.tooth_fdi) +
                    " is not a lower third molar, give 38 or 48");
  }
  if (!(parameters.voxel_mm >= 0.6 && parameters.voxel_mm <= 3.0)) {
    throw LoadError("face: voxel size is outside 0.6..3 mm, give one inside");
  }
  if (!(parameters.opening_mm >= kLeastOpening_mm && parameters.opening_mm <= kMostOpening_mm)) {
    throw LoadError("face: opening of the mouth is outside 25..50 mm, give one inside");
  }
}

}  // namespace

glm::dvec3 surgeonEyeDirection(int tooth_fdi) {
  return glm::normalize(dvec3(isRight(tooth_fdi) ? -0.11 : 0.11, -0.87, isUpper(tooth_fdi) ? -0.46 : 0.46));
}

MeshModel syntheticFace(const FaceParameters& parameters, const ReportProgress& report) {
  requireInRange(parameters);
  const HeadShape head{MouthOpening(parameters.opening_mm)};
  const FaceColours colours(head, parameters.seed);

  MeshModel model;
  addFace(model, head, colours, parameters.voxel_mm, sectionOf(report, 0.2, 0.7));
  const ReportProgress rest = sectionOf(report, 0.7, 1.0);
  rest(0.1);
  const auto tooth = [&](const dvec3& p, const dvec3& n) { return colours.tooth(p, n); };
  const Material enamel{glm::vec4(1.0f), 0.22f, 0.0f};
  model.parts.push_back(coloured(
      meshOf([&](const dvec3& p) { return upperTeeth_mm(head.opening().skullFromMandible(p)); }, kMouthBox, 0.7, 0.0),
      "UpperTeeth", enamel, tooth));
  model.parts.push_back(coloured(meshOf(lowerTeeth_mm, kMouthBox, 0.45, 0.0), "LowerTeeth", enamel, tooth));
  model.parts.push_back(coloured(meshOf(tongue_mm, kMouthBox, 1.0, 0.0), "Tongue", {glm::vec4(1.0f), 0.38f, 0.0f},
                                 [&](const dvec3& p, const dvec3& n) { return colours.tongue(p, n); }));
  MeshPart hair = facialHair(head, parameters.seed);
  hair.name = "Hair";
  hair.material = {{0.06f, 0.032f, 0.02f, 1.0f}, 0.55f, 0.0f};
  model.parts.push_back(std::move(hair));
  model.parts.push_back(cloth(meshOf([&](const dvec3& p) { return cap_mm(head, p); }, kCapBox, 2.0, 0.02), "Cap"));
  model.parts.push_back(
      cloth(meshOf([&](const dvec3& p) { return drape_mm(head, p); }, kDrapeBox, 2.2, 0.02), "Drape"));
  MeshPart retractor = cheekRetractor(head.rim());
  retractor.name = "Retractor";
  retractor.material = {{0.58f, 0.59f, 0.60f, 1.0f}, 0.3f, 1.0f};
  model.parts.push_back(std::move(retractor));

  // Modelled with the operated side at +x, the patient's left.
  if (parameters.tooth_fdi == 48) mirror(model);
  return model;
}

}  // namespace assets
