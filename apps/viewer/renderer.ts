// The drawing card: triangles in colours of a field, and lines. Plain WebGL 2: two short programs.

import { Camera } from "./camera";
import { INK } from "./colours";

const FILL_VERTEX = `#version 300 es
layout(location = 0) in vec2 position;
layout(location = 1) in float value;
uniform vec2 centre, toClip, ends;
out float t;
void main() {
  t = (value - ends.x) / (ends.y - ends.x);
  gl_Position = vec4((position - centre) * toClip, 0.0, 1.0);
}`;

const FILL_FRAGMENT = `#version 300 es
precision highp float;
in float t;
uniform sampler2D colours;
out vec4 colour;
void main() { colour = texture(colours, vec2(t, 0.5)); }`;

// A line is a box of four vertices; its width may differ between its ends. A line without length is a round dot.
// Boxes are written out and not drawn as instances: software drawing, as in virtual machines, takes 20 µs an instance.
const LINE_VERTEX = `#version 300 es
layout(location = 0) in vec4 line;
layout(location = 1) in vec2 widths;
layout(location = 2) in vec4 tint;
uniform vec2 centre, toClip, pixels;
uniform float alpha, ratio;
out vec4 colour;
out vec2 across;
out float edge;
void main() {
  vec2 from = (line.xy - centre) * toClip * pixels * 0.5, to = (line.zw - centre) * toClip * pixels * 0.5;
  float size = length(to - from);
  bool is_dot = size < 1e-3;
  vec2 corner = vec2(gl_VertexID >> 1 & 1, (gl_VertexID & 1) * 2 - 1);
  vec2 along = is_dot ? vec2(1.0, 0.0) : (to - from) / size;
  edge = 0.5 * (mix(widths.x, widths.y, corner.x) + 1.0 / ratio);
  across = vec2(is_dot ? (corner.x * 2.0 - 1.0) * edge : 0.0, corner.y * edge);
  vec2 at = mix(from, to, corner.x) + along * across.x + vec2(-along.y, along.x) * across.y;
  colour = vec4(tint.rgb, tint.a * alpha);
  gl_Position = vec4(at * 2.0 / pixels, 0.0, 1.0);
}`;

const LINE_FRAGMENT = `#version 300 es
precision highp float;
in vec4 colour;
in vec2 across;
in float edge;
uniform float ratio;
out vec4 result;
void main() {
  float cover = clamp((edge - length(across)) * ratio, 0.0, 1.0);
  result = vec4(colour.rgb, colour.a * cover);
}`;

const EDGE_VERTEX = `#version 300 es
layout(location = 0) in vec2 position;
uniform vec2 centre, toClip;
void main() { gl_Position = vec4((position - centre) * toClip, 0.0, 1.0); }`;

const EDGE_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 colour;
out vec4 result;
void main() { result = colour; }`;

function program(gl: WebGL2RenderingContext, vertex: string, fragment: string): WebGLProgram {
  const linked = gl.createProgram()!;
  for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as [number, string][]) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader) || "shader");
    gl.attachShader(linked, shader);
  }
  gl.linkProgram(linked);
  if (!gl.getProgramParameter(linked, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(linked) || "program");
  return linked;
}

const BYTES_OF_VERTEX = 28, FLOATS_OF_LINE = 28;

/** Lines to be drawn, filled anew for each picture. */
export class Lines {
  count = 0;
  private floats = new Float32Array(FLOATS_OF_LINE * 1024);
  private bytes = new Uint8Array(this.floats.buffer);

  clear(): void {
    this.count = 0;
  }
  add(x0: number, y0: number, x1: number, y1: number, width0: number, width1: number,
      colour: [number, number, number], alpha = 1): void {
    if ((this.count + 1) * FLOATS_OF_LINE > this.floats.length) {
      const larger = new Float32Array(2 * this.floats.length);
      larger.set(this.floats);
      this.floats = larger;
      this.bytes = new Uint8Array(larger.buffer);
    }
    const first = FLOATS_OF_LINE * this.count++, f = this.floats, b = this.bytes;
    for (let at = first; at < first + FLOATS_OF_LINE; at += 7) {
      f[at] = x0;
      f[at + 1] = y0;
      f[at + 2] = x1;
      f[at + 3] = y1;
      f[at + 4] = width0;
      f[at + 5] = width1;
      b[4 * at + 24] = colour[0];
      b[4 * at + 25] = colour[1];
      b[4 * at + 26] = colour[2];
      b[4 * at + 27] = 255 * alpha;
    }
  }
  get data(): Uint8Array {
    return this.bytes.subarray(0, this.count * 4 * BYTES_OF_VERTEX);
  }
}

interface LineBuffer {
  array: WebGLVertexArrayObject;
  buffer: WebGLBuffer;
  count: number;
}

/** Draws into a canvas. Positions are relative to the run's centre. */
export class Renderer {
  readonly gl: WebGL2RenderingContext;
  private readonly fill: WebGLProgram;
  private readonly line: WebGLProgram;
  private readonly locations = new Map<string, WebGLUniformLocation | null>();
  private readonly fillArray: WebGLVertexArrayObject;
  private readonly positions: WebGLBuffer;
  private readonly values: WebGLBuffer;
  private readonly triangles: WebGLBuffer;
  private readonly boxes: WebGLBuffer; // triangles of lines
  private nBoxes = 0;
  private readonly edge: WebGLProgram;
  private readonly edgeArray: WebGLVertexArrayObject;
  private readonly places: WebGLBuffer;
  private readonly edges: WebGLBuffer;
  private nEdgeEnds = 0;
  private readonly colours: WebGLTexture;
  private readonly lineBuffers = new Map<string, LineBuffer>();
  private nTriangleCorners = 0;
  private shown: { isFilled: boolean; ends: [number, number] } = { isFilled: false, ends: [0, 1] };

  constructor(readonly canvas: HTMLCanvasElement) {
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false });
    if (!gl) throw new Error("this browser offers no WebGL 2: allow it hardware acceleration, or use another browser");
    this.gl = gl;
    this.fill = program(gl, FILL_VERTEX, FILL_FRAGMENT);
    this.line = program(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.fillArray = gl.createVertexArray()!;
    this.positions = gl.createBuffer()!;
    this.values = gl.createBuffer()!;
    this.triangles = gl.createBuffer()!;
    this.boxes = gl.createBuffer()!;
    this.edge = program(gl, EDGE_VERTEX, EDGE_FRAGMENT);
    this.edgeArray = gl.createVertexArray()!;
    this.places = gl.createBuffer()!;
    this.edges = gl.createBuffer()!;
    this.colours = gl.createTexture()!;
    gl.bindVertexArray(this.fillArray);
    this.attribute(this.positions, 0, 2);
    this.attribute(this.values, 1, 1);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.triangles);
    gl.bindVertexArray(this.edgeArray);
    this.attribute(this.places, 0, 2);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.edges);
    gl.bindVertexArray(null);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  setTriangles(triangles: Uint32Array): void {
    const gl = this.gl;
    gl.bindVertexArray(this.fillArray);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    this.nTriangleCorners = triangles.length;
  }
  setPositions(positions: Float32Array): void {
    this.upload(this.positions, positions);
  }
  /** One for each corner. */
  setValues(values: Float32Array): void {
    this.upload(this.values, values);
  }
  /**
   * Colours from low to high, red, green, blue of each; or, for kinds, those of 0, 1, ...
   * \param ends  the values of the first and the last colour
   */
  setColours(table: [number, number, number][], smooth: boolean, isFilled: boolean, ends: [number, number]): void {
    const gl = this.gl, n = 1024, texels = new Uint8Array(4 * n);
    for (let k = 0; k < n; ++k) {
      const at = (k / (n - 1)) * (table.length - 1), below = smooth ? Math.floor(at) : Math.round(at), above = Math.min(below + 1, table.length - 1);
      for (let c = 0; c < 3; ++c)
        texels[4 * k + c] = smooth ? Math.round(table[below][c] + (at - below) * (table[above][c] - table[below][c])) : table[below][c];
      texels[4 * k + 3] = 255;
    }
    gl.bindTexture(gl.TEXTURE_2D, this.colours);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, n, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    this.shown = { isFilled, ends };
  }
  /** Plain lines, a pixel wide, between places: for more of them than boxes can be made of in time. */
  setEdges(ends: Uint32Array): void {
    const gl = this.gl;
    gl.bindVertexArray(this.edgeArray);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, ends, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    this.nEdgeEnds = ends.length;
  }
  setPlaces(places: Float32Array): void {
    this.upload(this.places, places);
  }
  /** Lines under a name; they are drawn until others take their place. */
  setLines(name: string, lines: Lines): void {
    const gl = this.gl;
    let target = this.lineBuffers.get(name);
    if (!target) {
      target = { array: gl.createVertexArray()!, buffer: gl.createBuffer()!, count: 0 };
      this.lineBuffers.set(name, target);
      gl.bindVertexArray(target.array);
      this.attribute(target.buffer, 0, 4, BYTES_OF_VERTEX, 0);
      this.attribute(target.buffer, 1, 2, BYTES_OF_VERTEX, 16);
      gl.enableVertexAttribArray(2);
      gl.vertexAttribPointer(2, 4, gl.UNSIGNED_BYTE, true, BYTES_OF_VERTEX, 24);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.boxes);
      gl.bindVertexArray(null);
    }
    if (lines.count > 0) this.upload(target.buffer, lines.data);
    target.count = lines.count;
    this.makeBoxes(lines.count);
  }

  /** \param order  names of lines, the first at the bottom, each with its opacity */
  draw(camera: Camera, ratio: number, edgeAlpha: number, order: [string, number][]): void {
    const gl = this.gl;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const toClip: [number, number] = [(2 * camera.scale) / camera.width, (2 * camera.scale) / camera.height];
    if (this.shown.isFilled) {
      gl.useProgram(this.fill);
      gl.uniform2f(this.at(this.fill, "centre"), camera.x, camera.y);
      gl.uniform2f(this.at(this.fill, "toClip"), ...toClip);
      gl.uniform2f(this.at(this.fill, "ends"), ...this.shown.ends);
      gl.bindTexture(gl.TEXTURE_2D, this.colours);
      gl.bindVertexArray(this.fillArray);
      gl.drawElements(gl.TRIANGLES, this.nTriangleCorners, gl.UNSIGNED_INT, 0);
    }
    if (edgeAlpha > 0) {
      gl.useProgram(this.edge);
      gl.uniform2f(this.at(this.edge, "centre"), camera.x, camera.y);
      gl.uniform2f(this.at(this.edge, "toClip"), ...toClip);
      gl.uniform4f(this.at(this.edge, "colour"), INK[0] / 255, INK[1] / 255, INK[2] / 255, edgeAlpha);
      gl.bindVertexArray(this.edgeArray);
      gl.drawElements(gl.LINES, this.nEdgeEnds, gl.UNSIGNED_INT, 0);
    }
    gl.useProgram(this.line);
    gl.uniform2f(this.at(this.line, "centre"), camera.x, camera.y);
    gl.uniform2f(this.at(this.line, "toClip"), ...toClip);
    gl.uniform2f(this.at(this.line, "pixels"), camera.width, camera.height);
    gl.uniform1f(this.at(this.line, "ratio"), ratio);
    for (const [name, alpha] of order) {
      const lines = this.lineBuffers.get(name);
      if (!lines || lines.count === 0) continue;
      gl.uniform1f(this.at(this.line, "alpha"), alpha);
      gl.bindVertexArray(lines.array);
      gl.drawElements(gl.TRIANGLES, 6 * lines.count, gl.UNSIGNED_INT, 0);
    }
    gl.bindVertexArray(null);
  }

  private attribute(buffer: WebGLBuffer, location: number, size: number, stride = 0, offset = 0): void {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, size, gl.FLOAT, false, stride, offset);
  }
  private makeBoxes(count: number): void {
    if (count <= this.nBoxes) return;
    this.nBoxes = 2 * count;
    const corners = new Uint32Array(6 * this.nBoxes);
    for (let k = 0; k < this.nBoxes; ++k) corners.set([4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 2, 4 * k + 1, 4 * k + 3], 6 * k);
    this.gl.bindVertexArray(null);
    this.gl.bindBuffer(this.gl.ELEMENT_ARRAY_BUFFER, this.boxes);
    this.gl.bufferData(this.gl.ELEMENT_ARRAY_BUFFER, corners, this.gl.DYNAMIC_DRAW);
  }
  private upload(buffer: WebGLBuffer, data: ArrayBufferView): void {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, buffer);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, data, this.gl.DYNAMIC_DRAW);
  }
  private at(of: WebGLProgram, name: string): WebGLUniformLocation | null {
    const key = (of === this.fill ? "fill " : of === this.line ? "line " : "edge ") + name;
    if (!this.locations.has(key)) this.locations.set(key, this.gl.getUniformLocation(of, name));
    return this.locations.get(key)!;
  }
}
