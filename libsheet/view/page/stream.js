// Frames of a stream, unpacked one after the other (libsheet/view/packed_frame.h). Quantities are SI.

import {unpack} from "./numbers.js";
import {Mesh} from "./mesh.js";
import {plainColours, quantities} from "./colours.js";

class Frame {
  constructor(description) {
    Object.assign(this, description); // time, step, vertices, triangles, ..., as FrameDescription
  }

  place(v) {
    const {positions: p, vertices: n, positionStep: s} = this;
    return [p[v] * s, p[n + v] * s, p[2 * n + v] * s];
  }
  velocity(v) {
    const {velocities: p, vertices: n, velocityStep: s} = this;
    return p ? [p[v] * s, p[n + v] * s, p[2 * n + v] * s] : [0, 0, 0];
  }
  thicknessOf(triangle) { return Math.exp(this.logs[triangle] * this.thicknessStep); }
  // Of a quantity that is packed, at a triangle or vertex.
  valueOf(name, row) { return this.values[name][row] * (this.steps[name] || 1); }
  // {name, colour} of the liquid at a vertex.
  liquidOf(v) {
    const {liquids} = this.stream;
    return liquids[this.liquid ? this.liquid[v] % liquids.length : 0];
  }
  cornersOf(triangle) { return this.mesh.corners.subarray(3 * triangle, 3 * triangle + 3); }
}

export class Stream {
  constructor(number, description) {
    Object.assign(this, description); // name, scene, up, solids, liquids, placements
    this.number = number;
    this.descriptions = description.frames;
    this.liquids.forEach((liquid, i) => { liquid.colour ??= plainColours[i % plainColours.length]; });
    this.frames = []; // those that are unpacked
    this.times = this.descriptions.map(d => d.time);
  }

  async unpackNext() {
    const number = this.frames.length, before = this.frames[number - 1];
    const frame = new Frame(this.descriptions[number]);
    const {vertices, triangles} = frame, data = await unpack(`frame-${this.number}-${number}`);
    frame.number = number;
    frame.thicknessStep = this.thicknessStep;
    frame.mesh = frame.sameMesh ? before.mesh : new Mesh(vertices, new Uint32Array(data.numbers(3 * triangles)));
    frame.positions = data.numbers(3 * vertices, frame.positionFollows ? before.positions : null);
    frame.logs = data.numbers(triangles, frame.sameMesh ? before.logs : null);
    if (frame.moves)
      frame.velocities = data.numbers(3 * vertices, frame.velocityFollows ? before.velocities : null);
    frame.values = {};
    frame.steps = {};
    for (const [i, {name, where, packed, kinds}] of quantities.entries()) {
      const field = frame.fields[i], rows = where === "triangle" ? triangles : vertices;
      if (!packed || !field)
        continue;
      frame.values[name] = kinds.length ? data.rawBytes(rows) : data.numbers(rows, field.follows ? before.values[name] : null);
      frame.steps[name] = field.step;
    }
    frame.liquid = frame.liquids ? data.rawBytes(vertices) : null;
    frame.stream = this;
    this.frames.push(frame);
  }

  async unpackSolids() {
    for (const [i, solid] of this.solids.entries()) {
      const data = await unpack(`solid-${this.number}-${i}`);
      solid.positions = data.numbers(3 * solid.vertices);
      solid.corners = new Uint32Array(data.numbers(3 * solid.triangles));
    }
  }

  // The last frame that is not later, or the first; of those that are unpacked.
  frameAt(time) {
    let number = 0;
    while (number + 1 < this.frames.length && this.times[number + 1] <= time * (1 + 1e-12))
      ++number;
    return this.frames[number];
  }
}
