#version 300 es
in vec3 a_place;
uniform mat4 u_matrix;
uniform float u_height;
out float v_up;

void main() {
  v_up = a_place.z / u_height;
  gl_Position = u_matrix * vec4(a_place, 1.0);
}
