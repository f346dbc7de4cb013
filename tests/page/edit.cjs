// Puts a raw plan right by clicks in the edit page, as a user would, and bakes what the page saves.
// usage: edit.cjs PROGRAM FOLDER
'use strict';

const assert = require('node:assert/strict');
const { execFileSync } = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const { chromium } = require('playwright-core');
const { PNG } = require('pngjs');

const [program, folder] = process.argv.slice(2);
const BROWSER = process.env.CHROMIUM || '/usr/bin/chromium';
const FLAGS = ['--no-sandbox', '--disable-gpu', '--force-color-profile=srgb', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];

/** A building of 20 x 12 m at 0.1 m a pixel, without any way in: two rooms, a door between them, a desk as a black block. */
const SIZE = { width: 240, height: 160 };
const DESK = [150, 60, 166, 84];
function isWall(x, y) {
  const within = ([left, top, right, bottom]) => x >= left && y >= top && x < right && y < bottom;
  const building = within([20, 20, 220, 140]);
  const inside = within([24, 24, 216, 136]);
  return (building && !inside) || (within([118, 20, 122, 140]) && !within([118, 66, 122, 80])) || within(DESK);
}
/** Metres per pixel that the page is told: the plan alone would be taken for another scale. */
const SCALE_M = 0.1;

/** A drawing with doors, and places on one of them, in pixels; beside its arc; and in the room that it opens into. */
const CAD = path.join(__dirname, '../../docs/images/plan-cad.png');
const [GAP, LEAF, ARC, BESIDE, ROOM] = [[225, 675], [262, 705], [292, 696], [298, 694], [310, 655]];

function drawPlan(file) {
  const png = new PNG(SIZE);
  for (let y = 0; y < SIZE.height; y++) {
    for (let x = 0; x < SIZE.width; x++) {
      const at = 4 * (y * SIZE.width + x);
      png.data.fill(isWall(x, y) ? 0 : 255, at, at + 3);
      png.data[at + 3] = 255;
    }
  }
  fs.writeFileSync(file, PNG.sync.write(png));
}

const run = (...words) => execFileSync(program, words, { cwd: folder, encoding: 'utf8' });

/** Mean of the floor's passes, a logarithm up to 255, over a rectangle of plan pixels. */
function passes(out, [left, top, right, bottom]) {
  const { floor } = JSON.parse(fs.readFileSync(path.join(out, 'manifest.json')));
  const file = fs.readdirSync(path.join(out, 'floor')).find((name) => /passes.*1001\.png$/.test(name));
  const png = PNG.sync.read(fs.readFileSync(path.join(out, 'floor', file)));
  const texels = (floor.texels_per_metre ?? 25) * SCALE_M;
  let [sum, count] = [0, 0];
  // Texel rows of a tile count from below, as metres do.
  const rows = [bottom, top].map((y) => png.height - (SIZE.height - y) * texels);
  for (let y = Math.ceil(rows[1]); y < rows[0]; y++) {
    for (let x = Math.ceil(left * texels); x < right * texels; x++) {
      sum += png.data[4 * (y * png.width + x)];
      count++;
    }
  }
  assert.ok(count > 100, `${count} texels`);
  return sum / count;
}

async function openPage(browser, file, context = {}) {
  const tab = await (await browser.newContext({ viewport: { width: 1100, height: 700 }, acceptDownloads: true, ...context })).newPage();
  const complaints = [];
  tab.on('console', (message) => { if (['error', 'warning'].includes(message.type())) complaints.push(message.text()); });
  tab.on('pageerror', (error) => complaints.push(error.message));
  tab.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) complaints.push(`asked for ${request.url()}`); });
  await tab.goto(`file://${file}`);
  await tab.evaluate(() => window.trodden.ready);
  const click = async (x, y, options) => tab.mouse.click(...await tab.evaluate((at) => window.trodden.toScreen(at), [x, y]), options);
  const drag = async (from, to) => {
    const [a, b] = await tab.evaluate((ends) => ends.map(window.trodden.toScreen), [from, to]);
    await tab.mouse.move(...a);
    await tab.mouse.down();
    await tab.mouse.move((a[0] + b[0]) / 2, (a[1] + b[1]) / 2, { steps: 3 });
    await tab.mouse.move(...b);
    await tab.mouse.up();
  };
  const nameAt = (x, y) => tab.evaluate(([x, y]) => window.trodden.nameAt(x, y), [x, y]);
  return { tab, click, drag, nameAt, complaints };
}

async function save(tab) {
  const downloads = [];
  tab.on('download', (download) => downloads.push(download));
  await tab.getByRole('button', { name: 'Save' }).click();
  await tab.locator('#saved').waitFor();
  for (let n = 0; n < 50 && downloads.length < 2; n++) await tab.waitForTimeout(100);
  for (const download of downloads) await download.saveAs(path.join(folder, download.suggestedFilename()));
  return downloads.map((download) => download.suggestedFilename()).sort();
}

(async () => {
  fs.rmSync(folder, { recursive: true, force: true });
  fs.mkdirSync(folder, { recursive: true });
  drawPlan(path.join(folder, 'plan.png'));
  run('edit', 'plan.png', '--quiet');
  const browser = await chromium.launch({ executablePath: BROWSER, headless: true, args: FLAGS });
  const page = await openPage(browser, path.join(folder, 'plan-edit.html'));
  const { tab, click, drag, nameAt } = page;
  const middle = [(DESK[0] + DESK[2]) / 2, (DESK[1] + DESK[3]) / 2];

  // The desk becomes floor: a letter chooses the paint, a click the piece; back, and forth again.
  assert.notEqual(await nameAt(...middle), 'floor');
  await tab.keyboard.press('f');
  await click(...middle);
  assert.equal(await nameAt(...middle), 'floor');
  await tab.getByRole('button', { name: 'Undo' }).click();
  assert.notEqual(await nameAt(...middle), 'floor');
  await tab.keyboard.press('Control+Shift+z');
  assert.equal(await nameAt(...middle), 'floor');
  // A table is drawn with the box tool.
  await tab.getByRole('button', { name: 'Box' }).click();
  await tab.locator('#palette label', { hasText: 'table' }).click();
  await tab.getByRole('button', { name: 'Box' }).click();
  await drag([180, 110], [200, 120]);
  assert.equal(await nameAt(190, 115), 'table');
  // The whole drawn width is 20 m.
  await tab.getByRole('button', { name: 'Scale' }).click();
  await drag([20, 10], [220, 10]);
  await tab.keyboard.type('20');
  await tab.keyboard.press('Enter');
  const { scale } = await tab.evaluate(() => window.trodden.placed());
  const metresPerPixel = scale.metres / Math.hypot(scale.to[0] - scale.from[0], scale.to[1] - scale.from[1]);
  assert.ok(Math.abs(metresPerPixel - SCALE_M) < 0.001, `${metresPerPixel} m`);
  // People come through the south wall and walk over where the desk was; back through the north wall.
  await tab.getByRole('button', { name: 'Entrance' }).click();
  await click(60, 138);
  await click(middle[0], 22);
  await tab.getByRole('button', { name: 'Route' }).click();
  await click(60, 138);
  await click(...middle);
  await click(middle[0], 22);
  await click(middle[0], 22);
  const placed = await tab.evaluate(() => window.trodden.placed());
  assert.equal(placed.entrances.length, 2);
  assert.equal(placed.routes.length, 1);
  assert.equal(placed.routes[0].places.length, 3);
  await tab.screenshot({ path: path.join(folder, 'page.png') });
  assert.deepEqual(await save(tab), ['plan-paint.png', 'plan.toml']);
  assert.deepEqual(page.complaints, []);

  // What was saved is baked: beside the route people use both rooms.
  const saved = fs.readFileSync(path.join(folder, 'plan.toml'), 'utf8');
  assert.match(saved, /\n\[life\]\nshare = 0.5\n/);
  run('bake', 'plan.toml', '--quick', '--people', '100', '-o', 'lived', '--quiet');
  const { life } = JSON.parse(fs.readFileSync(path.join(folder, 'lived', 'report.json')));
  assert.ok(life.rooms.length === 2 && life.rooms.every((room) => room.footfalls > 100), JSON.stringify(life));
  // On the route alone the floor of the desk is trodden, that of the table is not.
  fs.writeFileSync(path.join(folder, 'route.toml'), saved.replace('share = 0.5', 'share = 0.0'));
  run('bake', 'route.toml', '--quick', '--people', '100', '-o', 'out', '--quiet');
  const boxes = [[152, 62, 164, 82], [182, 112, 198, 118], [196, 30, 212, 50]];
  const [desk, table, corner] = boxes.map((box) => passes(path.join(folder, 'out'), box));
  console.log(`  passes, of 255: ${desk.toFixed(1)} where the desk was, ${table.toFixed(1)} under the table, ${corner.toFixed(1)} in a corner`);
  assert.ok(desk > 30 && corner < 1 && table === 0);

  // The page goes on from what it saved, and a save without changes is the same.
  const first = fs.readFileSync(path.join(folder, 'plan-paint.png'));
  run('edit', 'plan.toml', '--quiet', '--force');
  const again = await openPage(browser, path.join(folder, 'plan-edit.html'), { colorScheme: 'dark' });
  assert.equal(await again.nameAt(...middle), 'floor');
  assert.equal(await again.nameAt(190, 115), 'table');
  assert.equal(await again.nameAt(60, 138), 'entrance');
  await again.tab.screenshot({ path: path.join(folder, 'again.png') });
  const text = fs.readFileSync(path.join(folder, 'plan.toml'), 'utf8');
  await save(again.tab);
  assert.equal(fs.readFileSync(path.join(folder, 'plan.toml'), 'utf8'), text);
  const [a, b] = [first, fs.readFileSync(path.join(folder, 'plan-paint.png'))].map((bytes) => PNG.sync.read(bytes));
  let off = 0;
  for (let at = 0; at < a.data.length; at += 4) off += a.data[at + 3] !== b.data[at + 3];
  assert.ok(off < 100, `${off} pixels of paint differ`);

  // Keys alone: the cross goes to the desk's place, Enter paints it.
  await again.tab.locator('#view').focus();
  await again.tab.keyboard.press('w');
  await again.tab.keyboard.press('ArrowRight');
  await again.tab.keyboard.press('Enter');
  const cross = await again.tab.evaluate(() => document.getElementById('status').textContent);
  assert.match(cross, /wall/);
  assert.deepEqual(again.complaints, []);

  // A click on a door's gap, its leaf, or beside its arc catches the door: wall closes it between its jambs.
  fs.copyFileSync(CAD, path.join(folder, 'cad.png'));
  run('edit', 'cad.png', '--quiet');
  const cad = await openPage(browser, path.join(folder, 'cad-edit.html'));
  const names = () => Promise.all([GAP, LEAF, ARC, BESIDE].map((at) => cad.nameAt(...at)));
  assert.deepEqual(await names(), ['door', 'door', 'door', 'floor']);
  for (const at of [GAP, LEAF, BESIDE]) {
    await cad.tab.keyboard.press('w');
    await cad.click(at[0] + 0.5, at[1] + 0.5);
    assert.deepEqual(await names(), ['wall', 'door', 'door', 'floor'], `click at ${at}`);
    await cad.tab.getByRole('button', { name: 'Undo' }).click();
  }
  // Floor takes leaf and arc too, and a click well off the door means the room.
  await cad.tab.keyboard.press('f');
  await cad.click(ARC[0], ARC[1]);
  assert.deepEqual(await names(), ['floor', 'floor', 'floor', 'floor']);
  await cad.tab.getByRole('button', { name: 'Undo' }).click();
  await cad.tab.keyboard.press('o');
  await cad.click(...ROOM);
  assert.deepEqual(await names(), ['door', 'door', 'door', 'outside']);
  assert.deepEqual(cad.complaints, []);
  await browser.close();
  console.log('ok      a raw plan is put right by clicks and baked');
})().catch((error) => {
  console.log(`FAILED  ${error.stack}`);
  process.exit(1);
});
