// The page around the program: events in; pixels, files and the address out. Nothing leaves the browser.
import init, { Page, insert, key_name, lessons } from "./pkg/page.js";

// A module with one SIMD instruction.
const SIMD = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];
// Files in this folder are kept in the browser's storage; all others are downloads.
const UNSAVED = "unsaved/";
// The longest piece of work in the background, in milliseconds: input waits for it.
const PIECE = 8;
// The longest text of a scene in the address.
const LONGEST_LINK = 2 ** 15;

const [canvas, note, links, status, file] = ["canvas", "note", "links", "status", "file"].map((id) => document.getElementById(id));
const context = canvas.getContext("2d", { alpha: false });
let page, memory, outcome, known, events = [];
let modifiers = { alt: false, ctrl: false, shift: false, mac_cmd: false, command: false };

// Ends the program, and says why. Later reasons follow from the first.
function fail(reason) {
  if (page === null) return;
  page = null;
  note.textContent = `The program has ended: ${reason}\n\nReload the page. Edits that were not saved are offered then.`;
  note.hidden = false;
}

addEventListener("error", (event) => fail(event.message));
addEventListener("unhandledrejection", (event) => fail(event.reason));
// For tests.
globalThis.shadetrade = { outcome: () => outcome, memory: () => memory.buffer.byteLength };

// A step comes before other work, once for all events. Work in the background lets everything else go first.
const post = (task, priority) => globalThis.scheduler?.postTask ? scheduler.postTask(task, { priority }) : setTimeout(task);
let isAsked = false, isWorking = false, frame, timer;

function soon(...more) {
  events.push(...more);
  if (!isAsked) post(step, "user-blocking");
  isAsked = true;
}

function step(leaves = false) {
  isAsked = false;
  const { width, height } = canvas;
  if (!page || !width || !height) return;
  cancelAnimationFrame(frame);
  clearTimeout(timer);
  const input = [performance.now() / 1e3, [width, height], width / canvas.clientWidth, modifiers, events, leaves];
  events = [];
  outcome = JSON.parse(page.step(JSON.stringify(input)));
  context.putImageData(new ImageData(new Uint8ClampedArray(memory.buffer, page.pixels(), 4 * width * height), width, height), 0, 0);
  carryOut(outcome);
  if (outcome.wait < 0.016) frame = requestAnimationFrame(() => soon());
  else if (outcome.wait < 1e6) timer = setTimeout(soon, 1e3 * outcome.wait);
  work();
}

function carryOut({ copied, quits, files, name, title, sentence, message, method, error, proof }) {
  if (copied !== null) copy(copied);
  if (quits) links.querySelector("a").focus();
  for (const [path, content] of files) keep(path, content && new Uint8Array(content));
  if (name !== known || files.some(([path]) => !path.startsWith(UNSAVED))) follow(name);
  document.title = title;
  const facts = [method, error && `${error.toPrecision(3)} levels off exact Phong`, proof && `${proof.proven} of ${proof.pixels} pixels proven`];
  const words = [sentence, message, ...facts].filter(Boolean).join("; ");
  if (status.textContent !== words) status.textContent = words;
}

function work() {
  if (isWorking) return;
  isWorking = true;
  post(() => {
    isWorking = false;
    const start = performance.now();
    if (page?.carry_on(start / 1e3, PIECE / 1e3)) soon();
    // Less time means that no work is left.
    else if (performance.now() - start > PIECE - 1) work();
  }, "background");
}

const say = (text) => {
  page?.say(text);
  soon();
};
const on = (target, names, act, options) => names.split(" ").forEach((name) =>
  target.addEventListener(name, (event) => page && act(event), options));

// Keys. F5, F11, F12 and all with Alt or Ctrl are the browser's, except the program's own with Ctrl; so it sizes the letters,
// too. Tab goes through the controls in the canvas, and Q leaves it for the links below.
const held = new Map();
const keyEvent = (key, pressed, repeat = false) => ({ Key: { key, physical_key: null, pressed, repeat, modifiers } });

function tellModifiers(event) {
  // Windows reports AltGr, which is part of a character, as Ctrl and Alt.
  const isAltGr = event.getModifierState("AltGraph");
  const command = !isAltGr && (event.ctrlKey || event.metaKey);
  modifiers = { alt: !isAltGr && event.altKey, ctrl: command, shift: event.shiftKey, mac_cmd: false, command };
}

function release(codes = [...held.keys()]) {
  soon(...codes.filter((code) => held.has(code)).map((code) => keyEvent(held.get(code), false)));
  for (const code of codes) held.delete(code);
}

on(canvas, "keydown", (event) => {
  tellModifiers(event);
  const isOurs = modifiers.command ? /^([zysa]|Arrow.*|Home|End|Backspace|Delete)$/i : /^(?!(F5|F11|F12)$)/;
  if (!isOurs.test(event.key) || modifiers.alt || event.isComposing) return;
  event.preventDefault();
  // A letter of another alphabet has the name of its place on the keyboard.
  const key = key_name(event.key) ?? key_name(event.code.replace(/^(Key|Digit)/, ""));
  if (key) held.set(event.code, key);
  const isText = [...event.key].length === 1 && !modifiers.command;
  soon(...key ? [keyEvent(key, true, event.repeat)] : [], ...isText ? [{ Text: event.key }] : []);
});
on(canvas, "keyup", (event) => {
  tellModifiers(event);
  // A Mac reports no release of a key while Cmd is held.
  release(event.key === "Meta" ? undefined : [event.code]);
});
on(canvas, "focus blur", ({ type }) => {
  release();
  soon({ WindowFocused: type === "focus" });
});

// The pointer: a mouse, a pen or a finger. Two fingers zoom.
const fingers = new Map();
let notches = 0;

function tellPointer(event, pressed) {
  tellModifiers(event);
  const scale = canvas.width / canvas.clientWidth;
  const pos = { x: event.offsetX * scale, y: event.offsetY * scale };
  soon({ PointerMoved: pos }, ...pressed === undefined ? [] : [{ PointerButton: { pos, button: "Primary", pressed, modifiers } }]);
}

function turnWheel(turned) {
  // The program knows whole notches.
  notches += turned;
  const y = Math.trunc(notches);
  notches -= y;
  if (y) soon({ MouseWheel: { unit: "Line", delta: { x: 0, y }, phase: "Move", modifiers } });
}

const spread = ([one, other] = fingers.values()) => other ? Math.hypot(one.x - other.x, one.y - other.y) : 0;

on(canvas, "pointerdown", (event) => {
  if (event.pointerType === "touch") fingers.set(event.pointerId, event);
  if (event.button || !event.isPrimary) return;
  canvas.setPointerCapture(event.pointerId);
  tellPointer(event, true);
});
on(canvas, "pointermove", (event) => {
  const before = spread();
  if (fingers.has(event.pointerId)) fingers.set(event.pointerId, event);
  if (before) turnWheel(Math.log(spread() / before) / Math.log(1.1));
  else tellPointer(event);
});
on(canvas, "pointerup pointercancel", (event) => {
  fingers.delete(event.pointerId);
  if (event.button > 0 || !event.isPrimary) return;
  tellPointer(event, false);
  if (event.pointerType !== "mouse") soon("PointerGone");
});
on(canvas, "pointerleave", () => soon("PointerGone"));
on(canvas, "wheel", (event) => {
  // Ctrl and the wheel zoom the page.
  if (event.ctrlKey) return;
  event.preventDefault();
  turnWheel(-event.deltaY / (event.deltaMode ? 3 : 100));
}, { passive: false });

// The clipboard. A page that is not secure has none.
const copy = (text) => Promise.resolve().then(() => navigator.clipboard.writeText(text)).catch((error) => say(`not copied: ${error.message}`));

on(document, "copy cut paste", ({ type, clipboardData }) => {
  if (document.activeElement !== canvas) return;
  soon({ copy: "Copy", cut: "Cut", paste: { Paste: clipboardData.getData("text/plain") } }[type]);
});

// Files. Where the browser forbids storage, edits are kept as long as the page is.
let storage = {}; try { storage = localStorage; } catch { }

function keep(path, content) {
  try {
    if (!path.startsWith(UNSAVED)) content && download(path, content);
    else if (content) storage[path] = new TextDecoder().decode(content);
    else delete storage[path];
  } catch (error) {
    say(`not kept: ${error.message}`);
  }
}

function download(path, content) {
  const href = URL.createObjectURL(new Blob([content]));
  Object.assign(document.createElement("a"), { href, download: path.split("/").pop() }).click();
  setTimeout(() => URL.revokeObjectURL(href), 60_000);
}

function open(path, content) {
  if (content) insert(path, content);
  page.open(path);
  // A file of the same name may have another text.
  known = undefined;
  canvas.focus();
  soon();
}

async function openFile([chosen]) {
  // A name without an ending may be built in. More than 17 MiB is too large for the program.
  if (chosen) open(chosen.name.includes(".") ? chosen.name : `./${chosen.name}`, new Uint8Array(await chosen.slice(0, 17 << 20).arrayBuffer()));
}

on(links, "click", ({ target: { id, dataset: { key } } }) => {
  if (id === "open") file.click();
  if (!key) return;
  modifiers = { ...modifiers, ctrl: key === "S", command: key === "S" };
  soon(keyEvent(key, true), keyEvent(key, false));
});
on(file, "change", () => openFile(file.files).finally(() => { file.value = ""; }));
on(window, "dragover drop", (event) => {
  event.preventDefault();
  openFile(event.dataTransfer.files);
});
on(document, "visibilitychange", () => step(true));

// The address: `#lessons/NAME`, `#extremes/NAME`, or `#scene=` and the compressed text of a scene.
const through = async (data, stream) => new Uint8Array(await new Response(new Blob([data]).stream().pipeThrough(stream)).arrayBuffer());

async function follow(name) {
  known = name;
  const text = page.text();
  const bytes = await through(text ?? "", new CompressionStream("deflate"));
  const letters = bytes.length < LONGEST_LINK ? btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_") : "";
  const hash = text === undefined ? name : letters && `scene=${letters}`;
  if (known === name) history.replaceState(null, "", `${location.pathname}${location.search}#${hash}`);
}

async function read() {
  const [, letters] = /^#scene=(.*)/.exec(location.hash) ?? [];
  if (!letters) return open(decodeURIComponent(location.hash.slice(1)) || "cuboid");
  const bytes = Uint8Array.from(atob(letters.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt());
  open("scene.toml", await through(bytes, new DecompressionStream("deflate")));
}

const go = () => read().catch(() => say("not opened: the address holds no scene"));

// The start.
function resize([{ devicePixelContentBoxSize: [box] = [], contentRect }]) {
  canvas.width = box?.inlineSize ?? Math.round(contentRect.width * devicePixelRatio);
  canvas.height = box?.blockSize ?? Math.round(contentRect.height * devicePixelRatio);
  // At once, because the canvas is empty now.
  step();
  if (page) note.hidden = true;
}

async function start() {
  // The note says what is needed.
  if (!globalThis.WebAssembly?.validate(new Uint8Array(SIMD))) return;
  ({ memory } = await init());
  const edits = Object.entries(storage).filter(([path]) => path.startsWith(UNSAVED));
  for (const [path, text] of edits) insert(path, new TextEncoder().encode(text));
  page = new Page(canvas.clientWidth, canvas.clientHeight);
  const link = (name) => ({ href: `#${name}`, textContent: name.replace(/.*\//, "").replaceAll("-", " ") });
  links.querySelector("button").before(...lessons().map((name) => Object.assign(document.createElement("a"), link(name))));
  await go();
  on(window, "hashchange", go);
  const isExact = "devicePixelContentBoxSize" in ResizeObserverEntry.prototype;
  new ResizeObserver(resize).observe(canvas, { box: isExact ? "device-pixel-content-box" : "content-box" });
}

start();
