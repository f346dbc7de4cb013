#version 300 es
// Floor, walls and what belongs to them. The ceiling is the floor, lifted.
in vec3 a_place;
in vec2 a_uv;
in vec3 a_normal;
uniform mat4 u_matrix;
uniform float u_height;
out vec3 v_place;
out vec2 v_uv;
out vec3 v_normal;

void main() {
  v_place = a_place;
  v_normal = a_normal;
#ifdef IS_CEILING
  v_place.z = u_height;
  v_normal = vec3(0.0, 0.0, -1.0);
#endif
  v_uv = a_uv;
  gl_Position = u_matrix * vec4(v_place, 1.0);
}
