// Vectors and matrices (column by column, as WebGL has them). The frame is the plan's: x right, y up on the plan, z the
// height above the floor, metres.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const scaled = (a, by) => [a[0] * by, a[1] * by, a[2] * by];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/** Unit vector of a heading (counter-clockwise from +x) and a pitch (upward), radians. */
function direction(heading, pitch) {
  return [Math.cos(heading) * Math.cos(pitch), Math.sin(heading) * Math.cos(pitch), Math.sin(pitch)];
}

function product(a, b) {
  const out = new Float32Array(16);
  for (let column = 0; column < 4; column++) {
    for (let row = 0; row < 4; row++) {
      let sum = 0;
      for (let n = 0; n < 4; n++) sum += a[4 * n + row] * b[4 * column + n];
      out[4 * column + row] = sum;
    }
  }
  return out;
}

/** Where a camera sees things: its axes, and the matrix from the plan frame to clip space. */
function camera(eye, heading, pitch, fieldOfView, aspect, near, far) {
  const forward = direction(heading, pitch);
  const right = [Math.sin(heading), -Math.cos(heading), 0];
  const up = cross(right, forward);
  const view = new Float32Array([
    right[0], up[0], -forward[0], 0,
    right[1], up[1], -forward[1], 0,
    right[2], up[2], -forward[2], 0,
    -dot(right, eye), -dot(up, eye), dot(forward, eye), 1,
  ]);
  const focus = 1 / Math.tan(fieldOfView / 2);
  const projection = new Float32Array([
    focus / aspect, 0, 0, 0,
    0, focus, 0, 0,
    0, 0, (far + near) / (near - far), -1,
    0, 0, 2 * far * near / (near - far), 0,
  ]);
  return { eye, forward, right, up, focus, aspect, matrix: product(projection, view) };
}

/** Direction of the ray through a point of the view, both from -1 to 1, y upward. */
function rayThrough(seen, x, y) {
  const along = add(seen.forward, add(scaled(seen.right, x * seen.aspect / seen.focus), scaled(seen.up, y / seen.focus)));
  return scaled(along, 1 / Math.hypot(...along));
}

