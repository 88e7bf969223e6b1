// Uniforms of an eye. Frame P, mm; C++ twin: render::EyeBlock.
#include "shared_constants.glsl"

layout(std140, binding = EYE_BLOCK) uniform EyeBlock {
  mat4 clip_from_P;      // reverse-Z, 0..1
  vec4 eye_P;
  vec4 lower_left_P;     // corner of the virtual screen
  vec4 right_edge_P;     // from there along the rows of the image
  vec4 up_edge_P;        // from there along its columns
  vec4 lamp_P;           // w: distance at which the lamp gives its nominal light
  vec4 lamp_axis_P;      // unit, from the lamp
  vec4 up_P;             // unit, away from the floor
  vec4 window_eye_P;     // the face window is around the line from here
  vec4 window_site_P;    // to here; w: its radius, 0 for none
  vec4 field_P;          // centre of the operated site; w: 1 / (ln 2 · reach²), 0: everywhere
  vec4 field_cover;      // water, blood, dust, spray there, 0..1; all 0: dry
  vec4 begin_P;          // in a reflected view: out of the glass; w: how far this eye lies behind it. 0: rays begin here
  vec4 glass;            // x: 1 if the glass of the second hand reflects, y: its fog
  vec4 curing_P;         // tip of a curing lamp; w: how far its light reaches, 0: it is off
  vec4 curing_axis_P;    // unit, away from it; w: radius of its light
} eye;

// Unit direction from the eye through a point of the image, 0..1 from its lower left.
vec3 rayDirection(vec2 uv) {
  return normalize(eye.lower_left_P.xyz - eye.eye_P.xyz + uv.x * eye.right_edge_P.xyz + uv.y * eye.up_edge_P.xyz);
}

// mm along a ray to where it begins: the glass, in what is seen in it.
float rayBegin(vec3 direction) {
  return eye.begin_P.w == 0.0 ? 0.0 : eye.begin_P.w / max(dot(direction, eye.begin_P.xyz), 1e-6);
}

// Reverse-Z depth of a point, the same for rays and triangles.
float depthOf(vec3 p_P) {
  vec4 clip = eye.clip_from_P * vec4(p_P, 1.0);
  return clip.z / clip.w;
}
