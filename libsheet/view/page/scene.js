// What there is to draw of a stream at a frame, as lists of triangles and lines relative to an origin.

import {add, cross, dot, length, subtract, unit} from "./vectors.js";

// A solid's places at time 0 and their normals; vertices at sharp edges stand there once a face.
export function solidShape(solid) {
  const {vertices: n, positions: p, corners, step} = solid, place = new Float32Array(3 * n);
  for (let v = 0; v < n; ++v)
    for (let i = 0; i < 3; ++i)
      place[3 * v + i] = p[i * n + v] * step;
  const normal = new Float32Array(3 * n);
  for (let t = 0; t < corners.length; t += 3) {
    const [a, b, c] = Array.from(corners.subarray(t, t + 3), v => place.subarray(3 * v, 3 * v + 3));
    const out = cross(subtract(b, a), subtract(c, a));
    for (const v of corners.subarray(t, t + 3))
      for (let i = 0; i < 3; ++i)
        normal[3 * v + i] += out[i];
  }
  for (let v = 0; v < n; ++v)
    normal.set(unit(normal.subarray(3 * v, 3 * v + 3)), 3 * v);
  return {place, normal};
}

export function moved(shape, motion, origin) {
  const place = new Float32Array(shape.place.length), normal = new Float32Array(place.length);
  for (let v = 0; v < place.length; v += 3)
    for (let i = 0; i < 3; ++i) {
      const row = motion.slice(3 * i, 3 * i + 3);
      place[v + i] = dot(row, shape.place.subarray(v, v + 3)) + motion[9 + i] - origin[i];
      normal[v + i] = dot(row, shape.normal.subarray(v, v + 3));
    }
  return {place, normal};
}

// A square around the foot of the origin's perpendicular.
export function surfaceShape(surface, origin, radius) {
  const n = surface.normal, u = unit(cross(Math.abs(n[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0], n)), w = cross(n, u);
  const height = dot(n, subtract(surface.point, origin)), foot = n.map(x => x * height);
  const place = [];
  for (const [a, b] of [[-1, -1], [1, -1], [1, 1], [-1, 1]])
    place.push(...add(add(foot, u, 2.2 * a * radius), w, 2.2 * b * radius));
  return {place: new Float32Array(place), normal: new Float32Array([...n, ...n, ...n, ...n]),
          corners: new Uint32Array([0, 1, 2, 0, 2, 3]), kind: surface.kind};
}

// The slab where the plane cuts it: a strip along each line, in the plane.
export function capOf(lines, plane) {
  const place = [], normal = [], corners = [];
  for (const line of lines)
    line.forEach((point, k) => {
      const inPlane = add(point.normal, plane.normal, -dot(point.normal, plane.normal)), size = length(inPlane);
      const half = inPlane.map(x => x * point.thickness / 2 / Math.max(size * size, 0.04));
      const first = place.length / 3;
      place.push(...add(point.place, half), ...add(point.place, half, -1));
      normal.push(...plane.normal, ...plane.normal);
      if (k > 0)
        corners.push(first - 2, first - 1, first, first, first - 1, first + 1);
    });
  return {place: new Float32Array(place), normal: new Float32Array(normal), corners: new Uint32Array(corners)};
}
