// The board: picture, classes over it, and what is placed, moved and zoomed.

const canvas = element('view');
const board = canvas.getContext('2d');
const opacity = element('opacity');
/** Screen pixels per pixel of the plan, and where its upper left corner is on the screen. */
const view = { zoom: 1, x: 0, y: 0 };
/** The cross that the keyboard moves, in plan pixels; and the line that is being drawn, in plan pixels. */
let cross = null;
let draft = null;
let picture, classes;
let wanted = false;

/** Draws soon, once for all that changes until then. */
function draw() {
  if (wanted) return;
  wanted = true;
  requestAnimationFrame(() => {
    wanted = false;
    drawNow();
  });
}

/** Writes the colours of the paints of a rectangle. */
function colour([left, top, right, bottom] = [0, 0, WIDTH, HEIGHT]) {
  if (right <= left || bottom <= top) return;
  const image = new ImageData(right - left, bottom - top);
  const words = new Uint32Array(image.data.buffer);
  const colours = PAINTS.map(({ colour: [r, g, b] }) => (255 << 24 | b << 16 | g << 8 | r) >>> 0);
  let n = 0;
  for (let y = top; y < bottom; y++) {
    for (let x = left; x < right; x++) words[n++] = colours[now[y * WIDTH + x]];
  }
  classes.getContext('2d').putImageData(image, left, top);
}

const toScreen = ([x, y]) => [view.x + x * view.zoom, view.y + y * view.zoom];
const toPlan = ([x, y]) => [(x - view.x) / view.zoom, (y - view.y) / view.zoom];

/** Zooms around a place on the screen. */
function zoomBy(factor, [x, y] = [canvas.clientWidth / 2, canvas.clientHeight / 2]) {
  const least = 0.5 * Math.min(canvas.clientWidth / WIDTH, canvas.clientHeight / HEIGHT, 1);
  const zoom = Math.max(least, Math.min(64, view.zoom * factor));
  view.x = x - (x - view.x) * zoom / view.zoom;
  view.y = y - (y - view.y) * zoom / view.zoom;
  view.zoom = zoom;
  draw();
}

/** Shows the whole plan. */
function showAll() {
  view.zoom = 0.95 * Math.min(canvas.clientWidth / WIDTH, canvas.clientHeight / HEIGHT);
  view.x = (canvas.clientWidth - WIDTH * view.zoom) / 2;
  view.y = (canvas.clientHeight - HEIGHT * view.zoom) / 2;
  draw();
}

function line(points, { colour: ink, width = 2, dash = [] }) {
  board.beginPath();
  points.map(toScreen).forEach(([x, y], k) => (k ? board.lineTo(x, y) : board.moveTo(x, y)));
  // A pale seam keeps lines visible on any colour.
  for (const [style, wide] of [['rgba(255, 255, 255, 0.85)', width + 2.5], [ink, width]]) {
    board.setLineDash(style === ink ? dash : []);
    board.strokeStyle = style;
    board.lineWidth = wide;
    board.stroke();
  }
  board.setLineDash([]);
}

function disc(at, radius, fill, text = '') {
  const [x, y] = toScreen(at);
  board.beginPath();
  board.arc(x, y, radius, 0, 2 * Math.PI);
  board.fillStyle = fill;
  board.fill();
  board.lineWidth = 1.5;
  board.strokeStyle = '#fff';
  board.stroke();
  if (text) label(text, [x + radius + 4, y]);
}

function label(text, [x, y]) {
  board.font = '600 13px system-ui, sans-serif';
  board.textBaseline = 'middle';
  board.lineWidth = 4;
  board.lineJoin = 'round';
  board.strokeStyle = 'rgba(255, 255, 255, 0.9)';
  board.strokeText(text, x, y);
  board.fillStyle = '#1d1e20';
  board.fillText(text, x, y);
}

function drawNow() {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  board.setTransform(ratio, 0, 0, ratio, 0, 0);
  board.clearRect(0, 0, width, height);
  board.imageSmoothingEnabled = view.zoom < 1.5;
  const place = [view.x, view.y, WIDTH * view.zoom, HEIGHT * view.zoom];
  board.drawImage(picture, ...place);
  board.globalAlpha = opacity.value / 100;
  board.drawImage(classes, ...place);
  board.globalAlpha = 1;
  if (element('ways').checked) {
    for (const way of data.ways) line(way.points, { colour: '#3465c4', width: 1.5, dash: [7, 5] });
    for (const { name, ends } of data.openings) {
      line(ends, { colour: '#0a8a2a', width: 5 });
      label(name, toScreen([(ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2]));
    }
  }
  for (const { name, places } of placed.routes) {
    line(places.map((at) => at.at), { colour: '#7a2bb5', width: 2.5 });
    disc(places[0].at, 4, '#7a2bb5', name);
    disc(places.at(-1).at, 6, '#7a2bb5');
  }
  const metre = 1 / metresPerPixel();
  placed.entrances.forEach(({ at }) => disc(at, Math.max(6, 0.5 * metre * view.zoom), 'rgba(255, 0, 0, 0.8)', 'entrance'));
  placed.stops.forEach(({ at, name, kind }) => disc(at, 6, '#c25a00', `${name} (${kind})`));
  placed.rooms.forEach(({ at, name }) => label(name, toScreen(at)));
  const { scale } = placed;
  if (scale) {
    line([scale.from, scale.to], { colour: '#d0006f', width: 2.5 });
    [scale.from, scale.to].forEach((end) => disc(end, 4, '#d0006f'));
    const middle = [0, 1].map((axis) => (scale.from[axis] + scale.to[axis]) / 2);
    label(scale.metres ? `${scale.metres} m` : 'how far?', toScreen(middle));
  }
  if (draft) line(draft.points, draft);
  if (cross) {
    const [x, y] = toScreen(cross);
    board.strokeStyle = '#000';
    board.lineWidth = 1;
    board.strokeRect(x - 7, y - 7, 14, 14);
    line([toPlan([x - 12, y]), toPlan([x + 12, y])], { colour: '#000', width: 1.5 });
    line([toPlan([x, y - 12]), toPlan([x, y + 12])], { colour: '#000', width: 1.5 });
  }
}

