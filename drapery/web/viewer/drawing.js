// Draws a scene as the software renderer does: nearest texels, light by vertex in sRGB, blended
// triangles last and from far to near.

import { BLEND, composited } from "./texels.js";

const VERTEX = `#version 300 es
in vec3 position;
in float light;
in vec2 uv;
in ivec4 rect;
in int lit;
uniform mat4 clip;
uniform vec3 tint;
out vec2 texel;
out vec3 shade;
flat out ivec4 inside;
void main() {
  gl_Position = clip * vec4(position, 1.0);
  texel = uv * vec2(rect.zw);
  shade = lit != 0 ? light * tint : vec3(1.0);
  inside = rect;
}`;

const FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
in vec2 texel;
in vec3 shade;
flat in ivec4 inside;
uniform sampler2D texels;
out vec4 colour; // premultiplied
void main() {
  ivec2 place = clamp(ivec2(floor(texel)), ivec2(0), inside.zw - 1);
  vec4 seen = texelFetch(texels, inside.xy + place, 0);
  if (seen.a == 0.0) discard;
  colour = vec4(seen.rgb * shade * seen.a, seen.a);
}`;

const programs = new WeakMap(); // one for each context, for all its drawings

export class Drawing {
  constructor(gl) {
    this.gl = gl;
    this.scene = null;
    this.program = programOf(gl);
    [this.clip, this.tint] = ["clip", "tint"].map((name) => gl.getUniformLocation(this.program, name));
    this.vertexArray = gl.createVertexArray();
    this.buffers = {};
  }

  // Set the constant parts of the scene; the positions follow with the next moment.
  setScene(header, arrays) {
    const gl = this.gl;
    const count = header.vertices;
    this.scene = { header, ...arrays, positions: new Float32Array(3 * count), light: new Float32Array(count) };
    Object.assign(this, splitTriangles(arrays));
    gl.bindVertexArray(this.vertexArray);
    this.attribute("position", 3, this.scene.positions, gl.DYNAMIC_DRAW);
    this.attribute("light", 1, this.scene.light, gl.DYNAMIC_DRAW);
    this.attribute("uv", 2, arrays.uvs, gl.STATIC_DRAW);
    this.indices = this.filled("indices", gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from([...this.solid, ...this.blend]), gl.DYNAMIC_DRAW);
    this.setMaterials(arrays.materials, arrays.layers);
  }

  // Replace the materials by others of the same number and alpha.
  setMaterials(materials, layers) {
    const gl = this.gl;
    const { header, atlas, vertexMaterials } = this.scene;
    const { texels, size, rects } = composited(atlas, header.atlas[0], materials, layers);
    this.setTexels(texels, size);
    gl.bindVertexArray(this.vertexArray);
    const places = new Int32Array(4 * header.vertices);
    vertexMaterials.forEach((material, vertex) => places.set(rects[material], 4 * vertex));
    this.attribute("rect", 4, places, gl.STATIC_DRAW, true);
    this.attribute("lit", 1, vertexMaterials.map((material) => materials[4 * material + 3]), gl.STATIC_DRAW, true);
  }

  // Update the vertices that have moved.
  setMoment(runs, arrays) {
    const gl = this.gl;
    const { positions, light } = this.scene;
    let from = 0;
    for (const [first, count] of runs) {
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
  }

  // Draw into a rectangle, [x, y, width, height] with the origin at the lower left, which `clear` has made empty.
  draw(rect, matrix, tint) {
    const { gl, solid } = this;
    const { background } = this.scene.header;
    gl.useProgram(this.program);
    gl.bindVertexArray(this.vertexArray);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.viewport(...rect);
    gl.scissor(...rect);
    if (background[3]) clear(gl, rect, background);
    gl.uniformMatrix4fv(this.clip, false, matrix);
    gl.uniform3fv(this.tint, tint);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    gl.drawElements(gl.TRIANGLES, solid.length, gl.UNSIGNED_INT, 0);
    if (!this.blend.length) return;
    this.blend = farToNear(this.blend, this.scene.positions, matrix);
    gl.bufferSubData(gl.ELEMENT_ARRAY_BUFFER, 4 * solid.length, this.blend);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    gl.drawElements(gl.TRIANGLES, this.blend.length, gl.UNSIGNED_INT, 4 * solid.length);
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

  setTexels(values, [width, height]) {
    const gl = this.gl;
    this.texture ??= gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, values);
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
  }

  // Release the GPU memory immediately.
  free() {
    const gl = this.gl;
    Object.values(this.buffers).forEach((buffer) => gl.deleteBuffer(buffer));
    gl.deleteTexture(this.texture);
    gl.deleteVertexArray(this.vertexArray);
  }
}

// Fill a rectangle with a colour, 0 to 255 in straight alpha, and forget the depths there.
export function clear(gl, rect, colour = [0, 0, 0, 0]) {
  const [red, green, blue, alpha] = colour.map((value) => value / 255);
  gl.enable(gl.SCISSOR_TEST);
  gl.scissor(...rect);
  gl.clearColor(red * alpha, green * alpha, blue * alpha, alpha);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
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

// The vertices of opaque triangles and of blended ones.
function splitTriangles({ triangles, triangleMaterials, materials }) {
  const solid = [];
  const blend = [];
  triangleMaterials.forEach((material, t) => {
    const list = materials[4 * material + 2] === BLEND ? blend : solid;
    list.push(triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]);
  });
  return { solid, blend: Uint32Array.from(blend) };
}

function farToNear(blend, positions, m) {
  const count = blend.length / 3;
  const depth = new Float64Array(count);
  for (let t = 0; t < count; t++)
    for (let corner = 0; corner < 3; corner++) {
      const v = 3 * blend[3 * t + corner];
      const [x, y, z] = [positions[v], positions[v + 1], positions[v + 2]];
      depth[t] += (m[2] * x + m[6] * y + m[10] * z + m[14]) / (m[3] * x + m[7] * y + m[11] * z + m[15]);
    }
  const order = Array.from(depth.keys()).sort((a, b) => depth[b] - depth[a] || a - b);
  const sorted = new Uint32Array(blend.length);
  order.forEach((from, to) => sorted.set(blend.subarray(3 * from, 3 * from + 3), 3 * to));
  return sorted;
}
