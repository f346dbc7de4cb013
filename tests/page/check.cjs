// Opens the pages in a browser as a reader would, and checks what they show.
// usage: check.cjs PAGES GOLDEN REPORT [PART OF A CHECK'S NAME]
'use strict';

const assert = require('node:assert/strict');
const fs = require('node:fs');
const path = require('node:path');
const { chromium } = require('playwright-core');
const { PNG } = require('pngjs');

const [pages, golden, report, only = ''] = process.argv.slice(2);
const BROWSER = process.env.CHROMIUM || '/usr/bin/chromium';
// A renderer in software, the same everywhere; nothing that calls home.
const FLAGS = [
  '--no-sandbox', '--disable-gpu', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--force-color-profile=srgb',
  '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
];
const SIZE = { width: 480, height: 320 };
/** For walks: every frame of them is drawn, in software. */
const SMALL = { width: 240, height: 160 };
const TINY = { width: 60, height: 40 };
/** Width of golden pictures. */
const GOLDEN_PX = 120;
/** How far a shrunk picture may be from the golden one: on average, and at most, of 255. */
const TOLERANCE = { mean: 2, most: 48 };

/** Where the scripted walk leads. */
const WALKED = { x: 4.55, y: 3, heading: 1.17 };

let browser;

/** A page, opened from disk, with what it must never do. */
async function open(name, { query = '', context = {}, before } = {}) {
  const tab = await (await browser.newContext({ viewport: SIZE, ...context })).newPage();
  const complaints = [];
  // The driver remarks that screenshots are slow.
  tab.on('console', (message) => {
    if (['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall')) complaints.push(message.text());
  });
  tab.on('pageerror', (error) => complaints.push(error.message));
  tab.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) complaints.push(`asked for ${request.url()}`);
  });
  if (before) await before(tab);
  await tab.goto(`file://${path.join(pages, name)}.html${query}`);
  const ready = await tab.evaluate(() => window.trodden.ready.then(() => true, () => false));
  return { tab, complaints, ready };
}

const camera = (tab) => tab.evaluate(() => window.trodden.camera());
const setCamera = (tab, to) => tab.evaluate((to) => window.trodden.setCamera(to), to);
const show = (tab, what) => tab.evaluate((what) => window.trodden.show(what), what);

/** What the view shows, without the panel over it. */
async function picture(tab) {
  await tab.evaluate(() => document.body.classList.add('bare'));
  const png = PNG.sync.read(await tab.screenshot());
  await tab.evaluate(() => document.body.classList.remove('bare'));
  return png;
}

function pixel(png, [x, y]) {
  const at = 4 * (Math.floor(y) * png.width + Math.floor(x));
  return [...png.data.subarray(at, at + 3)];
}

/** Mean and largest difference of two pictures. */
function difference(a, b) {
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  let [sum, most] = [0, 0];
  for (let n = 0; n < a.data.length; n++) {
    if (n % 4 === 3) continue;
    const off = Math.abs(a.data[n] - b.data[n]);
    sum += off;
    most = Math.max(most, off);
  }
  return { mean: sum / (0.75 * a.data.length), most };
}

function shrunk(png) {
  const by = png.width / GOLDEN_PX;
  const small = new PNG({ width: GOLDEN_PX, height: png.height / by });
  for (let y = 0; y < small.height; y++) {
    for (let x = 0; x < small.width; x++) {
      for (let n = 0; n < 4; n++) {
        let sum = 0;
        for (let k = 0; k < by * by; k++) sum += png.data[4 * ((by * y + Math.floor(k / by)) * png.width + by * x + k % by) + n];
        small.data[4 * (y * small.width + x) + n] = Math.round(sum / by ** 2);
      }
    }
  }
  return small;
}

function assertGolden(name, png) {
  const file = path.join(golden, `${name}.png`);
  const actual = shrunk(png);
  if (process.env.BLESS === '1') {
    fs.writeFileSync(file, PNG.sync.write(actual, { colorType: 2 }));
    return;
  }
  const { mean, most } = difference(PNG.sync.read(fs.readFileSync(file)), actual);
  if (mean <= TOLERANCE.mean && most <= TOLERANCE.most) return;
  fs.mkdirSync(report, { recursive: true });
  fs.writeFileSync(path.join(report, `page_${name}.png`), PNG.sync.write(actual));
  assert.fail(`${name} is off by ${mean.toFixed(2)} on average and ${most} at most; see ${report}/page_${name}.png`);
}

/** Keys held for a time that passes as if on a slow day: the same steps on every machine. */
async function hold(tab, keys, milliseconds) {
  for (const key of keys) await tab.keyboard.down(key);
  await tab.clock.runFor(milliseconds);
  for (const key of keys) await tab.keyboard.up(key);
}

async function stopClock(tab) {
  await tab.clock.install({ time: 0 });
  await tab.clock.pauseAt(1000);
}

const checks = {
  async 'a scripted walk'() {
    const { tab, complaints, ready } = await open('light', { before: stopClock, context: { viewport: SMALL } });
    assert.ok(ready);
    await tab.clock.runFor(100);
    const first = await picture(tab);
    assertGolden('start', first);
    const inset = await tab.locator('#plan').screenshot();
    await tab.locator('#view').focus();
    await hold(tab, ['w'], 1500);
    await hold(tab, ['q'], 700);
    await hold(tab, ['ArrowUp', 'd'], 400);
    const there = await camera(tab);
    console.log(`  walked to ${there.x.toFixed(2)}, ${there.y.toFixed(2)}, heading ${there.heading.toFixed(2)}`);
    // A frame more or less is a few centimetres, which a picture shows: it is taken from the very place.
    const off = Math.hypot(there.x - WALKED.x, there.y - WALKED.y) + Math.abs(there.heading - WALKED.heading);
    assert.ok(off < 0.25, JSON.stringify(there));
    await setCamera(tab, { inside: true, ...WALKED });
    const second = await picture(tab);
    assert.ok(difference(first, second).mean > 8);
    assertGolden('walked', second);
    assert.notDeepEqual(inset, await tab.locator('#plan').screenshot());
    // Nothing moves by itself.
    await tab.clock.runFor(100);
    const frames = await tab.evaluate(() => window.trodden.frames());
    await tab.clock.runFor(2000);
    assert.equal(await tab.evaluate(() => window.trodden.frames()), frames);
    assert.equal(difference(second, await picture(tab)).most, 0);
    return complaints;
  },

  async 'walls stop a walker'() {
    const { tab, complaints } = await open('light', { before: stopClock, context: { viewport: TINY } });
    await tab.locator('#view').focus();
    for (const [x, y, heading, axis, wall] of [[3, 2.6, Math.PI / 2, 'y', 4], [3, 2.6, -Math.PI / 2, 'y', 1.5], [1, 2.6, 0, 'x', 13], [5, 6, 2.6, 'x', 4]]) {
      await setCamera(tab, { inside: true, x, y, heading });
      await hold(tab, ['w', 'Shift'], 3500);
      const off = Math.abs((await camera(tab))[axis] - wall);
      assert.ok(off > 0.2 && off < 0.32, `${off} m from the wall at ${axis} = ${wall}`);
    }
    // A camera asked for inside a wall stands beside it.
    await setCamera(tab, { inside: true, x: 1, y: 7 });
    assert.ok((await camera(tab)).y < 4);
    return complaints;
  },

  async 'the baked colours'() {
    const complaints = [];
    for (const name of ['light', 'dark']) {
      const { clean, places } = JSON.parse(fs.readFileSync(path.join(pages, `${name}.json`)));
      const opened = await open(name);
      const off = async (expected) => {
        const png = await picture(opened.tab);
        let [sum, count] = [0, 0];
        for (const { at, colour } of places) {
          const seen = await opened.tab.evaluate(([x, y]) => window.trodden.project(x, y, 0), at);
          if (!seen || seen[0] < 0 || seen[1] < 0 || seen[0] >= SIZE.width || seen[1] >= SIZE.height) continue;
          const shown = pixel(png, seen);
          shown.forEach((value, n) => { sum += Math.abs(value - expected(colour)[n]); });
          count += 3;
        }
        assert.ok(count > 60, `${count}`);
        return sum / count;
      };
      await setCamera(opened.tab, { inside: false, x: 3.5, y: 2.6, heading: Math.PI / 2, pitch: -1.5, distance: 9 });
      await show(opened.tab, { lit: false });
      const baked = await off((colour) => colour);
      await show(opened.tab, { amount: 0 });
      const plain = await off(() => clean);
      const dirty = await off((colour) => colour);
      console.log(`  ${name}: ${baked.toFixed(2)} from the bake, ${plain.toFixed(2)} from clean at 0 %`);
      assert.ok(baked < 3 && plain < 3 && dirty > 5);
      await show(opened.tab, { amount: 2 });
      assert.ok(await off((colour) => colour) > 3);
      complaints.push(...opened.complaints);
    }
    return complaints;
  },

  async 'stills of the same cameras'() {
    const complaints = [];
    for (const name of ['light', 'dark']) {
      const { tab, complaints: some } = await open(name);
      await show(tab, { amount: 0 });
      const still = (view) => PNG.sync.read(fs.readFileSync(path.join(pages, `${name}-${view}.png`)));
      const { mean } = difference(shrunk(await picture(tab)), shrunk(still('start')));
      await setCamera(tab, { inside: false });
      const [above, expected] = [await picture(tab), still('above')];
      const off = [];
      for (const { at } of JSON.parse(fs.readFileSync(path.join(pages, `${name}.json`))).places) {
        const seen = await tab.evaluate(([x, y]) => window.trodden.project(x, y, 0), at);
        const there = pixel(expected, seen);
        // Stills cut rooms into a block, which hides some of the floor: its top is bluish, walls are light.
        const floor = there[0] > (name === 'light' ? 1.04 : 1.015) * there[2] && (name === 'light' || there[0] < 100);
        if (floor) off.push(...pixel(above, seen).map((value, n) => Math.abs(value - there[n])));
      }
      const floor = off.reduce((sum, value) => sum + value, 0) / off.length;
      console.log(`  ${name}: inside ${mean.toFixed(1)} from the still, floor from above ${floor.toFixed(1)} at ${off.length / 3} places`);
      assert.ok(mean < 5 && floor < 2 && off.length >= 90);
      complaints.push(...some);
    }
    return complaints;
  },

  async 'slider and switches'() {
    const { tab, complaints } = await open('light', { context: { viewport: { width: 700, height: 500 } } });
    await setCamera(tab, { inside: true, x: 2, y: 2.6, heading: 0.5, pitch: -0.35 });
    const before = await picture(tab);
    const places = await tab.evaluate(() => {
      const grid = (of) => Array.from({ length: 400 }, (_, n) => window.trodden.project(...of(n % 20, Math.floor(n / 20))));
      return { floor: grid((i, j) => [2.6 + i * 0.08, 2 + j * 0.09, 0]), wall: grid((i, j) => [3.2 + i * 0.06, 4, j * 0.1]) };
    });
    const changed = async () => {
      const now = await picture(tab);
      const sums = { floor: 0, wall: 0 };
      for (const [name, grid] of Object.entries(places)) {
        for (const at of grid) {
          if (!at || at[0] < 0 || at[1] < 0 || at[0] >= now.width || at[1] >= now.height) continue;
          sums[name] += pixel(now, at).reduce((sum, value, k) => sum + Math.abs(value - pixel(before, at)[k]), 0);
        }
      }
      return sums;
    };
    assert.deepEqual(await changed(), { floor: 0, wall: 0 });
    await tab.getByLabel('Trodden film').click();
    let sums = await changed();
    assert.ok(sums.floor > 2000 && sums.wall === 0, JSON.stringify(sums));
    await tab.getByLabel('Trodden film').click();
    await tab.getByLabel('Hands').click();
    sums = await changed();
    assert.ok(sums.wall > 50 && sums.floor === 0, JSON.stringify(sums));
    await tab.getByLabel('Hands').click();
    assert.deepEqual(await changed(), { floor: 0, wall: 0 });
    await tab.locator('#amount').focus();
    await tab.keyboard.press('Home');
    assert.equal(await tab.locator('#amount-text').textContent(), '0 %');
    sums = await changed();
    assert.ok(sums.floor > 2000 && sums.wall > 50, JSON.stringify(sums));
    // Pictures are taken without the panel, which takes the focus from it.
    await tab.locator('#amount').focus();
    await tab.keyboard.press('End');
    await tab.waitForFunction(() => document.getElementById('amount').getAttribute('aria-valuetext') === '200 percent');
    assert.ok((await changed()).floor > 2000);
    await tab.locator('#view').focus();
    await tab.keyboard.press('c');
    assert.equal(await tab.locator('#amount-text').textContent(), '0 %');
    return complaints;
  },

  async 'orbit, small plan, going there'() {
    const { tab, complaints } = await open('light', { context: { viewport: { width: 900, height: 640 } } });
    await tab.getByRole('button', { name: 'Orbit' }).click();
    const above = await camera(tab);
    assert.equal(above.inside, false);
    await tab.mouse.move(600, 300);
    await tab.mouse.down();
    await tab.mouse.move(680, 330, { steps: 4 });
    await tab.mouse.up();
    await tab.mouse.wheel(0, -300);
    await tab.waitForFunction((distance) => window.trodden.camera().distance < distance, above.distance);
    assert.notEqual((await camera(tab)).heading, above.heading);
    await setCamera(tab, { inside: false, x: 6.5, y: 4, heading: Math.PI / 2, pitch: -0.9, distance: 20 });
    const at = await tab.evaluate(() => window.trodden.project(6, 2.2, 0));
    await tab.mouse.dblclick(at[0], at[1]);
    let there = await camera(tab);
    assert.ok(there.inside && Math.hypot(there.x - 6, there.y - 2.2) < 0.1, JSON.stringify(there));
    // The corridor's west end on the small plan.
    const box = await tab.locator('#plan').boundingBox();
    await tab.mouse.click(box.x + 20, box.y + 10 + (box.height - 20) * 5.4 / 8);
    there = await camera(tab);
    assert.ok(there.x < 1.5 && Math.abs(there.y - 2.6) < 0.6, JSON.stringify(there));
    await tab.keyboard.press('v');
    assert.equal((await camera(tab)).inside, false);
    await setCamera(tab, { inside: false, x: 6.5, y: 4, heading: 1.1, pitch: -0.85, distance: 19 });
    await tab.setViewportSize(SIZE);
    await tab.waitForFunction((width) => document.getElementById('view').width === width, SIZE.width);
    await tab.waitForTimeout(200);
    assertGolden('orbit', await picture(tab));
    return complaints;
  },

  async 'the graphics card is lost and found'() {
    const { tab, complaints } = await open('light');
    const before = await picture(tab);
    await tab.evaluate(async () => {
      const lost = document.getElementById('view').getContext('webgl2').getExtension('WEBGL_lose_context');
      lost.loseContext();
      await new Promise((done) => setTimeout(done, 100));
      window.before = window.trodden.frames();
      lost.restoreContext();
    });
    await tab.waitForFunction(() => window.trodden.frames() > window.before);
    assert.ok(difference(before, await picture(tab)).most <= 2);
    return complaints.filter((text) => !/context ?lost/i.test(text));
  },

  async 'small textures'() {
    const { tab, complaints, ready } = await open('light', { query: '?texture=64' });
    assert.ok(ready);
    const first = await picture(tab);
    assert.ok(first.data.some((value, n) => n % 4 < 3 && value > 150));
    return complaints;
  },

  async 'without WebGL 2'() {
    const without = () => {
      const get = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return kind === 'webgl2' ? null : get.call(this, kind, ...rest); };
    };
    const { tab, ready } = await open('light', { before: (tab) => tab.addInitScript(without) });
    assert.equal(ready, false);
    assert.match(await tab.locator('#cover').textContent(), /WebGL 2/);
    assert.ok(await tab.locator('#cover').isVisible());
    return [];
  },

  async 'a phone'() {
    const { tab, complaints } = await open('light', {
      context: { viewport: { width: 260, height: 460 }, deviceScaleFactor: 2, hasTouch: true, isMobile: true },
    });
    assert.equal(await tab.locator('#settings').isVisible(), false);
    const box = await tab.locator('#stick').boundingBox();
    const start = await camera(tab);
    await tab.evaluate(({ x, y }) => {
      const send = (type, y) => document.getElementById('stick').dispatchEvent(new PointerEvent(type, { pointerId: 1, pointerType: 'touch', clientX: x, clientY: y, bubbles: true }));
      document.getElementById('stick').setPointerCapture = () => {};
      send('pointerdown', y - 50);
      window.release = () => send('pointerup', y);
    }, { x: box.x + box.width / 2, y: box.y + box.height / 2 });
    await tab.waitForFunction((x) => window.trodden.camera().x > x + 0.2, start.x);
    await tab.evaluate(() => window.release());
    await tab.locator('#fold').tap();
    await tab.locator('#orbit').tap();
    assert.equal(await tab.locator('#stick').isVisible(), false);
    assert.equal(await tab.evaluate(() => document.getElementById('view').width), 520);
    return complaints;
  },

  async 'the shader of a bake'() {
    const file = path.join(__dirname, '../../src/export/targets/files/trodden_masks.glsl');
    const tab = await (await browser.newContext()).newPage();
    const shown = await tab.evaluate((law) => {
      const gl = document.createElement('canvas').getContext('webgl2');
      const program = gl.createProgram();
      const add = (type, text) => {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, `#version 300 es\nprecision highp float;\n${text}`);
        gl.compileShader(shader);
        gl.attachShader(program, shader);
        return gl.getShaderInfoLog(shader);
      };
      const told = add(gl.VERTEX_SHADER, 'void main() { gl_Position = vec4(0, 0, 0, 1); gl_PointSize = 500.0; }')
        + add(gl.FRAGMENT_SHADER, `${law}
          uniform sampler2D none;
          out vec4 colour;
          void main() {
            // Skin of density 0.7 and scuffs of 0.3 on a light wall; heel marks of 0.5 on a grey floor; nothing beyond a tile.
            vec4 wall = troddenWallDirt(1.0 - exp(-vec4(0.7, 0.0, 0.3, 0.0)), vec4(1.0), vec3(0.8), 0.5);
            vec4 ground = troddenDirt(1.0 - exp(-vec4(0.0, 0.0, 0.0, 0.5)), vec4(1.0), vec3(0.4), 0.5);
            vec4 outside = troddenMasks(none, none, vec2(1.5)) + 0.0 * troddenWallMasks(none, none, vec2(0.5));
            colour = vec4(wall.r, wall.b, ground.r, outside.r);
          }`);
      gl.linkProgram(program);
      if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return told + gl.getProgramInfoLog(program);
      gl.useProgram(program);
      gl.drawArrays(gl.POINTS, 0, 1);
      const pixel = new Uint8Array(4);
      gl.readPixels(100, 100, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      return [...pixel].map((byte) => byte / 255);
    }, fs.readFileSync(file, 'utf8'));
    // Linear light of the wall's red and blue, and of the floor's red.
    const over = (clean, dirt, total) => dirt + (clean - dirt) * Math.exp(-total);
    const wanted = [over(0.8, 0.7 * 0.191202 + 0.3 * 0.019382, 1), over(0.8, 0.7 * 0.068478 + 0.3 * 0.024158, 1), over(0.4, 0.019382, 0.5), 0];
    assert.ok(Array.isArray(shown) && shown.every((value, k) => Math.abs(value - wanted[k]) < 0.005), `${shown}; wanted ${wanted}`);
    return [];
  },
};

(async () => {
  browser = await chromium.launch({ executablePath: BROWSER, headless: true, args: FLAGS });
  let failed = 0;
  for (const [name, check] of Object.entries(checks).filter(([name]) => name.includes(only))) {
    try {
      assert.deepEqual(await check(), [], 'the page complains');
      console.log(`ok      ${name}`);
    } catch (error) {
      failed++;
      console.log(`FAILED  ${name}: ${error.stack}`);
    }
  }
  await browser.close();
  process.exitCode = failed ? 1 : 0;
})();
