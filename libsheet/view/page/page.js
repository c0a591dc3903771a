// The page: what is shown, what hands do, the address.

const $ = id => document.getElementById(id);
const streams = JSON.parse($("streams").textContent).map((d, i) => new Stream(i, d));
const times = [...new Set(streams.flatMap(s => s.times))].sort((a, b) => a - b);
const canvas = new Canvas($("view")), camera = new Camera(streams[0].up);
const state = {
  moment: 0, playing: false, colour: "plain", mesh: false, solids: true, measuring: false, ends: [], asked: null, cut: null,
};
const shown = streams.map(() => ({})); // what is on the graphics card for each stream
let origin = [0, 0, 0], corners = [], radius = 1, waiting = false; // corners of all there is, relative to the origin

// --- what there is to see

function findExtent() {
  const low = [Infinity, Infinity, Infinity], high = low.map(x => -x);
  const grow = x => x.forEach((c, i) => { low[i] = Math.min(low[i], c); high[i] = Math.max(high[i], c); });
  for (const d of streams.flatMap(s => s.descriptions).filter(d => d.triangles > 0))
    [d.low, d.high].forEach(grow);
  if (!(low[0] <= high[0]))
    [[-1, -1, -1], [1, 1, 1]].forEach(grow);
  const sheet = length(subtract(high, low));
  for (const stream of streams)
    stream.solids.forEach((solid, i) => {
      const {place, normal} = solidShape(solid);
      solid.shape = {place, normal};
      const at = moved(solid.shape, stream.placements[0].motions[i], [0, 0, 0]).place, a = [...low], b = [...high];
      for (let v = 0; v < at.length; v += 3)
        for (let k = 0; k < 3; ++k) {
          a[k] = Math.min(a[k], at[v + k]);
          b[k] = Math.max(b[k], at[v + k]);
        }
      if (length(subtract(b, a)) <= 5 * sheet)
        [a, b].forEach(grow);
    });
  origin = low.map((x, i) => (x + high[i]) / 2);
  radius = Math.max(length(subtract(high, low)) / 2, 1e-12);
  corners = cornersOf({low, high}).map(c => subtract(c, origin));
}

const cornersOf = ({low, high}) => Array.from({length: 8}, (_, k) => low.map((x, i) => k >> i & 1 ? high[i] : x));

// The sheet displaces a bath: its surface is drawn below the sheet where that lies deeper.
function loweredBath(stream, surface) {
  const heights = stream.descriptions.filter(d => d.triangles > 0).flatMap(cornersOf).map(c => dot(c, surface.normal));
  const level = dot(surface.point, surface.normal), lowest = Math.min(...heights) - 0.01 * radius;
  return lowest < level ? {...surface, point: add(surface.point, surface.normal, lowest - level)} : surface;
}

const now = () => times[state.moment];
const frames = () => streams.map(s => s.frameAt(now()));
const shownQuantities = quantities.filter(quantity => isThere(streams, quantity));
const quantity = () => quantityOf(state.colour);
const range = () => quantity() ? rangeOf(streams, quantity()) : [0, 1];
const plane = () => state.cut && {normal: state.cut.normal, at: state.cut.at - dot(state.cut.normal, origin)};

// Makes what has changed since the last picture anew.
function refresh(i) {
  const stream = streams[i], frame = stream.frameAt(now()), kept = shown[i];
  if (kept.frame !== frame || kept.colour !== state.colour) {
    if (kept.frame !== frame)
      kept.shape = shapeOf(frame, origin);
    const colours = coloursOf(frame, kept.shape, quantity(), range()), wall = wallOf(frame.mesh, kept.shape);
    [kept.sheet, kept.wall, kept.lines].forEach(u => canvas.free(u));
    kept.lines = null;
    kept.sheet = canvas.upload({...kept.shape, colour: colours, corners: frame.mesh.corners});
    const ends = new Uint8Array(4 * wall.source.length);
    wall.source.forEach((v, k) => ends.set(colours.subarray(4 * v, 4 * v + 4), 4 * k));
    kept.wall = canvas.upload({place: wall.at, normal: wall.out, colour: ends, corners: wall.corners});
  }
  if (state.mesh && !kept.lines)
    kept.lines = canvas.upload({...kept.shape, corners: frame.mesh.edges});
  const cut = plane(), key = cut && [...cut.normal, cut.at].join();
  if (kept.frame !== frame || kept.cutKey !== key) {
    canvas.free(kept.cap);
    kept.cap = null;
    kept.cutLines = [];
    if (cut) {
      kept.cutLines = cutBy(frame, kept.shape, cut);
      kept.cap = canvas.upload(capOf(kept.cutLines, cut));
    }
    kept.cutKey = key;
  }
  if (kept.placement !== frame.placement) {
    (kept.around || []).forEach(a => canvas.free(a.uploaded));
    const {motions, surfaces} = stream.placements[frame.placement];
    kept.around = [
      ...stream.solids.map((solid, k) => ({kind: "solid", number: solid.number, uploaded: canvas.upload(
        {...moved(solid.shape, motions[k], origin), corners: solid.corners})})),
      ...surfaces.map(s => ({kind: s.kind, uploaded: canvas.upload(
        surfaceShape(s.kind === "bath" ? loweredBath(stream, s) : s, origin, radius))})),
    ];
    kept.placement = frame.placement;
  }
  kept.frame = frame;
  kept.colour = state.colour;
}

// --- the picture

const aroundColours = {
  plane: [0.62, 0.64, 0.67, 0.55], belt: [0.45, 0.52, 0.60, 0.6], bath: [0.30, 0.50, 0.68, 0.45],
};
const solidColours = [[0.68, 0.66, 0.63], [0.52, 0.58, 0.64], [0.64, 0.57, 0.50], [0.56, 0.61, 0.55]];

// The part of the picture that shows a stream, in CSS pixels from the upper left.
function part(i) {
  const {clientWidth: width, clientHeight: height} = $("view"), n = streams.length;
  const columns = width >= height ? Math.ceil(Math.sqrt(n * width / Math.max(height, 1) / 1.4)) : Math.ceil(Math.sqrt(n / 2));
  const across = Math.min(n, Math.max(1, columns)), down = Math.ceil(n / across);
  return {x: (i % across) * width / across, y: Math.floor(i / across) * height / down,
          width: width / across, height: height / down};
}

function drawStream(i) {
  const {x, y, width, height} = part(i), ratio = canvas.element.width / Math.max(canvas.element.clientWidth, 1);
  const [right, up, back] = camera.axes, light = unit(add(add(back, right, -0.5), up, 0.7));
  canvas.begin(x * ratio, canvas.element.height - (y + height) * ratio, width * ratio, height * ratio,
               camera.matrix(width, height, origin, radius), subtract(camera.eye, origin), light, plane());
  const kept = shown[i], plain = state.colour === "plain", shine = plain ? 0.3 : 0.06;
  if (state.solids)
    for (const {kind, number, uploaded} of kept.around)
      if (kind === "solid")
        canvas.draw(uploaded, {colour: [...solidColours[number % 4], 1], behind: true});
  canvas.draw(kept.sheet, {side: 1, cull: state.cut ? null : "back", shine});
  canvas.draw(kept.sheet, {side: -1, cull: state.cut ? null : "front", shine});
  canvas.draw(kept.wall, {shine});
  if (kept.cap)
    canvas.draw(kept.cap, {colour: [0.85, 0.25, 0.15, 1], cut: false, lit: false});
  if (state.mesh)
    for (const side of [1, -1])
      canvas.draw(kept.lines, {side, lines: true, lit: false, colour: [0.05, 0.08, 0.14, 0.55]});
  if (state.solids)
    for (const {kind, uploaded} of kept.around)
      if (kind !== "solid")
        canvas.draw(uploaded, {colour: aroundColours[kind], reach: 2.2 * radius, cut: false, behind: true});
}

function draw() {
  waiting = false;
  if (document.body.dataset.state === "loading")
    return;
  const hex = themed("--canvas");
  canvas.clear([1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255));
  streams.forEach((_, i) => refresh(i));
  streams.forEach((_, i) => drawStream(i));
  drawMarks();
}

// Asks for a picture soon; `told`: texts and panel have changed too.
function show(told = false) {
  if (told)
    tellLater = true;
  if (!waiting) {
    waiting = true;
    requestAnimationFrame(() => {
      draw();
      if (tellLater)
        tell();
    });
  }
}
let tellLater = false;

// --- words

function drawMarks() {
  const marks = $("marks"), made = [];
  const put = (name, place, i, text = "") => {
    const {x, y, width, height} = part(i), seen = camera.see(place, width, height);
    if (!seen || Math.abs(seen[0]) > 1 || Math.abs(seen[1]) > 1)
      return null;
    const mark = element(name, text);
    const at = [x + (seen[0] + 1) * width / 2, y + (1 - seen[1]) * height / 2];
    mark.style.left = `${at[0]}px`;
    mark.style.top = `${at[1]}px`;
    made.push(mark);
    return {mark, at};
  };
  const asked = state.asked, held = asked && asked.states[frames()[asked.stream].number];
  if (held)
    put("i", held.place, asked.stream);
  streams.forEach((_, i) => {
    const ends = state.ends.map(place => put("i", place, i));
    ends.forEach(end => end && end.mark.classList.add("end"));
    if (ends[0] && ends[1]) {
      const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
      const line = document.createElementNS("http://www.w3.org/2000/svg", "line");
      [["x1", ends[0].at[0]], ["y1", ends[0].at[1]], ["x2", ends[1].at[0]], ["y2", ends[1].at[1]]].forEach(
        ([name, value]) => line.setAttribute(name, value));
      svg.append(line);
      made.unshift(svg);
      const middle = state.ends[0].map((c, k) => (c + state.ends[1][k]) / 2);
      put("span", middle, i, withUnit(length(subtract(...state.ends)), "m"));
    }
  });
  marks.replaceChildren(...made);
}

// With as many decimals as tell a thousandth of the run.
const seconds = time => `${time.toFixed(Math.max(3, -Math.floor(Math.log10(times.at(-1) - times[0] || 1)) + 2))} s`;

function tellLabels() {
  const made = streams.map((stream, i) => {
    const frame = stream.frameAt(now()), {x, y, width} = part(i), label = element("div");
    const number = times.length > 1 ? ` frame ${frame.number},` : "";
    label.append(element("b", stream.name), element("span", `${number} ${seconds(frame.time)}, step ${frame.step}, ` +
                                                            `${frame.triangles.toLocaleString("en")} triangles`));
    Object.assign(label.style, {left: `${x}px`, top: `${y}px`, maxWidth: `${width}px`});
    label.title = stream.scene;
    return label;
  });
  $("labels").replaceChildren(...made);
}

function tell() {
  tellLater = false;
  tellLabels();
  $("time").value = state.moment;
  $("clock").textContent = seconds(now());
  $("play").textContent = state.playing ? "❚❚" : "▶";
  $("colour").value = state.colour;
  for (const name of ["mesh", "solids"])
    $(name).setAttribute("aria-pressed", state[name]);
  $("measure").setAttribute("aria-pressed", state.measuring);
  $("legend").hidden = state.colour === "plain";
  if (state.colour !== "plain")
    drawLegend($("legend").firstElementChild, quantity(), range());
  $("cut").value = state.cut ? state.cut.name : "";
  $("cutter").hidden = !state.cut;
  if (state.cut) {
    $("cutat").value = plane().at / radius;
    const axis = "xyz".indexOf(state.cut.name), value = axis < 0 ? plane().at : state.cut.at * state.cut.normal[axis];
    $("cutplace").textContent = `${axis < 0 ? "" : state.cut.name + " = "}${withUnit(value, "m")}`;
  }
  const sections = [];
  if (state.asked)
    sections.push(triangleSection(streams[state.asked.stream], state.asked.states, frames()[state.asked.stream]));
  if (state.measuring || state.ends.length)
    sections.push(distanceSection(state.ends));
  if (state.cut)
    streams.forEach((stream, i) => sections.push(cutSection(stream, shown[i].cutLines || [])));
  showPanel(sections);
  if (document.body.dataset.state === "ready") // before, it says what is wanted
    writeAddressSoon();
}

// --- the address

// Browsers take no more than 100 addresses in 30 seconds.
let addressAt = 0, addressTimer = 0, knownAddress = location.hash;
function writeAddressSoon() {
  clearTimeout(addressTimer);
  document.body.dataset.address = "behind";
  addressTimer = setTimeout(() => {
    addressAt = performance.now();
    writeAddress();
    document.body.dataset.address = "written";
  }, Math.max(0, addressAt + 400 - performance.now()));
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
  if (location.hash !== knownAddress)
    return; // a new one, which is about to be read
  if (hash !== location.hash)
    history.replaceState(null, "", hash);
  knownAddress = location.hash;
}

// What makes no sense is passed over.
function readAddress() {
  knownAddress = location.hash;
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

// --- what hands do

function askTriangle(stream, start) {
  state.asked = {stream, start, states: follow(streams[stream], start)};
}

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
  const start = subtract(camera.eye, origin), direction = camera.ray(at.x, at.y, at.width, at.height);
  const hit = meet(frame, shape, start, direction, hidden);
  if (state.measuring) {
    if (hit)
      state.ends = [...(state.ends.length > 1 ? [] : state.ends), add(add(start, direction, hit.distance), origin)];
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
    state.cut = {name, normal, at: dot(normal, origin)};
  }
  show(true);
}

function moveCut(part) {
  if (state.cut)
    state.cut.at = dot(state.cut.normal, origin) + part * radius;
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

function fit() {
  const {width, height} = part(0);
  camera.fit(origin, corners, width, height);
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

function offerQuantities() {
  for (const {name} of shownQuantities)
    $("colour").append(new Option(name));
  $("colourkeys").textContent = shownQuantities.slice(0, 8).map((_, i) => i + 2).join(" ");
  $("colournames").textContent = shownQuantities.slice(0, 8).map(({name}) => name).join(", ");
}

function listen() {
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
    clearTimeout(addressTimer);
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

// --- start

async function start() {
  const say = text => { $("message").textContent = text; };
  if (!canvas.gl)
    return say("This browser has no WebGL 2, or it is switched off: nothing can be drawn.");
  const count = streams.reduce((n, s) => n + s.times.length, 0);
  let done = 0;
  for (const stream of streams) {
    await stream.unpackSolids();
    await stream.unpackNext();
    ++done;
  }
  findExtent();
  fit();
  $("time").max = times.length - 1;
  for (const id of ["play", "time", "clock"])
    $(id).hidden = times.length === 1;
  document.querySelector("footer").classList.toggle("still", times.length === 1);
  offerQuantities();
  listen();
  document.body.dataset.state = "unpacking";
  show(true);
  for (const stream of streams)
    while (stream.frames.length < stream.times.length) {
      await stream.unpackNext();
      if (++done % 8 === 0) {
        say(`frame ${done} of ${count}`);
        await new Promise(resolve => setTimeout(resolve));
      }
    }
  say("");
  readAddress();
  draw();
  document.body.dataset.state = "ready";
  show(true);
}

start().catch(error => {
  document.body.dataset.state = "failed";
  $("message").textContent = `This page cannot be shown: ${error.message}`;
});
