#version 450
// The last pass: averages the samples of each pixel in linear light, selects the eye of every output pixel, and encodes
// sRGB, once. Eye images smaller than their area of the output are scaled bilinearly.
#include "shared_constants.glsl"
#include "shoulder.glsl"
#include "stereo_layout.glsl"

layout(std140, binding = OUTPUT_BLOCK) uniform OutputBlock {
  ivec4 mode;       // x: DISPLAY_…, y: samples along each edge of a pixel, z: second output, w: eyes swapped
  ivec4 output_px;  // xy: position of the output on the panel, zw: size of the output, px
  ivec4 eye;        // xy: size of an eye's image, z: blank lines of a packed frame
} job;

layout(binding = LEFT_EYE_UNIT) uniform sampler2D left_eye;
layout(binding = RIGHT_EYE_UNIT) uniform sampler2D right_eye;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 colour;

// A drawn pixel, counted from the lower left, clamped to the edge.
vec3 resolved(sampler2D image, ivec2 size, ivec2 pixel) {
  pixel = clamp(pixel, ivec2(0), size - 1);
  vec3 sum = vec3(0.0);
  for (int j = 0; j < job.mode.y; ++j)
    for (int i = 0; i < job.mode.y; ++i)
      sum += shoulder(texelFetch(image, pixel * job.mode.y + ivec2(i, j), 0).rgb);
  return sum / float(job.mode.y * job.mode.y);
}

// The eye's image at a pixel of its area, counted from the top left.
vec3 seen(sampler2D image, ivec2 px) {
  ivec2 size = textureSize(image, 0) / job.mode.y;
  px.y = job.eye.y - 1 - px.y;
  if (size == job.eye.xy) return resolved(image, size, px);
  vec2 at = (vec2(px) + 0.5) * vec2(size) / vec2(job.eye.xy) - 0.5;
  ivec2 low = ivec2(floor(at));
  vec2 part = at - vec2(low);
  return mix(mix(resolved(image, size, low), resolved(image, size, low + ivec2(1, 0)), part.x),
             mix(resolved(image, size, low + ivec2(0, 1)), resolved(image, size, low + ivec2(1, 1)), part.x),
             part.y);
}

// IEC 61966-2-1.
vec3 srgb(vec3 x) {
  return mix(12.92 * x, 1.055 * pow(max(x, 1e-6), vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308)));
}

vec3 light() {
  ivec2 px = ivec2(int(gl_FragCoord.x), job.output_px.w - 1 - int(gl_FragCoord.y));
  SourcePixel shown = sourcePixelAt(job.mode.x, px, job.output_px.xy, job.eye.xy, job.eye.z, job.mode.z != 0, job.mode.w != 0);
  if (shown.eye == SOURCE_BLACK) return vec3(0.0);
  if (shown.eye == SOURCE_RIGHT) return seen(right_eye, shown.px);
  if (shown.eye != SOURCE_BOTH) return seen(left_eye, shown.px);
  vec3 left = seen(left_eye, shown.px), right = seen(right_eye, shown.px);
  return job.mode.w != 0 ? anaglyph(job.mode.x, right, left) : anaglyph(job.mode.x, left, right);
}

void main() { colour = vec4(srgb(clamp(light(), 0.0, 1.0)), 1.0); }
