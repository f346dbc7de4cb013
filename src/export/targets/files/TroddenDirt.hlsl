// Lays the dirt of one tile of a bake over your own floor, in world space. Unity 2021.3 or later, URP and HDRP.
//
// Shader Graph: add a Custom Function node of type File with this file and the name TroddenDirt, give it the inputs
// and outputs of the function below, in their order, and put it between your floor and the Base Color and Smoothness
// of the fragment. `World` is a Position node in space Absolute World, `Mask` and `Wear` are Textures 2D of the graph; `Origin` and
// `Size` are the tile's `world` in manifest.json. TroddenImporter.cs, in an Editor folder, sets the textures' flags,
// and fills in materials from the menu Assets > Trodden.
#ifndef TRODDEN_DIRT_INCLUDED
#define TRODDEN_DIRT_INCLUDED

// `Amount` scales each kind of dirt: (1, 1, 1, 1) is what was baked. Masks hold 1 - exp(-density): film, prints,
// edge and dust, and, as the green of `Wear`, heel marks. Colours are linear.
void TroddenDirt_float(
    float3 World, UnityTexture2D Mask, UnityTexture2D Wear, float2 Origin, float2 Size, float4 Amount,
    float3 FloorColour, float FloorSmoothness, out float3 Colour, out float Smoothness)
{
    const float3 soilColour = float3(0.127438, 0.099899, 0.061246);
    const float3 rubber = float3(0.019382, 0.020289, 0.024158);
    const float dirtSmoothness = 0.45;
    float2 uv = (World.xz - Origin) / Size;
    float2 inside = step(0.0, uv) * step(uv, 1.0);
    float3 masks = SAMPLE_TEXTURE2D(Mask.tex, Mask.samplerstate, uv).rgb;
    float marks = SAMPLE_TEXTURE2D(Wear.tex, Wear.samplerstate, uv).g;
    float4 density = -log(max(1.0 - float4(masks, marks) * (inside.x * inside.y), 0.002)) * Amount;
    float soil = density.r + density.g + density.b;
    float total = soil + density.a;
    float through = exp(-total);
    float3 dirt = (soilColour * soil + rubber * density.a) / max(total, 1e-6);
    Colour = lerp(dirt, FloorColour, through);
    Smoothness = lerp(dirtSmoothness, FloorSmoothness, through);
}

void TroddenDirt_half(
    half3 World, UnityTexture2D Mask, UnityTexture2D Wear, half2 Origin, half2 Size, half4 Amount,
    half3 FloorColour, half FloorSmoothness, out half3 Colour, out half Smoothness)
{
    float3 colour;
    float smoothness;
    TroddenDirt_float(World, Mask, Wear, Origin, Size, Amount, FloorColour, FloorSmoothness, colour, smoothness);
    Colour = half3(colour);
    Smoothness = half(smoothness);
}

#endif
