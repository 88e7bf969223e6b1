// Text that a scanner wrote into its pictures, which may name the patient: at least eight pieces of the brightest value
// on one line, of equal height from 3 to 30 pixels, the same in three slices or more. Found lines are blanked in all
// slices. Digits 1 and hyphens in them are blanked with the line. Any thread; one pass over the volume, 0.1 s for
// 512^3.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

/// Columns and rows of a line of text: `low` included, `end` not.
struct TextBox {
  glm::ivec2 low{0}, end{0};

  bool operator==(const TextBox&) const = default;
};

/// `grey`: size.x columns, size.y rows, size.z slices, columns fastest; values equal to `no_value` are no text.
std::vector<TextBox> burntInText(glm::ivec3 size, std::span<const std::int16_t> grey, std::int16_t no_value);

/// Sets the boxes to `no_value` in every slice.
void blankText(glm::ivec3 size, const std::vector<TextBox>& boxes, std::int16_t no_value, std::span<std::int16_t> grey);

}  // namespace assets
