// Water, blood, dust and spray on tooth and bone, and the light in narrow hollows that hold fluid. C++:
// surgical_field.h; CPU twin: cpu/field_body.h. Without any cover nothing changes.
#include "lighting.glsl"
#include "field_constants.glsl"

bool isCovered() { return eye.field_cover != vec4(0.0); }

// 1 at the middle of the site, 0 far away.
float nearSite(vec3 p_P) {
  vec3 offset = p_P - eye.field_P.xyz;
  return exp2(-min(eye.field_P.w * dot(offset, offset), FIELD_FARTHEST));
}

// Share of fluid in a hollow, from the open share of the room.
float hollowness(float open) { return smoothstep(FIELD_HOLLOW_FROM, FIELD_HOLLOW_TO, 1.0 - open); }

// `mottle`: noise of the tissue about 0; `open`: share of the room that is seen; `marrow`: share of open marrow.
Surface covered(Surface s, vec3 p_P, vec3 normal, float marrow, float mottle, float open) {
  if (!isCovered()) return s;
  vec4 cover = eye.field_cover;
  float near = nearSite(p_P), hollow = hollowness(open);

  // Blood from cut marrow, in streaks beside it, and in hollows.
  float bleeding = marrow * FIELD_MARROW_BLEEDS * smoothstep(FIELD_BLOOD_FROM, FIELD_BLOOD_TO, mottle);
  float streaks = FIELD_STREAKS * near * smoothstep(FIELD_STREAKS_FROM, FIELD_STREAKS_TO, mottle);
  float blood = cover.y * max(bleeding, streaks);
  s.albedo = mix(s.albedo, vec3(FIELD_HOLLOW_COLOUR), FIELD_HOLLOW_COVER * hollow);
  s.albedo = mix(s.albedo, vec3(FIELD_BLOOD_COLOUR), blood);

  // The film of water, thicker where blood and hollows hold it.
  float film = clamp(cover.x * mix(0.5, 1.0, near) * (1.0 + FIELD_FILM_PATCHES * mottle), 0.0, 1.0);
  film = max(film, max(blood, hollow));
  s.albedo *= 1.0 - FIELD_WET_DARKENS * film * (1.0 - s.wrap);
  s.roughness = mix(s.roughness, min(s.roughness, FIELD_WET_ROUGHNESS), film);
  s.f0 = mix(s.f0, max(s.f0, vec3(FIELD_WET_F0)), film);

  // Dust lies on what faces up.
  float slope = FIELD_DUST_SLOPE * dot(normal, eye.up_P.xyz);
  float dust = cover.z * near * smoothstep(FIELD_DUST_FROM, FIELD_DUST_TO, mottle + slope);
  s.albedo = mix(s.albedo, vec3(FIELD_DUST_COLOUR), dust);
  s.roughness = mix(s.roughness, FIELD_DUST_ROUGHNESS, dust);
  s.wrap *= 1.0 - dust;
  s.scatter = s.albedo;
  return s;
}

// Fluid in a hollow scatters light to where the cones see none.
Visibility litHollow(Visibility visibility) {
  if (!isCovered()) return visibility;
  float hollow = hollowness(visibility.ambient);
  visibility.ambient = max(visibility.ambient, FIELD_HOLLOW_AMBIENT * hollow);
  visibility.lamp = max(visibility.lamp, FIELD_HOLLOW_LAMP * hollow);
  return visibility;
}

// The mist of the irrigation between site and eye.
vec3 throughSpray(vec3 light, vec3 p_P) {
  if (eye.field_cover.w == 0.0) return light;
  return mix(light, vec3(FIELD_SPRAY_COLOUR), FIELD_SPRAY_COVER * eye.field_cover.w * nearSite(p_P));
}
