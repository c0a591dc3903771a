// What was asked: a triangle, a distance, the thickness along a cut. Text goes into the page as text only.

import {length, subtract} from "./vectors.js";
import {withUnit} from "./numbers.js";
import {plot} from "./plots.js";

export function element(name, text = "", children = []) {
  const made = document.createElement(name);
  made.textContent = text;
  made.append(...children);
  return made;
}

// rows: [word, text, exact value if it is not the text]
function table(rows) {
  const list = element("dl");
  for (const [word, text, exact] of rows) {
    const value = element("dd", text);
    value.dataset.of = word;
    value.dataset.value = exact ?? text;
    list.append(element("dt", word), value);
  }
  return list;
}

function withPlot(section, note, draw) {
  const canvas = element("canvas");
  section.append(element("p", note), canvas);
  section.drawPlot = () => draw(canvas);
  return section;
}

export function triangleSection(stream, states, now) {
  const state = states[now.number];
  const section = element("section", "", [element("h2", `Triangle of ${stream.name}`)]);
  section.id = "asked";
  if (!state) {
    section.append(element("p", "not followed to this frame"));
    return section;
  }
  const {frame, triangle, place} = state;
  section.append(table([
    ["triangle", `${triangle} of frame ${frame.number}`, triangle],
    ["thickness", withUnit(state.thickness, "m"), state.thickness],
    ["position", place.map(x => withUnit(x, "m")).join(", "), place.join(" ")],
    ["speed", withUnit(state.speed, "m/s"), state.speed],
    ...(frame.liquid ? [["liquid", frame.liquidOf(frame.cornersOf(triangle)[0]).name]] : []),
    ...state.values.map(([{name, kinds, unit}, value]) => [
      name, kinds.length ? kinds[value][0] : withUnit(value, unit), value]),
  ]));
  if (states.length < 2)
    return section;
  const curve = states.filter(Boolean).map(s => [s.time, s.thickness]);
  const steady = stream.frames.every((f, i) => i === 0 || f.sameMesh);
  return withPlot(section, steady ? "its thickness over time" : "thickness over time, followed with the liquid",
                  canvas => plot(canvas, [curve], ["s", "m"], frame.time));
}

export function distanceSection(ends) {
  const section = element("section", "", [element("h2", "Distance")]);
  section.id = "distance";
  if (ends.length < 2) {
    section.append(element("p", ends.length ? "click on the other end" : "click on the sheet at one end, then at the other"));
    return section;
  }
  const way = subtract(ends[1], ends[0]);
  section.append(table([["distance", withUnit(length(way), "m"), length(way)],
                        ["along x, y, z", way.map(x => withUnit(x, "m")).join(", "), way.join(" ")]]));
  return section;
}

export function cutSection(stream, lines) {
  const section = element("section", "", [element("h2", `Cut of ${stream.name}`)]);
  section.className = "cut";
  let along = 0;
  const curves = lines.map(line => line.map((point, k) => {
    along += k ? length(subtract(point.place, line[k - 1].place)) : 0;
    return [along, point.thickness];
  }));
  if (along === 0) {
    section.append(element("p", "the plane does not meet the sheet"));
    return section;
  }
  const all = curves.flat().map(p => p[1]), low = all.reduce((a, b) => Math.min(a, b)), high = all.reduce((a, b) => Math.max(a, b));
  section.append(table([["length", withUnit(along, "m"), along],
                        ["thickness", `${withUnit(low, "m")} to ${withUnit(high, "m")}`, `${low} ${high}`]]));
  return withPlot(section, curves.length > 1 ? `thickness along the cut, ${curves.length} pieces` : "thickness along the cut",
                  canvas => plot(canvas, curves, ["m", "m"]));
}

export function showPanel(sections) {
  const panel = document.getElementById("panel");
  panel.replaceChildren(...sections);
  panel.hidden = sections.length === 0;
  for (const section of sections)
    if (section.drawPlot)
      section.drawPlot();
}
