// Joins the parts: the panel, the pointer, the keys.

function buildPanel() {
  Object.entries(TOOLS).forEach(([id, { name }], k) => {
    const button = document.createElement('button');
    Object.assign(button, { type: 'button', textContent: name, title: `${k + 1}` });
    button.dataset.tool = id;
    button.addEventListener('click', () => choose(id));
    element('tools').append(button);
  });
  const list = document.createElement('div');
  element('palette').append(list);
  PAINTS.forEach(({ name, colour: rgb, key, meaning }, number) => {
    const row = document.createElement('label');
    row.title = meaning;
    const [input, chip, text, letter] = ['input', 'i', 'span', 'kbd'].map((kind) => document.createElement(kind));
    Object.assign(input, { type: 'radio', name: 'paint', value: number, checked: number === chosen });
    input.addEventListener('change', () => choosePaint(number));
    chip.style.background = `rgb(${rgb})`;
    text.textContent = name;
    letter.textContent = key;
    row.append(input, chip, text, letter);
    list.append(row);
  });
  for (const [value, text] of Object.entries(KINDS)) kindField.append(new Option(text, value));
  data.warnings.forEach((text) => element('warnings').append(Object.assign(document.createElement('li'), { textContent: text })));
  element('remarks').hidden = !data.warnings.length;
  element('undo').addEventListener('click', undo);
  element('redo').addEventListener('click', redo);
  element('save').addEventListener('click', save);
  element('delete').addEventListener('click', remove);
  opacity.addEventListener('input', draw);
  element('ways').addEventListener('change', draw);
  brush.addEventListener('input', showFields);
  metres.addEventListener('change', () => {
    const value = Number(metres.value);
    if (!(value > 0) || !placed.scale) return say('The distance is a number of metres above 0.');
    place((all) => { all.scale.metres = value; });
    say(`A pixel is ${metresPerPixel().toPrecision(4)} m; the plan is ${(WIDTH * metresPerPixel()).toFixed(1)} x ${(HEIGHT * metresPerPixel()).toFixed(1)} m.`);
  });
  metres.addEventListener('keydown', (event) => { if (event.key === 'Enter') metres.blur(); });
  nameField.addEventListener('change', () => rename());
  kindField.addEventListener('change', () => selected && place((all) => { all.stops[selected[1]].kind = kindField.value; }));
}

/** Renames what is selected; stops keep names of their own, because routes call them by name. */
function rename() {
  if (!selected) return;
  const [list, index] = selected;
  const name = nameField.value.trim();
  const before = placed[list][index].name;
  if (!name || placed[list].some((other, n) => n !== index && other.name === name)) {
    nameField.value = before;
    return say(name ? `There is another called ${name}.` : 'A name is needed.');
  }
  place((all) => {
    all[list][index].name = name;
    if (list !== 'stops') return;
    for (const at of all.routes.flatMap(({ places }) => places)) if (at.stop === before) at.stop = name;
  });
}

/** The pointer: one finger or the left button works, two fingers, other buttons and Space move. */
function listen() {
  const pointers = new Map();
  let mode = null;
  let spread = 0;
  let space = false;
  const placeOf = (event) => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
  const middle = () => { const all = [...pointers.values()]; return [0, 1].map((k) => all.reduce((sum, at) => sum + at[k], 0) / all.length); };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, placeOf(event));
    cross = null;
    if (pointers.size === 1 && event.button === 0 && !space) {
      mode = 'work';
      ACTIONS[tool].press(toPlan(placeOf(event)), event);
    } else {
      mode = 'move';
      draft = null;
      spread = pointers.size > 1 ? distance(...pointers.values()) : 0;
      canvas.classList.add('held');
    }
    draw();
  });
  canvas.addEventListener('pointermove', (event) => {
    const at = placeOf(event);
    if (!pointers.has(event.pointerId)) return tell(toPlan(at));
    const before = middle();
    pointers.set(event.pointerId, at);
    if (mode === 'work') ACTIONS[tool].drag?.(toPlan(at));
    else {
      const after = middle();
      view.x += after[0] - before[0];
      view.y += after[1] - before[1];
      if (pointers.size > 1) {
        const wide = distance(...pointers.values());
        if (spread) zoomBy(wide / spread, after);
        spread = wide;
      }
    }
    draw();
  });
  const end = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (mode === 'work' && event.type === 'pointerup') ACTIONS[tool].release?.(toPlan(placeOf(event)));
    if (!pointers.size) mode = null;
    if (event.type === 'pointercancel') draft = null;
    canvas.classList.remove('held');
    draw();
  };
  canvas.addEventListener('pointerup', end);
  canvas.addEventListener('pointercancel', end);
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoomBy(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), placeOf(event));
  }, { passive: false });
  new ResizeObserver(draw).observe(canvas);
  window.addEventListener('keyup', (event) => { if (event.key === ' ') space = false; });
  window.addEventListener('keydown', (event) => {
    const field = event.target.closest?.('input[type="text"], input[type="number"], select');
    const plain = !event.ctrlKey && !event.metaKey && !event.altKey;
    const key = event.key.toLowerCase();
    if (!plain && key === 's') save();
    else if (field) return;
    else if (!plain && key === 'z') (event.shiftKey ? redo : undo)();
    else if (!plain && key === 'y') redo();
    else if (!plain) return;
    else if (key === ' ' && event.target === canvas) space = true;
    else if (!keyOfPlan(event)) return;
    event.preventDefault();
  });
}

/** Keys for tools, paints, zoom and the cross. Returns whether the key means something. */
function keyOfPlan(event) {
  const key = event.key;
  const names = Object.keys(TOOLS);
  const paintOfKey = PAINTS.findIndex((paint) => paint.key === key.toLowerCase());
  if (names[key - 1]) choose(names[key - 1]);
  else if (paintOfKey >= 0) choosePaint(paintOfKey);
  else if (key === '+' || key === '=') zoomBy(1.25);
  else if (key === '-') zoomBy(0.8);
  else if (key === '0') showAll();
  else if (key === 'Escape') finishRoute();
  else if (key === 'Delete') remove();
  else if (event.target !== canvas) return false;
  else if (key.startsWith('Arrow')) {
    const by = (event.shiftKey ? 1 : 12) / view.zoom;
    const from = cross ?? toPlan([canvas.clientWidth / 2, canvas.clientHeight / 2]);
    const off = { ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, -by], ArrowDown: [0, by] }[key];
    cross = [from[0] + off[0], from[1] + off[1]];
    tell(cross);
    if (held) ACTIONS[tool].drag?.(cross);
  } else if (key === 'Enter' && cross) {
    // With tools that drag, the first Enter begins and the second ends.
    if (held) ACTIONS[tool].release(cross);
    else ACTIONS[tool].press(cross, { detail: 1, shiftKey: event.shiftKey });
    held = !held && Boolean(ACTIONS[tool].release);
  } else return false;
  draw();
  return true;
}
let held = false;

/** Says what is at a place. */
function tell(at) {
  const pixel = pixelAt(at);
  if (!pixel) return;
  const { name, meaning } = PAINTS[now[pixel[1] * WIDTH + pixel[0]]];
  const scale = metresPerPixel();
  say(`${name}: ${meaning} · ${(at[0] * scale).toFixed(2)}, ${((HEIGHT - at[1]) * scale).toFixed(2)} m`);
}

async function start() {
  picture = await canvasOf('picture');
  now = numbersOf(await canvasOf('now'));
  read = element('read') ? numbersOf(await canvasOf('read')) : now.slice();
  classes = new OffscreenCanvas(WIDTH, HEIGHT);
  colour();
  buildPanel();
  listen();
  onChange = (box) => {
    if (box) colour(box);
    if (selected && !placed[selected[0]][selected[1]]) selected = null;
    showFields();
    draw();
  };
  window.addEventListener('beforeunload', (event) => { if (unsaved) event.preventDefault(); });
  choose('piece');
  showAll();
  say(data.lack || 'Click what was read wrong; then save.');
}

// For tests.
window.trodden = {
  ready: start(),
  toScreen: (at) => { const box = canvas.getBoundingClientRect(); const [x, y] = toScreen(at); return [box.left + x, box.top + y]; },
  nameAt: (x, y) => PAINTS[now[y * WIDTH + x]].name,
  placed: () => placed,
};
window.trodden.ready.catch((error) => say(`The page does not work in this browser: ${error.message}`));
