// Packed numbers, as libsheet/view/packed_numbers.h describes them.

export async function unpack(id) {
  const element = document.getElementById(id), text = atob(element.textContent);
  element.remove();
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i)
    bytes[i] = text.charCodeAt(i);
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Unpacked(new Uint8Array(await new Response(plain).arrayBuffer()));
}

class Unpacked {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  // So many numbers; they are differences from those of `before`, or, without it, each from the one before it.
  numbers(count, before) {
    const {bytes, at} = this, out = new Int32Array(count);
    const second = at + count, third = second + count, fourth = third + count;
    let last = 0;
    for (let i = 0; i < count; ++i) {
      const z = bytes[at + i] | bytes[second + i] << 8 | bytes[third + i] << 16 | bytes[fourth + i] << 24;
      last = (before ? before[i] : last) + (z >>> 1 ^ -(z & 1)) | 0;
      out[i] = last;
    }
    this.at += 4 * count;
    return out;
  }

  rawBytes(count) {
    this.at += count;
    return this.bytes.slice(this.at - count, this.at);
  }
}

// A number with four digits and the unit's fitting prefix: 0.00123, "m" becomes "1.230 mm".
export function withUnit(value, unit) {
  if (!Number.isFinite(value) || Math.abs(value) > 1e15)
    return "without bound";
  if (value === 0)
    return unit ? `0 ${unit}` : "0";
  if (unit !== "m" && unit !== "m/s" && unit !== "s")
    return `${Number(value.toPrecision(4))}${unit ? " " + unit : ""}`;
  const size = Math.abs(value);
  for (const [factor, prefix] of [[1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]])
    if (size >= 0.9995 * factor)
      return `${Number((value / factor).toPrecision(4))} ${prefix}${unit}`;
  return `${value.toExponential(2)} ${unit}`;
}
