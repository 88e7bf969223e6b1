#version 450
// One triangle that covers the image; uv is 0..1 from the lower left.
layout(location = 0) out vec2 uv;

void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  uv = corner;
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
