// Lays the dirt of one tile of a bake over your own floor, in world space, and that of a sheet over your own wall.
// Unity 2021.3 or later, URP and HDRP.
//
// Shader Graph: add a Custom Function node of type File with this file and the name TroddenDirt, give it the inputs
// and outputs of the function below, in their order, and put it between your floor and the Base Color and Smoothness
// of the fragment. `World` is a Position node in space Absolute World, `Mask` and `Wear` are Textures 2D of the graph;
// `Origin` and `Size` are the tile's `world` in manifest.json. For walls of scene.glb the function is TroddenWallDirt,
// with `UV` from a UV node (UV0), `Mask` and `Splash`. TroddenImporter.cs, in an Editor folder, sets the textures' flags,
// and fills in materials from the menu Assets > Trodden.
#ifndef TRODDEN_DIRT_INCLUDED
#define TRODDEN_DIRT_INCLUDED

// Colour and smoothness under dirt of four linear colours. Masks hold 1 - exp(-density). Each kind of dirt absorbs red,
// green and blue by its own, 1 in the mean that eyes see; over a surface darker than itself it covers all colours alike,
// and is lighter and greyer.
void TroddenMix(
    float4 Masks, float4 Amount, float4x3 Colours, float3 Clean, float CleanSmoothness,
    out float3 Colour, out float Smoothness)
{
    const float dirtSmoothness = 0.45;
    const float3 seen = float3(0.2126, 0.7152, 0.0722);
    const float3 dust = float3(0.304987, 0.270498, 0.215861);
    float4 density = -log(max(1.0 - Masks, 0.002)) * Amount;
    float3 each = 0.0;
    float3 light = 0.0;
    for (int n = 0; n < 4; n++)
    {
        float3 absorbed = log(Colours[n]) / dot(log(Colours[n]), seen) * density[n];
        each += absorbed;
        light += absorbed * Colours[n];
    }
    float bright = dot(light, seen);
    float dark = saturate(3.0 * (0.8 * bright - dot(Clean, seen) * dot(each, seen)) / max(bright, 1e-6));
    float3 dirt = lerp(light / max(each, 1e-6), dust, 0.3 * dark);
    Colour = lerp(dirt, Clean, exp(-lerp(each, dot(each, seen), dark)));
    Smoothness = lerp(dirtSmoothness, CleanSmoothness, exp(-dot(each, seen)));
}

// `Amount` scales each kind of dirt: (1, 1, 1, 1) is what was baked: film, prints, edge and dust, and, as the green of
// `Wear`, heel marks.
void TroddenDirt_float(
    float3 World, UnityTexture2D Mask, UnityTexture2D Wear, float2 Origin, float2 Size, float4 Amount,
    float3 FloorColour, float FloorSmoothness, out float3 Colour, out float Smoothness)
{
    const float3 soilColour = float3(0.127438, 0.099899, 0.061246);
    const float3 rubber = float3(0.019382, 0.020289, 0.024158);
    float2 uv = (World.xz - Origin) / Size;
    float2 inside = step(0.0, uv) * step(uv, 1.0);
    float3 masks = SAMPLE_TEXTURE2D(Mask.tex, Mask.samplerstate, uv).rgb;
    float marks = SAMPLE_TEXTURE2D(Wear.tex, Wear.samplerstate, uv).g;
    float4x3 colours = float4x3(soilColour, soilColour, soilColour, rubber);
    TroddenMix(
        float4(masks, marks) * (inside.x * inside.y), Amount, colours, FloorColour, FloorSmoothness, Colour, Smoothness);
}

// The same for a wall: skin, rub of clothes and bags, scuffs of shoes, and, as `Splash`, splashes and dust.
void TroddenWallDirt_float(
    float2 UV, UnityTexture2D Mask, UnityTexture2D Splash, float4 Amount, float3 WallColour, float WallSmoothness,
    out float3 Colour, out float Smoothness)
{
    const float3 skin = float3(0.191202, 0.135633, 0.068478);
    const float3 cloth = float3(0.162029, 0.144128, 0.124772);
    const float3 rubber = float3(0.019382, 0.020289, 0.024158);
    const float3 splashes = float3(0.080220, 0.059511, 0.034340);
    float3 masks = SAMPLE_TEXTURE2D(Mask.tex, Mask.samplerstate, UV).rgb;
    float splash = SAMPLE_TEXTURE2D(Splash.tex, Splash.samplerstate, UV).r;
    float4x3 colours = float4x3(skin, cloth, rubber, splashes);
    TroddenMix(float4(masks, splash), Amount, colours, WallColour, WallSmoothness, Colour, Smoothness);
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

void TroddenWallDirt_half(
    half2 UV, UnityTexture2D Mask, UnityTexture2D Splash, half4 Amount, half3 WallColour, half WallSmoothness,
    out half3 Colour, out half Smoothness)
{
    float3 colour;
    float smoothness;
    TroddenWallDirt_float(UV, Mask, Splash, Amount, WallColour, WallSmoothness, colour, smoothness);
    Colour = half3(colour);
    Smoothness = half(smoothness);
}

#endif
