"use strict";

const SURFACE_SHADERS = [
  `attribute vec3 position; attribute vec3 normal; uniform mat4 toClip; varying vec3 n;
   void main() { n = normal; gl_Position = toClip * vec4(position, 1.0); }`,
  `precision mediump float; varying vec3 n; uniform vec3 toEye; uniform vec4 color;
   void main() {
     float facing = abs(dot(normalize(n), toEye));
     gl_FragColor = vec4(color.rgb * (0.35 + 0.65 * facing) * color.a, color.a);
   }`,
];
const LINE_SHADERS = [
  `attribute vec3 position; attribute vec3 other; attribute float side;
   uniform mat4 toClip; uniform vec2 size; uniform float width;
   void main() {
     vec4 here = toClip * vec4(position, 1.0);
     vec4 there = toClip * vec4(other, 1.0);
     float nearest = 0.001;
     if (here.w < nearest && there.w < nearest) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
     if (here.w < nearest) here = mix(there, here, (there.w - nearest) / max(there.w - here.w, 1e-6));
     if (there.w < nearest) there = mix(here, there, (here.w - nearest) / max(here.w - there.w, 1e-6));
     vec2 along = (there.xy / there.w - here.xy / here.w) * size;
     vec2 across = length(along) > 0.0 ? normalize(vec2(-along.y, along.x)) : vec2(0.0);
     gl_Position = here;
     gl_Position.xy += across * side * width / size * here.w;
   }`,
  `precision mediump float; uniform vec4 color;
   void main() { gl_FragColor = vec4(color.rgb * color.a, color.a); }`,
];

/** @param {WebGLRenderingContext} gl @param {string[]} sources vertex and fragment shader @returns {WebGLProgram} */
function linkProgram(gl, sources) {
  const program = gl.createProgram();
  [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].forEach((kind, i) => {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, sources[i]);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  });
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

/** Draws meshes and thick lines with WebGL. */
class SpacePainter {
  /** @param {HTMLCanvasElement} canvas. Throws where there is no WebGL. */
  constructor(canvas) {
    const gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true }); // for who prints the page
    if (!gl) throw new Error("This browser shows no WebGL.");
    this.gl = gl;
    this.programs = { mesh: linkProgram(gl, SURFACE_SHADERS), line: linkProgram(gl, LINE_SHADERS) };
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** @param {number[]} numbers @returns {WebGLBuffer} */
  buffer(numbers) {
    const made = this.gl.createBuffer();
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, made);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, new Float32Array(numbers), this.gl.STATIC_DRAW);
    return made;
  }

  /** @param {Mesh} mesh @param {boolean} around it surrounds the scene, which must be seen through its near side */
  keepMesh(mesh, around = false) {
    const parts = { position: [this.buffer(mesh.positions), 3], normal: [this.buffer(mesh.normals), 3] };
    return { program: "mesh", parts, count: mesh.positions.length / 3, around };
  }

  /** @param {[Vec3, Vec3][]} lines */
  keepLines(lines) {
    const [position, other, side] = [[], [], []];
    for (const [a, b] of lines) {
      for (const [here, there, where] of [
        [a, b, 1],
        [a, b, -1],
        [b, a, 1],
        [a, b, 1],
        [b, a, 1],
        [b, a, -1],
      ]) {
        position.push(...here);
        other.push(...there);
        side.push(where);
      }
    }
    const parts = {
      position: [this.buffer(position), 3],
      other: [this.buffer(other), 3],
      side: [this.buffer(side), 1],
    };
    return { program: "line", parts, count: side.length };
  }

  /** @param {object} kept by keepMesh or keepLines, and not drawn any more */
  drop({ parts }) {
    for (const [buffer] of Object.values(parts)) this.gl.deleteBuffer(buffer);
  }

  /** @param {Mat4} toClip @param {Vec3} toEye unit, for the light on surfaces */
  begin(toClip, toEye) {
    const { gl } = this;
    const { width, height } = gl.canvas;
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.frame = { toClip, toEye, size: [width, height] };
  }

  /** @param {object} kept by keepMesh or keepLines @param {number[]} color rgb and alpha @param {number} width pixels */
  draw(kept, color, width = 1) {
    const { gl, frame } = this;
    const program = this.programs[kept.program];
    const place = (name) => gl.getUniformLocation(program, name);
    gl.useProgram(program);
    gl.uniformMatrix4fv(place("toClip"), false, frame.toClip);
    gl.uniform4fv(place("color"), color);
    if (kept.program === "mesh") gl.uniform3fv(place("toEye"), frame.toEye);
    else {
      gl.uniform2fv(place("size"), frame.size);
      gl.uniform1f(place("width"), width);
    }
    for (const [name, [buffer, amount]] of Object.entries(kept.parts)) {
      const at = gl.getAttribLocation(program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, amount, gl.FLOAT, false, 0, 0);
    }
    if (kept.around) {
      gl.enable(gl.CULL_FACE);
      gl.cullFace(gl.FRONT);
    }
    gl.depthMask(color[3] >= 1);
    gl.drawArrays(gl.TRIANGLES, 0, kept.count);
    gl.depthMask(true);
    gl.disable(gl.CULL_FACE);
  }

  /** What is drawn inside is seen through everything. @param {() => void} draw */
  through(draw) {
    this.gl.disable(this.gl.DEPTH_TEST);
    draw();
    this.gl.enable(this.gl.DEPTH_TEST);
  }
}
