// False colours: dark to light for amounts, two-sided for curvature, three for contact; as sheet-render has them.

const amounts = [[31, 13, 71], [48, 48, 133], [28, 94, 153], [18, 135, 143], [61, 176, 107], [166, 209, 56], [252, 235, 84]];
const twoSided = [[23, 64, 140], [115, 168, 214], [242, 242, 240], [230, 145, 107], [158, 26, 38]];
const contactColours = [[204, 207, 212], [41, 115, 191], [219, 84, 41]];
const contactNames = ["none", "touches a solid", "touches the sheet"];
const plainColour = [176, 120, 78];

function between(stops, place) {
  const x = Math.max(0, Math.min(1, place || 0)) * (stops.length - 1), i = Math.min(stops.length - 2, Math.floor(x));
  return stops[i].map((c, k) => c + (x - i) * (stops[i + 1][k] - c));
}

const quantities = {
  thickness: {unit: "m", stops: amounts, at: (frame, shape, v) => shape.thickness[v]},
  speed: {unit: "m/s", stops: amounts, at: (frame, shape, v) => length(frame.velocity(v))},
  curvature: {unit: "1/m", stops: twoSided, at: (frame, shape, v) => frame.curvatureAt(v)},
};

// The range of a quantity in all frames of all streams, without the extreme hundredths of each frame.
function rangeOf(streams, quantity) {
  let low = Infinity, high = -Infinity;
  for (const stream of streams)
    for (const frame of stream.descriptions) {
      if (frame.triangles === 0)
        continue;
      low = Math.min(low, frame[quantity][0]);
      high = Math.max(high, frame[quantity][1]);
    }
  if (!(low <= high))
    return [0, 1];
  if (quantity === "curvature") {
    const most = Math.max(Math.abs(low), Math.abs(high), 1e-9);
    return [-most, most];
  }
  if (high - low > 1e-3 * Math.abs(high))
    return [low, high];
  return high > 0 ? [0.9 * low, 1.1 * high] : [0, 1];
}

// Red, green, blue, 255 for each vertex.
function coloursOf(frame, shape, name, range) {
  const colours = new Uint8Array(4 * frame.vertices).fill(255), quantity = quantities[name];
  for (let v = 0; v < frame.vertices; ++v) {
    const colour = name === "contact" ? contactColours[frame.contacts[v]]
      : quantity ? between(quantity.stops, (quantity.at(frame, shape, v) - range[0]) / (range[1] - range[0]))
      : plainColour;
    colours.set(colour, 4 * v);
  }
  return colours;
}
