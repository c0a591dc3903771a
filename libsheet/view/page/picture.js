// The picture: what of the streams is on the graphics card, and how it is drawn.

import {coloursOf} from "./colours.js";
import {cutBy} from "./measure.js";
import {shapeOf, wallOf} from "./mesh.js";
import {themed} from "./plots.js";
import {capOf, moved, surfaceShape} from "./scene.js";
import {camera, canvas, cornersOf, extent, now, part, plane, quantity, range, shown, state, streams} from "./state.js";
import {add, dot, subtract, unit} from "./vectors.js";

// The sheet displaces a bath: its surface is drawn below the sheet where that lies deeper.
function loweredBath(stream, surface) {
  const heights = stream.descriptions.filter(d => d.triangles > 0).flatMap(cornersOf).map(c => dot(c, surface.normal));
  const level = dot(surface.point, surface.normal), lowest = Math.min(...heights) - 0.01 * extent.radius;
  return lowest < level ? {...surface, point: add(surface.point, surface.normal, lowest - level)} : surface;
}

// Makes what has changed since the last picture anew.
function refresh(i) {
  const stream = streams[i], frame = stream.frameAt(now()), kept = shown[i];
  if (kept.frame !== frame || kept.colour !== state.colour) {
    if (kept.frame !== frame)
      kept.shape = shapeOf(frame, extent.origin);
    const colours = coloursOf(frame, kept.shape, quantity(), range()), wall = wallOf(frame.mesh, kept.shape);
    [kept.sheet, kept.wall, kept.lines].forEach(u => canvas.free(u));
    kept.lines = null;
    kept.sheet = canvas.upload({...kept.shape, colour: colours, corners: frame.mesh.corners});
    const ends = new Uint8Array(4 * wall.source.length);
    wall.source.forEach((v, k) => ends.set(colours.subarray(4 * v, 4 * v + 4), 4 * k));
    kept.wall = canvas.upload({place: wall.at, normal: wall.out, colour: ends, corners: wall.corners});
  }
  if (state.mesh && !kept.lines)
    kept.lines = canvas.upload({...kept.shape, corners: frame.mesh.edges});
  const cut = plane(), key = cut && [...cut.normal, cut.at].join();
  if (kept.frame !== frame || kept.cutKey !== key) {
    canvas.free(kept.cap);
    kept.cap = null;
    kept.cutLines = [];
    if (cut) {
      kept.cutLines = cutBy(frame, kept.shape, cut);
      kept.cap = canvas.upload(capOf(kept.cutLines, cut));
    }
    kept.cutKey = key;
  }
  if (kept.placement !== frame.placement) {
    (kept.around || []).forEach(a => canvas.free(a.uploaded));
    const {motions, surfaces} = stream.placements[frame.placement];
    kept.around = [
      ...stream.solids.map((solid, k) => ({kind: "solid", number: solid.number, uploaded: canvas.upload(
        {...moved(solid.shape, motions[k], extent.origin), corners: solid.corners})})),
      ...surfaces.map(s => ({kind: s.kind, uploaded: canvas.upload(
        surfaceShape(s.kind === "bath" ? loweredBath(stream, s) : s, extent.origin, extent.radius))})),
    ];
    kept.placement = frame.placement;
  }
  kept.frame = frame;
  kept.colour = state.colour;
}

const aroundColours = {
  plane: [0.62, 0.64, 0.67, 0.55], belt: [0.45, 0.52, 0.60, 0.6], bath: [0.30, 0.50, 0.68, 0.45],
  sea: [0.30, 0.50, 0.68, 0.45], // what runs down into it goes under
};
const solidColours = [[0.68, 0.66, 0.63], [0.52, 0.58, 0.64], [0.64, 0.57, 0.50], [0.56, 0.61, 0.55]];

function drawStream(i) {
  const {x, y, width, height} = part(i), ratio = canvas.element.width / Math.max(canvas.element.clientWidth, 1);
  const [right, up, back] = camera.axes, light = unit(add(add(back, right, -0.5), up, 0.7));
  canvas.begin(x * ratio, canvas.element.height - (y + height) * ratio, width * ratio, height * ratio,
               camera.matrix(width, height, extent.origin, extent.radius), subtract(camera.eye, extent.origin), light, plane());
  const kept = shown[i], plain = state.colour === "plain", shine = plain ? 0.3 : 0.06;
  if (state.solids)
    for (const {kind, number, uploaded} of kept.around)
      if (kind === "solid")
        canvas.draw(uploaded, {colour: [...solidColours[number % 4], 1], behind: true});
  canvas.draw(kept.sheet, {side: 1, cull: state.cut ? null : "back", shine});
  canvas.draw(kept.sheet, {side: -1, cull: state.cut ? null : "front", shine});
  canvas.draw(kept.wall, {shine});
  if (kept.cap)
    canvas.draw(kept.cap, {colour: [0.85, 0.25, 0.15, 1], cut: false, lit: false});
  if (state.mesh)
    for (const side of [1, -1])
      canvas.draw(kept.lines, {side, lines: true, lit: false, colour: [0.05, 0.08, 0.14, 0.55]});
  if (state.solids)
    for (const {kind, uploaded} of kept.around)
      if (kind !== "solid")
        canvas.draw(uploaded, {colour: aroundColours[kind], reach: 2.2 * extent.radius, cut: false, behind: true});
}

export function drawPicture() {
  const hex = themed("--canvas");
  canvas.clear([1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255));
  streams.forEach((_, i) => refresh(i));
  streams.forEach((_, i) => drawStream(i));
}
