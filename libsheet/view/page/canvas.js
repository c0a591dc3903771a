// Draws lists of triangles and lines with WebGL 2.

const vertexShader = `#version 300 es
in vec3 place; in vec3 normal; in float thickness; in vec4 colour;
uniform mat4 matrix; uniform float side;
out vec3 at; out vec3 outward; out vec4 tint;
void main() {
  at = place + 0.5 * side * thickness * normal;
  outward = side < 0.0 ? -normal : normal;
  tint = colour;
  gl_Position = matrix * vec4(at, 1.0);
}`;

const fragmentShader = `#version 300 es
precision highp float;
in vec3 at; in vec3 outward; in vec4 tint;
uniform vec3 eye; uniform vec3 light; uniform vec4 cut; uniform float cutting; uniform float shine; uniform float lit;
uniform float reach;
out vec4 result;
void main() {
  if (cutting > 0.5 && dot(at, cut.xyz) > cut.w) discard;
  vec3 v = normalize(eye - at), n = normalize(outward);
  if (dot(n, v) < 0.0) n = -n;
  float diffuse = max(dot(n, light), 0.0);
  float gloss = pow(max(dot(n, normalize(light + v)), 0.0), 48.0);
  vec3 shaded = tint.rgb * (0.42 + 0.38 * diffuse + 0.24 * max(dot(n, v), 0.0)) + shine * gloss;
  float fade = reach > 0.0 ? 1.0 - smoothstep(0.55 * reach, reach, length(at)) : 1.0;
  result = vec4(mix(tint.rgb, shaded, lit), tint.a * fade);
}`;

export class Canvas {
  constructor(element) {
    this.element = element;
    const gl = this.gl = element.getContext("webgl2", {alpha: false, antialias: true});
    if (!gl)
      return;
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    this.attributes = ["place", "normal", "thickness", "colour"];
    this.attributes.forEach((name, i) => gl.bindAttribLocation(program, i, name));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS))
      throw new Error(gl.getProgramInfoLog(program));
    gl.useProgram(program);
    this.uniform = name => gl.getUniformLocation(program, name);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  // Lists of numbers to the graphics card: place, normal, thickness, colour (bytes) a vertex; corners, and edges.
  upload(lists) {
    const {gl} = this, array = gl.createVertexArray(), buffers = [];
    gl.bindVertexArray(array);
    const buffer = (target, data) => {
      buffers.push(gl.createBuffer());
      gl.bindBuffer(target, buffers.at(-1));
      gl.bufferData(target, data, gl.STATIC_DRAW);
    };
    [3, 3, 1, 4].forEach((size, i) => {
      const data = lists[this.attributes[i]];
      if (!data)
        return;
      buffer(gl.ARRAY_BUFFER, data);
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, size, size === 4 ? gl.UNSIGNED_BYTE : gl.FLOAT, size === 4, 0, 0);
    });
    buffer(gl.ELEMENT_ARRAY_BUFFER, lists.corners);
    const made = {array, buffers, count: lists.corners.length};
    gl.bindVertexArray(null);
    return made;
  }

  free(uploaded) {
    if (!uploaded)
      return;
    uploaded.buffers.forEach(b => this.gl.deleteBuffer(b));
    this.gl.deleteVertexArray(uploaded.array);
  }

  // A part of the picture, in pixels from the lower left.
  begin(x, y, width, height, matrix, eye, light, cut) {
    const {gl} = this;
    gl.viewport(x, y, width, height);
    gl.uniformMatrix4fv(this.uniform("matrix"), false, matrix);
    gl.uniform3fv(this.uniform("eye"), eye);
    gl.uniform3fv(this.uniform("light"), light);
    gl.uniform4fv(this.uniform("cut"), cut ? [...cut.normal, cut.at] : [0, 0, 0, 0]);
    this.cutting = Boolean(cut);
  }

  // how: side (1, -1, 0), colour (if it is one for all, 0 to 1), lines, cut, shine, lit, reach, cull, behind (what
  // lies in the same place)
  draw(uploaded, how) {
    if (!uploaded || uploaded.count === 0)
      return;
    const {gl} = this;
    gl.bindVertexArray(uploaded.array);
    if (how.colour)
      gl.vertexAttrib4fv(3, how.colour);
    gl.uniform1f(this.uniform("side"), how.side || 0);
    gl.uniform1f(this.uniform("cutting"), this.cutting && how.cut !== false ? 1 : 0);
    gl.uniform1f(this.uniform("shine"), how.shine || 0);
    gl.uniform1f(this.uniform("lit"), how.lit === false ? 0 : 1);
    gl.uniform1f(this.uniform("reach"), how.reach || 0);
    const see = how.colour && how.colour[3] < 1 || how.reach;
    see ? gl.enable(gl.BLEND) : gl.disable(gl.BLEND);
    gl.depthMask(!see);
    how.lines ? gl.disable(gl.POLYGON_OFFSET_FILL) : gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(...(how.behind ? [3, 6] : [1, 1]));
    how.cull ? gl.enable(gl.CULL_FACE) : gl.disable(gl.CULL_FACE);
    gl.cullFace(how.cull === "front" ? gl.FRONT : gl.BACK);
    gl.drawElements(how.lines ? gl.LINES : gl.TRIANGLES, uploaded.count, gl.UNSIGNED_INT, 0);
    gl.depthMask(true);
  }

  clear(colour) {
    const {gl, element} = this, ratio = window.devicePixelRatio || 1;
    const width = Math.round(element.clientWidth * ratio), height = Math.round(element.clientHeight * ratio);
    if (element.width !== width || element.height !== height)
      Object.assign(element, {width, height});
    gl.clearColor(...colour, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }
}
