// Draws the scene: a call per part.

const STRIDE = 20;

const geometry = { vertices: bytesOf('vertices'), indices: bytesOf('indices') };

function program(gl, vertex, fragment, defines) {
  const made = gl.createProgram();
  for (const [type, id] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    const text = element(id).textContent.trim().replace('#version 300 es', `#version 300 es\n${defines.map((d) => `#define ${d}\n`).join('')}`);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
      throw new Error(`${id} (${defines}): ${gl.getShaderInfoLog(shader)}`);
    }
    gl.attachShader(made, shader);
  }
  ['a_place', 'a_uv', 'a_normal'].forEach((name, n) => gl.bindAttribLocation(made, n, name));
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(`${vertex}, ${fragment}: ${gl.getProgramInfoLog(made)}`);
  }
  const uniforms = {};
  const count = gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS);
  for (let n = 0; n < count; n++) {
    const name = gl.getActiveUniform(made, n).name;
    uniforms[name.replace('[0]', '')] = gl.getUniformLocation(made, name);
  }
  return { made, uniforms };
}

/** Everything on the graphics card. */
class Drawing {
  static async on(gl) {
    const drawing = new Drawing();
    drawing.gl = gl;
    drawing.programs = Object.fromEntries(['FLOOR', 'WALL', 'TOP', 'LINTEL', 'CEILING', 'FITTING', 'PANE']
      .map((kind) => [kind, program(gl, 'surface-vertex', 'surface-fragment', [`IS_${kind}`])]));
    drawing.plain = program(gl, 'plain-vertex', 'plain-fragment', []);
    drawing.array = drawing.upload();
    drawing.bright = drawing.uploadBright();
    drawing.field = await texture(gl, await imageOf('field', 'image/png'), 'three', false);
    drawing.light = {};
    for (const name of data.roofed ? ['inside', 'above'] : ['above']) {
      drawing.light[name] = {
        floor: await texture(gl, await imageOf(`light-${name}`, 'image/png'), 'three', false),
        walls: await texture(gl, await imageOf(`light-walls-${name}`, 'image/png'), 'four', false),
      };
    }
    drawing.lamps = lampTexture(gl);
    drawing.none = { dirt: plainTexture(gl, [0, 0, 0, 0]) };
    drawing.images = [];
    for (const [n, part] of data.parts.entries()) {
      if (!part.image) continue;
      const { id } = part.image;
      drawing.images[n] = {
        dirt: await texture(gl, await imageOf(`dirt-${id}`, 'image/png'), 'four', true),
        clean: await texture(gl, await imageOf(`clean-${id}`, 'image/jpeg'), 'colour', true),
        rough: await texture(gl, await imageOf(`rough-${id}`, 'image/jpeg'), 'one', true),
      };
    }
    return drawing;
  }

  upload() {
    const { gl } = this;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    this.buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, geometry.vertices, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, geometry.indices, gl.STATIC_DRAW);
    [0, 1, 2].forEach((n) => gl.enableVertexAttribArray(n));
    this.pointers(0);
    return array;
  }

  /** Parts count their vertices from 0; WebGL has no base vertex, so the pointers move. */
  pointers(first) {
    const { gl } = this;
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, STRIDE, first * STRIDE);
    gl.vertexAttribPointer(1, 2, gl.UNSIGNED_SHORT, true, STRIDE, first * STRIDE + 12);
    gl.vertexAttribPointer(2, 3, gl.BYTE, true, STRIDE, first * STRIDE + 16);
  }

  /** Lamps under the ceiling, and the light that stands in the openings. */
  uploadBright() {
    const { gl } = this;
    const places = [];
    const quad = (a, b, c, d) => places.push(...a, ...b, ...c, ...a, ...c, ...d);
    const high = data.height - 0.004;
    for (const [[x0, y0], [x1, y1]] of data.lamps) quad([x0, y0, high], [x1, y0, high], [x1, y1, high], [x0, y1, high]);
    const lamps = places.length / 3;
    for (const { a, b, open } of plan.edges) {
      if (open) quad([...a, 0], [...b, 0], [...b, data.height], [...a, data.height]);
    }
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(places), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    return { array, lamps, all: places.length / 3 };
  }

  /** Draws what `seen` sees. `shown`: amounts by kind of floor and wall, whether inside, whether lit. */
  draw(seen, shown) {
    const { gl } = this;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(...(shown.lit ? data.around[shown.inside ? 0 : 1] : [0, 0, 0]), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.CULL_FACE);
    gl.frontFace(gl.CCW);
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    data.parts.forEach((part, n) => {
      const kind = part.surface.toUpperCase();
      this.part(n, part, kind, seen, shown);
    });
    if (shown.inside && shown.lit) {
      // The ceiling is the floor seen from below.
      gl.frontFace(gl.CW);
      data.parts.forEach((part, n) => part.surface === 'floor' && this.part(n, part, 'CEILING', seen, shown));
      gl.disable(gl.CULL_FACE);
      this.drawBright(seen);
    }
  }

  part(n, part, kind, seen, shown) {
    const { gl } = this;
    const { made, uniforms } = this.programs[kind];
    gl.useProgram(made);
    const surface = kind === 'FLOOR' || kind === 'CEILING' ? data.surfaces.floor : data.surfaces.wall;
    const images = this.images[n] || {};
    const light = this.light[shown.inside ? 'inside' : 'above'];
    const textures = {
      u_dirt: images.dirt || this.none.dirt, u_clean: images.clean || this.none.dirt, u_rough: images.rough || this.none.dirt,
      u_field: this.field, u_light: light.floor, u_light_walls: light.walls, u_lamps: this.lamps.texture,
    };
    Object.entries(textures).forEach(([name, bound], unit) => {
      if (!uniforms[name]) return;
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, bound);
      gl.uniform1i(uniforms[name], unit);
    });
    const set = (name, how, ...values) => uniforms[name] && gl[how](uniforms[name], ...values);
    const colours = surface.kinds.flatMap((dirt) => dirt.colour);
    const absorbs = surface.kinds.flatMap((dirt) => dirt.absorbs);
    const amounts = kind === 'FLOOR' ? shown.floor : shown.wall;
    set('u_matrix', 'uniformMatrix4fv', false, seen.matrix);
    set('u_eye', 'uniform3fv', seen.eye);
    set('u_height', 'uniform1f', data.height);
    set('u_amounts', 'uniform4fv', [...amounts, 0, 0, 0, 0].slice(0, 4));
    set('u_colours', 'uniform3fv', [...colours, ...Array(12).fill(0)].slice(0, 12));
    set('u_absorbs', 'uniform3fv', [...absorbs, ...Array(12).fill(1)].slice(0, 12));
    set('u_clean_colour', 'uniform3fv', part.colour || surface.clean);
    set('u_clean_roughness', 'uniform1f', part.colour ? part.roughness : surface.roughness);
    set('u_textured', 'uniform1i', images.dirt ? 1 : 0);
    set('u_lit', 'uniform1i', shown.lit ? 1 : 0);
    set('u_inside', 'uniform1i', shown.inside ? 1 : 0);
    set('u_field_place', 'uniform4fv', placeOf(data.field));
    set('u_field_range', 'uniform2fv', data.field.range);
    set('u_light_place', 'uniform4fv', placeOf(data.light));
    set('u_light_most', 'uniform1f', data.light.most);
    set('u_light_heights', 'uniform4fv', data.light.heights);
    set('u_lamps_place', 'uniform4fv', this.lamps.place);
    this.pointers(part.vertices[0]);
    gl.drawElements(gl.TRIANGLES, part.indices[1], gl.UNSIGNED_INT, part.indices[0] * 4);
  }

  drawBright(seen) {
    const { gl, plain } = this;
    gl.useProgram(plain.made);
    gl.uniformMatrix4fv(plain.uniforms.u_matrix, false, seen.matrix);
    gl.bindVertexArray(this.bright.array);
    gl.uniform1f(plain.uniforms.u_height, data.height);
    gl.uniform1i(plain.uniforms.u_lamp, 1);
    gl.drawArrays(gl.TRIANGLES, 0, this.bright.lamps);
    gl.uniform1i(plain.uniforms.u_lamp, 0);
    gl.drawArrays(gl.TRIANGLES, this.bright.lamps, this.bright.all - this.bright.lamps);
  }
}

/** Origin and scale of a raster's texture. */
function placeOf({ origin, cell, width, height }) {
  return [origin[0], origin[1], 1 / (cell * width), 1 / (cell * height)];
}

