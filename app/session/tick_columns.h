// The ticks of a session as columns. A column has a name, a storage type, a unit and a frame; the table of columns is
// stored in the file, so other versions can read it: unknown columns are ignored, missing ones have the default of a
// Tick. A block stores column after column, each plane by plane (the lowest byte of every tick, then the next),
// little-endian, reals as IEEE 754 bits: bit-exact on every machine, and easy to compress. removed_total_mm3 is stored
// once per block, not per tick. Any thread; O(bytes), allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "haptics/servo/tick.h"

namespace app {

struct TickColumn {
  std::string name;     ///< path of the member in haptics::Tick: "hand.X_PT.translation_mm.x"
  std::string type;     ///< u, i or f and its bits: "u8", "u64", "f32", "f64"
  std::string unit;     ///< "mm", "N"; empty: dimensionless, or a flag
  std::string frame;    ///< "P"; empty: none
  std::string meaning;  ///< values of an enumeration: "off 0, calibrate 1, …"

  bool operator==(const TickColumn&) const = default;
};

/// The columns this program writes.
const std::vector<TickColumn>& tickColumns();
std::vector<std::uint8_t> packTicks(std::span<const haptics::Tick> ticks);
/// Of every column but work_us: two ticks with the same digest are the same, bit for bit.
std::uint64_t digestOf(const haptics::Tick& tick);

/// Reads blocks stored with the columns of a table.
class TickUnpacker {
 public:
  /// Throws SessionError for an unknown type.
  explicit TickUnpacker(std::span<const TickColumn> stored);

  /// Of all stored columns, including unknown ones.
  std::size_t bytesPerTick() const { return bytes_per_tick_; }
  /// Throws SessionError if `bytes` is not a whole number of ticks.
  std::vector<haptics::Tick> unpack(std::span<const std::uint8_t> bytes) const;

 private:
  struct Type {
    char kind = 'u';
    std::uint8_t bytes = 1;
    bool operator==(const Type&) const = default;
  };
  /// A stored column that a Tick has, and its place in a packed tick.
  struct Route {
    std::size_t from = 0, to = 0;
    Type stored, own;
  };
  static Type typeOf(const std::string& text);
  static std::uint64_t converted(std::uint64_t bits, Type from, Type to);

  std::vector<Route> routes_;
  std::vector<std::uint8_t> default_row_;
  std::size_t bytes_per_tick_ = 0;
};

}  // namespace app
