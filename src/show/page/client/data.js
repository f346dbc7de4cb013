// The page's data: the description, the triangles, the images; and the plan that stops a walker at walls.

const data = JSON.parse(element('data').textContent);

/** Takes a block of bytes out of the page. */
function bytesOf(id) {
  const holder = element(id);
  const text = atob(holder.textContent);
  holder.remove();
  const bytes = new Uint8Array(text.length);
  for (let n = 0; n < text.length; n++) bytes[n] = text.charCodeAt(n);
  return bytes;
}

/** Decodes an image of the page. Its text stays: it is needed again when the graphics card has lost it. */
async function imageOf(id, type) {
  const image = new Image();
  image.src = `data:${type};base64,${element(id).textContent}`;
  await image.decode();
  return image;
}

/** Straight pieces around all floor, in buckets, so that few are looked at per step. */
class Plan {
  constructor(outlines) {
    this.edges = [];
    this.low = [Infinity, Infinity];
    this.high = [-Infinity, -Infinity];
    for (const outline of outlines) {
      const openings = new Set(outline.openings);
      outline.points.forEach((a, k) => {
        const b = outline.points[(k + 1) % outline.points.length];
        this.edges.push({ a, b, open: openings.has(k) });
        for (const axis of [0, 1]) {
          this.low[axis] = Math.min(this.low[axis], a[axis]);
          this.high[axis] = Math.max(this.high[axis], a[axis]);
        }
      });
    }
    if (!this.edges.length) this.low = this.high = [0, 0];
    this.bucket = 2;
    this.buckets = new Map();
    this.edges.forEach((edge) => {
      const [[i0, j0], [i1, j1]] = [this.place(edge, Math.min), this.place(edge, Math.max)];
      for (let j = j0; j <= j1; j++) {
        for (let i = i0; i <= i1; i++) {
          const key = `${i},${j}`;
          if (!this.buckets.has(key)) this.buckets.set(key, []);
          this.buckets.get(key).push(edge);
        }
      }
    });
  }

  place({ a, b }, choose) {
    return [0, 1].map((axis) => Math.floor(choose(a[axis], b[axis]) / this.bucket));
  }

  /** Edges near the box around two points. */
  near(p, q, within) {
    const found = new Set();
    const low = [0, 1].map((axis) => Math.floor((Math.min(p[axis], q[axis]) - within) / this.bucket));
    const high = [0, 1].map((axis) => Math.floor((Math.max(p[axis], q[axis]) + within) / this.bucket));
    for (let j = low[1]; j <= high[1]; j++) {
      for (let i = low[0]; i <= high[0]; i++) {
        for (const edge of this.buckets.get(`${i},${j}`) || []) found.add(edge);
      }
    }
    return found;
  }

  /** Whether there is floor. */
  holds([x, y]) {
    let inside = false;
    for (const { a, b } of this.edges) {
      if ((a[1] > y) !== (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1])) inside = !inside;
    }
    return inside;
  }

  /** Whether nothing stands between two points. */
  free(p, q) {
    const side = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    for (const { a, b } of this.near(p, q, 0)) {
      if (side(a, b, p) > 0 !== side(a, b, q) > 0 && side(p, q, a) > 0 !== side(p, q, b) > 0) return false;
    }
    return true;
  }

  /** Where somebody of that radius ends who steps from `p` by `by`: walls are slid along, never passed. */
  step(p, by, radius) {
    const steps = Math.max(1, Math.ceil(Math.hypot(...by) / (0.4 * radius)));
    let at = p;
    for (let n = 0; n < steps; n++) {
      const next = this.pushed([at[0] + by[0] / steps, at[1] + by[1] / steps], radius);
      if (!this.free(at, next)) break;
      at = next;
    }
    return at;
  }

  pushed(p, radius) {
    let at = p;
    for (let round = 0; round < 4; round++) {
      let moved = false;
      for (const { a, b } of this.near(at, at, radius)) {
        const along = [b[0] - a[0], b[1] - a[1]];
        const length2 = along[0] ** 2 + along[1] ** 2;
        const t = length2 > 0 ? clamp(((at[0] - a[0]) * along[0] + (at[1] - a[1]) * along[1]) / length2, 0, 1) : 0;
        const away = [at[0] - a[0] - t * along[0], at[1] - a[1] - t * along[1]];
        const distance = Math.hypot(...away);
        if (distance < radius - 1e-6 && distance > 1e-9) {
          at = [at[0] + away[0] * (radius / distance - 1), at[1] + away[1] * (radius / distance - 1)];
          moved = true;
        }
      }
      if (!moved) break;
    }
    return at;
  }
}

const plan = new Plan(data.outlines);

