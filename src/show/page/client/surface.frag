#version 300 es
precision highp float;
precision highp int;

in vec3 v_place;
in vec2 v_uv;
in vec3 v_normal;
out vec4 o_colour;

uniform sampler2D u_dirt;   // 1 - exp(-D), a channel per kind
uniform sampler2D u_clean;  // base colour without dirt
uniform sampler2D u_rough;  // roughness as baked
uniform sampler2D u_field;  // distance to the nearest wall; day beyond openings
uniform sampler2D u_light;  // irradiance of the floor; share of the surroundings that is open; light over furniture
uniform sampler2D u_light_walls;  // irradiance of the nearest wall at u_light_heights
uniform sampler2D u_lamps;  // the ceiling's lamps

uniform vec4 u_amounts;     // times the baked density; 0 where a kind is left out
uniform vec3 u_colours[4];
uniform vec3 u_absorbs[4];  // optical density of red, green and blue per density
uniform vec3 u_clean_colour;
uniform float u_clean_roughness;
uniform bool u_textured;
uniform bool u_lit;
uniform bool u_inside;

uniform vec3 u_eye;
uniform float u_height;
uniform vec4 u_field_place;
uniform vec2 u_field_range;
uniform vec4 u_light_place;
uniform float u_light_most;
uniform vec4 u_light_heights;
uniform vec4 u_lamps_place;

{{light}}
const vec3 SEEN = vec3(0.2126, 0.7152, 0.0722);
const vec3 DUST = vec3(0.304987, 0.270498, 0.215861);  // linear
const float DUST_OVER_DARK = 0.3;

// Base colour in linear light, and roughness.
struct Material {
  vec3 colour;
  float roughness;
};

// The look's law (src/look/dirt.rs), channel by channel in linear light: C = clean T + sum(D c) / sum(D) (1 - T),
// T = exp(-sum D). Over a floor darker than itself dirt covers all channels alike, and is lighter and greyer.
Material material() {
  if (!u_textured) return Material(u_clean_colour, u_clean_roughness);
  vec4 baked = -log(1.0 - min(texture(u_dirt, v_uv), vec4(0.998)));
  vec4 densities = baked * u_amounts;
  float sum = dot(densities, vec4(1.0));
  vec3 each = vec3(0.0);
  vec3 dirt = vec3(0.0);
  for (int n = 0; n < 4; n++) {
    each += densities[n] * u_absorbs[n];
    dirt += densities[n] * u_absorbs[n] * u_colours[n];
  }
  vec3 clean = texture(u_clean, v_uv).rgb;
  float light = dot(dirt, SEEN);
  vec3 around = textureLod(u_clean, v_uv, 5.0).rgb;  // without the floor's flecks
  float dark = clamp(3.0 * (0.8 * light - dot(around, SEEN) * dot(each, SEEN)) / max(light, 1e-6), 0.0, 1.0);
  vec3 through = exp(-mix(each, vec3(dot(each, SEEN)), dark));
  dirt /= max(each, vec3(1e-6));
  dirt = mix(dirt, DUST, DUST_OVER_DARK * dark);
  vec3 colour = clean * through + dirt * (1.0 - through);
  float baked_sum = dot(baked, vec4(1.0));
  float share = min(sum / max(baked_sum, 1e-4), 1.25);
  float roughness = u_clean_roughness + (texture(u_rough, v_uv).r - u_clean_roughness) * share;
  return Material(colour, clamp(roughness, 0.05, 1.0));
}

float wall_distance(vec2 place) {
  float value = textureLod(u_field, (place - u_field_place.xy) * u_field_place.zw, 0.0).r;
  return mix(u_field_range.x, u_field_range.y, value);
}

// Irradiance of the floor, how open the surroundings are, and light over the furniture.
vec3 light_at(vec2 place) {
  vec3 root = textureLod(u_light, (place - u_light_place.xy) * u_light_place.zw, 0.0).rgb;
  return root * root * u_light_most;
}

// Irradiance of the nearest wall at a share of its height.
float wall_light_at(vec2 place, float up) {
  vec4 root = textureLod(u_light_walls, (place - u_light_place.xy) * u_light_place.zw, 0.0);
  vec4 light = root * root * u_light_most;
  vec3 share = clamp((up - u_light_heights.xyz) / (u_light_heights.yzw - u_light_heights.xyz), 0.0, 1.0);
  return light.x + dot(share, light.yzw - light.xyz);
}

// The room in a smooth floor (as `mirror` and `shine` of src/show/still/shade.rs): walls are met by marching through the
// map of distances.
vec3 mirrored(vec3 ray, float roughness) {
  float across = max(length(ray.xy), 1e-4);
  vec2 along = ray.xy / across;
  float slope = max(ray.z / across, 1e-4);
  float stretch = sqrt(1.0 + slope * slope);
  float ceiling_m = u_height / slope;
  float reach = min(1.6 * ceiling_m + 0.5, MIRROR_REACH_M);
  float wall_m = 0.03;
  for (int n = 0; n < 32; n++) {
    float d = wall_distance(v_place.xy + along * wall_m);
    if (d < 0.01 || wall_m > reach) break;
    wall_m += max(d, 0.03 + 0.01 * wall_m);
  }
  wall_m = min(wall_m, reach);
  float wall_z = wall_m * slope;
  vec2 blur = lobe(roughness, slope);
  float over = rise((wall_z - u_height) / (blur.y * wall_m * stretch + 0.02));
  vec3 wall = MIRRORED_WALL * (MIRRORED_WALL_LIGHT.x + MIRRORED_WALL_LIGHT.y * clamp(wall_z / u_height, 0.0, 1.0));
  // The ceiling and its lamps, blurred along the ray more than across.
  float gone = min(ceiling_m, wall_m);
  vec2 above = v_place.xy + along * gone;
  blur *= 2.0 * gone * stretch;
  vec2 ahead = along * min(blur.y * stretch / slope, 2.0 * LONGEST_STREAK_M);
  vec2 aside = vec2(-along.y, along.x) * blur.x;
  float lamps = textureGrad(u_lamps, (above - u_lamps_place.xy) * u_lamps_place.zw, ahead * u_lamps_place.zw, aside * u_lamps_place.zw).r;
  vec3 ceiling = mix(CEILING * MIRRORED_CEILING_LIGHT, MIRRORED_LAMP, lamps);
  float day = textureLod(u_field, (v_place.xy + along * (wall_m + 0.1) - u_field_place.xy) * u_field_place.zw, 0.0).g;
  day *= 1.0 - rise((wall_z - u_height) / (0.5 * u_height + LOBE * wall_m));
  return mix(mix(wall, ceiling, over), DAYLIGHT * MIRRORED_DAY, day);
}

// Lamps are warmer than what walls throw back, the sun is warmer than the sky.
vec3 lamplight(float full) {
  if (OUTSIDE) return tinted(full, TINT_SHADE, TINT_SUN);
  return u_inside ? tinted(full, TINT_DIM, TINT_BRIGHT) : vec3(full);
}

vec3 lit_floor(Material surface, vec3 view) {
  vec3 light = light_at(v_place.xy);
  float share = fresnel(view.z, surface.roughness);
  vec3 shine = u_inside ? mirrored(vec3(-view.xy, view.z), surface.roughness) : vec3(SKY_SHINE);
  return surface.colour * lamplight(light.x) * (1.0 - share) + shine * share * gloss(surface.roughness) * (FLOOR_SHINE.x + FLOOR_SHINE.y * light.y);
}

vec3 lit_wall(Material surface, vec3 view) {
  vec2 normal = normalize(v_normal.xy + vec2(1e-6, 0.0));
  vec2 beside = v_place.xy + 0.22 * normal;
  float open = light_at(beside).y;
  float full = wall_light_at(beside, clamp(v_place.z / u_height, 0.0, 1.0));
  if (u_inside) full *= wall_edges(v_place.z, u_height);
  vec3 light = lamplight(full);
  if (u_inside) light *= wall_tint(v_place.z / u_height);
  return surface.colour * light + fresnel(dot(normal, view.xy), surface.roughness) * WALL_SHINE * open * full;
}

// Mineral tiles in a grid of bars.
vec3 lit_ceiling() {
  vec2 joints = joint(v_place.xy, fwidth(v_place.xy));
  vec3 light = light_at(v_place.xy);
  return CEILING * ceiling_tint() * (CEILING_LIGHT.x * light.y + CEILING_LIGHT.y * light.z) * (1.0 - JOINT * min(joints.x + joints.y, 1.0));
}

vec3 lit_fitting(Material surface, vec3 view) {
  vec3 light = light_at(v_place.xy);
  // What is low stands in the shade of boards over it.
  float full = mix(light.x, light.z, clamp(v_place.z / 0.7, 0.0, 1.0));
  float shine = fresnel(dot(v_normal, view), surface.roughness) * WALL_SHINE * light.y * full;
  return surface.colour * lamplight(full * fitting_light(v_normal, v_place.z)) + shine;
}

// A threshold per pixel against bands.
float threshold() {
  return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
}

void main() {
  Material surface = material();
  vec3 view = normalize(u_eye - v_place);
  vec3 colour;
  if (!u_lit) {
    o_colour = vec4(srgb(surface.colour), 1.0);
    return;
  }
#if defined(IS_FLOOR)
  colour = lit_floor(surface, view);
#elif defined(IS_WALL)
  colour = lit_wall(surface, view);
#elif defined(IS_CEILING)
  colour = lit_ceiling();
#elif defined(IS_FITTING)
  colour = lit_fitting(surface, view);
#elif defined(IS_PANE)
  colour = u_inside ? DAYLIGHT : surface.colour;
#elif defined(IS_LINTEL)
  colour = abs(v_normal.z) > 0.5 ? surface.colour * SOFFIT : lit_wall(surface, view);
#else
  colour = u_inside ? surface.colour * 0.5 : TOP * (v_normal.z > 0.5 ? 1.0 : 0.75);
#endif
  colour *= OUTSIDE ? EXPOSURE_OUTSIDE : u_inside ? EXPOSURE_INSIDE : EXPOSURE_ABOVE;
  o_colour = vec4(srgb(toned(colour)) + threshold() / 255.0, 1.0);
}
