// Scalar type of stored voxels; each file format names it in its own way.
#pragma once

#include <cstddef>
#include <cstdint>

namespace assets {

enum class VoxelType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// f(Stored{}), with the C++ type of one voxel.
template <class Function>
decltype(auto) withVoxelType(VoxelType type, const Function& f) {
  switch (type) {
    case VoxelType::int8:
      return f(std::int8_t{});
    case VoxelType::uint8:
      return f(std::uint8_t{});
    case VoxelType::int16:
      return f(std::int16_t{});
    case VoxelType::uint16:
      return f(std::uint16_t{});
    case VoxelType::int32:
      return f(std::int32_t{});
    case VoxelType::uint32:
      return f(std::uint32_t{});
    case VoxelType::int64:
      return f(std::int64_t{});
    case VoxelType::uint64:
      return f(std::uint64_t{});
    case VoxelType::float32:
      return f(float{});
    case VoxelType::float64:
      break;
  }
  return f(double{});
}

inline std::size_t bytesOf(VoxelType type) {
  return withVoxelType(type, [](auto stored) { return sizeof(stored); });
}

}  // namespace assets
