// Lays the dirt of a bake over your own floor, in world space, and over your own walls. GLSL ES 3.00: WebGL 2, three.js, and anything that
// reads scene.glb as it is (metres, +Y up, right-handed).
//
// For each tile, manifest.json has, under floor.tiles[n].world, `origin` and `size`: texture coordinates are
// (world.xz - origin) / size, (0, 0) at the upper left of the image. Load the tile's `mask` and `wear` without colour
// conversion (three.js: texture.colorSpace = NoColorSpace, flipY = false; WebGL: UNPACK_COLORSPACE_CONVERSION_WEBGL
// none), at its full size, with mip-maps, clamped to its edges. Likewise `mask` and `splash` of walls.sheets[n] for the
// mesh walls_n of scene.glb, whose texture coordinates go with them.

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

// The masks of a wall: skin, rub of clothes and bags, scuffs of shoes, splashes and dust. `uv` is the mesh's own.
vec4 troddenWallMasks(sampler2D mask, sampler2D splash, vec2 uv) {
    return vec4(texture(mask, uv).rgb, texture(splash, uv).r);
}

// Colour and roughness (in a) under dirt of four colours. Masks hold 1 - exp(-density).
vec4 troddenMix(vec4 masks, vec4 amount, mat4x3 colours, vec3 clean, float roughness) {
    const float DIRT_ROUGHNESS = 0.55;
    vec4 density = -log(max(vec4(1.0) - masks, vec4(0.002))) * amount;
    float total = density.r + density.g + density.b + density.a;
    float through = exp(-total);
    vec3 dirt = colours * density / max(total, 1e-6);
    return vec4(mix(dirt, clean, through), mix(DIRT_ROUGHNESS, roughness, through));
}

// Colour and roughness (in a) of a floor under dirt, all linear. `amount` scales each kind: vec4(1) is what was
// baked.
vec4 troddenDirt(vec4 masks, vec4 amount, vec3 floorColour, float floorRoughness) {
    const vec3 SOIL = vec3(0.127438, 0.099899, 0.061246);
    const vec3 RUBBER = vec3(0.019382, 0.020289, 0.024158);
    return troddenMix(masks, amount, mat4x3(SOIL, SOIL, SOIL, RUBBER), floorColour, floorRoughness);
}

// The same for a wall and its masks.
vec4 troddenWallDirt(vec4 masks, vec4 amount, vec3 wallColour, float wallRoughness) {
    const vec3 SKIN = vec3(0.191202, 0.135633, 0.068478);
    const vec3 CLOTH = vec3(0.162029, 0.144128, 0.124772);
    const vec3 RUBBER = vec3(0.019382, 0.020289, 0.024158);
    const vec3 SPLASH = vec3(0.080220, 0.059511, 0.034340);
    return troddenMix(masks, amount, mat4x3(SKIN, CLOTH, RUBBER, SPLASH), wallColour, wallRoughness);
}
