// What is shown of which streams, and where they are.

import {quantities, quantityOf, isThere, rangeOf} from "./colours.js";
import {Stream} from "./stream.js";
import {Camera} from "./camera.js";
import {Canvas} from "./canvas.js";
import {follow} from "./measure.js";
import {moved, solidShape} from "./scene.js";
import {dot, length, subtract} from "./vectors.js";

export const $ = id => document.getElementById(id);
export const streams = JSON.parse($("streams").textContent).map((d, i) => new Stream(i, d));
export const times = [...new Set(streams.flatMap(s => s.times))].sort((a, b) => a - b);
export const canvas = new Canvas($("view"));
export const camera = new Camera(streams[0].up);
export const state = {
  moment: 0, playing: false, colour: "plain", mesh: false, solids: true, measuring: false, ends: [], asked: null, cut: null,
};
export const shown = streams.map(() => ({})); // what is on the graphics card for each stream
export const extent = {origin: [0, 0, 0], corners: [], radius: 1}; // corners of all there is, relative to the origin

export function findExtent() {
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
  extent.origin = low.map((x, i) => (x + high[i]) / 2);
  extent.radius = Math.max(length(subtract(high, low)) / 2, 1e-12);
  extent.corners = cornersOf({low, high}).map(c => subtract(c, extent.origin));
}

export const cornersOf = ({low, high}) => Array.from({length: 8}, (_, k) => low.map((x, i) => k >> i & 1 ? high[i] : x));

export const now = () => times[state.moment];
export const frames = () => streams.map(s => s.frameAt(now()));
export const shownQuantities = quantities.filter(quantity => isThere(streams, quantity));
export const quantity = () => quantityOf(state.colour);
export const range = () => quantity() ? rangeOf(streams, quantity()) : [0, 1];
export const plane = () => state.cut && {normal: state.cut.normal, at: state.cut.at - dot(state.cut.normal, extent.origin)};

// The part of the picture that shows a stream, in CSS pixels from the upper left.
export function part(i) {
  const {clientWidth: width, clientHeight: height} = $("view"), n = streams.length;
  const columns = width >= height ? Math.ceil(Math.sqrt(n * width / Math.max(height, 1) / 1.4)) : Math.ceil(Math.sqrt(n / 2));
  const across = Math.min(n, Math.max(1, columns)), down = Math.ceil(n / across);
  return {x: (i % across) * width / across, y: Math.floor(i / across) * height / down,
          width: width / across, height: height / down};
}

export function askTriangle(stream, start) {
  state.asked = {stream, start, states: follow(streams[stream], start)};
}
