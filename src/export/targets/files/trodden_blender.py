"""Loads this bake into Blender and lays its dirt over your own floor materials, in world space.

Blender 4.2 or later. In the Scripting workspace open this file where it lies and press Run, or

    blender --python shaders/trodden_blender.py -- --over "My floor"

What it does:
- scene.glb is imported, if the bake has one (not with --no-scene): metres, +Z up, the plan's lower-left corner at the
  world's origin;
- the node group "Trodden dirt NAME" is made: Color and Roughness of a clean floor in, of the dirty floor out. It finds
  the masks by the place in the world, not by texture coordinates. Sliders scale film, prints, edge and heel marks;
- each material named with --over gets the group between what feeds its Principled BSDF and the BSDF. With another
  floor height or place of your model nothing has to be done; move the group's input Offset with the model;
- the node group "Trodden wall dirt NAME" does the same for walls, by the texture coordinates of the scene's walls. With
  --walls "My plaster" the scene's walls get copies of that material of yours, one for each sheet, with the dirt over it.

Masks come as Non-Color, at full size. Run it again after another bake to the same folder: what it made before is
updated in its place, and your own changes of materials and of objects' places stay.
"""

import argparse
import functools
import json
import math
import operator
import re
import sys
from pathlib import Path

import bpy

# Linear colours of dirt: film, prints and edge of a floor; its heel marks; skin, clothes and splashes on walls.
SOIL = (0.127438, 0.099899, 0.061246)
RUBBER = (0.019382, 0.020289, 0.024158)
SKIN = (0.191202, 0.135633, 0.068478)
CLOTH = (0.162029, 0.144128, 0.124772)
SPLASH = (0.080220, 0.059511, 0.034340)
# What dirt shows of over a darker surface.
DUST = (0.304987, 0.270498, 0.215861)
# Weights of red, green and blue for the eye.
SEEN = (0.2126, 0.7152, 0.0722)
DIRT_ROUGHNESS = 0.55
AMOUNTS = ("Film", "Prints", "Edge", "Marks")
COLOURS = (SOIL, SOIL, SOIL, RUBBER)
WALL_AMOUNTS = ("Skin", "Rub", "Scuff", "Splash")
WALL_COLOURS = (SKIN, CLOTH, RUBBER, SPLASH)

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

    def seen(self, colour):
        """The mean of red, green and blue that eyes see."""
        node = self.add("ShaderNodeVectorMath", operation="DOT_PRODUCT")
        self.put(node.inputs[0], colour)
        self.put(node.inputs[1], SEEN)
        return node.outputs["Value"]

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


def is_udim(files):
    return all(re.search(r"[.][0-9]{4}[.]png$", file) for file in files)


def load_tiles(bake, files):
    """One UDIM image of all masks of a kind, NAME.1001.png and so on: Eevee takes 32 images in a material, no more."""
    path = re.sub(r"[0-9]{4}[.]png$", "<UDIM>.png", str(bake / files[0]))
    image = next((image for image in bpy.data.images if image.filepath == path), None)
    if image is None:
        image = bpy.data.images.load(str(bake / files[0]))
        image.source, image.filepath = "TILED", path
        image.colorspace_settings.name = "Non-Color"
    numbers = {int(file.split(".")[-2]) for file in files}
    for number in sorted(numbers - {tile.number for tile in image.tiles}):
        image.tiles.new(number)
    for tile in [tile for tile in image.tiles if tile.number not in numbers]:
        image.tiles.remove(tile)
    image.reload()
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


def add_image(nodes, image, uv):
    """The colour of an image at texture coordinates, as three numbers; nothing beyond it."""
    node = nodes.add("ShaderNodeTexImage", extension="CLIP", image=image)
    nodes.put(node.inputs["Vector"], uv)
    return node.outputs["Color"]


def split(nodes, colour):
    node = nodes.add("ShaderNodeSeparateXYZ")
    nodes.put(node.inputs[0], colour)
    return node.outputs


def add_masks(nodes, bake, tiles, position):
    """Film, prints, edge and heel marks at a place of the world, from all tiles; nothing beyond them."""
    def uv(tile):
        shifted = nodes.vector("SUBTRACT", position, (*tile["world"]["origin"], 0.0))
        return nodes.vector("DIVIDE", shifted, (*tile["world"]["size"], 1.0))

    masks = {}
    for kind in ("mask", "wear"):
        files = [tile[kind] for tile in tiles]
        if is_udim(files):
            # All tiles have one size.
            across = nodes.vector("ADD", uv(tiles[0]), (tiles[0]["u"], tiles[0]["v"], 0.0))
            masks[kind] = add_image(nodes, load_tiles(bake, files), across)
        else:
            # More than 10 x 10 tiles: an image for each, which Cycles takes.
            parts = [add_image(nodes, load_mask(bake / tile[kind]), uv(tile)) for tile in tiles]
            masks[kind] = functools.reduce(lambda sum, part: nodes.vector("ADD", sum, part), parts)
    mask, wear = (split(nodes, masks[kind]) for kind in ("mask", "wear"))
    return *(mask[axis] for axis in "XYZ"), wear["Y"]


def make_tree(name, amounts, others):
    """A node group with the inputs Color, Roughness, amounts of dirt and others (name, type); its nodes, none yet."""
    group = bpy.data.node_groups.get(name) or bpy.data.node_groups.new(name, "ShaderNodeTree")
    # In the same group: materials that use it keep their links and their sliders.
    group.nodes.clear()
    made = {(item.name, item.in_out): item for item in group.interface.items_tree if item.item_type == "SOCKET"}

    def socket(name, in_out, socket_type):
        return made.get((name, in_out)) or group.interface.new_socket(name, in_out=in_out, socket_type=socket_type)

    socket("Color", in_out="INPUT", socket_type="NodeSocketColor").default_value = (0.5, 0.5, 0.5, 1.0)
    socket("Roughness", in_out="INPUT", socket_type="NodeSocketFloat").default_value = 0.35
    for amount in amounts:
        slider = socket(amount, in_out="INPUT", socket_type="NodeSocketFloat")
        slider.default_value, slider.min_value, slider.max_value = 1.0, 0.0, 4.0
    for other, kind in others:
        socket(other, in_out="INPUT", socket_type=kind)
    socket("Color", in_out="OUTPUT", socket_type="NodeSocketColor")
    socket("Roughness", in_out="OUTPUT", socket_type="NodeSocketFloat")
    return group, Nodes(group)


def mix_dirt(nodes, given, masks, amounts, colours):
    """Lays dirt over the group's Color and Roughness. Masks hold 1 - exp(-density).

    Each kind of dirt absorbs red, green and blue by its own, 1 in the mean that eyes see; over a surface darker than itself
    it covers all colours alike, and is lighter and greyer.
    """
    each, light = None, None
    for mask, amount, colour in zip(masks, amounts, colours):
        left = nodes.math("MAXIMUM", nodes.math("SUBTRACT", 1.0, mask), 0.002)
        negative = nodes.math("LOGARITHM", left, 2.718281828)
        density = nodes.math("MULTIPLY", negative, nodes.math("MULTIPLY", given[amount], -1.0))
        depths = [math.log(channel) for channel in colour]
        absorbs = [depth / sum(map(operator.mul, SEEN, depths)) for depth in depths]
        absorbed = nodes.scale(absorbs, density)
        lit = nodes.vector("MULTIPLY", absorbed, colour)
        each = absorbed if each is None else nodes.vector("ADD", each, absorbed)
        light = lit if light is None else nodes.vector("ADD", light, lit)
    clean = given["Color"]
    mean, bright = nodes.seen(each), nodes.seen(light)
    lighter = nodes.math("SUBTRACT", nodes.math("MULTIPLY", bright, 0.8), nodes.math("MULTIPLY", nodes.seen(clean), mean))
    dark = nodes.math("DIVIDE", nodes.math("MULTIPLY", lighter, 3.0), nodes.math("MAXIMUM", bright, 1e-6))
    dark = nodes.math("MINIMUM", nodes.math("MAXIMUM", dark, 0.0), 1.0)
    dirt = nodes.vector("DIVIDE", light, nodes.vector("MAXIMUM", each, (1e-6,) * 3))
    dirt = nodes.mix(nodes.math("MULTIPLY", dark, 0.3), dirt, DUST, "VECTOR")
    through = nodes.add("ShaderNodeCombineXYZ")
    for axis, density in split(nodes, nodes.mix(dark, each, nodes.scale((1.0,) * 3, mean), "VECTOR")).items():
        nodes.put(through.inputs[axis], nodes.math("EXPONENT", nodes.math("MULTIPLY", density, -1.0)))
    left = nodes.vector("MULTIPLY", nodes.vector("SUBTRACT", clean, dirt), through.outputs[0])
    result = nodes.add("NodeGroupOutput").inputs
    nodes.put(result["Color"], nodes.vector("ADD", dirt, left))
    through = nodes.math("EXPONENT", nodes.math("MULTIPLY", mean, -1.0))
    nodes.put(result["Roughness"], nodes.mix(through, DIRT_ROUGHNESS, given["Roughness"], "FLOAT"))


def make_group(bake, manifest):
    """The node group of the floor's dirt."""
    group, nodes = make_tree(f"Trodden dirt {bake.name}", AMOUNTS, [("Offset", "NodeSocketVector")])
    given = nodes.add("NodeGroupInput").outputs
    position = nodes.vector("SUBTRACT", nodes.add("ShaderNodeNewGeometry").outputs["Position"], given["Offset"])
    masks = add_masks(nodes, bake, manifest["floor"]["tiles"], position)
    mix_dirt(nodes, given, masks, AMOUNTS, COLOURS)
    return group


def make_wall_group(bake, manifest):
    """The node group of the walls' dirt, by the texture coordinates of the scene's walls; None without walls."""
    sheets = (manifest.get("walls") or {}).get("sheets", [])
    kinds = {kind: [sheet[kind] for sheet in sheets] for kind in ("mask", "splash")}
    if not sheets or not is_udim(kinds["mask"]):
        return None
    group, nodes = make_tree(f"Trodden wall dirt {bake.name}", WALL_AMOUNTS, [("Sheet", "NodeSocketFloat")])
    given = nodes.add("NodeGroupInput").outputs
    place = nodes.add("ShaderNodeUVMap", uv_map="UVMap").outputs["UV"]

    # Sheet 0 lies in the tile 1001, sheet 10 above it.
    row = nodes.math("FLOOR", nodes.math("DIVIDE", given["Sheet"], 10.0))
    shift = nodes.add("ShaderNodeCombineXYZ")
    nodes.put(shift.inputs["X"], nodes.math("SUBTRACT", given["Sheet"], nodes.math("MULTIPLY", row, 10.0)))
    nodes.put(shift.inputs["Y"], row)
    uv = nodes.vector("ADD", place, shift.outputs[0])
    mask, splash = (split(nodes, add_image(nodes, load_tiles(bake, files), uv)) for files in kinds.values())
    mix_dirt(nodes, given, (*(mask[axis] for axis in "XYZ"), splash["X"]), WALL_AMOUNTS, WALL_COLOURS)
    return group


def dress_walls(bake, material, group):
    """Gives the scene's walls copies of a material with the dirt over it, one for each sheet."""
    for thing in bpy.data.objects:
        place = re.fullmatch(rf"{re.escape(bake.name)}/walls_([0-9]+)", thing.get(TAG, ""))
        if place is None or thing.type != "MESH":
            continue
        name = f"{material.name} {bake.name} walls {place[1]}"
        copy = bpy.data.materials.get(name)
        if copy is None:
            copy = material.copy()
            copy.name = name
        lay_over(copy, group).inputs["Sheet"].default_value = int(place[1])
        thing.data.materials[0] = copy


def lay_over(material, group):
    """Puts the group between what feeds a material's Principled BSDF and the BSDF; gives its node."""
    tree = material.node_tree
    bsdf = next((node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    if bsdf is None:
        raise ValueError(f"the material {material.name} has no Principled BSDF")
    there = next((node for node in tree.nodes if node.type == "GROUP" and node.node_tree == group), None)
    if there is not None:
        return there
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
    return node


def main():
    parser = argparse.ArgumentParser(prog="trodden_blender.py")
    parser.add_argument("--over", action="append", default=[], metavar="MATERIAL", help="lay the dirt over it")
    parser.add_argument("--walls", metavar="MATERIAL", help="give the scene's walls copies of it with the dirt over it")
    parser.add_argument("--no-scene", action="store_true", help="do not import scene.glb")
    own = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    options = parser.parse_args(own)
    bake = find_bake()
    manifest = json.loads((bake / "manifest.json").read_text(encoding="utf-8"))
    if manifest.get("target", {}).get("uv_axes") != ["X", "Y"] or manifest["target"]["units_per_metre"] != 1:
        raise ValueError("this bake was not made with --target blender")
    if (bake / "scene.glb").is_file() and not options.no_scene:
        import_scene(bake)
    group, walls = make_group(bake, manifest), make_wall_group(bake, manifest)
    for name in [*options.over, *filter(None, [options.walls])]:
        if name not in bpy.data.materials:
            raise ValueError(f"there is no material {name}; there are {', '.join(bpy.data.materials.keys())}")
    for name in options.over:
        lay_over(bpy.data.materials[name], group)
    if options.walls and walls:
        dress_walls(bake, bpy.data.materials[options.walls], walls)
    print(f"{group.name} is ready: Add > Group in a material's shader editor")


if __name__ == "__main__":
    main()
