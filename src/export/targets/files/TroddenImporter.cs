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
        @"^(Floor|Wall)_(BaseMap|DirtMask|Passes|Splash|Rub|Wear|Normal|ORM|MaskMap|Layers\d+)_(\d{4}|u\d{3}_v\d{3})\.(png|exr)$");

    private void OnPreprocessTexture()
    {
        Match match = Texture.Match(Path.GetFileName(assetPath));
        if (!match.Success || FolderOfBake(assetPath) == null)
        {
            return;
        }
        var importer = (TextureImporter)assetImporter;
        bool isNormal = match.Groups[2].Value == "Normal";
        importer.textureType = isNormal ? TextureImporterType.NormalMap : TextureImporterType.Default;
        // Only base colour is a colour; all others are numbers.
        importer.sRGBTexture = match.Groups[2].Value == "BaseMap";
        importer.alphaIsTransparency = false;
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
    private class Manifest
    {
        public Floor floor;
    }

    // Copies the selected material, whose shader has _Mask, _Wear, _Origin and _Size for the Custom Function of
    // TroddenDirt.hlsl, once for each tile of the bake whose manifest.json is chosen.
    [MenuItem("Assets/Trodden/Floor materials from manifest")]
    private static void MakeMaterials()
    {
        var material = Selection.activeObject as Material;
        string path = EditorUtility.OpenFilePanel("The bake's manifest.json", "Assets", "json");
        if (material == null || string.IsNullOrEmpty(path))
        {
            Debug.LogError("Select your floor's material first, then choose the manifest.json of a bake in Assets.");
            return;
        }
        string bake = FileUtil.GetProjectRelativePath(Path.GetDirectoryName(path).Replace('\\', '/'));
        var manifest = JsonUtility.FromJson<Manifest>(File.ReadAllText(path));
        foreach (Tile tile in manifest.floor.tiles)
        {
            var copy = new Material(material);
            copy.SetTexture("_Mask", AssetDatabase.LoadAssetAtPath<Texture2D>(bake + "/" + tile.mask));
            copy.SetTexture("_Wear", AssetDatabase.LoadAssetAtPath<Texture2D>(bake + "/" + tile.wear));
            copy.SetVector("_Origin", new Vector4(tile.world.origin[0], tile.world.origin[1], 0f, 0f));
            copy.SetVector("_Size", new Vector4(tile.world.size[0], tile.world.size[1], 0f, 0f));
            string name = string.Format("{0}/{1}_u{2}_v{3}.mat", bake, material.name, tile.u, tile.v);
            AssetDatabase.CreateAsset(copy, AssetDatabase.GenerateUniqueAssetPath(name));
        }
        AssetDatabase.SaveAssets();
    }
}
