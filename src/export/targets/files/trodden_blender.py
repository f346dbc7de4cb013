"""Loads this bake into Blender and lays its dirt over your own floor materials, in world space.

Blender 4.2 or later. In the Scripting workspace open this file where it lies and press Run, or

    blender --python shaders/trodden_blender.py -- --over "My floor"

What it does:
- scene.glb is imported, if the bake has one (not with --no-scene): metres, +Z up, the plan's lower-left corner at the
  world's origin;
- the node group "Trodden dirt NAME" is made: Color and Roughness of a clean floor in, of the dirty floor out. It finds
  the masks by the place in the world, not by texture coordinates. Sliders scale film, prints, edge and heel marks;
- each material named with --over gets the group between what feeds its Principled BSDF and the BSDF. With another
  floor height or place of your model nothing has to be done; move the group's input Offset with the model.

Masks come as Non-Color, at full size. Run it again after another bake to the same folder: what it made before is
updated in its place, and your own changes of materials and of objects' places stay.
"""

import argparse
import json
import re
import sys
from pathlib import Path

import bpy

# Linear colours of dirt: film, prints and edge; and heel marks.
SOIL = (0.127438, 0.099899, 0.061246)
RUBBER = (0.019382, 0.020289, 0.024158)
DIRT_ROUGHNESS = 0.55
AMOUNTS = ("Film", "Prints", "Edge", "Marks")

# The property that says from which bake something is, and what it was called there.
TAG = "trodden"


def find_bake():
    """The folder of the bake, two above this file."""
    files = [Path(__file__)] + [Path(bpy.path.abspath(text.filepath)) for text in bpy.data.texts if text.filepath]
    for file in files:
        bake = file.resolve().parent.parent
        if file.name == "trodden_blender.py" and (bake / "manifest.json").is_file():
            return bake
    raise FileNotFoundError("there is no manifest.json above this script: open it where the bake has it")


class Nodes:
    """Adds nodes to a tree, from left to right."""

    def __init__(self, tree):
        self.tree = tree
        self.x = 0

    def add(self, kind, **properties):
        node = self.tree.nodes.new(kind)
        self.x += 40
        node.location = (self.x, -self.x % 400)
        for name, value in properties.items():
            setattr(node, name, value)
        return node

    def put(self, socket, value):
        """Links a socket, or sets what an unlinked input holds."""
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation, *values):
        node = self.add("ShaderNodeMath", operation=operation)
        for socket, value in zip(node.inputs, values):
            self.put(socket, value)
        return node.outputs["Value"]

    def vector(self, operation, *values):
        node = self.add("ShaderNodeVectorMath", operation=operation)
        for socket, value in zip(node.inputs, values):
            self.put(socket, value)
        return node.outputs["Vector"]

    def scale(self, vector, factor):
        node = self.add("ShaderNodeVectorMath", operation="SCALE")
        self.put(node.inputs[0], vector)
        self.put(node.inputs["Scale"], factor)
        return node.outputs["Vector"]

    def mix(self, factor, a, b, kind):
        """`a` where the factor is 0, `b` where it is 1."""
        node = self.add("ShaderNodeMix", data_type=kind)
        inputs = [socket for socket in node.inputs if socket.enabled]
        for socket, value in zip(inputs, (factor, a, b)):
            self.put(socket, value)
        return next(socket for socket in node.outputs if socket.enabled)


def load_mask(path):
    """The image of a mask: read again where an earlier run has loaded it."""
    image = bpy.data.images.load(str(path), check_existing=True)
    image.reload()
    image.colorspace_settings.name = "Non-Color"
    return image


def tag(bake, thing):
    """What a thing of the scene is called in the bake, without the number that Blender adds to a name in use."""
    name = Path(thing.filepath).name if isinstance(thing, bpy.types.Image) and thing.filepath else thing.name
    return f"{bake.name}/{re.sub(r'[.][0-9]{3}$', '', name)}"


def update_mesh(old, new):
    """Gives a mesh's users the new one, with the materials that the old one had."""
    for index, material in enumerate(old.materials):
        if index < len(new.materials):
            new.materials[index] = material
    name = old.name
    old.user_remap(new)
    bpy.data.meshes.remove(old)
    new.name = name


def update_image(old, new):
    """Reads an image again from where it is now."""
    old.filepath = new.filepath
    if new.packed_file:
        data = new.packed_file.data
        old.pack(data=data, data_len=len(data))
    old.reload()
    new.user_remap(old)
    bpy.data.images.remove(new)


def update_material(old, new):
    """Keeps a material as it is, but for the plain values of its BSDF."""
    def pins(material):
        nodes = [node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"]
        return {pin.name: pin for node in nodes for pin in node.inputs if not pin.is_linked}

    old_pins, new_pins = pins(old), pins(new)
    for name in ("Base Color", "Roughness"):
        if name in old_pins and name in new_pins:
            old_pins[name].default_value = new_pins[name].default_value
    new.user_remap(old)
    bpy.data.materials.remove(new)


def update_object(old, new):
    """Keeps an object where it is: its mesh is the new one already. Cameras and lamps go where the new bake has them."""
    data = new.data if new.type in ("CAMERA", "LIGHT") else None
    if data:
        old.matrix_local = new.matrix_local.copy()
    bpy.data.objects.remove(new)
    if data:
        bpy.data.batch_remove([data])


def import_scene(bake):
    """Imports scene.glb. What an earlier run imported of it is updated in its place."""
    kinds = {"images": update_image, "materials": update_material, "meshes": update_mesh, "objects": update_object}
    there = {kind: set(getattr(bpy.data, kind)) for kind in kinds}
    earlier = {
        kind: {thing[TAG]: thing for thing in things if thing.get(TAG, "").startswith(f"{bake.name}/")}
        for kind, things in there.items()}
    bpy.ops.import_scene.gltf(filepath=str(bake / "scene.glb"))
    for kind, update in kinds.items():
        for thing in [thing for thing in getattr(bpy.data, kind) if thing not in there[kind]]:
            name = tag(bake, thing)
            old = earlier[kind].pop(name, None)
            # A new mesh takes the old one's place, so it has to be known the next time.
            if old is None or kind == "meshes":
                thing[TAG] = name
            if old is not None:
                update(old, thing)
    # Pieces that the new bake does not have.
    for thing in earlier["objects"].values():
        bpy.data.objects.remove(thing)


def add_masks(nodes, bake, tiles, position):
    """Film, prints, edge and heel marks at a place of the world, from all tiles; nothing beyond them."""
    masks = {"mask": None, "wear": None}
    for tile in tiles:
        world = tile["world"]
        shifted = nodes.vector("SUBTRACT", position, (*world["origin"], 0.0))
        uv = nodes.vector("DIVIDE", shifted, (*world["size"], 1.0))
        for kind, sum in masks.items():
            image = nodes.add("ShaderNodeTexImage", extension="CLIP", image=load_mask(bake / tile[kind]))
            nodes.put(image.inputs["Vector"], uv)
            masks[kind] = image.outputs["Color"] if sum is None else nodes.vector("ADD", sum, image.outputs["Color"])
    split = {kind: nodes.add("ShaderNodeSeparateXYZ") for kind in masks}
    for kind, sum in masks.items():
        nodes.put(split[kind].inputs[0], sum)
    return *(split["mask"].outputs[axis] for axis in "XYZ"), split["wear"].outputs["Y"]


def make_group(bake, manifest):
    """The node group of the dirt. Masks hold 1 - exp(-density)."""
    name = f"Trodden dirt {bake.name}"
    group = bpy.data.node_groups.get(name) or bpy.data.node_groups.new(name, "ShaderNodeTree")
    # In the same group: materials that use it keep their links and their sliders.
    group.nodes.clear()
    made = {(item.name, item.in_out): item for item in group.interface.items_tree if item.item_type == "SOCKET"}

    def socket(name, in_out, socket_type):
        return made.get((name, in_out)) or group.interface.new_socket(name, in_out=in_out, socket_type=socket_type)

    socket("Color", in_out="INPUT", socket_type="NodeSocketColor").default_value = (0.5, 0.5, 0.5, 1.0)
    socket("Roughness", in_out="INPUT", socket_type="NodeSocketFloat").default_value = 0.35
    for amount in AMOUNTS:
        slider = socket(amount, in_out="INPUT", socket_type="NodeSocketFloat")
        slider.default_value, slider.min_value, slider.max_value = 1.0, 0.0, 4.0
    socket("Offset", in_out="INPUT", socket_type="NodeSocketVector")
    socket("Color", in_out="OUTPUT", socket_type="NodeSocketColor")
    socket("Roughness", in_out="OUTPUT", socket_type="NodeSocketFloat")

    nodes = Nodes(group)
    given = nodes.add("NodeGroupInput").outputs
    position = nodes.vector("SUBTRACT", nodes.add("ShaderNodeNewGeometry").outputs["Position"], given["Offset"])
    masks = add_masks(nodes, bake, manifest["floor"]["tiles"], position)
    total, dirt = None, None
    for mask, amount, colour in zip(masks, AMOUNTS, (SOIL, SOIL, SOIL, RUBBER)):
        left = nodes.math("MAXIMUM", nodes.math("SUBTRACT", 1.0, mask), 0.002)
        negative = nodes.math("LOGARITHM", left, 2.718281828)
        density = nodes.math("MULTIPLY", negative, nodes.math("MULTIPLY", given[amount], -1.0))
        part = nodes.scale(colour, density)
        total = density if total is None else nodes.math("ADD", total, density)
        dirt = part if dirt is None else nodes.vector("ADD", dirt, part)
    through = nodes.math("EXPONENT", nodes.math("MULTIPLY", total, -1.0))
    dirt = nodes.scale(dirt, nodes.math("DIVIDE", 1.0, nodes.math("MAXIMUM", total, 1e-6)))
    result = nodes.add("NodeGroupOutput").inputs
    nodes.put(result["Color"], nodes.mix(through, dirt, given["Color"], "RGBA"))
    nodes.put(result["Roughness"], nodes.mix(through, DIRT_ROUGHNESS, given["Roughness"], "FLOAT"))
    return group


def lay_over(material, group):
    """Puts the group between what feeds a material's Principled BSDF and the BSDF."""
    tree = material.node_tree
    bsdf = next((node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    if bsdf is None:
        raise ValueError(f"the material {material.name} has no Principled BSDF")
    if any(node.type == "GROUP" and node.node_tree == group for node in tree.nodes):
        return
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree = group
    node.location = (bsdf.location.x - 220, bsdf.location.y)
    for pin, of_bsdf in (("Color", "Base Color"), ("Roughness", "Roughness")):
        target = bsdf.inputs[of_bsdf]
        if target.is_linked:
            tree.links.new(target.links[0].from_socket, node.inputs[pin])
        else:
            node.inputs[pin].default_value = target.default_value
        tree.links.new(node.outputs[pin], target)


def main():
    parser = argparse.ArgumentParser(prog="trodden_blender.py")
    parser.add_argument("--over", action="append", default=[], metavar="MATERIAL", help="lay the dirt over it")
    parser.add_argument("--no-scene", action="store_true", help="do not import scene.glb")
    own = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    options = parser.parse_args(own)
    bake = find_bake()
    manifest = json.loads((bake / "manifest.json").read_text(encoding="utf-8"))
    if manifest.get("target", {}).get("uv_axes") != ["X", "Y"] or manifest["target"]["units_per_metre"] != 1:
        raise ValueError("this bake was not made with --target blender")
    if (bake / "scene.glb").is_file() and not options.no_scene:
        import_scene(bake)
    group = make_group(bake, manifest)
    for name in options.over:
        if name not in bpy.data.materials:
            raise ValueError(f"there is no material {name}; there are {', '.join(bpy.data.materials.keys())}")
        lay_over(bpy.data.materials[name], group)
    print(f"{group.name} is ready: Add > Group in a material's shader editor")


if __name__ == "__main__":
    main()
