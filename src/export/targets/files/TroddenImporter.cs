// Sets the flags of a bake's textures when Unity imports them, and fills in floor materials from its manifest.
//
// Copy the whole bake into Assets. This file has to lie in a folder called Editor, as it does in the bake. One copy
// serves all bakes of a project: delete it from the others.
using System;
using System.IO;
using System.Text.RegularExpressions;
using UnityEditor;
using UnityEngine;

// Fields that only JsonUtility fills in.
#pragma warning disable 0649

public class TroddenImporter : AssetPostprocessor
{
    // Floor_BaseMap_1001.png, Wall_DirtMask_1002.png, Floor_Layers1_u012_v000.exr
    private static readonly Regex Texture = new Regex(
        @"^(Floor|Wall)_(BaseMap|DirtMask|Passes|Splash|Rub|Wear|Normal|ORM|Clean|Dirt|MaskMap|Layers\d+)_(\d{4}|u\d{3}_v\d{3})\.(png|exr)$");

    private void OnPreprocessTexture()
    {
        Match match = Texture.Match(Path.GetFileName(assetPath));
        if (!match.Success || FolderOfBake(assetPath) == null)
        {
            return;
        }
        var importer = (TextureImporter)assetImporter;
        string kind = match.Groups[2].Value;
        bool isNormal = kind == "Normal";
        importer.textureType = isNormal ? TextureImporterType.NormalMap : TextureImporterType.Default;
        // These are colours; all others are numbers.
        importer.sRGBTexture = kind == "BaseMap" || kind == "Clean" || kind == "Dirt";
        importer.alphaIsTransparency = kind == "Dirt";
        importer.maxTextureSize = 16384;
        importer.npotScale = TextureImporterNPOTScale.None;
        importer.mipmapEnabled = true;
        importer.streamingMipmaps = true;
        importer.wrapMode = TextureWrapMode.Clamp;
        importer.anisoLevel = 8;
        importer.textureCompression = TextureImporterCompression.CompressedHQ;
    }

    // The folder two above a texture, if it is a bake.
    private static string FolderOfBake(string asset)
    {
        string bake = Path.GetDirectoryName(Path.GetDirectoryName(asset));
        return bake != null && File.Exists(Path.Combine(bake, "manifest.json")) ? bake : null;
    }

    [Serializable]
    private class World
    {
        public float[] origin;
        public float[] size;
    }

    [Serializable]
    private class Tile
    {
        public int u;
        public int v;
        public string mask;
        public string wear;
        public World world;
    }

    [Serializable]
    private class Floor
    {
        public Tile[] tiles;
    }

    [Serializable]
    private class Sheet
    {
        public string mask;
        public string splash;
    }

    [Serializable]
    private class Walls
    {
        public Sheet[] sheets;
    }

    [Serializable]
    private class Manifest
    {
        public Floor floor;
        public Walls walls;
    }

    // Copies the selected material, whose shader has _Mask, _Wear, _Origin and _Size for the Custom Function of
    // TroddenDirt.hlsl, once for each tile of the bake whose manifest.json is chosen.
    [MenuItem("Assets/Trodden/Floor materials from manifest")]
    private static void MakeFloorMaterials()
    {
        MakeMaterials((manifest, bake, material) =>
        {
            foreach (Tile tile in manifest.floor.tiles)
            {
                Material copy = Copy(material, bake, string.Format("u{0}_v{1}", tile.u, tile.v));
                SetTexture(copy, "_Mask", bake, tile.mask);
                SetTexture(copy, "_Wear", bake, tile.wear);
                copy.SetVector("_Origin", new Vector4(tile.world.origin[0], tile.world.origin[1], 0f, 0f));
                copy.SetVector("_Size", new Vector4(tile.world.size[0], tile.world.size[1], 0f, 0f));
            }
        });
    }

    // Likewise with _Mask and _Splash, once for each sheet: material N is for the mesh walls_N.
    [MenuItem("Assets/Trodden/Wall materials from manifest")]
    private static void MakeWallMaterials()
    {
        MakeMaterials((manifest, bake, material) =>
        {
            Sheet[] sheets = manifest.walls == null || manifest.walls.sheets == null ? new Sheet[0] : manifest.walls.sheets;
            for (int n = 0; n < sheets.Length; n++)
            {
                Material copy = Copy(material, bake, "walls_" + n);
                SetTexture(copy, "_Mask", bake, sheets[n].mask);
                SetTexture(copy, "_Splash", bake, sheets[n].splash);
            }
        });
    }

    private static void MakeMaterials(Action<Manifest, string, Material> make)
    {
        var material = Selection.activeObject as Material;
        string path = EditorUtility.OpenFilePanel("The bake's manifest.json", "Assets", "json");
        if (material == null || string.IsNullOrEmpty(path))
        {
            Debug.LogError("Select your own material first, then choose the manifest.json of a bake in Assets.");
            return;
        }
        string bake = FileUtil.GetProjectRelativePath(Path.GetDirectoryName(path).Replace('\\', '/'));
        make(JsonUtility.FromJson<Manifest>(File.ReadAllText(path)), bake, material);
        AssetDatabase.SaveAssets();
    }

    private static Material Copy(Material material, string bake, string name)
    {
        var copy = new Material(material);
        string path = string.Format("{0}/{1}_{2}.mat", bake, material.name, name);
        AssetDatabase.CreateAsset(copy, AssetDatabase.GenerateUniqueAssetPath(path));
        return copy;
    }

    private static void SetTexture(Material material, string name, string bake, string file)
    {
        material.SetTexture(name, AssetDatabase.LoadAssetAtPath<Texture2D>(bake + "/" + file));
    }
}
