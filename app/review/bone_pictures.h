// Pictures of the site as it is left, for a report: drawn by the product's renderer on the CPU, without face and gum,
// from above, from the cheek, from the tongue and from in front. Against a plan, bone that was cut outside of it is
// red, bone of it that still stands is blue. Frame P, mm. Any one thread; about a second each.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "assets/volume_grid.h"
#include "haptics/bone/filling.h"
#include "render/image.h"

namespace app {

struct SiteView {
  glm::dvec3 middle_P_mm{0.0};
  glm::dvec3 distal_P{0.0, 1.0, 0.0}, buccal_P{1.0, 0.0, 0.0}, up_P{0.0, 0.0, 1.0};  ///< unit, square to each other
};

struct BoneStates {
  const assets::VolumeGrid& grid;
  std::span<const std::uint8_t> label;              ///< may be empty
  std::span<const std::uint8_t> before, after;      ///< solid, in the order of the grid
  const haptics::Filling::Volumes* laid = nullptr;  ///< into it, drawn as what it is; null: nothing is
};

struct BonePicture {
  std::string from;  ///< "from the cheek"
  render::Image image;
};

/// Of what cut and stands: how far outside or inside of the plan counts.
inline constexpr double kPlanTolerance_mm = 0.3;

/// `from_plan_mm`: signed distance to what was to go, negative inside; empty: no plan.
std::vector<BonePicture> bonePictures(const BoneStates& bone, const SiteView& site,
                                      const std::function<double(const glm::dvec3&)>& from_plan_mm, glm::ivec2 px);

}  // namespace app
