// Body of a Custom node (output type float4) that lays masks of dirt over a floor: colour in rgb, roughness in a.
// Unreal Engine 5. Inputs: Masks (what trodden_dirt.hlsl gives), Amount (how much of film, prints, edge and heel marks:
// 1, 1, 1, 1 is what was baked), FloorColour, FloorRoughness.
const float3 soilColour = float3(0.127438, 0.099899, 0.061246);
const float3 rubber = float3(0.019382, 0.020289, 0.024158);
const float dirtRoughness = 0.55;
// Each kind of dirt absorbs red, green and blue by its own: 1 in the mean that eyes see.
const float3 seen = float3(0.2126, 0.7152, 0.0722);
const float3 dust = float3(0.304987, 0.270498, 0.215861);
float4 density = -log(max(1.0 - Masks, 0.002)) * Amount;
float soil = density.r + density.g + density.b;
float3 soilEach = log(soilColour) / dot(log(soilColour), seen) * soil;
float3 rubberEach = log(rubber) / dot(log(rubber), seen) * density.a;
float3 each = soilEach + rubberEach;
float3 light = soilEach * soilColour + rubberEach * rubber;
// Over a floor darker than itself dirt covers all colours alike, and is lighter and greyer.
float bright = dot(light, seen);
float dark = saturate(3.0 * (0.8 * bright - dot(FloorColour, seen) * dot(each, seen)) / max(bright, 1e-6));
float through = exp(-dot(each, seen));
float3 dirt = lerp(light / max(each, 1e-6), dust, 0.3 * dark);
return float4(lerp(dirt, FloorColour, exp(-lerp(each, dot(each, seen), dark))), lerp(dirtRoughness, FloorRoughness, through));
