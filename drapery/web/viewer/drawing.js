// Draws a scene as the software renderer does: nearest texels, layers composited in straight
// alpha, light by vertex in sRGB, blended triangles last and from far to near.

const VERTEX = `#version 300 es
in vec3 position;
in float light;
in vec2 uv;
in int material;
uniform mat4 clip;
out vec3 uvLight;
flat out int materialIndex;
void main() {
  gl_Position = clip * vec4(position, 1.0);
  uvLight = vec3(uv, light);
  materialIndex = material;
}`;

const FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
precision highp isampler2D;
in vec3 uvLight;
flat in int materialIndex;
uniform sampler2D atlas;
uniform isampler2D materials;
uniform isampler2D layers;
uniform vec3 tint;
out vec4 colour; // premultiplied

const int CUTOUT = 1, BLEND = 2;

ivec4 row(isampler2D table, int place) {
  return texelFetch(table, ivec2(place & 1023, place >> 10), 0);
}

vec3 rounded(vec3 rgb) {
  return floor(rgb * 255.0 + 0.5) / 255.0;
}

vec4 layer(int number) {
  ivec4 rect = row(layers, 2 * number);
  ivec2 inside = clamp(ivec2(floor(uvLight.xy * vec2(rect.zw))), ivec2(0), rect.zw - 1);
  vec4 texel = texelFetch(atlas, rect.xy + inside, 0);
  return vec4(floor(texel.rgb * vec3(row(layers, 2 * number + 1).rgb) + 0.5) / 255.0, texel.a);
}

void main() {
  ivec4 material = row(materials, materialIndex); // first layer, number of layers, alpha mode, lit
  vec4 seen = layer(material.x);
  if (material.z == CUTOUT && seen.a < 0.5) discard;
  if (material.z != BLEND) seen.a = 1.0;
  for (int upper = 1; upper < material.y; upper++) {
    vec4 top = layer(material.x + upper);
    float share = seen.a * (1.0 - top.a), total = top.a + share;
    if (total > 0.0) seen = vec4(rounded((top.rgb * top.a + seen.rgb * share) / total), total);
  }
  if (material.w != 0) seen.rgb = rounded(seen.rgb * uvLight.z * tint);
  colour = vec4(seen.rgb * seen.a, seen.a);
}`;

const BLEND = 2;
const WIDE = 1024;

const programs = new WeakMap(); // one for each context, for all its drawings

export class Drawing {
  constructor(gl) {
    this.gl = gl;
    this.scene = null;
    this.program = programOf(gl);
    this.at = Object.fromEntries(
      ["clip", "atlas", "materials", "layers", "tint"].map((name) => [name, gl.getUniformLocation(this.program, name)])
    );
    this.vertexArray = gl.createVertexArray();
    this.textures = {};
    this.buffers = {};
  }

  // Set the constant parts of the scene; the positions follow with the next moment.
  setScene(header, arrays) {
    const gl = this.gl;
    const count = header.vertices;
    this.scene = { header, ...arrays, positions: new Float32Array(3 * count), light: new Float32Array(count) };
    this.scene.panes = header.panes.map((pane) => splitPane(pane, arrays));
    gl.bindVertexArray(this.vertexArray);
    this.attribute("position", 3, this.scene.positions, gl.DYNAMIC_DRAW);
    this.attribute("light", 1, this.scene.light, gl.DYNAMIC_DRAW);
    this.attribute("uv", 2, arrays.uvs, gl.STATIC_DRAW);
    this.attribute("material", 1, arrays.vertexMaterials, gl.STATIC_DRAW, true);
    this.indices = this.filled("indices", gl.ELEMENT_ARRAY_BUFFER, allIndices(this.scene.panes), gl.DYNAMIC_DRAW);
    const [width, height] = header.atlas;
    this.texture("atlas", gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, width, height, arrays.atlas);
    this.setMaterials(arrays.materials, arrays.layers);
  }

  // Replace the materials by others of the same number and alpha.
  setMaterials(materials, layers) {
    this.table("materials", materials);
    this.table("layers", widened(layers));
  }

  // Update the vertices that have moved.
  setMoment(header, arrays) {
    const gl = this.gl;
    const { positions, light } = this.scene;
    let from = 0;
    for (const [first, count] of header.runs) {
      const moved = arrays.positions.subarray(3 * from, 3 * (from + count));
      const lit = arrays.light.subarray(from, from + count);
      positions.set(moved, 3 * first);
      light.set(lit, first);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.position);
      gl.bufferSubData(gl.ARRAY_BUFFER, 12 * first, moved);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.light);
      gl.bufferSubData(gl.ARRAY_BUFFER, 4 * first, lit);
      from += count;
    }
    this.tints = header.tints;
  }

  // Draw each pane into its rectangle of the canvas: [x, y, width, height], origin at lower left.
  draw(rects, matrices) {
    const gl = this.gl;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (!this.scene || !this.tints) return;
    gl.useProgram(this.program);
    gl.bindVertexArray(this.vertexArray);
    ["atlas", "materials", "layers"].forEach((name, place) => {
      gl.activeTexture(gl.TEXTURE0 + place);
      gl.bindTexture(gl.TEXTURE_2D, this.textures[name]);
      gl.uniform1i(this.at[name], place);
    });
    gl.enable(gl.SCISSOR_TEST);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.disable(gl.CULL_FACE);
    this.scene.panes.forEach((pane, number) => {
      if (rects[number]) this.drawPane(pane, rects[number], matrices[number], this.tints[number]);
    });
  }

  drawPane(pane, rect, matrix, tint) {
    const gl = this.gl;
    const [red, green, blue, alpha] = pane.background.map((value) => value / 255);
    gl.viewport(...rect);
    gl.scissor(...rect);
    gl.clearColor(red * alpha, green * alpha, blue * alpha, alpha);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(this.at.clip, false, matrix);
    gl.uniform3fv(this.at.tint, tint);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    gl.drawElements(gl.TRIANGLES, pane.solid.length, gl.UNSIGNED_INT, 4 * pane.start);
    if (!pane.blend.length) return;
    sortFarToNear(pane, this.scene.positions, matrix);
    gl.bufferSubData(gl.ELEMENT_ARRAY_BUFFER, 4 * (pane.start + pane.solid.length), pane.blend);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    gl.drawElements(gl.TRIANGLES, pane.blend.length, gl.UNSIGNED_INT, 4 * (pane.start + pane.solid.length));
    gl.depthMask(true);
  }

  attribute(name, size, values, usage, whole = false) {
    const gl = this.gl;
    const place = gl.getAttribLocation(this.program, name);
    this.filled(name, gl.ARRAY_BUFFER, values, usage);
    gl.enableVertexAttribArray(place);
    if (whole) gl.vertexAttribIPointer(place, size, gl.INT, 0, 0);
    else gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
  }

  filled(name, target, values, usage) {
    const gl = this.gl;
    this.buffers[name] ??= gl.createBuffer();
    gl.bindBuffer(target, this.buffers[name]);
    gl.bufferData(target, values, usage);
    return this.buffers[name];
  }

  table(name, values) {
    const gl = this.gl;
    const rows = Math.max(1, Math.ceil(values.length / 4 / WIDE));
    const whole = new Int32Array(4 * WIDE * rows);
    whole.set(values);
    this.texture(name, gl.RGBA32I, gl.RGBA_INTEGER, gl.INT, WIDE, rows, whole);
  }

  texture(name, inside, format, type, width, height, values) {
    const gl = this.gl;
    this.textures[name] ??= gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.textures[name]);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    gl.texImage2D(gl.TEXTURE_2D, 0, inside, width, height, 0, format, type, values);
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
  }

  // Release the GPU memory immediately.
  free() {
    const gl = this.gl;
    Object.values(this.buffers).forEach((buffer) => gl.deleteBuffer(buffer));
    Object.values(this.textures).forEach((texture) => gl.deleteTexture(texture));
    gl.deleteVertexArray(this.vertexArray);
  }
}

function programOf(gl) {
  // A program of a context that was lost and restored is not a program any more.
  if (!gl.isProgram(programs.get(gl) ?? null)) programs.set(gl, link(gl));
  return programs.get(gl);
}

function link(gl) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(gl.getProgramInfoLog(program) || "the shaders cannot be linked");
  return program;
}

// Split a pane's triangles into opaque ones and blended ones.
function splitPane(pane, { triangles, triangleMaterials, materials }) {
  const [first, count] = pane.triangles;
  const solid = [];
  const blend = [];
  for (let t = first; t < first + count; t++) {
    const list = materials[4 * triangleMaterials[t] + 2] === BLEND ? blend : solid;
    list.push(triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]);
  }
  return { ...pane, solid: Uint32Array.from(solid), blend: Uint32Array.from(blend), start: 0 };
}

function allIndices(panes) {
  const total = panes.reduce((sum, pane) => sum + pane.solid.length + pane.blend.length, 0);
  const indices = new Uint32Array(total);
  let at = 0;
  for (const pane of panes) {
    pane.start = at;
    indices.set(pane.solid, at);
    indices.set(pane.blend, at + pane.solid.length);
    at += pane.solid.length + pane.blend.length;
  }
  return indices;
}

// Pad layers of seven numbers to rows of eight.
function widened(layers) {
  const rows = new Int32Array((layers.length / 7) * 8);
  for (let layer = 0; 7 * layer < layers.length; layer++) rows.set(layers.subarray(7 * layer, 7 * layer + 7), 8 * layer);
  return rows;
}

function sortFarToNear(pane, positions, m) {
  const count = pane.blend.length / 3;
  const depth = new Float64Array(count);
  for (let t = 0; t < count; t++)
    for (let corner = 0; corner < 3; corner++) {
      const v = 3 * pane.blend[3 * t + corner];
      const [x, y, z] = [positions[v], positions[v + 1], positions[v + 2]];
      depth[t] += (m[2] * x + m[6] * y + m[10] * z + m[14]) / (m[3] * x + m[7] * y + m[11] * z + m[15]);
    }
  const order = Array.from(depth.keys()).sort((a, b) => depth[b] - depth[a] || a - b);
  const sorted = new Uint32Array(pane.blend.length);
  order.forEach((from, to) => sorted.set(pane.blend.subarray(3 * from, 3 * from + 3), 3 * to));
  pane.blend = sorted;
}
