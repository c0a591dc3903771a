// Asking the sheet: what a ray meets, what becomes of a point, what a plane cuts.

import {add, cross, dot, length, subtract, unit} from "./vectors.js";
import {quantities} from "./colours.js";

// Where the ray first meets a side of the slab: {triangle, weights, distance}, or null. Start relative to the shape's
// origin; `hidden(point)` tells what is cut away.
export function meet(frame, shape, start, direction, hidden) {
  let nearest = null;
  for (const side of [0.5, -0.5])
    for (let t = 0; t < frame.triangles; ++t) {
      const x = Array.from(frame.cornersOf(t), v => [0, 1, 2].map(
        i => shape.place[3 * v + i] + side * shape.thickness[v] * shape.normal[3 * v + i]));
      const hit = meetTriangle(x, start, direction);
      if (hit && (!nearest || hit.distance < nearest.distance) && !hidden(add(start, direction, hit.distance)))
        nearest = {triangle: t, ...hit};
    }
  return nearest;
}

// Möller and Trumbore 1997.
function meetTriangle([a, b, c], start, direction) {
  const u = subtract(b, a), w = subtract(c, a), p = cross(direction, w), size = dot(u, p);
  if (size === 0)
    return null;
  const s = subtract(start, a), second = dot(s, p) / size;
  if (second < 0 || second > 1)
    return null;
  const q = cross(s, u), third = dot(direction, q) / size, distance = dot(w, q) / size;
  return third < 0 || second + third > 1 || distance <= 0
    ? null : {distance, weights: [1 - second - third, second, third]};
}

const mean = (frame, triangle, weights, value) => {
  const sum = [0, 0, 0];
  frame.cornersOf(triangle).forEach((v, k) => value(v).forEach((x, i) => { sum[i] += weights[k] * x; }));
  return sum;
};

// Of the quantities that are packed, [quantity, value] each; of kinds that at the nearest corner.
function packedValues(frame, triangle, weights) {
  const nearest = weights.indexOf(Math.max(...weights));
  const at = ({name, where, kinds}) => where === "triangle" ? frame.valueOf(name, triangle)
    : kinds.length ? frame.valueOf(name, frame.cornersOf(triangle)[nearest])
    : mean(frame, triangle, weights, v => [frame.valueOf(name, v), 0, 0])[0];
  return quantities.filter(({name}) => name in frame.values).map(quantity => [quantity, at(quantity)]);
}

export function stateOf(frame, triangle, weights) {
  const velocity = mean(frame, triangle, weights, v => frame.velocity(v));
  return {
    frame, triangle, weights, velocity, time: frame.time, thickness: frame.thicknessOf(triangle),
    place: mean(frame, triangle, weights, v => frame.place(v)), speed: length(velocity),
    values: packedValues(frame, triangle, weights),
  };
}

// The point of the sheet that is nearest to a place: {triangle, weights}.
function nearestTo(frame, place) {
  let best = Infinity, found = null;
  for (let t = 0; t < frame.triangles; ++t) {
    const [a, b, c] = Array.from(frame.cornersOf(t), v => frame.place(v));
    const reach = Math.max(length(subtract(b, a)), length(subtract(c, a)));
    if (length(subtract(place, a)) - reach > best)
      continue;
    const weights = nearestWeights(a, b, c, place);
    const point = add(add(add([0, 0, 0], a, weights[0]), b, weights[1]), c, weights[2]);
    const distance = length(subtract(place, point));
    if (distance < best)
      [best, found] = [distance, {triangle: t, weights}];
  }
  return found;
}

// Of the triangle's point that is nearest to p: its projection if that lies inside, else the nearest of its edges.
function nearestWeights(a, b, c, p) {
  const u = subtract(b, a), w = subtract(c, a), s = subtract(p, a);
  const uu = dot(u, u), uw = dot(u, w), ww = dot(w, w), su = dot(s, u), sw = dot(s, w), size = uu * ww - uw * uw;
  const second = (ww * su - uw * sw) / size, third = (uu * sw - uw * su) / size;
  if (second >= 0 && third >= 0 && second + third <= 1)
    return [1 - second - third, second, third];
  const onEdge = (from, to) => Math.min(1, Math.max(0, dot(subtract(p, from), subtract(to, from)) /
                                                      (dot(subtract(to, from), subtract(to, from)) || 1)));
  const i = onEdge(a, b), j = onEdge(b, c), k = onEdge(c, a);
  const away = weights => length(subtract(p, add(add(add([0, 0, 0], a, weights[0]), b, weights[1]), c, weights[2])));
  return [[1 - i, i, 0], [0, 1 - j, j], [k, 0, 1 - k]].sort((x, y) => away(x) - away(y))[0];
}

// The states of a piece of liquid in all frames: where the mesh stays, it stays in its triangle; elsewhere it goes
// with its velocity and on to the nearest point of the next mesh.
export function follow(stream, start) {
  const states = [];
  states[start.frame.number] = start;
  for (const sense of [1, -1])
    for (let state = start;;) {
      const next = stream.frames[state.frame.number + sense];
      if (!next || next.triangles === 0)
        break;
      if ((sense > 0 ? next : state.frame).sameMesh) {
        state = stateOf(next, state.triangle, state.weights);
      } else {
        const found = nearestTo(next, add(state.place, state.velocity, next.time - state.time));
        state = stateOf(next, found.triangle, found.weights);
      }
      states[next.number] = state;
    }
  return states;
}

// What the plane {normal, at} cuts, relative to the shape's origin: lines, each a list of {place, normal, thickness}.
export function cutBy(frame, shape, {normal, at}) {
  const {mesh: {corners}, vertices} = frame, away = new Float64Array(vertices);
  for (let v = 0; v < vertices; ++v)
    away[v] = dot(normal, shape.place.subarray(3 * v, 3 * v + 3)) - at;
  const points = new Map(), neighbours = new Map();
  const pointOn = (a, b) => {
    const key = a < b ? a * vertices + b : b * vertices + a;
    if (!points.has(key)) {
      const w = away[a] / (away[a] - away[b]), blend = (from, size) => Array.from(
        {length: size}, (_, i) => (1 - w) * from[size * a + i] + w * from[size * b + i]);
      points.set(key, {place: blend(shape.place, 3), normal: unit(blend(shape.normal, 3)),
                       thickness: blend(shape.thickness, 1)[0]});
      neighbours.set(key, []);
    }
    return key;
  };
  for (let t = 0; t < corners.length; t += 3) {
    const ends = [];
    for (let i = 0; i < 3; ++i) {
      const a = corners[t + i], b = corners[t + (i + 1) % 3];
      if (away[a] < 0 !== away[b] < 0)
        ends.push(pointOn(a, b));
    }
    if (ends.length === 2) {
      neighbours.get(ends[0]).push(ends[1]);
      neighbours.get(ends[1]).push(ends[0]);
    }
  }
  return chains(neighbours).map(keys => keys.map(key => points.get(key)));
}

// Walks open lines from an end of theirs, then closed ones.
function chains(neighbours) {
  const seen = new Set(), lines = [];
  const walk = start => {
    const line = [start];
    seen.add(start);
    for (let at = start;;) {
      const next = neighbours.get(at).find(key => !seen.has(key));
      if (next === undefined) {
        if (line.length > 2 && neighbours.get(at).includes(start))
          line.push(start);
        return line;
      }
      seen.add(at = next);
      line.push(at);
    }
  };
  for (const ends of [true, false])
    for (const [key, others] of neighbours)
      if (!seen.has(key) && (!ends || others.length === 1))
        lines.push(walk(key));
  return lines;
}
