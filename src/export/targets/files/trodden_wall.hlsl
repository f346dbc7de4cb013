// Body of a Custom node (output type float4) that lays the dirt of one sheet of a bake over a wall of scene.glb: colour in
// rgb, roughness in a. Unreal Engine 5. trodden_unreal.py makes such a node; to make one by hand, give it the inputs
//   UV         TexCoord[0]
//   Mask       Texture Object of the sheet's mask, sampler type Masks: R skin, G rub, B scuffs, each 1 - exp(-density)
//   Splash     Texture Object of the sheet's splash, sampler type Linear Grayscale
//   Amount     how much of skin, rub, scuffs and splashes: 1, 1, 1, 1 is what was baked
//   WallColour, WallRoughness
const float3 skin = float3(0.191202, 0.135633, 0.068478);
const float3 cloth = float3(0.162029, 0.144128, 0.124772);
const float3 rubber = float3(0.019382, 0.020289, 0.024158);
const float3 soilColour = float3(0.080220, 0.059511, 0.034340);
const float dirtRoughness = 0.55;
// Each kind of dirt absorbs red, green and blue by its own: 1 in the mean that eyes see.
const float3 seen = float3(0.2126, 0.7152, 0.0722);
const float3 dust = float3(0.304987, 0.270498, 0.215861);
SamplerState clamped = GetMaterialSharedSampler(MaskSampler, View.MaterialTextureBilinearClampedSampler);
float4 masks = float4(Texture2DSample(Mask, clamped, UV).rgb, Texture2DSample(Splash, clamped, UV).r);
float4 density = -log(max(1.0 - masks, 0.002)) * Amount;
const float3 colours[4] = { skin, cloth, rubber, soilColour };
float3 each = 0.0;
float3 light = 0.0;
for (int n = 0; n < 4; n++)
{
    float3 absorbed = log(colours[n]) / dot(log(colours[n]), seen) * density[n];
    each += absorbed;
    light += absorbed * colours[n];
}
// Over a wall darker than itself dirt covers all colours alike, and is lighter and greyer.
float bright = dot(light, seen);
float dark = saturate(3.0 * (0.8 * bright - dot(WallColour, seen) * dot(each, seen)) / max(bright, 1e-6));
float through = exp(-dot(each, seen));
float3 dirt = lerp(light / max(each, 1e-6), dust, 0.3 * dark);
return float4(lerp(dirt, WallColour, exp(-lerp(each, dot(each, seen), dark))), lerp(dirtRoughness, WallRoughness, through));
