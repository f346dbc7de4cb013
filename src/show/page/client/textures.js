// Images on the graphics card.

/** Longest side of a texture: what the card takes, less on phones, whose memory is short; `?texture=512` asks for less. */
function textureLimit(gl) {
  const asked = Number(new URLSearchParams(location.search).get('texture')) || Infinity;
  const small = matchMedia('(pointer: coarse)').matches || navigator.deviceMemory <= 2 ? 2048 : Infinity;
  return clamp(Math.min(gl.getParameter(gl.MAX_TEXTURE_SIZE), asked, small), 64, 8192);
}

/** Uploads an image, made small enough. `kind`: a colour in sRGB, four plain channels, three, or one. */
async function texture(gl, image, kind, mipmaps) {
  const [internal, format] = {
    colour: [gl.SRGB8_ALPHA8, gl.RGBA],
    four: [gl.RGBA8, gl.RGBA],
    three: [gl.RGB8, gl.RGB],
    one: [gl.R8, gl.RED],
  }[kind];
  let source = image;
  const limit = textureLimit(gl);
  const longest = Math.max(image.naturalWidth, image.naturalHeight);
  if (longest > limit) {
    const size = (side) => Math.max(1, Math.round(side * limit / longest));
    source = await createImageBitmap(image, {
      resizeWidth: size(image.naturalWidth), resizeHeight: size(image.naturalHeight), resizeQuality: 'high',
      premultiplyAlpha: 'none', colorSpaceConversion: 'none',
    });
  }
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  // Masks are numbers, not colours: neither profiles nor opacity may change them.
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
  gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
  gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texImage2D(gl.TEXTURE_2D, 0, internal, format, gl.UNSIGNED_BYTE, source);
  filtered(gl, mipmaps);
  return made;
}

/** Sets how the bound texture is read. */
function filtered(gl, mipmaps) {
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, mipmaps ? gl.LINEAR_MIPMAP_LINEAR : gl.LINEAR);
  if (!mipmaps) return;
  gl.generateMipmap(gl.TEXTURE_2D);
  const anisotropic = gl.getExtension('EXT_texture_filter_anisotropic');
  if (anisotropic) {
    const most = gl.getParameter(anisotropic.MAX_TEXTURE_MAX_ANISOTROPY_EXT);
    gl.texParameterf(gl.TEXTURE_2D, anisotropic.TEXTURE_MAX_ANISOTROPY_EXT, Math.min(16, most));
  }
}

/** A texture of one texel. */
function plainTexture(gl, values) {
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(values));
  filtered(gl, false);
  return made;
}

/** The ceiling from below: where lamps are, for what mirrors them. Blurred by its mipmaps. */
function lampTexture(gl) {
  const { origin, cell, width, height } = data.field;
  const limit = Math.min(2048, gl.getParameter(gl.MAX_TEXTURE_SIZE));
  const perMetre = Math.min(10, limit / (cell * Math.max(width, height)));
  const sheet = document.createElement('canvas');
  sheet.width = Math.max(1, Math.ceil(width * cell * perMetre));
  sheet.height = Math.max(1, Math.ceil(height * cell * perMetre));
  const pen = sheet.getContext('2d');
  pen.fillStyle = '#000';
  pen.fillRect(0, 0, sheet.width, sheet.height);
  pen.fillStyle = '#fff';
  for (const [[x0, y0], [x1, y1]] of data.lamps) {
    pen.fillRect((x0 - origin[0]) * perMetre, (y0 - origin[1]) * perMetre, (x1 - x0) * perMetre, (y1 - y0) * perMetre);
  }
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, sheet);
  filtered(gl, true);
  return { texture: made, place: [origin[0], origin[1], perMetre / sheet.width, perMetre / sheet.height] };
}

