// The address holds moment and view.

import {stateOf} from "./measure.js";
import {askTriangle, camera, now, shownQuantities, state, streams, times} from "./state.js";

// Browsers take no more than 100 addresses in 30 seconds.
const pause = 400; // [ms]
let writtenAt = 0, timer = 0, known = location.hash;
export function writeAddressSoon() {
  forgetAddress();
  document.body.dataset.address = "behind";
  timer = setTimeout(() => {
    writtenAt = performance.now();
    writeAddress();
    document.body.dataset.address = "written";
  }, Math.max(0, writtenAt + pause - performance.now()));
}

function writeAddress() {
  const brief = numbers => numbers.map(x => Number(x.toPrecision(7))).join();
  const words = new URLSearchParams({t: now(), eye: brief([camera.azimuth, camera.elevation, camera.distance, ...camera.target])});
  if (state.colour !== "plain")
    words.set("colour", state.colour);
  if (state.mesh)
    words.set("mesh", 1);
  if (!state.solids)
    words.set("solids", 0);
  if (state.cut)
    words.set("cut", `${state.cut.name},${brief([...state.cut.normal, state.cut.at])}`);
  if (state.asked)
    words.set("ask", [state.asked.stream, state.asked.start.frame.number, state.asked.start.triangle].join());
  if (state.ends.length === 2)
    words.set("ends", brief(state.ends.flat()));
  if (document.documentElement.dataset.theme)
    words.set("theme", document.documentElement.dataset.theme);
  const hash = "#" + words.toString().replaceAll("%2C", ",");
  if (location.hash !== known)
    return; // a new one, which is about to be read
  if (hash !== location.hash)
    history.replaceState(null, "", hash);
  known = location.hash;
}

// What is shown is no longer written into the address.
export function forgetAddress() {
  clearTimeout(timer);
}

// What makes no sense is passed over.
export function readAddress() {
  known = location.hash;
  const words = new URLSearchParams(location.hash.slice(1));
  const numbers = (name, count) => {
    const list = (words.get(name) || "").split(",").map(x => x === "" ? NaN : Number(x));
    return list.length === count && list.every(Number.isFinite) ? list : null;
  };
  const time = numbers("t", 1), eye = numbers("eye", 6), ends = numbers("ends", 6), ask = numbers("ask", 3);
  if (time)
    state.moment = Math.max(0, times.findLastIndex(t => t <= time[0] + 1e-12));
  if (eye && eye[2] > 0)
    [camera.azimuth, camera.elevation, camera.distance, ...camera.target] = eye;
  if (shownQuantities.some(({name}) => name === words.get("colour")))
    state.colour = words.get("colour");
  state.mesh = words.get("mesh") === "1";
  state.solids = words.get("solids") !== "0";
  const [name, ...plane] = (words.get("cut") || "").split(",");
  if (["x", "y", "z", "view"].includes(name) && plane.length === 4 && plane.every(x => Number.isFinite(Number(x))))
    state.cut = {name, normal: plane.slice(0, 3).map(Number), at: Number(plane[3])};
  if (ends)
    state.ends = [ends.slice(0, 3), ends.slice(3)];
  if (ask && streams[ask[0]]?.frames[ask[1]] && ask[2] in streams[ask[0]].frames[ask[1]].logs)
    askTriangle(ask[0], stateOf(streams[ask[0]].frames[ask[1]], ask[2], [1 / 3, 1 / 3, 1 / 3]));
  if (["light", "dark"].includes(words.get("theme")))
    document.documentElement.dataset.theme = words.get("theme");
}
