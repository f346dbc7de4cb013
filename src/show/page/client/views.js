// Where one looks from: walking at the height of eyes, or around the plan from above.

/** Half the width of somebody who walks, metres. */
const RADIUS = 0.25;
const STEEPEST = 1.45;

/** A place to stand: the one asked for, or the nearest lamp's if there is no floor. */
function standing(x, y) {
  if (plan.holds([x, y])) return plan.pushed([x, y], RADIUS);
  const middles = data.lamps.map(([low, high]) => [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2]);
  middles.sort((a, b) => Math.hypot(a[0] - x, a[1] - y) - Math.hypot(b[0] - x, b[1] - y));
  return middles[0] || [x, y];
}

const walker = { at: standing(data.start.at[0], data.start.at[1]), heading: data.start.heading, pitch: data.start.pitch };

const extent = Math.max(plan.high[0] - plan.low[0], plan.high[1] - plan.low[1], 4);
/** From above one turns about the place on the floor that is seen in the middle. */
const orbiter = (({ at, heading, pitch }) => {
  const distance = at[2] / Math.sin(-pitch);
  return { target: [...add(at, scaled(direction(heading, pitch), distance)).slice(0, 2), 0], heading, pitch, distance };
})(data.above);

const state = {
  inside: true,
  orbited: false,
  lit: true,
  amount: 1,
  kinds: { floor: data.surfaces.floor.kinds.map(() => true), wall: data.surfaces.wall.kinds.map(() => true) },
};

/** Vertical angle of a view that shows all that a still of that horizontal angle shows, whatever the window's shape. */
function lens(fov, aspect) {
  return 2 * Math.atan(Math.tan(fov / 2) / Math.min(aspect, data.aspect));
}

/** The camera of now. */
function seenNow() {
  const aspect = Math.max(canvas.width, 1) / Math.max(canvas.height, 1);
  if (state.inside) {
    // Upright phones see enough to both sides.
    const wide = lens(data.start.fov, Math.max(aspect, 0.6));
    return camera([...walker.at, data.start.at[2]], walker.heading, walker.pitch, wide, aspect, 0.05, 4 * extent + 50);
  }
  const eye = add(orbiter.target, scaled(direction(orbiter.heading, orbiter.pitch), -orbiter.distance));
  const { heading, pitch, distance } = orbiter;
  return camera(eye, heading, pitch, lens(data.above.fov, aspect), aspect, distance / 50, distance * 3 + 2 * extent);
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
  const size = 2 * orbiter.distance / seenNow().focus;
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

/** Changes between walking and orbiting: at first around the whole plan, later around the place where one walked. */
function setInside(inside) {
  if (state.inside && !inside) {
    if (state.orbited) orbiter.target = [...walker.at, 0];
    state.orbited = true;
  }
  state.inside = inside;
  showMode();
  invalidate();
}

