// Saving: the scenario as TOML and the paint as a picture that holds only what differs from the reading.

const quoted = (text) => JSON.stringify(text).replace(/\u007f/g, '\\u007f');
const px = ([x, y]) => `{ px = [${x.toFixed(1)}, ${y.toFixed(1)}] }`;
const placeText = ({ at, opening, stop }) => (stop !== undefined || opening !== undefined ? quoted(stop ?? opening) : px(at));

/** Share of people who use the rooms beside the first routes. */
const ROUTES_LEAVE = 0.5;

/** Sets keys of a table in the text of a scenario; `null` takes a key away. */
function withKeys(text, table, keys) {
  const lines = text.split('\n');
  let start = lines.findIndex((row) => new RegExp(`^\\s*\\[\\s*${table}\\s*\\]`).test(row));
  if (start < 0) {
    lines.unshift(`[${table}]`);
    start = 0;
  }
  let end = lines.findIndex((row, n) => n > start && /^\s*\[/.test(row));
  if (end < 0) end = lines.length;
  const own = lines.slice(start + 1, end).filter((row) => !Object.keys(keys).some((key) => new RegExp(`^\\s*${key}\\s*=`).test(row)));
  const set = Object.entries(keys).filter(([, value]) => value !== null).map(([key, value]) => `${key} = ${value}`);
  return [...lines.slice(0, start + 1), ...set, ...own, ...lines.slice(end)].join('\n');
}

/** Leaves the rooms in use beside the first routes, unless the scenario says how much. */
function withLife(text) {
  const table = text.match(/^[ \t]*\[[ \t]*life[ \t]*\][^\[]*/m)?.[0];
  if (/^[ \t]*life[ \t]*[.=]/m.test(text) || /^[ \t]*share[ \t]*=/m.test(table ?? '')) return text;
  // A new table stands last: keys without a table have to stay at the top.
  return withKeys(table ? text : `${text.trimEnd()}\n\n[life]\n`, 'life', { share: ROUTES_LEAVE });
}

/** The scenario as TOML. */
function scenarioText(hasPaint) {
  const keys = { paint: hasPaint ? quoted(data.paintFile) : null };
  const { scale } = placed;
  if (scale?.metres) {
    keys.scale = `{ from = ${px(scale.from)}, to = ${px(scale.to)}, metres = ${scale.metres} }`;
    keys.metres_per_pixel = null;
  } else if (data.writesScale) {
    keys.metres_per_pixel = String(data.metresPerPixel);
  }
  let text = data.toml || `[plan]\nimage = ${quoted(data.image)}\n`;
  if (placed.routes.length && !data.written) text = withLife(text);
  text = withKeys(text, 'plan', keys).trimEnd() + '\n';
  for (const { at, name, kind } of placed.stops) text += `\n[[stop]]\nname = ${quoted(name)}\nkind = "${kind}"\nat = ${px(at)}\n`;
  for (const { name, places } of placed.routes) {
    const via = places.slice(1, -1).map(placeText);
    text += `\n[[route]]\nname = ${quoted(name)}\nfrom = ${placeText(places[0])}\nto = ${placeText(places.at(-1))}\n`;
    if (via.length) text += `via = [${via.join(', ')}]\n`;
  }
  for (const { at, name } of placed.rooms) text += `\n[[room]]\nname = ${quoted(name)}\nat = ${px(at)}\n`;
  return text;
}

/** The paint: transparent where the plan stays as read. `null` if that is everywhere. */
async function paintBlob() {
  const image = new ImageData(WIDTH, HEIGHT);
  const words = new Uint32Array(image.data.buffer);
  const word = PAINTS.map(({ colour: [r, g, b] }) => (255 << 24 | b << 16 | g << 8 | r) >>> 0);
  let any = false;
  for (let at = 0; at < now.length; at++) {
    if (now[at] === read[at]) continue;
    words[at] = word[now[at]];
    any = true;
  }
  // An entrance is half a metre around its place, and opens the wall there.
  for (const { at } of placed.entrances) {
    for (const pixel of strokeOf(at, at, Math.max(2, 0.5 / metresPerPixel()))) {
      words[pixel] = word[ENTRANCE];
      any = true;
    }
  }
  if (!any) return null;
  const sheet = new OffscreenCanvas(WIDTH, HEIGHT);
  sheet.getContext('2d').putImageData(image, 0, 0);
  return sheet.convertToBlob({ type: 'image/png' });
}

function download(id, name, blob) {
  const link = element(id);
  if (link.href.startsWith('blob:')) URL.revokeObjectURL(link.href);
  link.hidden = !blob;
  if (!blob) return;
  link.href = URL.createObjectURL(blob);
  link.download = link.textContent = name;
  link.click();
}

async function save() {
  // A field that is being typed in counts too.
  document.activeElement?.blur();
  finishRoute();
  if (placed.scale && !placed.scale.metres) return say('The scale lacks its metres: type them, or delete the line.');
  const paintFile = await paintBlob();
  download('saved-toml', data.scenarioFile, new Blob([scenarioText(Boolean(paintFile))], { type: 'application/toml' }));
  download('saved-png', data.paintFile, paintFile);
  const files = paintFile ? `${data.scenarioFile} and ${data.paintFile}` : data.scenarioFile;
  element('saved').hidden = false;
  element('saved-text').textContent = `Put ${files} beside ${data.image}; then: trodden bake ${data.scenarioFile}`;
  unsaved = false;
  say(`Saved ${files}`);
}

