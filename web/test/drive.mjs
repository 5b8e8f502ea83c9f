// Drives the page in headless Chromium, and compares its pictures and proofs with those of the program.
//   node drive.mjs SITE PROGRAM OUTPUT [MINUTES]      TOOLS: a folder with playwright-core; CHROMIUM: the browser
// OUTPUT gets screenshots. MINUTES: how long the page is used to see whether its memory grows.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join } from "node:path";
import { gzipSync } from "node:zlib";

const [site, program, output, minutes = "0"] = process.argv.slice(2);
const { chromium } = createRequire(join(process.env.TOOLS ?? ".", "here"))("playwright-core");
const TYPES = { ".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".wasm": "application/wasm" };
mkdirSync(output, { recursive: true });

const names = ["index.html", "page.css", "page.js", "pkg/page.js", "pkg/page_bg.wasm"];
const files = new Map(names.map((name) => [name, gzipSync(readFileSync(join(site, name)))]));
const server = createServer((request, answer) => {
  const name = new URL(request.url, "http://localhost").pathname.replace("/page/", "") || "index.html";
  answer.writeHead(files.has(name) ? 200 : 404, { "Content-Type": TYPES[extname(name)], "Content-Encoding": "gzip" });
  answer.end(files.get(name));
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
// Below a folder, because the page has relative addresses.
const origin = `http://127.0.0.1:${server.address().port}`;
const address = `${origin}/page/`;
// Emulated ratios are unknown to `devicePixelContentBoxSize`.
const launch = (ratio) => chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", `--force-device-scale-factor=${ratio}`],
});
const browser = await launch(1);

const say = (text) => console.log(text);
const median = (values) => [...values].sort((one, other) => one - other)[values.length >> 1];
const quiet = (page, milliseconds) => page.waitForTimeout(milliseconds);
const outcome = (page) => page.evaluate(() => shadetrade.outcome());
/// Waits for a test to hold in the page. `waitForFunction` needs `eval`, which the page forbids, in versions for Node.js 18.
const until = async (page, test, argument, timeout = 180_000) => {
  for (const end = Date.now() + timeout; Date.now() < end; await quiet(page, 50)) {
    // A page that is being loaded has no context yet.
    if (await page.evaluate(test, argument).catch(() => false)) return;
  }
  assert.fail(`it does not come: ${test}`);
};
const shot = (page, name) => page.screenshot({ path: join(output, `${name}.png`) });
const run = (...words) => execFileSync(program, words, { maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });

/// Opens the page in a window, and waits for the first picture.
async function open(viewport, options = {}, own = browser) {
  const context = await own.newContext({ viewport, ...options });
  const page = await context.newPage();
  const faults = [];
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("request", (request) => /^(data|blob):/.test(request.url()) || request.url().startsWith(origin) || faults.push(`request of ${request.url()}`));
  page.faults = faults;
  await page.addInitScript(() => {
    globalThis.hashed = async (context, ...place) => {
      const hash = await crypto.subtle.digest("SHA-256", context.getImageData(...place).data);
      return Array.from(new Uint8Array(hash), (byte) => byte.toString(16).padStart(2, "0")).join("");
    };
    // Times from an input to the pixels that it changed.
    globalThis.delays = [];
    let pressed;
    addEventListener("keydown", (event) => { pressed = event.timeStamp; }, true);
    const put = CanvasRenderingContext2D.prototype.putImageData;
    CanvasRenderingContext2D.prototype.putImageData = function (...picture) {
      put.apply(this, picture);
      globalThis.firstPicture ??= performance.now();
      if (pressed) delays.push(performance.now() - pressed);
      pressed = undefined;
    };
  });
  await page.goto(address);
  await until(page, () => document.getElementById("note").hidden);
  return page;
}

/// A hash of the pixels of the picture on screen, and of those of a PNG.
const shown = async (page) => {
  const { picture: [{ x, y }, [width, height]] } = await outcome(page);
  return page.evaluate(([x, y, width, height]) => hashed(document.getElementById("canvas").getContext("2d"), x, y, width, height), [x, y, width, height].map(Math.round));
};
const decoded = (page, png) => page.evaluate(async (text) => {
  const picture = await createImageBitmap(new Blob([Uint8Array.from(atob(text), (letter) => letter.charCodeAt())]));
  const context = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
  context.drawImage(picture, 0, 0);
  return hashed(context, 0, 0, picture.width, picture.height);
}, png.toString("base64"));

async function drop(page, name, text) {
  const data = await page.evaluateHandle(([name, text]) => {
    const data = new DataTransfer();
    data.items.add(new File([text], name));
    return data;
  }, [name, text]);
  await page.dispatchEvent("#canvas", "drop", { dataTransfer: data });
}

/// A place of the status line, which has no tooltip.
const AWAY = [600, 706];

/// Shows the whole picture, over which nothing is written, and drags the numbers under the heading of the scene until one of
/// them is an edit.
async function edit(page) {
  await page.keyboard.press("g");
  await page.keyboard.press("e");
  await quiet(page, 300);
  for (let y = 430; y < 740; y += 11) {
    await page.mouse.move(98, y);
    await page.mouse.down();
    await page.mouse.move(112, y, { steps: 3 });
    await page.mouse.up();
    await quiet(page, 100);
    if (!(await page.title()).includes("*")) continue;
    // The tooltip of the number does not stay on the picture.
    await page.mouse.move(...AWAY);
    await page.keyboard.press("e");
    return quiet(page, 500);
  }
  assert.fail("no number was found that can be dragged");
}

async function latency(page, keys, count, during) {
  await page.evaluate(() => { delays = []; });
  for (let index = 0; index < count; index += 1) {
    await page.keyboard.press(keys[index % keys.length]);
    await quiet(page, 40);
  }
  const times = await page.evaluate(() => delays);
  say(`  key to changed pixels ${during}: median ${median(times).toFixed(1)} ms, largest ${Math.max(...times).toFixed(1)} ms, ${times.length} keys`);
  return median(times);
}

const checks = {
  async "the first picture"() {
    const page = await open({ width: 1366, height: 768 });
    say(`  after ${(await page.evaluate(() => firstPicture)).toFixed(0)} ms`);
    assert.ok((await page.title()).startsWith("cuboid (Ctrl S writes "));
    await shot(page, "1366x768-first");
    return page;
  },

  async "keys, a click, the chart, a proof"(page) {
    await page.keyboard.press("p");
    await until(page, () => shadetrade.outcome().method === "Phong within half a level");
    await page.mouse.click(700, 300);
    await until(page, () => shadetrade.outcome().pixel);
    await until(page, () => shadetrade.outcome().trade && shadetrade.outcome().proof);
    await shot(page, "1366x768-proven");
    const { proof, trade, pixel, picture: [, [width, height]] } = await outcome(page);
    const sized = ["--size", `${width}x${height}`, "--simd", "fallback"];
    const native = JSON.parse(run("prove", "--shading", "phong", ...sized, "--json"));
    for (const key of ["pixels", "proven", "refuted", "undecided", "gaps", "outline", "worst", "widest_enclosure"]) {
      assert.equal(proof[key], native[key], `prove: ${key}`);
    }
    say(`  ${proof.proven} of ${proof.pixels} pixels proven, at most ${proof.worst} off, as the program says; pixel ${pixel}`);
    const rows = JSON.parse(readFileSync(tradeOf(width, height))).methods;
    for (const own of trade) {
      const row = rows.find((it) => it.id === own.id);
      assert.ok(Math.abs(own.error.max - row.error.max) < 1e-9 * (1 + row.error.max), row.id);
      const [here, there] = [own, row].map((it) => it.ms === null ? "not timed" : `${it.ms.median.toFixed(2)} ms`);
      assert.equal(own.ms === null, row.ms === null, `timed: ${row.id}`);
      say(`  ${row.id.padEnd(20)} ${here.padStart(10)}, the program ${there.padStart(10)}`);
    }
  },

  async "a number that is varied"(page) {
    await page.keyboard.press("v");
    const start = Date.now();
    await until(page, () => shadetrade.outcome().varied);
    say(`  the curves of ${(await outcome(page)).varied.key} after ${Date.now() - start} ms`);
    await shot(page, "1366x768-varied");
    await page.keyboard.press("v");
  },

  async "a wipe and its divider"(page) {
    await page.keyboard.press("F3");
    await quiet(page, 300);
    const before = await shown(page);
    const { picture: [corner, size] } = await outcome(page);
    const divider = /^divider = ([0-9.]+)/m.exec(readFileSync(new URL("../../assets/scenes/cuboid.toml", import.meta.url), "utf8"))[1];
    const [x, y] = [corner.x + size[0] * divider, corner.y + size[1] * 0.9];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x - 150, y, { steps: 5 });
    await page.mouse.up();
    await quiet(page, 300);
    assert.notEqual(await shown(page), before, "the divider moves");
    await shot(page, "1366x768-wipe");
    await page.keyboard.press("F2");
    await page.keyboard.press("Escape");
  },

  async "a lesson to its end"(page) {
    await page.click("text=why the plane stays dull");
    await until(page, () => shadetrade.outcome().name === "lessons/why-the-plane-stays-dull");
    const text = readFileSync(new URL("../../assets/lessons/why-the-plane-stays-dull.toml", import.meta.url), "utf8");
    const sentences = new Set();
    for (const step of text.split("[[step]]").slice(1)) {
      const { name, sentence } = await outcome(page);
      assert.equal(name, "lessons/why-the-plane-stays-dull");
      assert.ok(step.includes(sentence) && (await page.textContent("#status")).includes(sentence));
      sentences.add(sentence);
      if (sentences.size === 3) await shot(page, "1366x768-lesson");
      await page.keyboard.press("Enter");
      await quiet(page, 200);
    }
    assert.match(page.url(), /#lessons\/smooth-or-sharp-edges$/, "the last step leads to the next lesson");
  },

  async "an edit, saved and opened again"(page) {
    await page.click("text=default scene");
    await until(page, () => shadetrade.outcome().name === "cuboid");
    await edit(page);
    await until(page, () => Object.keys(localStorage).some((path) => path.startsWith("unsaved/")));
    const [saved] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Control+s")]);
    assert.equal(saved.suggestedFilename(), "cuboid.toml");
    await until(page, () => /#scene=/.test(location.href));
    assert.equal(await page.evaluate(() => Object.keys(localStorage).length), 0, "nothing is unsaved");
    const picture = await shown(page);
    const path = join(output, "cuboid.toml");
    await saved.saveAs(path);
    const link = page.url();
    await page.goto(address);
    await page.reload();
    await until(page, () => document.getElementById("note").hidden);
    assert.notEqual(await shown(page), picture, "the edit is seen");
    await page.setInputFiles("#file", path);
    await until(page, () => shadetrade.outcome().name === "cuboid.toml");
    await quiet(page, 300);
    assert.equal(await shown(page), picture, "the file has the picture");
    await page.goto(`${address}?again${new URL(link).hash}`);
    await until(page, () => document.getElementById("note").hidden);
    assert.equal((await outcome(page)).name, "scene.toml");
    assert.equal(await shown(page), picture, "the link has the picture");
    const [image] = await Promise.all([page.waitForEvent("download"), page.click("text=save the picture")]);
    assert.equal(image.suggestedFilename(), "shadetrade-001.png");
    await image.saveAs(join(output, "saved-picture.png"));
  },

  async "edits that were not saved are offered at the next visit"(page) {
    await page.goto(address);
    await page.reload();
    await until(page, () => document.getElementById("note").hidden);
    await edit(page);
    const edited = await shown(page);
    await until(page, () => Object.keys(localStorage).some((path) => path.startsWith("unsaved/")));
    await page.reload();
    await until(page, () => document.getElementById("note").hidden);
    await quiet(page, 300);
    await shot(page, "1366x768-offered");
    const { picture: [corner, size] } = await outcome(page);
    await page.mouse.click(corner.x + size[0] / 2 + 46, corner.y + 9);
    await page.mouse.move(...AWAY);
    await until(page, () => shadetrade.outcome().title.includes("*"));
    assert.equal(await shown(page), edited, "the edits are restored");
  },

  async "a file that is dropped, and a broken one"(page) {
    const text = readFileSync(new URL("../../assets/scenes/cuboid.toml", import.meta.url), "utf8");
    await drop(page, "mine.toml", text.replace(/^background = .*$/m, "background = [255, 0, 0]"));
    await until(page, () => shadetrade.outcome().name === "mine.toml");
    await quiet(page, 300);
    const { picture: [corner] } = await outcome(page);
    const background = await page.evaluate(({ x, y }) => [...document.getElementById("canvas").getContext("2d").getImageData(x + 3, y + 3, 1, 1).data], corner);
    assert.deepEqual(background, [255, 0, 0, 255]);
    await edit(page);
    await until(page, () => Object.keys(localStorage).some((path) => path.startsWith("unsaved/") && path.includes("mine")));
    await drop(page, "broken.toml", "light = 3");
    await until(page, () => /broken\.toml/.test(shadetrade.outcome().message ?? ""));
    assert.equal((await outcome(page)).name, "mine.toml");
    await shot(page, "1366x768-broken");
    await page.evaluate(() => { location.hash = "#scene=!"; });
    await until(page, () => /no scene/.test(shadetrade.outcome().message ?? ""));
    await page.evaluate(() => { location.hash = "#extremes/near-plane-in-corners"; });
    await until(page, () => shadetrade.outcome().name === "extremes/near-plane-in-corners");
  },

  async "a number is copied, typed and pasted"() {
    const page = await open({ width: 1366, height: 768 });
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    const clipboard = () => page.evaluate(() => navigator.clipboard.readText());
    const isNumber = /^[0-9.]+$/;
    let copied = "";
    await page.keyboard.press("e");
    await quiet(page, 300);
    for (let y = 520; y < 740 && !isNumber.test(copied); y += 11) {
      await page.mouse.click(98, y);
      await quiet(page, 100);
      await page.keyboard.press("Control+a");
      await page.keyboard.press("Control+c");
      await quiet(page, 100);
      copied = await clipboard();
    }
    assert.match(copied, isNumber);
    await page.keyboard.type("123.5");
    await page.keyboard.press("Control+a");
    await page.keyboard.press("Control+x");
    await quiet(page, 100);
    assert.equal(await clipboard(), "123.5");
    await page.keyboard.press("Control+v");
    await page.keyboard.press("Enter");
    await until(page, () => shadetrade.outcome().title.includes("*"));
    await page.keyboard.press("Control+z");
    await until(page, () => !shadetrade.outcome().title.includes("*"));
    return page;
  },

  async "the keyboard leaves the canvas"(page) {
    await page.focus("#canvas");
    await page.keyboard.press("q");
    await until(page, () => document.activeElement.tagName === "A");
  },

  async "the picture's pixels are those of the program"() {
    const page = await open({ width: 1366, height: 768 });
    for (const scene of ["cuboid", "bench-far", "bench-close", "assignment", "extremes/needle-1e-6", "extremes/horizon-1e5"]) {
      await page.goto(`${address}?${scene}#${scene}`);
      await until(page, (scene) => document.getElementById("note").hidden && shadetrade.outcome().name === scene, scene);
      for (const [tolerance, keys] of [["0.5", ""], ["0", "[["]]) {
        for (const key of keys) await page.keyboard.press(key);
        for (const [mode, key] of [["gouraud", "g"], ["phong", "p"]]) {
          await page.keyboard.press(key);
          await quiet(page, 300);
          const { picture: [, [width, height]] } = await outcome(page);
          const png = run("render", scene, "--shading", mode, "--tolerance", tolerance, "--simd", "fallback", "--size", `${width}x${height}`, "-o", "-");
          assert.equal(await shown(page), await decoded(page, png), `${scene}, ${mode}, ${tolerance}`);
        }
      }
    }
  },

  async "a key changes the picture soon"() {
    const page = await open({ width: 1366, height: 768 });
    await page.keyboard.press("p");
    await until(page, () => shadetrade.outcome().proof && shadetrade.outcome().trade);
    const keys = ["ArrowLeft", "ArrowRight", "w", "w", "p", "g"];
    const idle = await latency(page, keys, 60, "(each outdates the facts, which are sought again)");
    await page.keyboard.press("e");
    await until(page, () => shadetrade.outcome().proof && shadetrade.outcome().trade);
    // The view of another method is proven again, and nothing is measured.
    await page.keyboard.press("]");
    await quiet(page, 300);
    const busy = await latency(page, ["Shift+ArrowLeft", "Shift+ArrowRight"], 30, "while it compares and proves");
    assert.ok(Math.max(idle, busy) < 100, "the machine is loaded, or the page is slow");
    return page;
  },

  async "a fault is told"(page) {
    await page.evaluate(() => dispatchEvent(new ErrorEvent("error", { message: "a test" })));
    assert.match(await page.textContent("#note"), /has ended: a test/);
    assert.ok(await page.isVisible("#note"));
    const old = await page.context().newPage();
    await old.addInitScript(() => { WebAssembly.validate = () => false; });
    await old.goto(address);
    await quiet(old, 500);
    assert.ok(await old.isVisible("text=It needs scripts, and WebAssembly with SIMD"));
  },

  async "other windows, also of a phone"() {
    for (const [name, viewport, options] of [
      ["360x740-touch", { width: 360, height: 740 }, { deviceScaleFactor: 3, hasTouch: true, isMobile: true }],
      ["1366x768-ratio-2", { width: 1366, height: 768 }, { deviceScaleFactor: 2 }],
      ["1920x1080", { width: 1920, height: 1080 }, {}],
    ]) {
      const ratio = options.deviceScaleFactor ?? 1;
      const own = await launch(ratio);
      const page = await open(viewport, options, own);
      assert.equal(await page.evaluate(() => document.getElementById("canvas").width / innerWidth), ratio);
      await shot(page, `${name}-first`);
      const { picture: [corner, size] } = await outcome(page);
      const at = [(corner.x + size[0] / 2) / ratio, (corner.y + size[1] / 2) / ratio];
      if (options.hasTouch) await page.touchscreen.tap(...at);
      else await page.mouse.click(...at);
      await until(page, () => shadetrade.outcome().pixel);
      await until(page, () => shadetrade.outcome().error !== null);
      await shot(page, `${name}-pixel`);
      assert.deepEqual(page.faults, []);
      await own.close();
    }
  },

  async "memory"() {
    const page = await open({ width: 1366, height: 768 });
    const end = Date.now() + 60_000 * minutes;
    for (let round = 0; round === 0 || Date.now() < end; round += 1) {
      if (round % 20 === 0) say(`  ${await page.evaluate(() => `${shadetrade.memory() >> 20} MiB of the program, ${performance.memory.usedJSHeapSize >> 20} MiB of scripts`)}`);
      for (const key of ["p", "F4", "F6", "F2", "e", "n", "c", "g", "o", "ArrowLeft", "]", "["]) {
        await page.keyboard.press(key);
        await quiet(page, 150);
      }
    }
  },
};

/// The trade of the program in a picture of this size, as a file.
function tradeOf(width, height) {
  const folder = join(output, "trade");
  run("trade", "--simd", "fallback", "--size", `${width}x${height}`, "--seconds", "2", "-o", folder);
  return join(folder, "trade.json");
}

let page, failed = 0;
for (const [name, check] of Object.entries(checks)) {
  const start = Date.now();
  say(name);
  try {
    page = await check(page) ?? page;
    assert.deepEqual(page.faults.splice(0), [], "nothing is reported on the console");
  } catch (error) {
    failed += 1;
    say(`  FAILED: ${error.message}`);
    await page?.screenshot({ path: join(output, "failed.png") });
  }
  say(`  ${((Date.now() - start) / 1e3).toFixed(1)} s`);
}
await browser.close();
server.close();
process.exitCode = failed && 1;
