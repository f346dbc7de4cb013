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
uniform sampler2D u_field;  // distance to the nearest wall
uniform sampler2D u_light;  // irradiance: floor, wall low, wall high, from everywhere
uniform sampler2D u_lamps;  // the ceiling's lamps

uniform vec4 u_amounts;     // times the baked density; 0 where a kind is left out
uniform vec3 u_colours[4];
uniform vec3 u_clean_colour;
uniform float u_clean_roughness;
uniform vec3 u_wall_colour;
uniform vec3 u_floor_colour;
uniform bool u_textured;
uniform bool u_lit;
uniform bool u_inside;

uniform vec3 u_eye;
uniform float u_height;
uniform vec4 u_field_place;
uniform vec2 u_field_range;
uniform vec4 u_light_place;
uniform float u_light_most;
uniform vec2 u_light_heights;
uniform vec4 u_lamps_place;

const vec3 LAMP = vec3(1.0, 0.985, 0.95);
const vec3 LAMP_GLOW = vec3(6.0, 5.9, 5.6);
// How bright an irradiance of 1 is shown.
const float EXPOSURE = 0.80;

// What is seen without light: colour and roughness.
struct Material {
  vec3 colour;
  float roughness;
};

// The look's law: C = clean T + sum(D c) / sum(D) (1 - T), T = exp(-sum D), in linear light.
Material material() {
  if (!u_textured) return Material(u_clean_colour, u_clean_roughness);
  vec4 baked = -log(1.0 - min(texture(u_dirt, v_uv), vec4(0.998)));
  vec4 densities = baked * u_amounts;
  float sum = dot(densities, vec4(1.0));
  float through = exp(-sum);
  vec3 dirt = (densities.x * u_colours[0] + densities.y * u_colours[1] + densities.z * u_colours[2] + densities.w * u_colours[3]) / max(sum, 1e-6);
  vec3 colour = texture(u_clean, v_uv).rgb * through + dirt * (1.0 - through);
  float baked_sum = dot(baked, vec4(1.0));
  float share = min(sum / max(baked_sum, 1e-4), 1.25);
  float roughness = u_clean_roughness + (texture(u_rough, v_uv).r - u_clean_roughness) * share;
  return Material(colour, clamp(roughness, 0.05, 1.0));
}

float wall_distance(vec2 place) {
  float value = textureLod(u_field, (place - u_field_place.xy) * u_field_place.zw, 0.0).r;
  return mix(u_field_range.x, u_field_range.y, value);
}

// Irradiance of the floor, of walls low, of walls high, and what comes from everywhere.
vec4 light_at(vec2 place) {
  vec4 root = textureLod(u_light, (place - u_light_place.xy) * u_light_place.zw, 0.0);
  return root * root * u_light_most;
}

// Share of a hemisphere over the floor that a long wall of height h takes up at distance d, weighted by the cosine.
float wall_share(float d) {
  return 0.5 * (1.0 - d / sqrt(d * d + u_height * u_height));
}

// The floor's hue at the brightness of white.
vec3 floor_tint() {
  return u_floor_colour / max(dot(u_floor_colour, vec3(0.2126, 0.7152, 0.0722)), 0.02);
}

float wall_lamps(vec4 light, float up) {
  float lamps = mix(light.y, light.z, smoothstep(0.0, u_light_heights.y, up));
  // Lamps set in the ceiling hardly reach what is right below it.
  return lamps * (1.0 - 0.45 * smoothstep(u_light_heights.y, 1.0, up));
}

vec3 wall_irradiance(vec2 place, vec2 normal, float z) {
  vec4 light = light_at(place + 0.22 * normal);
  float up = clamp(z / u_height, 0.0, 1.0);
  // What floor and ceiling throw back has their colour.
  vec3 bounce = light.w * mix(floor_tint(), vec3(1.0), 0.6 + 0.4 * up);
  bounce *= mix(mix(0.55, 0.95, clamp(u_floor_colour.g * 2.0, 0.0, 1.0)), 0.92, up);
  // Shade where surfaces meet: along the floor, along the ceiling, in the corners of the plan.
  float foot = 1.0 - 0.34 * exp(-z / 0.09) - 0.14 * exp(-z / 0.45);
  float head = 1.0 - 0.22 * exp(-(u_height - z) / 0.12);
  // Full a little before a plain wall's own distance, or the steps of eight bits would show as stripes.
  float near = clamp(wall_distance(place + 0.25 * normal) / 0.22, 0.0, 1.0);
  float far = clamp(wall_distance(place + 0.8 * normal) / 0.75, 0.0, 1.0);
  float corner = mix(0.66, 1.0, near) * mix(0.84, 1.0, far);
  return (LAMP * wall_lamps(light, up) * mix(1.0, corner, 0.5) + bounce * corner) * foot * head;
}

// Light that comes to the eye by way of a smooth floor: walls are met by marching through the map of distances.
vec3 mirrored(vec3 ray, float roughness) {
  float across = length(ray.xy);
  float up = max(ray.z, 0.02);
  float to_ceiling = u_height / up;
  vec2 along = ray.xy / max(across, 1e-4);
  float gone = 0.03;
  float most = min(to_ceiling * across, 40.0);
  float blur = roughness * roughness * 0.9;
  // How near the ray comes to a wall, in widths of its cone, and where: silhouettes are as soft as the floor is rough.
  float nearest = 1.0;
  float where = gone;
  for (int n = 0; n < 26; n++) {
    float d = wall_distance(v_place.xy + along * gone);
    float share = d / max(0.6 * blur * gone, 0.01);
    if (share < nearest) {
      nearest = max(share, 0.0);
      where = gone;
    }
    if (d < 0.01) break;
    gone += max(d, 0.03 + 0.02 * gone);
    if (gone > most * 1.3 + 0.5) break;
  }
  float met = 1.0 - smoothstep(0.0, 1.0, nearest);
  gone = met > 0.0 ? where : gone;
  vec2 hit = v_place.xy + along * min(gone, most);
  // The ceiling and its lamps, blurred along the ray more than across.
  vec2 above = v_place.xy + along * most;
  float spread = blur * to_ceiling;
  vec2 stretch = along * spread / max(up, 0.15);
  vec2 side = vec2(-along.y, along.x) * spread;
  float lamps = textureGrad(u_lamps, (above - u_lamps_place.xy) * u_lamps_place.zw, stretch * u_lamps_place.zw, side * u_lamps_place.zw).r;
  vec3 ceiling = vec3(0.8) * light_at(hit).w + LAMP_GLOW * lamps;
  if (met <= 0.0) return ceiling;
  float height = gone / max(across, 1e-4) * ray.z;
  // Before the wall, however far the last step went into it.
  vec4 there = light_at(hit - along * (0.25 + 0.04 * gone));
  float lamps_there = min(wall_lamps(there, clamp(height / u_height, 0.0, 1.0)), 0.6 * there.w);
  vec3 wall = u_wall_colour * (0.8 * there.w + lamps_there);
  float edge = max(spread, 0.02);
  return mix(ceiling, wall, met * (1.0 - smoothstep(u_height - edge, u_height + edge, height)));
}

vec3 lit_floor(Material surface, vec3 view) {
  float d = max(wall_distance(v_place.xy), 0.0);
  float walls = wall_share(d);
  float touch = 1.0 - 0.42 * exp(-d / 0.07) - 0.16 * exp(-d / 0.35);
  vec4 from = light_at(v_place.xy);
  if (!u_inside) {
    float sky = 1.0 - 0.85 * walls;
    vec3 light = vec3(0.98, 1.0, 1.03) * sky * touch * (0.80 + 0.20 * from.x);
    return surface.colour * light + u_wall_colour * surface.colour * walls * 0.25;
  }
  vec3 light = LAMP * from.x * mix(1.0, touch, 0.55) + from.w * mix(vec3(1.0), u_wall_colour, walls) * touch;
  vec3 ray = vec3(-view.xy, view.z);
  float facing = clamp(view.z, 0.0, 1.0);
  float fresnel = 0.04 + (max(1.0 - surface.roughness, 0.04) - 0.04) * pow(1.0 - facing, 5.0);
  vec3 mirror = mirrored(ray, surface.roughness) * touch;
  return (surface.colour * light * (1.0 - fresnel) + mirror * fresnel) * EXPOSURE;
}

vec3 lit_wall(Material surface, vec3 view) {
  vec2 normal = normalize(v_normal.xy + vec2(1e-6, 0.0));
  if (!u_inside) {
    float up = clamp(v_place.z / u_height, 0.0, 1.0);
    float near = clamp(wall_distance(v_place.xy + 0.25 * normal) / 0.22, 0.0, 1.0);
    float foot = 1.0 - 0.30 * exp(-v_place.z / 0.12);
    float side = 0.92 + 0.10 * normal.x + 0.06 * normal.y;
    return surface.colour * (0.52 + 0.30 * up) * mix(0.75, 1.0, near) * foot * side;
  }
  vec3 light = wall_irradiance(v_place.xy, normal, v_place.z);
  float facing = clamp(dot(vec3(normal, 0.0), view), 0.0, 1.0);
  float fresnel = 0.04 + (max(1.0 - surface.roughness, 0.04) - 0.04) * pow(1.0 - facing, 5.0);
  return (surface.colour * (1.0 - fresnel) + 0.6 * fresnel) * light * EXPOSURE;
}

// Mineral tiles in a grid of bars.
vec3 lit_ceiling() {
  vec2 cell = v_place.xy / 0.6;
  vec2 width = max(fwidth(cell), vec2(1e-4));
  vec2 off = abs(fract(cell) - 0.5);
  vec2 bar = smoothstep(vec2(0.5) - vec2(0.02) - width, vec2(0.5) - vec2(0.012), off) * clamp(0.06 / width, 0.0, 1.0);
  float d = max(wall_distance(v_place.xy), 0.0);
  vec4 light = light_at(v_place.xy);
  // It is lit by what it lights: the floor below.
  vec3 bounce = light.w * mix(floor_tint(), vec3(1.0), 0.72) * mix(0.8, 1.15, clamp(u_floor_colour.g * 2.0, 0.0, 1.0));
  float shade = 1.0 - 0.22 * exp(-d / 0.15);
  return vec3(0.84, 0.84, 0.82) * bounce * shade * (1.0 - 0.14 * max(bar.x, bar.y)) * EXPOSURE;
}

// Leaves colours as they are up to 0.76 and rolls brighter ones off, without a hue shift.
vec3 toned(vec3 colour) {
  const float START = 0.76;
  float peak = max(colour.r, max(colour.g, colour.b));
  if (peak < START) return colour;
  float range = 1.0 - START;
  float rolled = 1.0 - range * range / (peak + range - START);
  vec3 kept = colour * (rolled / peak);
  float pale = 1.0 - 1.0 / (0.15 * (peak - rolled) + 1.0);
  return mix(kept, vec3(rolled), pale);
}

vec3 srgb(vec3 light) {
  vec3 high = 1.055 * pow(max(light, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(high, 12.92 * light, lessThanEqual(light, vec3(0.0031308)));
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
#if defined(FLOOR)
  colour = lit_floor(surface, view);
#elif defined(WALL)
  colour = lit_wall(surface, view);
#elif defined(CEILING)
  colour = lit_ceiling();
#elif defined(LINTEL)
  colour = abs(v_normal.z) > 0.5 ? surface.colour * 0.35 : lit_wall(surface, view);
#else
  colour = u_inside ? surface.colour * 0.5 : vec3(0.16, 0.165, 0.172);
#endif
  o_colour = vec4(srgb(toned(colour)) + threshold() / 255.0, 1.0);
}
