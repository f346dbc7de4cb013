#version 300 es
// Emitters: lamps, and daylight in the openings, paler above the horizon.
precision highp float;
in float v_up;
uniform bool u_lamp;
out vec4 o_colour;

{{light}}
void main() {
  vec3 light = u_lamp ? LAMP : DAYLIGHT * mix(0.6, 1.0, smoothstep(0.0, 0.7, v_up));
  o_colour = vec4(srgb(toned(light * EXPOSURE_INSIDE)), 1.0);
}
