// Keys, mouse, fingers, switches, the small plan.

const held = new Set();
const KEYS = {
  KeyW: 'ahead', ArrowUp: 'ahead', KeyS: 'back', ArrowDown: 'back', KeyA: 'left', ArrowLeft: 'turnLeft',
  KeyD: 'right', ArrowRight: 'turnRight', KeyQ: 'turnLeft', KeyE: 'turnRight',
  ShiftLeft: 'hurry', ShiftRight: 'hurry', PageUp: 'closer', PageDown: 'farther',
};
/** Metres per second, radians per second. */
const PACE = 1.9;
const HURRY = 4.2;
const TURN = 1.6;
const stick = { ahead: 0, right: 0 };

/** Whether the last frame's wishes go on; moves by what `seconds` allow. */
function advance(seconds) {
  const wish = (plus, minus) => (held.has(plus) ? 1 : 0) - (held.has(minus) ? 1 : 0);
  let ahead = wish('ahead', 'back') + stick.ahead;
  let right = wish('right', 'left') + stick.right;
  const turn = wish('turnLeft', 'turnRight');
  const zoomed = wish('farther', 'closer');
  if (!ahead && !right && !turn && !zoomed) return false;
  const most = Math.max(1, Math.hypot(ahead, right));
  const far = (held.has('hurry') ? HURRY : PACE) * seconds / most;
  if (state.inside) walkBy(ahead * far, right * far);
  else pan(right * 0.6 * seconds, ahead * 0.6 * seconds);
  if (turn) look(turn * TURN * seconds, 0);
  if (zoomed && !state.inside) zoom(2 ** (zoomed * seconds));
  return true;
}

/** Whether a key is meant for something else. */
function typing(event) {
  const slides = event.target.id === 'amount' && /^(Arrow|Page|Home|End)/.test(event.code);
  return slides || event.ctrlKey || event.metaKey || event.altKey;
}

addEventListener('keydown', (event) => {
  if (typing(event)) return;
  const key = KEYS[event.code];
  if (key) {
    held.add(key);
    event.preventDefault();
    invalidate();
  } else if (!event.repeat && event.code === 'KeyV') setInside(!state.inside);
  else if (!event.repeat && event.code === 'KeyC') setAmount(state.amount > 0 ? 0 : 1);
  else if (!event.repeat && event.code === 'KeyH') document.body.classList.toggle('bare');
});
addEventListener('keyup', (event) => held.delete(KEYS[event.code]));
addEventListener('blur', () => held.clear());

// Pointers on the view.

const pointers = new Map();
let pinch = null;

const inView = (event) => {
  const box = canvas.getBoundingClientRect();
  return [2 * (event.clientX - box.left) / box.width - 1, 1 - 2 * (event.clientY - box.top) / box.height];
};

canvas.addEventListener('pointerdown', (event) => {
  canvas.setPointerCapture(event.pointerId);
  canvas.focus({ preventScroll: true });
  pointers.set(event.pointerId, { x: event.clientX, y: event.clientY, button: event.button });
  pinch = null;
  canvas.classList.add('held');
  if (event.pointerType === 'touch') document.body.classList.add('touch');
});

canvas.addEventListener('pointermove', (event) => {
  const before = pointers.get(event.pointerId);
  if (!before) return;
  const size = Math.max(canvas.clientHeight, 1);
  const [dx, dy] = [(event.clientX - before.x) / size, (event.clientY - before.y) / size];
  before.x = event.clientX;
  before.y = event.clientY;
  if (pointers.size === 2) gesture(size);
  else if (!state.inside && (before.button === 2 || before.button === 1 || event.shiftKey)) pan(-dx, dy);
  // The scene follows the hand.
  else if (state.inside) look(dx * 1.5, dy * 1.5);
  else look(-dx * 3, -dy * 3);
  invalidate();
});

/** Two fingers: apart and together zooms (inside: walks), both together move. */
function gesture(size) {
  const [a, b] = [...pointers.values()];
  const now = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.max(8, Math.hypot(a.x - b.x, a.y - b.y)) };
  if (pinch) {
    if (state.inside) walkBy(Math.log(now.apart / pinch.apart) * 4 + (pinch.y - now.y) / size * 4, (now.x - pinch.x) / size * 4);
    else {
      zoom(pinch.apart / now.apart);
      pan((pinch.x - now.x) / size, (now.y - pinch.y) / size);
    }
  }
  pinch = now;
}

for (const name of ['pointerup', 'pointercancel']) {
  canvas.addEventListener(name, (event) => {
    pointers.delete(event.pointerId);
    pinch = null;
    if (!pointers.size) canvas.classList.remove('held');
  });
}

canvas.addEventListener('wheel', (event) => {
  event.preventDefault();
  const lines = event.deltaY * (event.deltaMode === 1 ? 30 : event.deltaMode === 2 ? 400 : 1);
  if (state.inside) walkBy(clamp(-lines / 200, -1, 1), 0);
  else zoom(Math.exp(clamp(lines, -400, 400) / 800));
  invalidate();
}, { passive: false });

canvas.addEventListener('contextmenu', (event) => event.preventDefault());

// `dblclick` comes from double taps as well where the page forbids zooming by them.
canvas.addEventListener('dblclick', (event) => {
  const place = floorAt(...inView(event));
  if (place) goTo(place);
});

// The ring for the thumb.

const ring = element('stick');
const knob = ring.firstElementChild;

function moveStick(event) {
  const box = ring.getBoundingClientRect();
  const radius = box.width / 2;
  let [x, y] = [(event.clientX - box.left - radius) / radius, (event.clientY - box.top - radius) / radius];
  const length = Math.hypot(x, y);
  if (length > 1) [x, y] = [x / length, y / length];
  stick.right = Math.abs(x) > 0.12 ? x : 0;
  stick.ahead = Math.abs(y) > 0.12 ? -y : 0;
  knob.style.transform = `translate(${x * 2.4}rem, ${y * 2.4}rem)`;
  invalidate();
}

ring.addEventListener('pointerdown', (event) => {
  ring.setPointerCapture(event.pointerId);
  moveStick(event);
});
ring.addEventListener('pointermove', (event) => ring.hasPointerCapture(event.pointerId) && moveStick(event));
for (const name of ['pointerup', 'pointercancel']) {
  ring.addEventListener(name, () => {
    stick.ahead = stick.right = 0;
    knob.style.transform = '';
  });
}
if (matchMedia('(pointer: coarse)').matches) document.body.classList.add('touch');

// The panel.

function showMode() {
  element('walk').setAttribute('aria-pressed', state.inside);
  element('orbit').setAttribute('aria-pressed', !state.inside);
  document.body.classList.toggle('walking', state.inside);
}

function setAmount(amount) {
  state.amount = clamp(Number(amount) || 0, 0, 2);
  const percent = Math.round(100 * state.amount);
  element('amount').value = percent;
  element('amount').setAttribute('aria-valuetext', `${percent} percent`);
  element('amount-text').textContent = `${percent} %`;
  invalidate();
}

function setKind(surface, n, on) {
  state.kinds[surface][n] = Boolean(on);
  const box = element(`${surface}-${n}`);
  if (box) box.checked = state.kinds[surface][n];
  invalidate();
}

for (const surface of ['floor', 'wall']) {
  const list = element(`${surface}-kinds`);
  list.hidden = !data.parts.some((part) => part.surface === surface && part.image);
  data.surfaces[surface].kinds.forEach((kind, n) => {
    const label = document.createElement('label');
    const box = document.createElement('input');
    box.type = 'checkbox';
    box.id = `${surface}-${n}`;
    box.checked = true;
    box.addEventListener('change', () => setKind(surface, n, box.checked));
    const dot = document.createElement('i');
    dot.style.background = `rgb(${kind.srgb})`;
    label.append(box, kind.name, dot);
    list.append(label);
  });
}

element('orbit').addEventListener('click', () => setInside(false));
element('walk').addEventListener('click', () => setInside(true));
element('amount').addEventListener('input', (event) => setAmount(event.target.value / 100));
element('fold').addEventListener('click', () => fold(!element('settings').hidden));

function fold(folded) {
  element('settings').hidden = folded;
  element('fold').setAttribute('aria-expanded', !folded);
}
// On a phone the view comes first.
if (matchMedia('(max-width: 640px), (max-height: 480px)').matches) fold(true);

// The small plan.

const small = element('plan');
let ground = null;

/** From the plan frame to pixels of the small plan. */
function smallPlace([x, y]) {
  return [ground.left + (x - plan.low[0]) * ground.scale, ground.top + (plan.high[1] - y) * ground.scale];
}

function sizeSmall() {
  const dense = devicePixelRatio || 1;
  const most = clamp(Math.min(innerWidth, innerHeight) * 0.3, 110, 260);
  const [width, depth] = [Math.max(plan.high[0] - plan.low[0], 0.1), Math.max(plan.high[1] - plan.low[1], 0.1)];
  const scale = (most - 20) / Math.max(width, depth);
  const size = [Math.max(width * scale + 20, 60), Math.max(depth * scale + 20, 40)];
  [small.width, small.height] = size.map((side) => Math.round(side * dense));
  [small.style.width, small.style.height] = size.map((side) => `${side}px`);
  ground = { dense, scale: scale * dense, left: (small.width - width * scale * dense) / 2, top: (small.height - depth * scale * dense) / 2 };
  // The plan itself is drawn once.
  ground.sheet = document.createElement('canvas');
  [ground.sheet.width, ground.sheet.height] = [small.width, small.height];
  const pen = ground.sheet.getContext('2d');
  pen.beginPath();
  for (const outline of data.outlines) {
    outline.points.forEach((p, n) => pen[n ? 'lineTo' : 'moveTo'](...smallPlace(p)));
    pen.closePath();
  }
  pen.fillStyle = 'rgba(240, 238, 232, 0.82)';
  pen.fill('evenodd');
}

function drawSmall() {
  if (!ground) return;
  const pen = small.getContext('2d');
  pen.clearRect(0, 0, small.width, small.height);
  pen.drawImage(ground.sheet, 0, 0);
  const from = state.inside ? walker : { at: orbiter.target, heading: orbiter.heading };
  const [x, y] = smallPlace(from.at);
  const size = ground.dense;
  pen.save();
  pen.translate(x, y);
  pen.rotate(-from.heading);
  const cone = pen.createRadialGradient(0, 0, 0, 0, 0, 34 * size);
  cone.addColorStop(0, 'rgba(214, 120, 20, 0.75)');
  cone.addColorStop(1, 'rgba(214, 120, 20, 0)');
  pen.fillStyle = cone;
  pen.beginPath();
  pen.moveTo(0, 0);
  pen.arc(0, 0, 34 * size, -0.55, 0.55);
  pen.fill();
  pen.beginPath();
  pen.arc(0, 0, 4.5 * size, 0, 2 * Math.PI);
  pen.fillStyle = '#c8620a';
  pen.fill();
  pen.lineWidth = 1.5 * size;
  pen.strokeStyle = '#fff';
  pen.stroke();
  pen.restore();
}

small.addEventListener('pointerdown', (event) => {
  const box = small.getBoundingClientRect();
  const [px, py] = [(event.clientX - box.left) * ground.dense, (event.clientY - box.top) * ground.dense];
  const place = [plan.low[0] + (px - ground.left) / ground.scale, plan.high[1] - (py - ground.top) / ground.scale];
  if (!state.inside) {
    orbiter.target = [clamp(place[0], plan.low[0], plan.high[0]), clamp(place[1], plan.low[1], plan.high[1]), 0];
    invalidate();
  } else if (plan.holds(place)) goTo(place);
});

