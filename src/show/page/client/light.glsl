// The functions of src/show/rooms/shades.rs once more: a change there is a change here.

float fresnel(float cosine, float roughness) {
  return F0 + (max(1.0 - roughness, F0) - F0) * pow(1.0 - clamp(cosine, 0.0, 1.0), 5.0);
}

vec2 lobe(float roughness, float slope) {
  float upward = max(2.0 * LOBE_WIDTH * roughness * roughness, 0.002);
  return vec2(upward * slope / sqrt(1.0 + slope * slope), upward);
}

float gloss(float roughness) {
  return clamp(GLOSS.x / max(roughness, 1e-3), GLOSS.y, GLOSS.z);
}

float wall_edges(float z, float height) {
  return (1.0 - FOOT.x * exp(-z / FOOT.y)) * (1.0 - HEAD.x * exp(-(height - z) / HEAD.y));
}

float fitting_light(vec3 normal, float height) {
  if (normal.z > 0.5) return FITTING_LIGHT.x;
  if (normal.z < -0.5) return FITTING_LIGHT.z;
  return (FITTING_LIGHT.y + dot(FITTING_TURN, normal.xy)) * (1.0 - FOOT.x * exp(-height / FOOT.y));
}

vec3 tinted(float full, vec3 dim, vec3 bright) {
  return mix(dim, bright, smoothstep(0.0, 1.0, full)) * full;
}

vec3 wall_tint(float height) {
  return mix(vec3(1.0), FLOOR_TINT, mix(BOUNCED.x, BOUNCED.y, clamp(height, 0.0, 1.0)));
}

vec3 ceiling_tint() {
  return mix(vec3(1.0), FLOOR_TINT, BOUNCED.z);
}

float rise(float t) {
  return smoothstep(-1.5, 1.5, t);
}

vec2 joint(vec2 at, vec2 width) {
  vec2 away = abs(fract(at / TILE_M + 0.5) - 0.5) * TILE_M;
  vec2 w = max(width, vec2(1e-5));
  return clamp((JOINT_HALF_M + 0.5 * w - away) / w, vec2(0.0), min(2.0 * JOINT_HALF_M / w, vec2(1.0)));
}

vec3 toned(vec3 light) {
  light = CONTRAST.x * pow(max(light, vec3(0.0)) / CONTRAST.x, vec3(CONTRAST.y));
  float rest = 1.0 - STRAIGHT;
  return min(light, STRAIGHT + rest * (1.0 - exp(-max(light - STRAIGHT, vec3(0.0)) / rest)));
}

vec3 srgb(vec3 light) {
  vec3 high = 1.055 * pow(max(light, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(high, 12.92 * light, lessThanEqual(light, vec3(0.0031308)));
}
