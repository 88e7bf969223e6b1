// Shading of skin, gingiva and steel. Both sides are drawn; the face is cut away around the line from the eyes to the
// site.
#include "part_block.glsl"
#include "occlusion.glsl"
#include "tool_shade.glsl"
#include "soft_marks.glsl"

layout(location = 0) in vec3 p_P;
layout(location = 1) in vec3 normal_P;
layout(location = 2) in vec4 vertex_tint;

// mm from the rim of the face window, negative inside, where nothing is drawn. Behind the site nothing is cut.
float rimDistance(vec3 p) {
  vec3 line = eye.window_site_P.xyz - eye.window_eye_P.xyz;
  float reach = length(line);
  vec3 axis = line / reach;
  vec3 offset = p - eye.window_eye_P.xyz;
  float along = dot(offset, axis);
  float beyond = along - (reach - RIM_BEHIND);
  float across = length(offset - along * axis) - eye.window_site_P.w;
  return max(across, beyond);
}

// Colour (not premultiplied) and opacity; discards fragments inside the window.
vec4 meshColour() {
  vec3 to_eye = normalize(eye.eye_P.xyz - p_P);
  vec3 normal = normalize(normal_P);
  if (!gl_FrontFacing) normal = -normal;
  vec4 base = part.base_colour * vertex_tint;
  int finish = int(part.finish.z);
  bool is_unlit = finish == FINISH_GUIDE || finish == FINISH_OBSTACLE;
  if (is_unlit && !gl_FrontFacing) discard;

  // The rim of the window is drawn as a cut edge, darker and redder.
  float rim = 1.0;
  if ((int(part.finish.w) & PART_CUT_BY_WINDOW) != 0 && eye.window_site_P.w > 0.0) {
    float away = rimDistance(p_P);
    if (away < 0.0) discard;
    rim = smoothstep(0.0, RIM_WIDTH, away);
  }

  // Marks on gingiva, and on the face without its metal; cut gingiva is gone.
  bool is_soft = finish == FINISH_GINGIVA || (finish == FINISH_SKIN && part.finish.w > 0.5);
  float from_cut = is_soft ? cutDistance(p_P) : SOFT_FAR;
  if (finish == FINISH_GINGIVA && from_cut < 0.0) discard;

  float metallic = part.finish.y;
  Surface s;
  s.roughness = clamp(part.finish.x, MIN_ROUGHNESS, 1.0);
  s.albedo = base.rgb * (1.0 - metallic);
  s.f0 = mix(vec3(MESH_F0), base.rgb, metallic);
  s.wrap = 0.0;
  s.scatter = s.albedo;
  if (finish == FINISH_SKIN) {
    s.wrap = SKIN_WRAP;
    s.f0 = mix(vec3(SKIN_F0), base.rgb, metallic);
    vec3 hue = s.albedo / max(max(s.albedo.r, s.albedo.g), max(s.albedo.b, 1e-3));
    s.scatter = hue * hue;
    s.albedo = mix(s.albedo * vec3(RIM_TINT), s.albedo, rim);
  } else if (finish == FINISH_GINGIVA) {
    s.wrap = GINGIVA_WRAP;
    s.f0 = vec3(GINGIVA_F0);
    s.scatter = vec3(GINGIVA_SCATTER);
  } else if (finish == FINISH_TOOTH) {
    const vec3 kEnamel = FINISH_ENAMEL;
    s.roughness = kEnamel.x;
    s.f0 = vec3(kEnamel.y);
    s.wrap = kEnamel.z;
  }
  if (is_soft) s = marked(s, p_P, from_cut);
  if (is_unlit) {
    // Unlit: it is not part of the patient and is visible inside the bone.
    float facing = abs(dot(normal, to_eye));
    return vec4(base.rgb * mix(GUIDE_DARKEST, 1.0, facing), base.a);
  }
  Visibility visibility = visibilityFromVolume(p_P + MESH_LIFT * normal, normal);
  if (finish == FINISH_INSTRUMENT || finish == FINISH_GLASS) {
    // Steel in a cavity still reflects the opening.
    visibility.ambient = mix(STEEL_MIN_AMBIENT, 1.0, visibility.ambient);
    visibility.lamp = mix(STEEL_MIN_LAMP, 1.0, visibility.lamp);
  } else {
    visibility = besideTool(visibility, p_P, normal);
  }
  visibility.ambient *= gl_FrontFacing ? 1.0 : INSIDE_AMBIENT;
  visibility.lamp *= gl_FrontFacing ? 1.0 : INSIDE_LAMP;
  vec3 light = lit(s, p_P, normal, to_eye, visibility);
  return vec4(finish == FINISH_GINGIVA ? underRing(light, p_P) : light, base.a);
}
