"""Imports the scene of a bake into Blender, as an artist would, and renders it from above.

    pip install bpy==5.0.1        # Blender as a module; wants Python 3.11
    python tests/gltf/blender.py BAKE/scene.glb PICTURE.png

or, with Blender itself, `blender --background --python tests/gltf/blender.py -- BAKE/scene.glb PICTURE.png`. Exits with
1 if a textured material lost its base colour or roughness.
"""

import pathlib
import sys

import bpy
from mathutils import Vector


def imported(file):
    """The meshes of a scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=file)
    return [thing for thing in bpy.data.objects if thing.type == "MESH"]


def textured(material):
    """Whether base colour and roughness of a material are images that can be read."""
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    colour, roughness = (shader.inputs[name].is_linked for name in ("Base Color", "Roughness"))
    images = [node.image for node in material.node_tree.nodes if node.type == "TEX_IMAGE"]
    return colour and roughness and len(images) == 2 and all(image.size[0] > 1 for image in images)


def look_from(place, target):
    """Adds a camera."""
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.clip_end = 10_000
    camera.location = place
    camera.rotation_euler = (Vector(target) - Vector(place)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def light():
    """Adds a sun and a sky."""
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 2.5
    sun.rotation_euler = (0.6, 0.35, 0.0)
    bpy.context.collection.objects.link(sun)
    bpy.context.scene.world = bpy.data.worlds.new("sky")
    bpy.context.scene.world.color = (0.5, 0.55, 0.65)


def main(file, picture):
    meshes = imported(str(pathlib.Path(file).resolve()))
    corners = [mesh.matrix_world @ Vector(corner) for mesh in meshes for corner in mesh.bound_box]
    least, greatest = ([pick(corner[k] for corner in corners) for k in range(3)] for pick in (min, max))
    print(f"{len(meshes)} meshes, {sum(len(mesh.data.polygons) for mesh in meshes)} triangles, {least} to {greatest} m")
    lost = []
    for mesh in meshes:
        material = mesh.data.materials[0]
        if mesh.name.startswith(("floor_", "walls_")) and not textured(material):
            lost.append(material.name)
    print("BAD  without textures: " + ", ".join(lost) if lost else "ok   all textures are there")
    size = max(greatest[0] - least[0], greatest[1] - least[1])
    middle = [(a + b) / 2 for a, b in zip(least, greatest)]
    look_from((middle[0] - 0.25 * size, middle[1] - 0.95 * size, 0.8 * size), middle)
    light()
    render = bpy.context.scene.render
    render.engine = "CYCLES"
    bpy.context.scene.cycles.samples = 16
    bpy.context.scene.cycles.use_denoising = False
    render.resolution_x, render.resolution_y = 1200, 800
    render.filepath = str(pathlib.Path(picture).resolve())
    bpy.ops.render.render(write_still=True)
    return lost


if __name__ == "__main__":
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:]
    sys.exit(1 if main(*arguments) else 0)
