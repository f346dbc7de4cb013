// Lays the dirt of a bake over your own floor, in world space. GLSL ES 3.00: WebGL 2, three.js, and anything that
// reads scene.glb as it is (metres, +Y up, right-handed).
//
// For each tile, manifest.json has, under floor.tiles[n].world, `origin` and `size`: texture coordinates are
// (world.xz - origin) / size, (0, 0) at the upper left of the image. Load the tile's `mask` without colour conversion
// (three.js: texture.colorSpace = NoColorSpace, flipY = false; WebGL: UNPACK_COLORSPACE_CONVERSION_WEBGL
// none), at its full size, with mip-maps, clamped to its edges.

// Texture coordinates of a place of the world.
vec2 troddenUv(vec3 world, vec2 origin, vec2 size) {
    return (world.xz - origin) / size;
}

// The masks there, nothing beyond the tile: R film, G prints and scuffs, B edge and dust.
vec3 troddenMasks(sampler2D tile, vec2 uv) {
    vec3 masks = texture(tile, uv).rgb;
    vec2 inside = step(vec2(0.0), uv) * step(uv, vec2(1.0));
    return masks * inside.x * inside.y;
}

// Colour and roughness (in a) of a floor under dirt, all linear. `amount` scales each kind: vec3(1) is what was
// baked. Masks hold 1 - exp(-density).
vec4 troddenDirt(vec3 masks, vec3 amount, vec3 floorColour, float floorRoughness) {
    const vec3 DRY = vec3(0.174647, 0.147027, 0.111932);
    const vec3 PRINTS = vec3(0.098900, 0.084601, 0.066576);
    const float DIRT_ROUGHNESS = 0.55;
    vec3 density = -log(max(vec3(1.0) - masks, vec3(0.002))) * amount;
    float total = density.r + density.g + density.b;
    float through = exp(-total);
    vec3 dirt = (DRY * (density.r + density.b) + PRINTS * density.g) / max(total, 1e-6);
    return vec4(mix(dirt, floorColour, through), mix(DIRT_ROUGHNESS, floorRoughness, through));
}
