// Body of a Custom node (output type float4) that lays the dirt of one tile of a bake over a floor, in world space.
// Unreal Engine 5. trodden_unreal.py makes such nodes; to make one by hand, give it the inputs
//   World      Absolute World Position, cm
//   Mask       Texture Object of the tile's mask, sampler type Masks
//   Wear       Texture Object of the tile's wear, sampler type Masks
//   Place      origin x, y and size x, y of the tile's `world` in manifest.json, cm
// The output is the tile's masks, nothing beyond the tile: R film, G prints, B edge and dust, A heel marks, each
// 1 - exp(-density). Masks of several tiles add up.
float2 uv = (World.xy - Place.xy) / Place.zw;
float2 inside = step(0.0, uv) * step(uv, 1.0);
// One sampler for the textures of all tiles: a material has 16.
SamplerState clamped = GetMaterialSharedSampler(MaskSampler, View.MaterialTextureBilinearClampedSampler);
float4 masks = float4(Texture2DSample(Mask, clamped, uv).rgb, Texture2DSample(Wear, clamped, uv).g);
return masks * (inside.x * inside.y);
