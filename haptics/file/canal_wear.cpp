#include "haptics/file/canal_wear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "haptics/file/material_frame.h"

namespace haptics {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec3;

constexpr std::size_t kMostBlocks = 192;  ///< that a section's surface meets; the rest waits for the next turn
constexpr double kHalfBlock = 1.5;        ///< from its middle to its outer voxels, along an axis
constexpr double kLeastDue_mm3 = 1e-10;

/// A section's frame and the depth of its rays.
struct PressedSection {
  SectionPlace at;
  dvec3 e1, e2;
  std::array<double, kRays> depth_mm;
  double deepest_mm;
};

struct PressedBlock {
  ivec3 block;
  std::array<std::uint16_t, kBlockVoxels> coverage;
  std::array<std::uint32_t, kBlockVoxels> exposure;
};

/// How many rays from e1 a direction lies, counted round the axis; linear in between, so that no angle is needed.
double rayOf(double x, double y) {
  static_assert(kRays == 16);
  constexpr std::array<double, 5> kFrom{0.0, 0.29289321881345254, 0.5, 0.70710678118654746, 1.0};
  const double sum = std::fabs(x) + std::fabs(y);
  if (!(sum > 0.0)) return 0.0;
  const int quarter = y >= 0.0 ? (x > 0.0 ? 0 : 1) : (x < 0.0 ? 2 : 3);
  const double part = (quarter % 2 == 0 ? std::fabs(y) : std::fabs(x)) / sum;
  const std::size_t ray = part < kFrom[2] ? (part < kFrom[1] ? 0 : 1) : (part < kFrom[3] ? 2 : 3);
  return 4.0 * quarter + static_cast<double>(ray) + (part - kFrom[ray]) / (kFrom[ray + 1] - kFrom[ray]);
}

double depthTowards_mm(const PressedSection& section, double x, double y) {
  const double ray = rayOf(x, y);
  const auto before = static_cast<std::size_t>(ray);
  const double share = ray - static_cast<double>(before);
  return (1.0 - share) * section.depth_mm[before % kRays] + share * section.depth_mm[(before + 1) % kRays];
}

/// Of the tissues, relative to dentine.
constexpr auto kSoftness = [] {
  std::array<double, assets::kTissueCount> softness{};
  for (std::size_t tissue = 0; tissue < softness.size(); ++tissue)
    softness[tissue] = assets::kTissues[tissue].removal_factor /
                       assets::kTissues[static_cast<std::size_t>(assets::Tissue::dentine)].removal_factor;
  return softness;
}();
double softness(std::uint8_t label) { return kSoftness[label < kSoftness.size() ? label : 0]; }

/// Where the section may take something of a block: as much of each voxel as the file covers, in a face as smooth as it
/// is felt, by the depth there. Returns the sum of what a loss of 1 takes, in voxels; 0: nothing.
double pressedOn(const PressedSection& section, const SolidField& field, ivec3 block, PressedBlock& out) {
  const SectionPlace& at = section.at;
  const double s = field.grid.spacing_mm, half_mm = 0.5 * (at.length_mm + s);
  const dvec3 middle = field.grid.centre_P_mm(kBlockEdge * block) + kHalfBlock * s - at.centre_P_mm;
  const double beside = glm::dot(middle, at.axis), across2 = glm::dot(middle, middle) - beside * beside;
  const double around_mm = std::numbers::sqrt3 * kHalfBlock * s, far_mm = at.radius_mm + s + around_mm;
  if (std::fabs(beside) > half_mm + around_mm || across2 > far_mm * far_mm) return 0.0;

  const std::size_t start = field.slotAt(block) * kBlockVoxels;
  const std::uint8_t* const solid = field.solid + start;
  const std::uint8_t* const label = field.label == nullptr ? nullptr : field.label + start;
  double sum = 0.0;
  for (int v = 0; v < kBlockVoxels; ++v) {
    const auto n = static_cast<std::size_t>(v);
    out.coverage[n] = 0;
    out.exposure[n] = 0;
    if (solid[n] == 0) continue;
    const dvec3 away = middle + (dvec3(v & 3, v >> 2 & 3, v >> 4) - kHalfBlock) * s;
    if (std::fabs(glm::dot(away, at.axis)) > half_mm) continue;
    const double x = glm::dot(away, section.e1), y = glm::dot(away, section.e2);
    const double beyond_mm = std::sqrt(x * x + y * y) - at.radius_mm;
    const double outside = std::clamp(0.5 + 0.5 * beyond_mm / s, 0.0, 1.0);
    if (static_cast<double>(solid[n]) <= 255.0 * outside) continue;
    const double deep = std::min(1.0, depthTowards_mm(section, x, y) / section.deepest_mm);
    if (!(deep > 0.0)) continue;
    const double covered = 1.0 - outside;
    out.coverage[n] = static_cast<std::uint16_t>(65535.0 * covered);
    out.exposure[n] = static_cast<std::uint32_t>(65535.0 * covered * deep);
    sum += covered * deep * softness(label == nullptr ? std::uint8_t{0} : label[n]);
  }
  out.block = block;
  return sum;
}

}  // namespace

double wornVolume_mm3(const WearSettings& settings, double normal_N, double touched_mm2, const dvec2& slip_mm,
                      double radius_mm, double lead_mm) noexcept {
  const double tangent = 2.0 * std::numbers::pi * radius_mm / lead_mm,
               cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
  const double across_mm = std::fabs(slip_mm.x * tangent * cosine - slip_mm.y * cosine);
  const double eta = slip_mm.x > 0.0 ? settings.push_share : 1.0;
  switch (settings.law) {
    case WearLaw::wear:
      return settings.alpha_mm3_per_Nmm * normal_N * across_mm * eta;
    case WearLaw::counters:
      return settings.counter * touched_mm2 * std::fabs(slip_mm.x);
    case WearLaw::counters_helical:
      return settings.counter * touched_mm2 * across_mm;
  }
  return 0.0;
}

WearSettings sanitised(const WearSettings& settings) noexcept {
  constexpr WearSettings kUsual;
  const auto within = [](double value, double most, double usual) {
    return value >= 0.0 && value <= most ? value : usual;
  };
  return {settings.law <= WearLaw::counters_helical ? settings.law : kUsual.law,
          within(settings.alpha_mm3_per_Nmm, 1.0, kUsual.alpha_mm3_per_Nmm),
          within(settings.push_share, 1.0, kUsual.push_share), within(settings.counter, 1.0, kUsual.counter)};
}

SectionPlace CanalWear::placeOf(const FileInCanal& file, std::size_t section) noexcept {
  const FileChain& chain = file.chain();
  const ChainShape& shape = file.state().shape;
  const bool is_tip = section == chain.links;
  const dvec3& d = shape.direction[section];
  return {shape.node_mm[section], is_tip ? d : unitOf(d + shape.direction[section + 1]), chain.radius_mm[section],
          is_tip ? 0.5 * chain.link_mm : chain.link_mm};
}

CarveResult CanalWear::step(const FileInCanal& file, CarvedBone& wall, StrokeHistory* strokes, std::uint64_t tick,
                            FileFlutes* flutes) noexcept {
  const FileChain& chain = file.chain();
  const FileState& state = file.state();
  std::array<std::size_t, kWornAtOnce> most{};
  for (std::size_t i = 1; i <= chain.links; ++i) {
    Section& section = of_[i];
    if (!(state.normal_N[i] > 0.0)) {
      section.touched_mm2 = 0.0;
      continue;
    }
    if (section.touched_mm2 == 0.0) lookAt(file.law(), wall.field(), placeOf(file, i), section);
    const double eta = flutes != nullptr && settings_.law == WearLaw::wear ? flutes->eta(i) : 1.0;
    const double worn_mm3 = eta * wornVolume_mm3(settings_, state.normal_N[i], section.touched_mm2, state.slip_mm[i],
                                                 chain.radius_mm[i], chain.lead_mm);
    section.due_mm3 += worn_mm3;
    due_mm3_ += worn_mm3;
    // Node 0 is none of them: nothing is due there.
    std::size_t candidate = i;
    for (std::size_t& one : most)
      if (of_[candidate].due_mm3 > of_[one].due_mm3) std::swap(candidate, one);
  }
  CarveResult taken;
  for (const std::size_t i : most) {
    if (i == 0) continue;
    const CarveResult one = take(file.law(), placeOf(file, i), of_[i], wall, strokes, tick);
    if (flutes != nullptr) flutes->add(i, one.removed_mm3);
    taken += one;
  }
  removed_mm3_ += taken.removed_mm3;
  return taken;
}

bool CanalWear::lookAt(const FileLaw& law, const SolidField& field, const SectionPlace& at, Section& section,
                       std::array<double, kRays>* depth_mm) noexcept {
  std::array<double, kRays> own{};
  std::array<double, kRays>& depths = depth_mm == nullptr ? own : *depth_mm;
  section.touched_mm2 = 0.0;
  if (!rayDepths(law, field, at, depths)) return false;
  const auto touching = std::count_if(depths.begin(), depths.end(), [](double depth) { return depth > 0.0; });
  section.touched_mm2 = static_cast<double>(touching) / kRays * 2.0 * std::numbers::pi * at.radius_mm * at.length_mm;
  return true;
}

CarveResult CanalWear::take(const FileLaw& law, const SectionPlace& at, Section& section, CarvedBone& wall,
                            StrokeHistory* strokes, std::uint64_t tick) noexcept {
  CarveResult taken;
  const SolidField field = wall.field();
  const std::array<dvec3, kRays> rays = raysAbout(at.axis);
  PressedSection pressed{at, rays[0], rays[kRays / 4], {}, 0.0};
  if (!lookAt(law, field, at, section, &pressed.depth_mm)) return taken;
  pressed.deepest_mm = *std::max_element(pressed.depth_mm.begin(), pressed.depth_mm.end());
  if (section.due_mm3 < kLeastDue_mm3 || !(pressed.deepest_mm > 0.0)) return taken;

  // Where it presses.
  const double s = field.grid.spacing_mm;
  const dvec3 aside = at.radius_mm * glm::sqrt(glm::max(dvec3(0.0), 1.0 - at.axis * at.axis));
  const dvec3 reach = aside + 0.5 * at.length_mm * glm::abs(at.axis) + 2.0 * s;
  const VoxelBox box(field.grid, field.grid.indexFromPoint(at.centre_P_mm - reach),
                     field.grid.indexFromPoint(at.centre_P_mm + reach));
  if (box.empty()) return taken;
  std::array<PressedBlock, kMostBlocks> blocks;
  std::size_t count = 0;
  double yield = 0.0;
  assets::forVoxels(box.first / kBlockEdge, box.last / kBlockEdge + 1, [&](ivec3 block) {
    if (count == kMostBlocks || field.weight[field.slotAt(block)] == 0) return;
    const double sum = pressedOn(pressed, field, block, blocks[count]);
    if (!(sum > 0.0)) return;
    yield += sum;
    ++count;
  });
  if (!(yield > 0.0)) return taken;

  // By depth and by what may go.
  const double voxel_mm3 = field.grid.voxelVolume_mm3(), loss = section.due_mm3 / (yield * voxel_mm3);
  BlockCut cut;
  for (std::size_t tissue = 0; tissue < cut.loss_q32.size(); ++tissue) {
    const double of_tissue = std::min(1.0, loss * softness(static_cast<std::uint8_t>(tissue)));
    cut.loss_q32[tissue] = static_cast<std::uint32_t>(of_tissue * 4294967295.0);
  }
  cut.tick = tick;
  std::array<std::int64_t, assets::kTissueCount> steps{};
  for (std::size_t n = 0; n < count; ++n) {
    cut.coverage = blocks[n].coverage;
    cut.exposure = blocks[n].exposure;
    wall.cutBlock(blocks[n].block, cut, steps, strokes);
  }
  for (std::size_t tissue = 0; tissue < steps.size(); ++tissue) {
    const double removed_mm3 = static_cast<double>(steps[tissue]) * voxel_mm3 / 255.0;
    taken.removed_mm3_by_label[tissue] = removed_mm3;
    taken.removed_mm3 += removed_mm3;
  }
  section.due_mm3 -= taken.removed_mm3;
  return taken;
}

}  // namespace haptics
