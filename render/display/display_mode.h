// How the two eyes' images reach the two eyes: what kind of display it is, and the words people type for it.
// Plain values; any thread.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace render {

enum class DisplayMode {
  mono,               ///< one image, from between the eyes
  quad_buffer,        ///< left and right back buffer of one window; the driver and the glasses do the rest
  two_windows,        ///< a window an eye, on two monitors or projectors
  side_by_side,       ///< half: both eyes share the width, the display stretches each
  side_by_side_full,  ///< each eye at full size, the output is twice as wide
  top_bottom,         ///< half: both eyes share the height
  top_bottom_full,    ///< each eye at full size, the output is twice as high
  frame_packing,      ///< HDMI 1.4a: left above right, blank lines between
  row_interleaved,
  column_interleaved,
  checkerboard,
  anaglyph,           ///< red-cyan glasses, least-squares colours (anaglyph.h)
  anaglyph_red_cyan,  ///< red-cyan glasses, plain channels: full colour, more rivalry
};

struct DisplayModeName {
  DisplayMode mode;
  std::string_view name;  ///< as people type it
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
