// Asks for the run's state every second and shows it; the newest frame comes as sheet-view's page, in a frame that takes
// the place of the one before when it is ready, with the same view.

const pause = 1000, framePause = 2000; // [ms]
const litres = [["m³", 1], ["l", 1e3], ["ml", 1e6]], squares = [["m²", 1], ["cm²", 1e4], ["mm²", 1e6]];
const joules = [["J", 1], ["mJ", 1e3], ["µJ", 1e6]], metres = [["m", 1], ["mm", 1e3], ["µm", 1e6]];
const panels = [
  {title: "volume", names: ["volume"], units: litres},
  {title: "thickness: least, mean, greatest", names: ["thickness_min", "thickness_mean", "thickness_max"], units: metres},
  {title: "area", names: ["area"], units: squares},
  {title: "kinetic energy", names: ["kinetic_energy"], units: joules},
];
let shownStep = null, coming = false;

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

function canvasOf(panel) {
  if (!panel.canvas) {
    const figure = document.createElement("figure");
    panel.caption = document.createElement("figcaption");
    panel.canvas = document.createElement("canvas");
    figure.append(panel.caption, panel.canvas);
    document.getElementById("curves").append(figure);
  }
  return panel.canvas;
}

function showCurves(curves) {
  for (const panel of panels) {
    const values = panel.names.flatMap(name => curves[name]).filter(Number.isFinite);
    if (values.length === 0)
      continue;
    const most = Math.max(...values.map(Math.abs));
    const [unit, factor] = panel.units.find(([, f]) => most * f >= 1) ?? panel.units.at(-1);
    const lines = panel.names.map(name => curves.time.map((t, i) => [t, (curves[name][i] ?? NaN) * factor]));
    plot(canvasOf(panel), lines, ["s", ""]);
    panel.caption.textContent = `${panel.title} [${unit}]`;
  }
}

function showFrame(step) {
  if (coming || step === shownStep || document.hidden)
    return;
  coming = true;
  const place = document.getElementById("frames"), before = place.querySelector("iframe");
  const view = new URLSearchParams(before ? before.contentWindow.location.hash.slice(1) : "");
  view.delete("t");
  view.delete("ask"); // its triangle may be another one now
  const next = document.createElement("iframe");
  next.className = before ? "coming" : "";
  next.title = "newest frame";
  next.src = `frame.html?step=${step}` + (`${view}` ? `#${view}` : ""); // an empty # would scroll this page, too
  const swap = () => {
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
      showCurves(state.curves);
      showFrame(state.step);
    }
  } catch {
    message.textContent = "No answer: the run has ended, or its machine cannot be reached. What is shown was the last.";
  }
  setTimeout(ask, pause);
}
ask();
