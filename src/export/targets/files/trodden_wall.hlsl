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
SamplerState clamped = GetMaterialSharedSampler(MaskSampler, View.MaterialTextureBilinearClampedSampler);
float4 masks = float4(Texture2DSample(Mask, clamped, UV).rgb, Texture2DSample(Splash, clamped, UV).r);
float4 density = -log(max(1.0 - masks, 0.002)) * Amount;
float total = density.r + density.g + density.b + density.a;
float through = exp(-total);
float3 dirt = skin * density.r + cloth * density.g + rubber * density.b + soilColour * density.a;
dirt /= max(total, 1e-6);
return float4(lerp(dirt, WallColour, through), lerp(dirtRoughness, WallRoughness, through));
