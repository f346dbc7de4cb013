// Lays the dirt of a bake over your own floor, in world space. GLSL ES 3.00: WebGL 2, three.js, and anything that
// reads scene.glb as it is (metres, +Y up, right-handed).
//
// For each tile, manifest.json has, under floor.tiles[n].world, `origin` and `size`: texture coordinates are
// (world.xz - origin) / size, (0, 0) at the upper left of the image. Load the tile's `mask` and `wear` without colour conversion
// (three.js: texture.colorSpace = NoColorSpace, flipY = false; WebGL: UNPACK_COLORSPACE_CONVERSION_WEBGL
// none), at its full size, with mip-maps, clamped to its edges.

// Texture coordinates of a place of the world.
vec2 troddenUv(vec3 world, vec2 origin, vec2 size) {
    return (world.xz - origin) / size;
}

// The masks there, nothing beyond the tile: film, prints, edge and dust, heel marks. `wear` is the tile's `wear`.
vec4 troddenMasks(sampler2D tile, sampler2D wear, vec2 uv) {
    vec4 masks = vec4(texture(tile, uv).rgb, texture(wear, uv).g);
    vec2 inside = step(vec2(0.0), uv) * step(uv, vec2(1.0));
    return masks * inside.x * inside.y;
}

// Colour and roughness (in a) of a floor under dirt, all linear. `amount` scales each kind: vec4(1) is what was
// baked. Masks hold 1 - exp(-density).
vec4 troddenDirt(vec4 masks, vec4 amount, vec3 floorColour, float floorRoughness) {
    const vec3 SOIL = vec3(0.127438, 0.099899, 0.061246);
    const vec3 RUBBER = vec3(0.019382, 0.020289, 0.024158);
    const float DIRT_ROUGHNESS = 0.55;
    vec4 density = -log(max(vec4(1.0) - masks, vec4(0.002))) * amount;
    float soil = density.r + density.g + density.b;
    float total = soil + density.a;
    float through = exp(-total);
    vec3 dirt = (SOIL * soil + RUBBER * density.a) / max(total, 1e-6);
    return vec4(mix(dirt, floorColour, through), mix(DIRT_ROUGHNESS, floorRoughness, through));
}
