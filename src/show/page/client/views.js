// Where one looks from: walking at the height of eyes, or around the plan from above.

const EYE = 1.7;
/** Half the width of somebody who walks, metres. */
const RADIUS = 0.25;
const STEEPEST = 1.45;

/** A place to stand: the one asked for, or the nearest lamp's if there is no floor. */
function standing(x, y) {
  if (plan.holds([x, y])) return plan.pushed([x, y], RADIUS);
  const middles = data.lamps.map((corners) => [0, 1].map((axis) => corners.reduce((sum, p) => sum + p[axis] / 4, 0)));
  middles.sort((a, b) => Math.hypot(a[0] - x, a[1] - y) - Math.hypot(b[0] - x, b[1] - y));
  return middles[0] || [x, y];
}

const walker = { at: standing(data.start.x, data.start.y), heading: data.start.heading, pitch: data.start.pitch };

const extent = Math.max(plan.high[0] - plan.low[0], plan.high[1] - plan.low[1], 4);
const orbiter = {
  target: [(plan.low[0] + plan.high[0]) / 2, (plan.low[1] + plan.high[1]) / 2, 0],
  heading: Math.PI / 2 - 0.45,
  pitch: -0.85,
  distance: 0,
};

const state = {
  inside: true,
  lit: true,
  amount: 1,
  kinds: { floor: data.surfaces.floor.kinds.map(() => true), wall: data.surfaces.wall.kinds.map(() => true) },
};

/** The distance from which the whole plan is seen. */
function wholePlan(aspect) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((n) => [
    (n & 1 ? plan.high : plan.low)[0], (n & 2 ? plan.high : plan.low)[1], n & 4 ? data.height : 0,
  ]);
  const fits = (distance) => {
    const eye = add(orbiter.target, scaled(direction(orbiter.heading, orbiter.pitch), -distance));
    const { matrix } = camera(eye, orbiter.heading, orbiter.pitch, 0.7, aspect, 1, 2);
    return corners.every(([x, y, z]) => {
      const row = (n) => matrix[n] * x + matrix[4 + n] * y + matrix[8 + n] * z + matrix[12 + n];
      return row(3) > 0 && Math.max(Math.abs(row(0)), Math.abs(row(1))) < 0.92 * row(3);
    });
  };
  let distance = 4;
  while (distance < 1e4 && !fits(distance)) distance *= 1.05;
  return distance;
}

/** The camera of now. */
function seenNow() {
  const aspect = Math.max(canvas.width, 1) / Math.max(canvas.height, 1);
  if (state.inside) {
    // Upright phones see enough to both sides.
    const wide = 2 * Math.atan(Math.tan(0.575) * clamp(1 / aspect, 1, 1.6));
    return camera([...walker.at, EYE], walker.heading, walker.pitch, wide, aspect, 0.05, 4 * extent + 50);
  }
  if (!orbiter.distance) orbiter.distance = wholePlan(aspect);
  const eye = add(orbiter.target, scaled(direction(orbiter.heading, orbiter.pitch), -orbiter.distance));
  return camera(eye, orbiter.heading, orbiter.pitch, 0.7, aspect, orbiter.distance / 50, orbiter.distance * 3 + 2 * extent);
}

function look(by, up) {
  const from = state.inside ? walker : orbiter;
  from.heading = (from.heading + by) % (2 * Math.PI);
  from.pitch = state.inside ? clamp(from.pitch + up, -STEEPEST, STEEPEST) : clamp(from.pitch + up, -1.5, -0.12);
}

function zoom(factor) {
  orbiter.distance = clamp(orbiter.distance * factor, 2, 6 * extent + 20);
}

/** Moves what is orbited by shares of the view's height. */
function pan(right, up) {
  const size = 2 * Math.tan(0.35) * orbiter.distance;
  const [sine, cosine] = [Math.sin(orbiter.heading), Math.cos(orbiter.heading)];
  const ahead = up / Math.max(0.35, Math.sin(-orbiter.pitch));
  const by = [(sine * right + cosine * ahead) * size, (-cosine * right + sine * ahead) * size];
  orbiter.target[0] = clamp(orbiter.target[0] + by[0], plan.low[0], plan.high[0]);
  orbiter.target[1] = clamp(orbiter.target[1] + by[1], plan.low[1], plan.high[1]);
}

/** Walks ahead and to the right, metres. */
function walkBy(ahead, right) {
  const [sine, cosine] = [Math.sin(walker.heading), Math.cos(walker.heading)];
  walker.at = plan.step(walker.at, [cosine * ahead + sine * right, sine * ahead - cosine * right], RADIUS);
}

/** The place on the floor at a point of the view (-1 to 1), if one is seen there. */
function floorAt(x, y) {
  const seen = seenNow();
  const ray = rayThrough(seen, x, y);
  if (ray[2] > -1e-4) return null;
  const place = add(seen.eye, scaled(ray, seen.eye[2] / -ray[2])).slice(0, 2);
  if (!plan.holds(place)) return null;
  return !state.inside || plan.free(walker.at, place) ? place : null;
}

/** Goes to a place and walks from there. */
function goTo(place) {
  if (!state.inside) walker.heading = orbiter.heading;
  walker.at = standing(...place);
  setInside(true);
}

/** Changes between walking and orbiting; one orbits around the place where one walked. */
function setInside(inside) {
  if (state.inside && !inside) {
    if (!orbiter.distance) orbiter.distance = wholePlan(canvas.width / Math.max(canvas.height, 1));
    else orbiter.target = [...walker.at, 0];
  }
  state.inside = inside;
  showMode();
  invalidate();
}

