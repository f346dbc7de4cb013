// The tools: what a press, a drag and a click do, by tool.

const status = element('status');
const say = (text) => { status.textContent = text; };
const metres = element('metres');
const nameField = element('name');
const kindField = element('kind');
const brush = element('brush');
/** The chosen tool and paint; the placed thing that the fields and the Delete button are about: [list, index]. */
let tool = 'piece';
let chosen = numberOf('wall');
let selected = null;
/** Places of the route that is being clicked. */
let route = [];

/** Screen distance within which a click means what is there. */
const NEAR_PX = 12;
/** The same of doors, whose lines are thin but lie in rooms that are clicked too. */
const DOOR_PX = 5;
const KINDS = { place: 'stand', queue: 'queue at a counter', machine: 'machine', bench: 'bench', gate: 'ticket gate' };

const TOOLS = {
  piece: { name: 'Piece', help: 'Choose a paint, then click a connected piece: it becomes that. A door catches the click.', paints: true },
  brush: { name: 'Brush', help: 'Choose a paint and draw over the plan. A click with Shift draws a straight line from the last place.', paints: true, row: 'brush' },
  box: { name: 'Box', help: 'Choose a paint and drag a rectangle.', paints: true },
  scale: { name: 'Scale', help: 'Drag between two points whose distance you know, and type the metres.', row: 'metres' },
  entrance: { name: 'Entrance', help: 'Click where people come in and go out, at an outer door.' },
  stop: { name: 'Stop', help: 'Click where people stop; then let a route pass it.', row: 'name', kinds: true },
  route: { name: 'Route', help: 'Click where people start, where they pass, and twice where they end. Entrances, openings and stops catch the click. Half of the people take routes, the others use the rooms.', row: 'name' },
  room: { name: 'Room', help: 'Click into a room and type its name.', row: 'name' },
};
if (!data.rooms) delete TOOLS.room;

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
const rounded = (at) => at.map((v) => Math.round(v * 10) / 10);
const pixelAt = ([x, y]) => (x >= 0 && y >= 0 && x < WIDTH && y < HEIGHT ? [Math.floor(x), Math.floor(y)] : null);

/** The placed thing of a list near a place, as its index; -1 for none. */
function nearest(list, at) {
  let best = -1;
  list.forEach((thing, index) => {
    const off = distance(toScreen(thing.at), toScreen(at));
    if (off <= NEAR_PX && (best < 0 || off < distance(toScreen(list[best].at), toScreen(at)))) best = index;
  });
  return best;
}

/** Shows the fields of the tool, and those of what is selected. */
function showFields() {
  const { row, kinds, paints, help } = TOOLS[tool];
  element('help').textContent = help;
  element('palette').disabled = !paints;
  const thing = selected && placed[selected[0]][selected[1]];
  element('brush-row').hidden = row !== 'brush';
  element('metres-row').hidden = row !== 'metres' || !placed.scale;
  element('name-row').hidden = row !== 'name' || !thing;
  element('kind-row').hidden = !kinds || !thing;
  element('delete').hidden = !(thing || (tool === 'scale' && placed.scale));
  if (thing) nameField.value = thing.name ?? '';
  if (thing?.kind) kindField.value = thing.kind;
  element('brush-text').value = `${(brush.value * metresPerPixel()).toFixed(2)} m`;
  for (const [id, steps] of [['undo', past], ['redo', future]]) element(id).disabled = !steps.length;
}

function choose(name) {
  finishRoute();
  tool = name;
  selected = null;
  for (const button of element('tools').children) button.setAttribute('aria-pressed', String(button.dataset.tool === name));
  showFields();
  draw();
}

function choosePaint(number) {
  chosen = number;
  document.querySelector(`#palette input[value="${number}"]`).checked = true;
  if (!TOOLS[tool].paints) choose('piece');
  say(`${PAINTS[number].name}: ${PAINTS[number].meaning}`);
}

/** Adds a thing to a list and selects it. */
function add(list, thing) {
  place((all) => all[list].push(thing));
  selected = [list, placed[list].length - 1];
  showFields();
}

function paintAndTell(pixels) {
  const count = paint(pixels, chosen);
  say(count ? `${(count * metresPerPixel() ** 2).toFixed(2)} m2 are ${PAINTS[chosen].name} now` : `this is ${PAINTS[chosen].name} already`);
}

/** Goes to the name field, once the press has left the focus on the plan. */
function askName() {
  setTimeout(() => { if (selected) { nameField.focus(); nameField.select(); } });
}

/** What a click of the route tool means: a place, and what caught it. */
function routePlace(at) {
  const [entrance, stop] = [nearest(placed.entrances, at), nearest(placed.stops, at)];
  if (stop >= 0) return { at: placed.stops[stop].at, stop: placed.stops[stop].name };
  if (entrance >= 0) return { at: placed.entrances[entrance].at };
  const middle = ({ ends: [a, b] }) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  const opening = data.openings.find((known) => distance(toScreen(middle(known)), toScreen(at)) <= 2 * NEAR_PX);
  return opening ? { at: middle(opening), opening: opening.name } : { at: rounded(at) };
}

function finishRoute() {
  const places = route;
  route = [];
  draft = null;
  const ends = [places[0], places.at(-1)];
  if (places.length >= 2 && ends.every((end) => end.stop === undefined)) {
    add('routes', { name: `route ${placed.routes.length + 1}`, places });
    say('The route is there; the next click begins another.');
  } else if (places.length) {
    say(places.length < 2 ? 'A route needs a start and an end.' : 'A route starts and ends beside stops, not at one.');
  }
  draw();
}

/** What each tool does with a press at a place, a drag from there, and the release. */
const ACTIONS = {
  piece: {
    press(at) {
      const pixel = pixelAt(at);
      if (!pixel) return;
      const is = now[pixel[1] * WIDTH + pixel[0]];
      // Arcs and leaves are thin, and what lies behind them is a whole room.
      const door = is === DOOR || PAINTS[is].solid ? null : doorNear(at, DOOR_PX / view.zoom);
      const piece = pieceAt(...(door ?? pixel));
      // A closed door is wall between its jambs, not along its leaf.
      paintAndTell(PAINTS[chosen].solid && (door || is === DOOR) ? gapOf(piece) : piece);
    },
  },
  brush: {
    last: null,
    press(at, event) {
      this.stroke = new Set(strokeOf(event.shiftKey && this.last ? this.last : at, at, brush.value / 2));
      this.last = at;
      draft = { points: [at, at], colour: `rgb(${PAINTS[chosen].colour})`, width: brush.value * view.zoom };
    },
    drag(at) {
      for (const pixel of strokeOf(this.last, at, brush.value / 2)) this.stroke.add(pixel);
      this.last = at;
      draft.points.push(at);
    },
    release() { draft = null; paintAndTell([...this.stroke]); },
  },
  box: {
    press(at) { this.from = at; },
    drag(at) {
      const [a, b] = [this.from, at];
      draft = { points: [a, [b[0], a[1]], b, [a[0], b[1]], a], colour: `rgb(${PAINTS[chosen].colour})` };
    },
    release(at) {
      draft = null;
      const side = (axis, most) => [this.from[axis], at[axis]].map((v) => Math.max(0, Math.min(most, Math.round(v)))).sort((a, b) => a - b);
      const [[left, right], [top, bottom]] = [side(0, WIDTH), side(1, HEIGHT)];
      const pixels = [];
      for (let y = top; y < bottom; y++) for (let x = left; x < right; x++) pixels.push(y * WIDTH + x);
      if (pixels.length) paintAndTell(pixels);
    },
  },
  scale: {
    press(at) { this.from = rounded(at); },
    drag(at) { draft = { points: [this.from, at], colour: '#d0006f' }; },
    release(at) {
      draft = null;
      const to = rounded(at);
      if (distance(this.from, to) < 2) return;
      place((all) => { all.scale = { from: this.from, to, metres: null }; });
      showFields();
      metres.value = '';
      metres.focus();
      say(`This is ${(distance(this.from, to) * data.metresPerPixel).toFixed(2)} m as it was read. How far is it?`);
    },
  },
  entrance: {
    press(at) {
      const index = nearest(placed.entrances, at);
      const pixel = pixelAt(at);
      if (index >= 0) selected = ['entrances', index];
      else if (pixel) {
        add('entrances', { at: rounded(at) });
        const solid = PAINTS[now[pixel[1] * WIDTH + pixel[0]]].solid;
        say(solid ? 'The wall is open here now: people come and go.' : 'People come and go here.');
      }
      showFields();
    },
  },
  stop: {
    press(at) {
      const index = nearest(placed.stops, at);
      if (index >= 0) selected = ['stops', index];
      else if (pixelAt(at)) add('stops', { at: rounded(at), name: `stop ${placed.stops.length + 1}`, kind: 'place' });
      showFields();
      askName();
    },
  },
  route: {
    press(at, event) {
      if (!pixelAt(at)) return;
      const next = routePlace(at);
      if (route.length && (event.detail > 1 || distance(toScreen(route.at(-1).at), toScreen(next.at)) < 4)) return finishRoute();
      route.push(next);
      draft = { points: route.map((place) => place.at), colour: '#7a2bb5', dash: [5, 4] };
      say(route.length === 1 ? `From ${next.opening ?? 'here'}. Click on; twice where it ends.` : 'Click on, or twice to end here.');
    },
  },
  room: {
    press(at) {
      const index = nearest(placed.rooms, at);
      if (index >= 0) selected = ['rooms', index];
      else if (pixelAt(at)) add('rooms', { at: rounded(at), name: `room ${placed.rooms.length + 1}` });
      showFields();
      askName();
    },
  },
};

function remove() {
  if (tool === 'scale') place((all) => { all.scale = null; });
  else if (selected) place((all) => all[selected[0]].splice(selected[1], 1));
  selected = null;
  showFields();
}

