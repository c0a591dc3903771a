// Curves and the scale of false colours, drawn on small canvases.

export const themed = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function sharp(canvas) {
  const ratio = window.devicePixelRatio || 1, {clientWidth: width, clientHeight: height} = canvas;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  pen.font = "11px system-ui, sans-serif";
  return {pen, width, height};
}

// A factor and the unit that suit numbers up to `most`; units: [name, factor] from large to small.
function fitting(most, units) {
  const [name, factor] = units.find(([, f]) => most * f >= 0.9995) ?? units.at(-1);
  return [factor, name];
}
const metres = [["m", 1], ["mm", 1e3], ["µm", 1e6]], plainly = unit => unit === "m" ? metres : [[unit, 1]];

function ticks(low, high, count) {
  const rough = (high - low) / count, size = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map(f => f * size).find(s => s >= rough * 0.999), out = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    out.push(Number((i * step).toPrecision(12)));
  return out;
}

// lines: lists of [x, y]; cursor: an x; dashes: a pattern for each line, solid without. The y axis begins at 0 unless the
// values are close together.
export function plot(canvas, lines, units, cursor, dashes = []) {
  const {pen, width, height} = sharp(canvas), all = lines.flat().filter(p => Number.isFinite(p[1]) && p[1] < 1e15);
  if (all.length === 0)
    return;
  let [left, right] = [Math.min(...all.map(p => p[0])), Math.max(...all.map(p => p[0]))];
  let [low, high] = [Math.min(...all.map(p => p[1])), Math.max(...all.map(p => p[1]))];
  if (right === left)
    right = left + 1;
  if (low > 0 && low < 0.7 * high)
    low = 0;
  const spare = Math.max((high - low) * 0.08, Math.abs(high) * 1e-3, 1e-12);
  [low, high] = [low === 0 ? 0 : low - spare, high + spare];
  const [fx, ux] = fitting(Math.max(Math.abs(left), Math.abs(right)), plainly(units[0]));
  const [fy, uy] = fitting(Math.max(Math.abs(low), Math.abs(high)), plainly(units[1]));
  const box = {x: 46, y: 16, w: width - 56, h: height - 36};
  const px = x => box.x + box.w * (x - left) / (right - left), py = y => box.y + box.h * (1 - (y - low) / (high - low));
  pen.fillStyle = pen.strokeStyle = themed("--line");
  const label = themed("--soft");
  for (const y of ticks(low * fy, high * fy, 4)) {
    pen.fillRect(box.x, Math.round(py(y / fy)), box.w, 1);
    pen.fillStyle = label;
    pen.textAlign = "right";
    pen.fillText(y, box.x - 5, py(y / fy) + 4);
    pen.fillStyle = themed("--line");
  }
  pen.fillStyle = label;
  pen.textAlign = "center";
  for (const x of ticks(left * fx, right * fx, 5))
    pen.fillText(x, px(x / fx), height - 6);
  pen.textAlign = "left";
  pen.fillText(uy, 4, 11);
  pen.fillText(ux, 4, height - 6);
  pen.lineWidth = 1.6;
  pen.strokeStyle = pen.fillStyle = themed("--accent");
  for (const [number, line] of lines.entries()) {
    pen.setLineDash(dashes[number] ?? []);
    pen.beginPath();
    line.forEach(([x, y], i) => i ? pen.lineTo(px(x), py(y)) : pen.moveTo(px(x), py(y)));
    pen.stroke();
    if (line.length === 1)
      pen.fillRect(px(line[0][0]) - 2, py(line[0][1]) - 2, 4, 4);
  }
  if (cursor !== undefined) {
    pen.fillStyle = "#d4351c";
    pen.fillRect(px(cursor) - 0.5, box.y, 1.5, box.h);
  }
}

export function drawLegend(canvas, quantity, range, colourAt) {
  canvas.style.height = `${18 * quantity.kinds.length || 54}px`;
  const {pen, width} = sharp(canvas), ink = themed("--ink");
  pen.textAlign = "left";
  quantity.kinds.forEach(([text, colour], i) => {
    pen.fillStyle = `rgb(${colour})`;
    pen.fillRect(4, 3 + 18 * i, 24, 12);
    pen.fillStyle = ink;
    pen.fillText(text, 36, 13 + 18 * i);
  });
  if (quantity.kinds.length)
    return;
  const {units} = quantity, [factor, unit] = fitting(Math.max(...range.map(Math.abs)), units);
  pen.fillStyle = ink;
  pen.fillText(unit ? `${quantity.caption} [${unit}]` : quantity.caption, 4, 12);
  const bar = {x: 14, w: width - 28};
  for (let i = 0; i < bar.w; ++i) {
    pen.fillStyle = `rgb(${colourAt(i / (bar.w - 1))})`;
    pen.fillRect(bar.x + i, 18, 1.5, 14);
  }
  pen.fillStyle = ink;
  pen.textAlign = "center";
  const [low, high] = range.map(x => x * factor);
  for (const x of ticks(low, high, 4))
    pen.fillText(x, bar.x + bar.w * (x - low) / (high - low), 47);
}
