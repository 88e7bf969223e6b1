// 5x7 dot glyphs for the labels of CT slices and legends: some capitals, digits, point, <, space. Any thread; pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace render {

inline constexpr int kLetterWidth = 5, kLetterHeight = 7;

/// Rows from the top, bit 4 leftmost.
using GlyphRows = std::array<std::uint8_t, kLetterHeight>;

struct Glyph {
  char letter;
  GlyphRows dots;
};

inline constexpr std::array<Glyph, 27> kGlyphs = {{
    {'A', {0b01110, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001}},
    {'C', {0b01110, 0b10001, 0b10000, 0b10000, 0b10000, 0b10001, 0b01110}},
    {'E', {0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111}},
    {'G', {0b01110, 0b10001, 0b10000, 0b10111, 0b10001, 0b10001, 0b01110}},
    {'I', {0b01110, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110}},
    {'L', {0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b11111}},
    {'M', {0b10001, 0b11011, 0b10101, 0b10101, 0b10001, 0b10001, 0b10001}},
    {'N', {0b10001, 0b11001, 0b10101, 0b10011, 0b10001, 0b10001, 0b10001}},
    {'O', {0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110}},
    {'P', {0b11110, 0b10001, 0b10001, 0b11110, 0b10000, 0b10000, 0b10000}},
    {'R', {0b11110, 0b10001, 0b10001, 0b11110, 0b10100, 0b10010, 0b10001}},
    {'S', {0b01111, 0b10000, 0b10000, 0b01110, 0b00001, 0b00001, 0b11110}},
    {'T', {0b11111, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100}},
    {'U', {0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110}},
    {'X', {0b10001, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001, 0b10001}},
    {'0', {0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110}},
    {'1', {0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110}},
    {'2', {0b01110, 0b10001, 0b00001, 0b00010, 0b00100, 0b01000, 0b11111}},
    {'3', {0b11111, 0b00010, 0b00100, 0b00010, 0b00001, 0b10001, 0b01110}},
    {'4', {0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010}},
    {'5', {0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110}},
    {'6', {0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110}},
    {'7', {0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000}},
    {'8', {0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110}},
    {'9', {0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100}},
    {'.', {0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b01100}},
    {'<', {0b00010, 0b00100, 0b01000, 0b10000, 0b01000, 0b00100, 0b00010}},
}};

/// Empty for other characters.
constexpr GlyphRows glyphRows(char letter) {
  for (const Glyph& known : kGlyphs)
    if (known.letter == letter) return known.dots;
  return {};
}

/// Calls dot(x, y, is_rim) for every pixel of a word in dots of `dot_px`, first those of a rim one pixel wide around
/// the letters, by which a word is legible on any ground.
template <class Dot>
void forWordPixels(std::string_view word, int left, int top, int dot_px, const Dot& dot) {
  for (const bool rim : {true, false})
    for (std::size_t n = 0; n < word.size(); ++n) {
      const GlyphRows rows = glyphRows(word[n]);
      const int from = left + static_cast<int>(n) * (kLetterWidth + 1) * dot_px;
      for (int y = 0; y < kLetterHeight * dot_px; ++y)
        for (int x = 0; x < kLetterWidth * dot_px; ++x) {
          if ((rows[static_cast<std::size_t>(y / dot_px)] >> (kLetterWidth - 1 - x / dot_px) & 1) == 0) continue;
          for (int dy = rim ? -1 : 0; dy <= (rim ? 1 : 0); ++dy)
            for (int dx = rim ? -1 : 0; dx <= (rim ? 1 : 0); ++dx) dot(from + x + dx, top + y + dy, rim);
        }
    }
}

}  // namespace render
