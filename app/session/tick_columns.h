// The ticks of a session as columns. A column says what it is called, how a value is stored, its unit and its frame;
// the table of them goes into the file, so a program with more or fewer columns still reads it: what it does not know
// it passes by, what is not there has the value of a Tick as it is made. A block holds column after column; a column
// is stored plane by plane (the lowest byte of every tick, then the next …), little-endian, reals as their IEEE 754
// bits: a round trip is bit-exact on every machine, and neighbouring ticks compress.
// Not stored: removed_total_mm3, which each block has once. Any thread; O(bytes), allocates. Not the compression.
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
  std::string unit;     ///< "mm", "N"; empty: a count, a number or a yes and no
  std::string frame;    ///< "P"; empty: none
  std::string meaning;  ///< of the numbers of an enumeration: "off 0, calibrate 1, …"

  bool operator==(const TickColumn&) const = default;
};

/// As this program writes them.
const std::vector<TickColumn>& tickColumns();
std::vector<std::uint8_t> packTicks(std::span<const haptics::Tick> ticks);

/// Reads blocks that were stored with the columns of a table.
class TickUnpacker {
 public:
  /// Throws SessionError for a type that is none.
  explicit TickUnpacker(std::span<const TickColumn> stored);

  /// Of all stored columns, known or not.
  std::size_t bytesPerTick() const { return bytes_per_tick_; }
  /// Throws SessionError if `bytes` is no whole number of ticks.
  std::vector<haptics::Tick> unpack(std::span<const std::uint8_t> bytes) const;

 private:
  struct Type {
    char kind = 'u';
    std::uint8_t bytes = 1;
    bool operator==(const Type&) const = default;
  };
  /// A stored column that a Tick has, and where in a packed tick it goes.
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
