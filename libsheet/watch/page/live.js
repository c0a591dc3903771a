// Asks for the run's state every second and shows it; the newest frame comes as sheet-view's page, in a frame that takes
// the place of the one before when it is ready, with the same view.

import {plot} from "./plots.js";

const pause = 1000, framePause = 2000; // [ms]
const canvases = new Map(); // of panels, by title
const dashes = [[], [7, 3], [2, 2]], signs = ["\u2014", "\u2013 \u2013", "\u00b7\u00b7\u00b7"];
let shownStep = null, coming = false;
let turned = false; // the view is the user's; until then every frame is fitted into the picture

function duration(seconds) {
  const s = Math.round(seconds), h = Math.floor(s / 3600), m = Math.floor(s / 60) % 60;
  return h ? `${h} h ${m} min` : m ? `${m} min ${s % 60} s` : `${s} s`;
}

const brief = x => Number(x.toPrecision(4)).toString();

function showFigures(state) {
  const rows = [["step", state.step.toLocaleString("en")], ["time", `${brief(state.time)} s`],
                ["vertices", state.vertices.toLocaleString("en")], ["triangles", state.triangles.toLocaleString("en")],
                ["elapsed", duration(state.elapsed)]];
  if (state.speed !== null)
    rows.push(["a minute makes", `${brief(60 * state.speed)} s`]);
  if (state.left !== null)
    rows.push(["left", duration(state.left)]);
  document.getElementById("figures").replaceChildren(...rows.map(([name, value]) => {
    const row = document.createElement("div"), term = document.createElement("dt"), text = document.createElement("dd");
    term.textContent = name;
    text.textContent = value;
    row.append(term, text);
    return row;
  }));
  const progress = document.getElementById("progress");
  progress.hidden = state.until === null;
  if (state.until !== null) {
    progress.max = state.until;
    progress.value = state.time;
  }
}

function canvasOf(title) {
  if (!canvases.has(title)) {
    const figure = document.createElement("figure"), caption = document.createElement("figcaption");
    const canvas = document.createElement("canvas");
    figure.append(caption, canvas);
    document.getElementById("curves").append(figure);
    canvases.set(title, {caption, canvas});
  }
  return canvases.get(title);
}

// panels: [{title, units: [[name, factor], ...], curves: [[name, label], ...]}, ...]
function showCurves(panels, curves) {
  for (const panel of panels) {
    const drawn = panel.curves.filter(([name]) => curves[name]?.some(Number.isFinite));
    if (drawn.length === 0)
      continue;
    const most = Math.max(...drawn.flatMap(([name]) => curves[name]).filter(Number.isFinite).map(Math.abs));
    const [unit, factor] = panel.units.find(([, f]) => most * f >= 1) ?? panel.units.at(-1);
    const lines = drawn.map(([name]) => curves.time.map((t, i) => [t, (curves[name][i] ?? NaN) * factor]));
    const {caption, canvas} = canvasOf(panel.title);
    plot(canvas, lines, ["s", ""], undefined, dashes);
    const legend = drawn.map(([, label], i) => `${signs[i]} ${label}`.replaceAll(" ", "\u00a0")).join(", ");
    caption.textContent = panel.title + (unit ? ` [${unit}]` : "") + (drawn.length > 1 ? `: ${legend}` : ` ${drawn[0][1]}`);
  }
}

function noteTurning(page) {
  const view = page.getElementById("view"), note = now => () => { turned = now; };
  if (!view) // an error is shown
    return;
  for (const kind of ["pointerdown", "wheel"])
    view.addEventListener(kind, note(true));
  page.getElementById("fit").addEventListener("click", note(false));
  page.addEventListener("keydown", event => {
    if ("xyz+-f".includes(event.key))
      turned = event.key !== "f";
  });
}

function showFrame(step) {
  if (coming || step === shownStep || document.hidden)
    return;
  coming = true;
  const place = document.getElementById("frames"), before = place.querySelector("iframe");
  const view = new URLSearchParams(before ? before.contentWindow.location.hash.slice(1) : "");
  view.delete("t");
  if (!turned)
    view.delete("eye");
  view.delete("ask"); // its triangle may be another one now
  const next = document.createElement("iframe");
  next.className = before ? "coming" : "";
  next.title = "newest frame";
  next.src = `frame.html?step=${step}` + (`${view}` ? `#${view}` : ""); // an empty # would scroll this page, too
  const swap = () => {
    noteTurning(next.contentDocument);
    next.className = "";
    before?.remove();
    shownStep = step;
    setTimeout(() => { coming = false; }, framePause);
  };
  next.addEventListener("load", () => {
    const wait = setInterval(() => {
      if (next.contentDocument?.body?.dataset.state === "unpacking")
        return;
      clearInterval(wait);
      swap();
    }, 50);
  });
  place.append(next);
}

async function ask() {
  const message = document.getElementById("message");
  try {
    const state = await (await fetch("state.json")).json();
    if (state.step === undefined)
      message.textContent = "waiting for the first frame";
    else {
      message.textContent = "";
      showFigures(state);
      showCurves(state.panels, state.curves);
      showFrame(state.step);
    }
  } catch {
    message.textContent = "No answer: the run has ended, or its machine cannot be reached. What is shown came last.";
  }
  setTimeout(ask, pause);
}
ask();
