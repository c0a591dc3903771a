// False colours, as sheet-render has them: the page brings quantities and palettes along.

import {cross, length, subtract} from "./vectors.js";

export const quantities = JSON.parse(document.getElementById("quantities").textContent);
// Of liquids without a material, in turn.
export const plainColours = [[176, 120, 78], [92, 140, 176], [150, 160, 84], [168, 108, 150]];

// The colour at a place of the scale, 0 to 1; stops are [place, colour].
export function between(stops, place) {
  const x = Math.max(0, Math.min(1, place || 0)), i = Math.max(1, stops.findIndex(stop => x <= stop[0]));
  const [[low, from], [high, to]] = [stops[i - 1], stops[i]];
  return from.map((c, k) => c + (x - low) / (high - low) * (to[k] - c));
}

export const quantityOf = name => quantities.find(quantity => quantity.name === name);

// Whether any frame of the streams has it.
export const isThere = (streams, {name}) => {
  const i = quantities.indexOf(quantityOf(name));
  return streams.some(stream => stream.descriptions.some(frame => frame.fields[i]));
};

// Its values at the vertices: those of triangles by their area; kinds have no middle.
function vertexValues(frame, shape, {name, where, kinds}) {
  if (name === "thickness")
    return shape.thickness;
  if (name === "speed")
    return Float64Array.from({length: frame.vertices}, (_, v) => length(frame.velocity(v)));
  if (where === "vertex")
    return Float64Array.from({length: frame.vertices}, (_, v) => frame.valueOf(name, v));
  const sum = new Float64Array(frame.vertices), area = new Float64Array(frame.vertices);
  for (let t = 0; t < frame.triangles; ++t) {
    const corners = frame.cornersOf(t), [a, b, c] = Array.from(corners, v => shape.place.subarray(3 * v, 3 * v + 3));
    const size = length(cross(subtract(b, a), subtract(c, a)));
    for (const v of corners) {
      const before = kinds.length ? 0 : 1;
      sum[v] = before * sum[v] + size * frame.valueOf(name, t);
      area[v] = before * area[v] + size;
    }
  }
  return sum.map((x, v) => area[v] > 0 ? x / area[v] : 0);
}

// The range of a quantity in all frames of all streams, without the extreme hundredths of each frame.
export function rangeOf(streams, quantity) {
  const i = quantities.indexOf(quantity);
  let low = Infinity, high = -Infinity;
  for (const stream of streams)
    for (const frame of stream.descriptions) {
      if (frame.triangles === 0 || !frame.fields[i])
        continue;
      low = Math.min(low, frame.fields[i].range[0]);
      high = Math.max(high, frame.fields[i].range[1]);
    }
  if (!(low <= high))
    return [0, 1];
  if (quantity.symmetric) {
    const most = Math.max(Math.abs(low), Math.abs(high), 1e-9);
    return [-most, most];
  }
  if (high - low > 1e-3 * Math.abs(high))
    return [low, high];
  if (low === 0 && high === 0) // of what rests: nothing has a negative speed
    return [0, 1];
  const width = high > 0 ? 0.1 * high : 1;
  return [low - width, high + width];
}

// Red, green, blue, 255 for each vertex; that of its liquid where there is no quantity, or the frame does not have it.
export function coloursOf(frame, shape, quantity, range) {
  const colours = new Uint8Array(4 * frame.vertices).fill(255);
  const values = quantity && frame.fields[quantities.indexOf(quantity)] && vertexValues(frame, shape, quantity);
  for (let v = 0; v < frame.vertices; ++v) {
    const colour = !values ? frame.liquidOf(v).colour
      : quantity.kinds.length ? quantity.kinds[values[v]][1]
      : between(quantity.stops, (values[v] - range[0]) / (range[1] - range[0]));
    colours.set(colour, 4 * v);
  }
  return colours;
}
