// Looks at a target from a direction given by two angles about the scene's upward direction.

import {add, cross, dot, length, subtract, unit} from "./vectors.js";

export class Camera {
  constructor(up) {
    this.up = unit(up);
    const side = Math.abs(this.up[2]) > 0.9 ? [0, -1, 0] : [0, 0, 1];
    this.front = unit(subtract(side, this.up.map(x => x * dot(side, this.up))));
    this.right = cross(this.up, this.front);
    Object.assign(this, {azimuth: 0.6, elevation: 0.35, distance: 1, target: [0, 0, 0]});
  }

  static fieldOfView = 0.6; // of the smaller side [rad]

  // From the target to the eye.
  get toward() {
    const {azimuth: a, elevation: e} = this, level = Math.cos(e);
    return add(add(this.up.map(x => x * Math.sin(e)), this.front, level * Math.cos(a)), this.right, level * Math.sin(a));
  }
  get axes() {
    const back = this.toward, right = unit(add(this.front.map(x => -x * Math.sin(this.azimuth)), this.right,
                                               Math.cos(this.azimuth)));
    return [right, cross(back, right), back];
  }
  get eye() { return add(this.target, this.toward, this.distance); }

  // So far away that all corners (relative to the center) are in a picture of that size.
  fit(center, corners, width, height) {
    const [right, up, back] = this.axes, [sx, sy] = this.scales(width, height);
    this.target = center;
    this.distance = 1.06 * Math.max(...corners.map(
      c => dot(c, back) + Math.max(sx * Math.abs(dot(c, right)), sy * Math.abs(dot(c, up)))));
  }

  turn(x, y) {
    this.azimuth -= x;
    this.elevation = Math.max(-1.57, Math.min(1.57, this.elevation + y));
  }

  // In pictures' smaller sides.
  move(x, y) {
    const [right, up] = this.axes, size = 2 * this.distance * Math.tan(Camera.fieldOfView / 2);
    this.target = add(add(this.target, right, -x * size), up, y * size);
  }

  zoom(factor) { this.distance *= factor; }

  // Scales of x and y in clip space.
  scales(width, height) {
    const s = 1 / Math.tan(Camera.fieldOfView / 2), smaller = Math.min(width, height);
    return [s * smaller / width, s * smaller / height];
  }

  // Column by column, of places relative to `origin`; `radius` of what there is to see around it.
  matrix(width, height, origin, radius) {
    const [right, up, back] = this.axes, eye = subtract(this.eye, origin), [sx, sy] = this.scales(width, height);
    const far = length(eye) + 6 * radius, near = Math.max(0.002 * this.distance, this.distance - 8 * radius);
    const a = (far + near) / (near - far), b = 2 * far * near / (near - far);
    const m = [];
    for (let i = 0; i < 3; ++i)
      m.push(sx * right[i], sy * up[i], a * back[i], -back[i]);
    m.push(-sx * dot(right, eye), -sy * dot(up, eye), b - a * dot(back, eye), dot(back, eye));
    return new Float32Array(m);
  }

  // Direction of the ray through a place of the picture, -1 to 1 from left to right and bottom to top.
  ray(x, y, width, height) {
    const [right, up, back] = this.axes, [sx, sy] = this.scales(width, height);
    return unit(add(add(back.map(c => -c), right, x / sx), up, y / sy));
  }

  // Where a place is seen in such a picture, or null behind the eye.
  see(place, width, height) {
    const [right, up, back] = this.axes, r = subtract(place, this.eye), depth = -dot(r, back);
    const [sx, sy] = this.scales(width, height);
    return depth > 0 ? [sx * dot(r, right) / depth, sy * dot(r, up) / depth] : null;
  }
}
