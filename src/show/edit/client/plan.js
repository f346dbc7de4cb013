// The plan: a paint number per pixel as it was read and as it is now, what is placed on it, and the steps back.

const element = (id) => document.getElementById(id);
const data = JSON.parse(element('data').textContent);
const { width: WIDTH, height: HEIGHT, paints: PAINTS } = data;
const numberOf = (name) => PAINTS.findIndex((paint) => paint.name === name);
const [FLOOR, OUTSIDE, ENTRANCE, DOOR] = ['floor', 'outside', 'entrance', 'door'].map(numberOf);

/** Decodes an image of the page into a canvas of its size. */
async function canvasOf(id) {
  const holder = element(id);
  const image = new Image();
  image.src = `data:${holder.dataset.type};base64,${holder.textContent}`;
  await image.decode();
  holder.remove();
  const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight);
  canvas.getContext('2d').drawImage(image, 0, 0);
  return canvas;
}

/** The red channel of an image: a number per pixel. */
function numbersOf(canvas) {
  const { data: rgba } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  return Uint8Array.from({ length: rgba.length / 4 }, (_, at) => rgba[4 * at]);
}

/** What is placed on the plan; places in pixels from the top left. */
let placed = { scale: null, entrances: [], stops: [], routes: [], rooms: [] };
/** Paint numbers: as read without paint, and now. */
let read, now;
/** Steps that can be taken back, and those that were. */
const [past, future] = [[], []];
/** Whether something changed since the last save. */
let unsaved = false;
/** Called with the changed rectangle, or without one when only placed things changed. */
let onChange = () => {};

/** The rectangle around pixels: left, top, right, bottom. */
function around(pixels) {
  const box = [WIDTH, HEIGHT, 0, 0];
  for (const at of pixels) {
    const [x, y] = [at % WIDTH, Math.floor(at / WIDTH)];
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x + 1);
    box[3] = Math.max(box[3], y + 1);
  }
  return box;
}

function remember(step) {
  past.push(step);
  future.length = 0;
  unsaved = true;
  onChange(step.pixels && around(step.pixels));
}

/** Paints pixels; what is painted already does not count. Erasing shows what lies around. */
function paint(pixels, number) {
  const changed = pixels.filter((at) => now[at] !== number);
  if (!changed.length) return 0;
  const before = Uint8Array.from(changed, (at) => now[at]);
  for (const at of changed) now[at] = number;
  remember({ pixels: changed, before, after: new Uint8Array(changed.length).fill(number) });
  return changed.length;
}

/** Changes what is placed, by a function that changes a copy. */
function place(change) {
  const before = placed;
  const after = structuredClone(placed);
  change(after);
  placed = after;
  remember({ placed: { before, after } });
}

/** Takes a step back, or forward again. */
function step(from, to, side) {
  const taken = from.pop();
  if (!taken) return;
  if (taken.pixels) taken.pixels.forEach((at, n) => { now[at] = taken[side][n]; });
  else placed = taken.placed[side];
  to.push(taken);
  unsaved = true;
  onChange(taken.pixels && around(taken.pixels));
}
const undo = () => step(past, future, 'before');
const redo = () => step(future, past, 'after');

/** The connected pixels of one paint around a pixel. What stands and doors, whose arcs are thin, join over corners. */
function pieceAt(x, y) {
  const own = now[y * WIDTH + x];
  const corners = PAINTS[own].solid || own === DOOR ? 1 : 0;
  const seen = new Uint8Array(now.length);
  const [found, open] = [[], [[x, y]]];
  const free = (at) => !seen[at] && now[at] === own;
  while (open.length) {
    let [left, row] = open.pop();
    if (!free(row * WIDTH + left)) continue;
    let right = left;
    while (left > 0 && free(row * WIDTH + left - 1)) left--;
    while (right + 1 < WIDTH && free(row * WIDTH + right + 1)) right++;
    for (let k = left; k <= right; k++) {
      seen[row * WIDTH + k] = 1;
      found.push(row * WIDTH + k);
    }
    for (const beside of [row - 1, row + 1]) {
      if (beside < 0 || beside >= HEIGHT) continue;
      let within = false;
      for (let k = Math.max(0, left - corners); k <= Math.min(WIDTH - 1, right + corners); k++) {
        const is = free(beside * WIDTH + k);
        if (is && !within) open.push([k, beside]);
        within = is;
      }
    }
  }
  return found;
}

/** The nearest pixel of a door within a radius of a place; `null` for none. */
function doorNear(at, radius) {
  const doors = strokeOf(at, at, radius).filter((pixel) => now[pixel] === DOOR).map((pixel) => [pixel % WIDTH, Math.floor(pixel / WIDTH)]);
  const off = ([x, y]) => Math.hypot(x + 0.5 - at[0], y + 0.5 - at[1]);
  return doors.reduce((best, pixel) => (best && off(best) <= off(pixel) ? best : pixel), null);
}

/** Of the pixels of a door those between its jambs, as deep as the wall: leaf and arc lie beside it. All if it has none. */
function gapOf(pixels) {
  const own = new Set(pixels);
  const found = [];
  for (const [from, to] of data.doors) {
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    const along = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    // Half pixels leave no holes in doors that stand askew.
    const row = (off) => Array.from({ length: Math.ceil(2 * length) }, (_, k) => {
      const [x, y] = [from[0] + along[0] * (k + 0.5) / 2 - along[1] * off, from[1] + along[1] * (k + 0.5) / 2 + along[0] * off];
      return Math.floor(y) * WIDTH + Math.floor(x);
    });
    for (const side of [-0.5, 0.5]) {
      for (let off = side; Math.abs(off) < length; off += side) {
        const within = row(off).filter((at) => own.has(at));
        if (within.length < 0.6 * 2 * length) break;
        found.push(...within);
      }
    }
  }
  return found.length ? [...new Set(found)] : pixels;
}

/** The pixels within a radius of a line between two places. */
function strokeOf([x0, y0], [x1, y1], radius) {
  const pixels = [];
  const clamp = (v, most) => Math.max(0, Math.min(most, v));
  const [left, right] = [clamp(Math.floor(Math.min(x0, x1) - radius), WIDTH), clamp(Math.ceil(Math.max(x0, x1) + radius), WIDTH)];
  const [top, bottom] = [clamp(Math.floor(Math.min(y0, y1) - radius), HEIGHT), clamp(Math.ceil(Math.max(y0, y1) + radius), HEIGHT)];
  const length = Math.hypot(x1 - x0, y1 - y0) || 1;
  const along = [(x1 - x0) / length, (y1 - y0) / length];
  for (let y = top; y < bottom; y++) {
    for (let x = left; x < right; x++) {
      const off = [x + 0.5 - x0, y + 0.5 - y0];
      const way = clamp(off[0] * along[0] + off[1] * along[1], length);
      if (Math.hypot(off[0] - way * along[0], off[1] - way * along[1]) <= radius) pixels.push(y * WIDTH + x);
    }
  }
  return pixels;
}

/** Metres per pixel: by the two points, else as read. */
function metresPerPixel() {
  const { scale } = placed;
  return scale?.metres ? scale.metres / Math.hypot(scale.to[0] - scale.from[0], scale.to[1] - scale.from[1]) : data.metresPerPixel;
}

