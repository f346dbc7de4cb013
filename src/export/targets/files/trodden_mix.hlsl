// Body of a Custom node (output type float4) that lays masks of dirt over a floor: colour in rgb, roughness in a.
// Unreal Engine 5. Inputs: Masks (what trodden_dirt.hlsl gives), Amount (how much of each kind: 1, 1, 1 is what was
// baked), FloorColour, FloorRoughness.
const float3 dry = float3(0.174647, 0.147027, 0.111932);
const float3 prints = float3(0.098900, 0.084601, 0.066576);
const float dirtRoughness = 0.55;
float3 density = -log(max(1.0 - Masks, 0.002)) * Amount;
float total = density.r + density.g + density.b;
float through = exp(-total);
float3 dirt = (dry * (density.r + density.b) + prints * density.g) / max(total, 1e-6);
return float4(lerp(dirt, FloorColour, through), lerp(dirtRoughness, FloorRoughness, through));
