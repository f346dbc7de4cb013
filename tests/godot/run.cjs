// Runs a package in Godot for the web, in headless Chromium, until it prints `wrong: N`; exits with 1 unless N is 0 and
// Godot had nothing to complain about.
// usage: run.cjs ENGINE PACKAGE      ENGINE is the folder of index.js and index.wasm
'use strict';

const fs = require('node:fs');
const http = require('node:http');
const path = require('node:path');
const { chromium } = require('playwright-core');

const [engine, pack] = process.argv.slice(2);
const BROWSER = process.env.CHROMIUM || '/usr/bin/chromium';
const FLAGS = ['--no-sandbox', '--disable-gpu', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];
const LONGEST_MS = 60_000;

const PAGE = `<!doctype html><canvas id="canvas"></canvas><script src="index.js"></script><script>
  const engine = new Engine({
    executable: 'index', mainPack: 'check.pck', canvas: document.getElementById('canvas'), canvasResizePolicy: 0,
    args: ['--headless'], serviceWorker: '', persistentPaths: [],
    onPrint: (text) => console.log(text), onPrintError: (text) => console.error(text),
  });
  engine.startGame().catch((error) => console.error(String(error)));
</script>`;

async function main() {
  const types = { '.js': 'text/javascript', '.wasm': 'application/wasm' };
  const server = http.createServer((request, response) => {
    const name = path.basename(new URL(request.url, 'http://localhost').pathname) || 'index.html';
    const file = name === 'check.pck' ? pack : path.join(engine, name);
    const content = name === 'page.html' ? PAGE : fs.existsSync(file) && fs.readFileSync(file);
    const type = name === 'page.html' ? 'text/html' : types[path.extname(name)] || 'application/octet-stream';
    // Without these Godot has no threads.
    const headers = { 'Content-Type': type, 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };
    response.writeHead(content ? 200 : 404, headers).end(content || '');
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  const browser = await chromium.launch({ executablePath: BROWSER, args: FLAGS });
  try {
    const tab = await browser.newPage();
    let complaints = 0;
    let begun = false;
    const wrong = new Promise((done, fail) => {
      tab.on('console', (message) => {
        if (message.location().url.endsWith('favicon.ico')) return;
        begun ||= message.text() === 'checks begin';
        complaints += begun && message.type() === 'error';
        console.log(message.text());
        const last = /^wrong: (\d+)$/.exec(message.text());
        if (last) done(Number(last[1]));
      });
      setTimeout(() => fail(new Error(`Godot is not done after ${LONGEST_MS} ms`)), LONGEST_MS).unref();
    });
    await tab.goto(`http://127.0.0.1:${server.address().port}/page.html`);
    process.exitCode = (await wrong) + complaints > 0 ? 1 : 0;
    if (complaints) console.log(`BAD  Godot complains ${complaints} times`);
  } finally {
    await browser.close();
    server.close();
  }
}

main().catch((error) => { console.error(error); process.exit(1); });
