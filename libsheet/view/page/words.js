// What is written: marks on the picture, labels, the scale, the panel.

import {writeAddressSoon} from "./address.js";
import {between} from "./colours.js";
import {withUnit} from "./numbers.js";
import {cutSection, distanceSection, element, showPanel, triangleSection} from "./panel.js";
import {drawLegend} from "./plots.js";
import {$, camera, extent, frames, now, part, plane, quantity, range, shown, state, streams, times} from "./state.js";
import {length, subtract} from "./vectors.js";

export function drawMarks() {
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

// The liquids of all streams, [name, colour] each, once; none where no stream has several.
function liquidKinds() {
  if (streams.every(({liquids}) => liquids.length < 2))
    return [];
  const kinds = streams.flatMap(({liquids}) => liquids.map(({name, colour}) => [name, colour]));
  return [...new Map(kinds.map(kind => [String(kind), kind])).values()];
}

export function tell() {
  tellLabels();
  $("time").value = state.moment;
  $("clock").textContent = seconds(now());
  $("play").textContent = state.playing ? "❚❚" : "▶";
  $("colour").value = state.colour;
  for (const name of ["mesh", "solids"])
    $(name).setAttribute("aria-pressed", state[name]);
  $("measure").setAttribute("aria-pressed", state.measuring);
  const scale = quantity() ?? {kinds: liquidKinds()};
  $("legend").hidden = state.colour === "plain" && scale.kinds.length === 0;
  if (!$("legend").hidden)
    drawLegend($("legend").firstElementChild, scale, range(), place => between(scale.stops, place));
  $("cut").value = state.cut ? state.cut.name : "";
  $("cutter").hidden = !state.cut;
  if (state.cut) {
    $("cutat").value = plane().at / extent.radius;
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
