#version 300 es
// What shines by itself: lamps, and the day in the openings, paler above the horizon.
precision highp float;
in float v_up;
uniform vec3 u_low;
uniform vec3 u_high;
out vec4 o_colour;

void main() {
  vec3 light = mix(u_low, u_high, smoothstep(0.0, 0.7, v_up));
  o_colour = vec4(pow(min(light, vec3(1.0)), vec3(1.0 / 2.2)), 1.0);
}
