// Body of a Custom node (output type float4) that lays masks of dirt over a floor: colour in rgb, roughness in a.
// Unreal Engine 5. Inputs: Masks (what trodden_dirt.hlsl gives), Amount (how much of film, prints, edge and heel marks:
// 1, 1, 1, 1 is what was baked), FloorColour, FloorRoughness.
const float3 soilColour = float3(0.127438, 0.099899, 0.061246);
const float3 rubber = float3(0.019382, 0.020289, 0.024158);
const float dirtRoughness = 0.55;
float4 density = -log(max(1.0 - Masks, 0.002)) * Amount;
float soil = density.r + density.g + density.b;
float total = soil + density.a;
float through = exp(-total);
float3 dirt = (soilColour * soil + rubber * density.a) / max(total, 1e-6);
return float4(lerp(dirt, FloorColour, through), lerp(dirtRoughness, FloorRoughness, through));
