"""Runs the Blender script of a bake three times in one session and checks that later runs only update."""

import runpy
import sys

import bpy

script = sys.argv[1]
sys.argv = [script, "--", "--over", "Mine", "--walls", "Plaster"]
KINDS = ("objects", "meshes", "materials", "images", "node_groups")


def there():
    return {kind: sorted(thing.name for thing in getattr(bpy.data, kind)) for kind in KINDS}


def group_node():
    return next(node for node in mine.node_tree.nodes if node.type == "GROUP")


bpy.ops.wm.read_factory_settings(use_empty=True)
mine = bpy.data.materials.new("Mine")
mine.use_nodes = True
bpy.data.materials.new("Plaster").use_nodes = True
runpy.run_path(script, run_name="__main__")
first = there()
node = group_node()
node.inputs["Film"].default_value = 2.5
moved = next(thing for thing in bpy.data.objects if thing.type == "MESH")
moved.location.x = 3.0
wall = next(thing for thing in bpy.data.objects if thing.type == "MESH" and thing is not moved)
wall.data.materials[0] = mine
name = wall.name
runpy.run_path(script, run_name="__main__")
runpy.run_path(script, run_name="__main__")
second = there()
assert first == second, f"{first}\n{second}"
assert group_node().inputs["Film"].default_value == 2.5 and group_node().outputs["Color"].is_linked
assert moved.location.x == 3.0 and bpy.data.objects[name].data.materials[0] == mine
assert all(len(thing.data.materials) > 0 for thing in bpy.data.objects if thing.type == "MESH")
assert all(image.size[0] > 0 for image in bpy.data.images if image.source in ("FILE", "TILED")), "an image cannot be read"
print("ok")
