// The display modes: how the two eyes' images reach the two eyes, and the names of the modes on the command line.
// Plain values; any thread.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "render/shaders/shared_constants.glsl"

namespace render {

enum class DisplayMode {
  mono = DISPLAY_MONO,                            ///< one image, from between the eyes
  quad_buffer = DISPLAY_QUAD_BUFFER,              ///< left and right back buffer of one window, shown by the driver
  two_windows = DISPLAY_TWO_WINDOWS,              ///< a window per eye, on two monitors or projectors
  side_by_side = DISPLAY_SIDE_BY_SIDE,            ///< half: both eyes share the width, the display stretches each
  side_by_side_full = DISPLAY_SIDE_BY_SIDE_FULL,  ///< each eye at full size, the output is twice as wide
  top_bottom = DISPLAY_TOP_BOTTOM,                ///< half: both eyes share the height
  top_bottom_full = DISPLAY_TOP_BOTTOM_FULL,      ///< each eye at full size, the output is twice as high
  frame_packing = DISPLAY_FRAME_PACKING,          ///< HDMI 1.4a: left above right, blank lines between
  row_interleaved = DISPLAY_ROW_INTERLEAVED,
  column_interleaved = DISPLAY_COLUMN_INTERLEAVED,
  checkerboard = DISPLAY_CHECKERBOARD,
  anaglyph = DISPLAY_ANAGLYPH,                    ///< red-cyan glasses, least-squares colours (anaglyph.h)
  anaglyph_red_cyan = DISPLAY_ANAGLYPH_RED_CYAN,  ///< red-cyan glasses, plain channels: full colour, more rivalry
};

struct DisplayModeName {
  DisplayMode mode;
  std::string_view name;  ///< on the command line
};

inline constexpr std::array<DisplayModeName, 13> kDisplayModes = {{
    {DisplayMode::mono, "mono"},
    {DisplayMode::quad_buffer, "quad-buffer"},
    {DisplayMode::two_windows, "two-windows"},
    {DisplayMode::side_by_side, "side-by-side"},
    {DisplayMode::side_by_side_full, "side-by-side-full"},
    {DisplayMode::top_bottom, "top-bottom"},
    {DisplayMode::top_bottom_full, "top-bottom-full"},
    {DisplayMode::frame_packing, "frame-packing"},
    {DisplayMode::row_interleaved, "row-interleaved"},
    {DisplayMode::column_interleaved, "column-interleaved"},
    {DisplayMode::checkerboard, "checkerboard"},
    {DisplayMode::anaglyph, "anaglyph"},
    {DisplayMode::anaglyph_red_cyan, "anaglyph-red-cyan"},
}};

constexpr std::string_view nameOf(DisplayMode mode) { return kDisplayModes[static_cast<std::size_t>(mode)].name; }

constexpr std::optional<DisplayMode> displayModeNamed(std::string_view name) {
  for (const DisplayModeName& known : kDisplayModes)
    if (known.name == name) return known.mode;
  return std::nullopt;
}

}  // namespace render
