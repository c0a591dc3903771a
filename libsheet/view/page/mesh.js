// Who meets whom in a mesh, and what follows from places: normals, thickness at vertices, the rim's wall.

import {cross, unit} from "./vectors.js";

export class Mesh {
  constructor(vertices, corners) {
    this.vertices = vertices;
    this.corners = corners;
  }

  // Half-edges at the rim, each as [from, to] in the sense of its triangle; and every edge once, for drawing.
  get rim() { return this.parts().rim; }
  get edges() { return this.parts().edges; }

  parts() {
    if (this.found)
      return this.found;
    const {corners, vertices} = this, first = new Uint32Array(vertices + 1), to = new Uint32Array(corners.length);
    for (const v of corners)
      ++first[v + 1];
    for (let v = 0; v < vertices; ++v)
      first[v + 1] += first[v];
    const next = first.slice();
    for (let i = 0; i < corners.length; ++i)
      to[next[corners[i]]++] = corners[i % 3 === 2 ? i - 2 : i + 1];
    const rim = [], edges = [];
    for (let a = 0; a < vertices; ++a)
      for (let i = first[a]; i < first[a + 1]; ++i) {
        const b = to[i];
        const inner = to.subarray(first[b], first[b + 1]).includes(a);
        if (!inner)
          rim.push(a, b);
        if (!inner || a < b)
          edges.push(a, b);
      }
    return this.found = {rim: new Uint32Array(rim), edges: new Uint32Array(edges)};
  }
}

// Places relative to `origin`, normals of length 1 weighted by area, thickness: all volume over all area around.
export function shapeOf(frame, origin) {
  const {vertices, triangles, positions: p, positionStep: s, mesh: {corners}} = frame;
  const place = new Float32Array(3 * vertices), normal = new Float32Array(3 * vertices);
  const area = new Float64Array(vertices), volume = new Float64Array(vertices);
  for (let axis = 0; axis < 3; ++axis)
    for (let v = 0, from = axis * vertices; v < vertices; ++v)
      place[3 * v + axis] = p[from + v] * s - origin[axis];
  for (let t = 0; t < triangles; ++t) {
    const a = 3 * corners[3 * t], b = 3 * corners[3 * t + 1], c = 3 * corners[3 * t + 2];
    const ux = place[b] - place[a], uy = place[b + 1] - place[a + 1], uz = place[b + 2] - place[a + 2];
    const wx = place[c] - place[a], wy = place[c + 1] - place[a + 1], wz = place[c + 2] - place[a + 2];
    const nx = uy * wz - uz * wy, ny = uz * wx - ux * wz, nz = ux * wy - uy * wx;
    const size = Math.hypot(nx, ny, nz), amount = size > 0 ? size * frame.thicknessOf(t) : 0;
    for (const v of [a, b, c]) {
      normal[v] += nx;
      normal[v + 1] += ny;
      normal[v + 2] += nz;
      area[v / 3] += size;
      volume[v / 3] += amount;
    }
  }
  const thickness = new Float32Array(vertices);
  for (let v = 0; v < vertices; ++v) {
    const size = Math.hypot(normal[3 * v], normal[3 * v + 1], normal[3 * v + 2]) || 1;
    for (let axis = 0; axis < 3; ++axis)
      normal[3 * v + axis] /= size;
    thickness[v] = area[v] > 0 ? volume[v] / area[v] : 0;
  }
  return {place, normal, thickness};
}

// The wall along the rim: two triangles for each of its edges, from one side to the other.
export function wallOf(mesh, {place, normal, thickness}) {
  const count = mesh.rim.length / 2, at = new Float32Array(12 * count), out = new Float32Array(12 * count);
  const source = new Uint32Array(4 * count), corners = new Uint32Array(6 * count);
  for (let e = 0; e < count; ++e) {
    const ends = [mesh.rim[2 * e], mesh.rim[2 * e + 1]], [a, b] = ends;
    const along = [0, 1, 2].map(i => place[3 * b + i] - place[3 * a + i]);
    const outward = unit(cross(along, [0, 1, 2].map(i => normal[3 * a + i] + normal[3 * b + i])));
    for (let k = 0; k < 4; ++k) {
      const v = ends[k >> 1], half = (k & 1 ? -0.5 : 0.5) * thickness[v];
      source[4 * e + k] = v;
      for (let i = 0; i < 3; ++i) {
        at[12 * e + 3 * k + i] = place[3 * v + i] + half * normal[3 * v + i];
        out[12 * e + 3 * k + i] = outward[i];
      }
    }
    corners.set([0, 1, 2, 2, 1, 3].map(i => 4 * e + i), 6 * e);
  }
  return {at, out, source, corners};
}
