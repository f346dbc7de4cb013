// Starts everything; draws when something has changed, and only then.

let drawing = null;
let waiting = false;
let last = 0;
let moving = false;
let frames = 0;

function invalidate() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(frame);
}

function frame(now) {
  waiting = false;
  // The first step of a walk lasts a frame. No step is longer than 0.2 s, so that nothing jumps after a pause.
  const seconds = moving ? Math.min((now - last) / 1000, 0.2) : 1 / 60;
  last = now;
  moving = advance(seconds);
  if (moving) invalidate();
  draw();
}

function draw() {
  if (!drawing || drawing.gl.isContextLost()) return;
  const amounts = (surface) => state.kinds[surface].map((on) => (on ? state.amount : 0));
  drawing.draw(seenNow(), { floor: amounts('floor'), wall: amounts('wall'), inside: state.inside && data.roofed, lit: state.lit });
  drawSmall();
  frames++;
}

function resize() {
  // More than two pixels per pixel are not seen, but cost.
  const dense = Math.min(devicePixelRatio || 1, 2);
  const size = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * dense)));
  if (size[0] !== canvas.width || size[1] !== canvas.height) [canvas.width, canvas.height] = size;
  sizeSmall();
  invalidate();
}

async function begin() {
  const gl = canvas.getContext('webgl2', { antialias: true, alpha: false, powerPreference: 'high-performance' });
  if (!gl) {
    say('This page shows the plan in 3D with WebGL 2, which this browser does not offer or has switched off.\n'
      + 'Current versions of Chrome, Edge, Firefox and Safari have it; hardware acceleration has to be on.');
    throw new Error('WebGL 2 is missing');
  }
  canvas.addEventListener('webglcontextlost', (event) => {
    event.preventDefault();
    drawing = null;
  });
  canvas.addEventListener('webglcontextrestored', () => {
    const failed = (error) => gl.isContextLost() || say(`The plan cannot be shown: ${error.message}`);
    Drawing.on(gl).then((made) => { drawing = made; }, failed).then(invalidate);
  });
  new ResizeObserver(resize).observe(canvas);
  addEventListener('resize', resize);
  showMode();
  setAmount(1);
  drawing = await Drawing.on(gl);
  resize();
  draw();
  cover.hidden = true;
}

/** For tests and for those who steer the page from outside. */
window.trodden = {
  ready: begin().catch((error) => {
    if (cover.textContent === 'Loading') say(`The plan cannot be shown: ${error.message}`);
    throw error;
  }),
  /** Looks from somewhere: `{ inside, x, y, heading, pitch, distance }`, metres and radians; what is left out stays. */
  setCamera({ inside = state.inside, x, y, heading, pitch, distance }) {
    const from = inside ? walker : orbiter;
    if (x !== undefined && y !== undefined) {
      if (inside) walker.at = standing(x, y);
      else orbiter.target = [x, y, 0];
    }
    if (heading !== undefined) from.heading = heading;
    if (pitch !== undefined) from.pitch = pitch;
    if (distance !== undefined) orbiter.distance = distance;
    setInside(inside);
    draw();
  },
  camera() {
    const from = state.inside ? { at: walker.at, ...walker } : { ...orbiter, at: orbiter.target };
    return { inside: state.inside, x: from.at[0], y: from.at[1], heading: from.heading, pitch: from.pitch, distance: orbiter.distance };
  },
  /** Changes what is shown: `{ amount, floor: [..], wall: [..], lit }`. */
  show({ amount, floor = [], wall = [], lit = state.lit }) {
    state.lit = lit;
    floor.forEach((on, n) => setKind('floor', n, on));
    wall.forEach((on, n) => setKind('wall', n, on));
    setAmount(amount === undefined ? state.amount : amount);
    draw();
  },
  /** Where a point in space is seen: pixels of the page from its upper left, or null behind the eye. */
  project(x, y, z) {
    const { matrix } = seenNow();
    const row = (n) => matrix[n] * x + matrix[4 + n] * y + matrix[8 + n] * z + matrix[12 + n];
    const w = row(3);
    if (w <= 0) return null;
    return [(row(0) / w + 1) / 2 * canvas.clientWidth, (1 - row(1) / w) / 2 * canvas.clientHeight];
  },
  frames: () => frames,
};
