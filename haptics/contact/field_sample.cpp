#include "haptics/contact/field_sample.h"

namespace haptics {
namespace {

/// Eight voxels by their offsets in memory, `dx` … beyond the lowest, interpolated in the order x, y, z.
double interpolated(const std::uint8_t* lowest, std::size_t dx, std::size_t dy, std::size_t dz,
                    const glm::dvec3& part) {
  const auto along_x = [&](std::size_t offset) {
    const double a = lowest[offset], b = lowest[offset + dx];
    return a + part.x * (b - a);
  };
  const auto along_y = [&](std::size_t offset) {
    const double a = along_x(offset), b = along_x(offset + dy);
    return a + part.y * (b - a);
  };
  const double a = along_y(0), b = along_y(dz);
  return a + part.z * (b - a);
}

/// The same where blocks that touch may lie anywhere.
double interpolatedBySlots(const SolidField& field, const glm::ivec3& low, const glm::dvec3& part) {
  std::array<std::uint8_t, 8> byte;
  for (int n = 0; n < 8; ++n)
    byte[static_cast<std::size_t>(n)] = field.solidAt(low + glm::ivec3(n & 1, (n >> 1) & 1, n >> 2));
  return interpolated(byte.data(), 1, 2, 4, part);
}

/// The same where some of the eight lie outside the grid.
double interpolatedAtBorder(const SolidField& field, const glm::ivec3& low, const glm::dvec3& part) {
  double sum = 0.0;
  for (int n = 0; n < 8; ++n) {
    const glm::ivec3 step(n & 1, (n >> 1) & 1, n >> 2);
    if (!field.grid.contains(low + step)) continue;
    const glm::dvec3 share = glm::dvec3(step) * part + glm::dvec3(1 - step) * (1.0 - part);
    sum += share.x * share.y * share.z * field.solidAt(low + step);
  }
  return sum;
}

/// From a voxel to its neighbour along an axis, in memory: within a block, or to the next one.
std::size_t stepFrom(int index, std::size_t within, std::size_t block) {
  return (index & 3) != 3 ? within : block - 3 * within;
}

/// At the grid's border, and where blocks have slots.
[[gnu::noinline]] FieldSample sampleByVoxels(const SolidField& field, const glm::ivec3& low, const glm::dvec3& part,
                                             bool inside) {
  const double sum = inside ? interpolatedBySlots(field, low, part) : interpolatedAtBorder(field, low, part);
  if (sum <= 0.0) return {};
  if (field.label == nullptr) return {sum / 255.0, 0};
  const glm::ivec3 up(part.x >= 0.5, part.y >= 0.5, part.z >= 0.5);
  return {sum / 255.0, field.labelAt(glm::clamp(low + up, glm::ivec3(0), field.grid.size - 1))};
}

[[gnu::always_inline]] inline FieldSample sampleAt(const SolidField& field, const glm::dvec3& index) {
  const glm::ivec3 size = field.grid.size;
  // Also false for NaN.
  const bool near =
      index.x > -1.0 && index.y > -1.0 && index.z > -1.0 && index.x < size.x && index.y < size.y && index.z < size.z;
  if (!near) return {};
  // Rounds down: every index is above -1.
  const glm::ivec3 low(static_cast<int>(index.x + 1.0) - 1, static_cast<int>(index.y + 1.0) - 1,
                       static_cast<int>(index.z + 1.0) - 1);
  const glm::dvec3 part(index.x - low.x, index.y - low.y, index.z - low.z);
  const bool inside =
      low.x >= 0 && low.y >= 0 && low.z >= 0 && low.x + 1 < size.x && low.y + 1 < size.y && low.z + 1 < size.z;
  if (!inside || field.slot_of != nullptr) return sampleByVoxels(field, low, part, inside);

  const auto blocks_x = static_cast<std::size_t>(field.blocks.x), blocks_y = static_cast<std::size_t>(field.blocks.y);
  const std::size_t lowest = field.blockAt(SolidField::blockOf(low)) * kBlockVoxels + SolidField::within(low);
  const std::size_t dx = stepFrom(low.x, 1, kBlockVoxels), dy = stepFrom(low.y, 4, kBlockVoxels * blocks_x),
                    dz = stepFrom(low.z, 16, kBlockVoxels * blocks_x * blocks_y);
  const double sum = interpolated(field.solid + lowest, dx, dy, dz, part);
  if (sum <= 0.0) return {};
  if (field.label == nullptr) return {sum / 255.0, 0};
  const std::size_t nearest = lowest + (part.x >= 0.5 ? dx : 0) + (part.y >= 0.5 ? dy : 0) + (part.z >= 0.5 ? dz : 0);
  return {sum / 255.0, field.label[nearest]};
}

}  // namespace

ToolSampler::ToolSampler(const SolidBodies& bodies,
                         const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT) noexcept {
  for (const SolidBody& body : bodies.bodies()) {
    const calibration::Pose<calibration::Patient, calibration::Tool> tool = body.inBody(X_PT);
    bodies_[count_++] = {body.field, glm::mat3_cast(tool.rotation) / body.field.grid.spacing_mm,
                         body.field.grid.indexFromPoint(tool.translation_mm)};
  }
}

FieldSample ToolSampler::at(const glm::dvec3& position_T_mm) const noexcept {
  if (count_ > 1) return sumAt(position_T_mm);
  return sampleAt(bodies_[0].field, bodies_[0].to_index * position_T_mm + bodies_[0].origin);
}

FieldSample ToolSampler::sumAt(const glm::dvec3& position_T_mm) const noexcept {
  FieldSample sum;
  double largest = 0.0;
  for (std::size_t n = 0; n < count_; ++n) {
    const FieldSample part = sampleAt(bodies_[n].field, bodies_[n].to_index * position_T_mm + bodies_[n].origin);
    sum.solid += part.solid;
    if (part.solid <= largest) continue;
    largest = part.solid;
    sum.label = part.label;
  }
  // Pieces that press into one another count once.
  sum.solid = sum.solid > 1.0 ? 1.0 : sum.solid;
  return sum;
}

}  // namespace haptics
