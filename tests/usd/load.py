"""Opens scene.usda of bakes with OpenUSD and holds it against scene.glb.

    load.py BAKE...

Exits with 1 and says what differs.
"""

import json
import pathlib
import re
import sys

import numpy as np
import trimesh
from PIL import Image
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade, UsdValidation


class Check:
    def __init__(self):
        self.failures = 0

    def right(self, what, right):
        self.failures += not right
        print(f"{'ok ' if right else 'BAD'}  {what}")


def complaints(stage):
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    return [f"{error.GetName()}: {error.GetMessage()}" for error in context.Validate(stage)]


def meshes_of_glb(file):
    """Mesh by name, in the plan's frame: x, y, height."""
    scene, found = trimesh.load_scene(file, process=False), {}
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        if name.startswith("UCX_"):  # Unreal's collision hulls.
            continue
        mesh = scene.geometry[name].copy().apply_transform(transform)
        x, height, minus_y = mesh.vertices.T
        mesh.vertices = np.column_stack([x, -minus_y, height])
        found[node] = mesh
    return found


def corners(points, indices):
    """The corners of all triangles, in an order that does not depend on the file's."""
    flat = np.round(np.asarray(points, dtype=float)[np.asarray(indices)].reshape(-1, 3, 3), 4).reshape(-1, 9)
    return flat[np.lexsort(flat.T)]


def input_of(shader, name):
    """The source of a connected input: shader and output; or its value."""
    connected = shader.GetInput(name)
    if connected and connected.HasConnectedSource():
        source, output, _ = connected.GetConnectedSource()
        return UsdShade.Shader(source.GetPrim()), output
    return connected.Get() if connected else None


def check_texture(check, bake, name, shader, colour_space):
    asset = shader.GetInput("file").Get()
    there = pathlib.Path(asset.resolvedPath)
    right = there.is_file() and there.is_relative_to(bake) and not pathlib.Path(asset.path).is_absolute()
    right &= shader.GetInput("sourceColorSpace").Get() == colour_space
    reader, output = input_of(shader, "st")
    right &= output == "result" and reader.GetIdAttr().Get() == "UsdPrimvarReader_float2"
    check.right(f"{name}: {asset.path} is there, as {colour_space}", right and reader.GetInput("varname").Get() == "st")
    return Image.open(there)


def check_material(check, bake, mesh, target):
    name = mesh.GetPrim().GetName()
    material, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    surface = material.ComputeSurfaceSource()[0] if material else None
    if not surface or surface.GetIdAttr().Get() != "UsdPreviewSurface":
        check.right(f"{name} has a UsdPreviewSurface", False)
        return
    colour = input_of(surface, "diffuseColor")
    if not isinstance(colour, tuple):
        check.right(f"{name} is plain, {colour}", all(0.0 <= c <= 1.0 for c in colour))
        return
    check_texture(check, bake, name, colour[0], "sRGB")
    channels = {key: input_of(surface, key) for key in ("occlusion", "roughness", "metallic")}
    check.right(f"{name}: red is occlusion, green roughness, blue metallic",
                [output for _, output in channels.values()] == ["r", "g", "b"])
    check_texture(check, bake, name, channels["roughness"][0], "raw")
    connected = input_of(surface, "normal")
    # Unreal's images have normals whose green points down.
    check.right(f"{name}: normals for all but Unreal", (connected is None) == (target == "unreal"))
    if connected:
        shader, _ = connected
        image = np.asarray(check_texture(check, bake, name, shader, "raw"), dtype=float) / 255.0
        scale, bias = (np.array(shader.GetInput(key).Get())[:3] for key in ("scale", "bias"))
        mean = image.reshape(-1, 3).mean(axis=0) * scale + bias
        check.right(f"{name}: normals are upright on the whole, {np.round(mean, 3)}", mean[2] > 0.9)


def check_mesh(check, mesh, wanted):
    name = mesh.GetPrim().GetName()
    points, indices = np.array(mesh.GetPointsAttr().Get()), np.array(mesh.GetFaceVertexIndicesAttr().Get())
    same = len(wanted.faces) == len(indices) // 3
    same = same and np.abs(corners(points, indices) - corners(wanted.vertices, wanted.faces)).max() < 1e-3
    check.right(f"{name} has the {len(wanted.faces)} triangles of scene.glb", same)
    extent = np.array(mesh.GetExtentAttr().Get())
    bounds = wanted.bounds.astype(np.float32)
    check.right(f"{name} reaches from {extent[0]} to {extent[1]} m", np.abs(extent - bounds).max() < 1e-4)
    triangles = points[indices].reshape(-1, 3, 3)
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals = np.array(mesh.GetNormalsAttr().Get())[indices].reshape(-1, 3, 3)
    # Slivers have no side in single precision.
    facing = np.einsum("ij,ikj->ik", across, normals).min() > -1e-6
    kind = mesh.GetSubdivisionSchemeAttr().Get(), mesh.GetNormalsInterpolation()
    check.right(f"{name}: triangles face where their normals point", facing and kind == ("none", "vertex"))
    collider = UsdPhysics.MeshCollisionAPI(mesh)
    check.right(f"{name} is a collider of its triangles", mesh.GetPrim().HasAPI(UsdPhysics.CollisionAPI)
                and collider.GetApproximationAttr().Get() == "none")
    st = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st")
    if name.startswith(("floor", "walls_")):
        values = np.array(st.Get())
        low, high = values.min(), values.max()
        # trimesh has v upward too.
        off = np.abs(np.sort(values, axis=0) - np.sort(wanted.visual.uv, axis=0)).max()
        check.right(f"{name}: st lies within the image, {low:.3f} to {high:.3f}, as in scene.glb",
                    low >= 0.0 and high <= 1.0 and off < 1e-5)


def main(bakes):
    check = Check()
    for bake in (pathlib.Path(bake).resolve() for bake in bakes):
        print(bake.name)
        manifest = json.loads((bake / "manifest.json").read_text())
        stage = Usd.Stage.Open(str(bake / "scene.usda"))
        found = complaints(stage)
        check.right("OpenUSD's validators find nothing" + "".join(f"\n     {text}" for text in found), not found)
        check.right("the manifest lists it", "scene.usda" in manifest["files"])
        frame = UsdGeom.GetStageMetersPerUnit(stage), UsdGeom.GetStageUpAxis(stage)
        check.right(f"metres, +Z up: {frame}", frame == (1.0, "Z"))
        root = stage.GetDefaultPrim()
        title = pathlib.Path(manifest["settings"]["plan"]["image"]).stem
        check.right(f"the default prim is {root.GetPath()}, shown as {root.GetDisplayName()}",
                    root.IsA(UsdGeom.Xform) and root.GetDisplayName() == title and re.fullmatch(r"\w+", root.GetName()))
        wanted = meshes_of_glb(bake / "scene.glb")
        meshes = [UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
        check.right(f"{len(meshes)} meshes", sorted(mesh.GetPrim().GetName() for mesh in meshes) == sorted(wanted))
        for mesh in meshes:
            check_mesh(check, mesh, wanted[mesh.GetPrim().GetName()])
            check_material(check, bake, mesh, manifest["target"]["name"])
    return check.failures


if __name__ == "__main__":
    sys.exit(1 if main(sys.argv[1:]) else 0)
