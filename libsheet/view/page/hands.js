// What hands do: pointers, keys, buttons.

import {forgetAddress, readAddress} from "./address.js";
import {meet, stateOf} from "./measure.js";
import {themed} from "./plots.js";
import {show} from "./showing.js";
import {$, askTriangle, camera, extent, now, part, plane, shown, shownQuantities, state, streams, times} from "./state.js";
import {add, dot, subtract} from "./vectors.js";

// The stream and the place in its part of the picture, -1 to 1.
function partAt(event) {
  const bounds = $("view").getBoundingClientRect(), px = event.clientX - bounds.left, py = event.clientY - bounds.top;
  for (let i = 0; i < streams.length; ++i) {
    const {x, y, width, height} = part(i);
    if (px >= x && px < x + width && py >= y && py < y + height)
      return {i, x: 2 * (px - x) / width - 1, y: 1 - 2 * (py - y) / height, width, height};
  }
  return null;
}

function click(event) {
  const at = partAt(event);
  if (!at)
    return;
  const {frame, shape} = shown[at.i], cut = plane(), hidden = p => cut && dot(p, cut.normal) > cut.at;
  const start = subtract(camera.eye, extent.origin), direction = camera.ray(at.x, at.y, at.width, at.height);
  const hit = meet(frame, shape, start, direction, hidden);
  if (state.measuring) {
    if (hit)
      state.ends = [...(state.ends.length > 1 ? [] : state.ends), add(add(start, direction, hit.distance), extent.origin)];
  } else if (hit) {
    askTriangle(at.i, stateOf(frame, hit.triangle, hit.weights));
  } else {
    state.asked = null;
  }
  show(true);
}

function listenToPointers() {
  const view = $("view"), fingers = new Map();
  let way = 0;
  view.addEventListener("pointerdown", event => {
    view.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    way = fingers.size > 1 ? Infinity : 0;
  });
  view.addEventListener("pointermove", event => {
    const before = fingers.get(event.pointerId);
    if (!before)
      return;
    const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
    const {width, height} = part(0), size = Math.min(width, height);
    way += Math.abs(dx) + Math.abs(dy);
    if (fingers.size === 2) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
      const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
      camera.zoom(apart(before, other) / Math.max(apart([event.clientX, event.clientY], other), 1));
      camera.move(dx / 2 / size, dy / 2 / size);
    } else if (event.buttons & 6 || event.shiftKey) {
      camera.move(dx / size, dy / size);
    } else if (way > 4) {
      camera.turn(4 * dx / size, 4 * dy / size);
    }
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    show();
  });
  view.addEventListener("pointerup", event => {
    fingers.delete(event.pointerId);
    if (way <= 4 && event.button === 0 && !event.shiftKey)
      click(event);
    show(true);
  });
  view.addEventListener("pointercancel", event => fingers.delete(event.pointerId));
  view.addEventListener("contextmenu", event => event.preventDefault());
  view.addEventListener("wheel", event => {
    event.preventDefault();
    camera.zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY * 0.0015))));
    show(true);
  }, {passive: false});
}

function setCut(name) {
  state.cut = null;
  if (name) {
    const axis = "xyz".indexOf(name), toward = camera.toward;
    const normal = axis < 0 ? toward : [0, 1, 2].map(i => i !== axis ? 0 : toward[axis] < 0 ? -1 : 1);
    state.cut = {name, normal, at: dot(normal, extent.origin)};
  }
  show(true);
}

function moveCut(part) {
  if (state.cut)
    state.cut.at = dot(state.cut.normal, extent.origin) + part * extent.radius;
  show(true);
}

function goTo(moment) {
  const ready = Math.min(...streams.map(s => s.frames.length === s.times.length ? Infinity : s.times[s.frames.length - 1]));
  moment = Math.max(0, Math.min(times.length - 1, moment));
  while (moment > 0 && times[moment] > ready)
    --moment;
  if (moment === state.moment)
    return;
  state.moment = moment;
  show(true);
}

// A run plays in 2 to 10 seconds, in its own time if that is between.
function play() {
  state.playing = !state.playing;
  if (state.playing && state.moment === times.length - 1)
    state.moment = 0;
  const all = times.at(-1) - times[0], rate = all / Math.max(2, Math.min(10, all)), from = now();
  let began = null;
  const go = clock => {
    if (!state.playing)
      return;
    began ??= clock;
    const time = from + rate * (clock - began) / 1000;
    goTo(Math.max(0, times.findLastIndex(t => t <= time)));
    if (time >= times.at(-1)) {
      state.playing = false;
      show(true);
    }
    requestAnimationFrame(go);
  };
  requestAnimationFrame(go);
  show(true);
}

export function fit() {
  const {width, height} = part(0);
  camera.fit(extent.origin, extent.corners, width, height);
  show(true);
}

function lookAlong(axis) {
  const [right, , back] = [0, 1, 2].map(i => [0, 1, 2].map(k => Number(k === i)));
  const toward = [right, [0, 1, 0], back][axis], height = dot(toward, camera.up);
  camera.elevation = Math.asin(Math.max(-1, Math.min(1, height)));
  if (Math.abs(height) < 0.99)
    camera.azimuth = Math.atan2(dot(toward, camera.right), dot(toward, camera.front));
  show(true);
}

function changeTheme() {
  const root = document.documentElement, dark = themed("--back") === "#15181c";
  root.dataset.theme = dark ? "light" : "dark";
  show(true);
}

const toggle = name => {
  state[name] = !state[name];
  show(true);
};
function forget() {
  Object.assign(state, {asked: null, ends: [], measuring: false, cut: null});
  show(true);
}
const setColour = name => {
  state.colour = name;
  show(true);
};

const keys = {
  " ": play, w: () => toggle("mesh"), o: () => toggle("solids"), m: () => toggle("measuring"), f: fit, t: changeTheme,
  ArrowLeft: () => goTo(state.moment - 1), ArrowRight: () => goTo(state.moment + 1),
  Home: () => goTo(0), End: () => goTo(times.length - 1), Escape: forget,
  x: () => lookAlong(0), y: () => lookAlong(1), z: () => lookAlong(2),
  "+": () => { camera.zoom(0.8); show(true); }, "-": () => { camera.zoom(1.25); show(true); },
  "?": () => $("keys").showModal(),
  "[": () => moveCut(Math.max(-1, Number($("cutat").value) - 0.02)), "]": () => moveCut(Math.min(1, Number($("cutat").value) + 0.02)),
  c: () => {
    const names = ["", "x", "y", "z", "view"];
    setCut(names[(names.indexOf(state.cut ? state.cut.name : "") + 1) % names.length]);
  },
};
["plain", ...shownQuantities.map(({name}) => name)].slice(0, 9).forEach((name, i) => { keys[i + 1] = () => setColour(name); });

export function offerQuantities() {
  for (const {name} of shownQuantities)
    $("colour").append(new Option(name));
  $("colourkeys").textContent = shownQuantities.slice(0, 8).map((_, i) => i + 2).join(" ");
  $("colournames").textContent = shownQuantities.slice(0, 8).map(({name}) => name).join(", ");
}

export function listen() {
  listenToPointers();
  window.addEventListener("keydown", event => {
    const own = event.target.matches("select, input, button") && [" ", "Home", "End", "ArrowLeft", "ArrowRight"].includes(event.key);
    if (event.ctrlKey || event.metaKey || event.altKey || own || $("keys").open || !keys[event.key])
      return;
    event.preventDefault();
    keys[event.key]();
  });
  window.addEventListener("resize", () => show(true));
  window.addEventListener("hashchange", () => {
    forgetAddress();
    Object.assign(state, {asked: null, ends: [], cut: null, colour: "plain"});
    readAddress();
    show(true);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => show(true));
  $("time").addEventListener("input", event => goTo(Number(event.target.value)));
  $("colour").addEventListener("change", event => setColour(event.target.value));
  $("cut").addEventListener("change", event => setCut(event.target.value));
  $("cutat").addEventListener("input", event => moveCut(Number(event.target.value)));
  for (const [id, act] of [["play", play], ["mesh", keys.w], ["solids", keys.o], ["measure", keys.m], ["fit", fit],
                           ["theme", changeTheme], ["help", keys["?"]], ["close", () => $("keys").close()]])
    $(id).addEventListener("click", act);
}
