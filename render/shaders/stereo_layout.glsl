// What a pixel of the output shows: which eye, which pixel of it, or black. Twin of display/stereo_layout.h. Pixels
// count from the top left.
#include "anaglyph_constants.glsl"

struct SourcePixel {
  int eye;   // SOURCE_…
  ivec2 px;  // in the eye's image
};

// `at`: position of the output on the panel. `eye_px`: size of an eye's image. `gap`: blank lines of a packed frame.
// `second_output`: the right eye's buffer or window. `swapped`: the display shows left for right.
SourcePixel sourcePixelAt(int mode, ivec2 px, ivec2 at, ivec2 eye_px, int gap, bool second_output, bool swapped) {
  if (mode == DISPLAY_MONO) return SourcePixel(SOURCE_CYCLOPEAN, px);
  if (mode == DISPLAY_ANAGLYPH || mode == DISPLAY_ANAGLYPH_RED_CYAN) return SourcePixel(SOURCE_BOTH, px);
  ivec2 panel = px + at;
  bool second = second_output;
  if (mode == DISPLAY_SIDE_BY_SIDE || mode == DISPLAY_SIDE_BY_SIDE_FULL) {
    second = px.x >= eye_px.x;
    if (second) px.x -= eye_px.x;
  } else if (mode == DISPLAY_TOP_BOTTOM || mode == DISPLAY_TOP_BOTTOM_FULL || mode == DISPLAY_FRAME_PACKING) {
    int below = eye_px.y + (mode == DISPLAY_FRAME_PACKING ? gap : 0);
    second = px.y >= below;
    if (second) px.y -= below;
  } else if (mode == DISPLAY_ROW_INTERLEAVED) {
    second = (panel.y & 1) != 0;
  } else if (mode == DISPLAY_COLUMN_INTERLEAVED) {
    second = (panel.x & 1) != 0;
  } else if (mode == DISPLAY_CHECKERBOARD) {
    second = ((panel.x + panel.y) & 1) != 0;
  }
  if (any(lessThan(px, ivec2(0))) || any(greaterThanEqual(px, eye_px))) return SourcePixel(SOURCE_BLACK, ivec2(0));
  return SourcePixel(second != swapped ? SOURCE_RIGHT : SOURCE_LEFT, px);
}

// Both eyes for red-cyan glasses, in linear light.
vec3 anaglyph(int mode, vec3 left, vec3 right) {
  if (mode == DISPLAY_ANAGLYPH_RED_CYAN) return vec3(left.r, right.gb);
  return clamp(vec3(dot(vec3(DUBOIS_LEFT_RED), left) + dot(vec3(DUBOIS_RIGHT_RED), right),
                    dot(vec3(DUBOIS_LEFT_GREEN), left) + dot(vec3(DUBOIS_RIGHT_GREEN), right),
                    dot(vec3(DUBOIS_LEFT_BLUE), left) + dot(vec3(DUBOIS_RIGHT_BLUE), right)),
               0.0, 1.0);
}
