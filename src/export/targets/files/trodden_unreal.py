"""Brings the textures of this bake into an Unreal project and makes a material function of its dirt.

Unreal Engine 5 with the plugins Python Editor Script and Editor Scripting Utilities: in the Output Log, choose Cmd and
type
    py "C:/bakes/station/shaders/trodden_unreal.py"

Textures come to /Game/Trodden/NAME with their flags set: base colour sRGB, masks and ORM linear (Masks), layers HDR,
full size, clamped. MF_TroddenDirt there takes your floor's BaseColor and Roughness and gives both with the dirt over
them, in world space: put it in front of the outputs of your own floor material. It expects the plan's lower-left corner
at the world's origin, where scene.glb comes to lie; move both together with the input Offset.

MF_TroddenWallDirt does the same for the walls of scene.glb: give its inputs Mask and Splash Texture Object Parameters in
front of your own wall material, and make an instance of it with the textures of each sheet, the mesh walls_N gets that of
sheet N.

Run it again after another bake to the same folder: textures are replaced, and the function gets new nodes inside, so
that materials keep their links to it.
"""

import json
import re
import shutil
from pathlib import Path

import unreal

BAKE = Path(__file__).resolve().parent.parent
NAME = re.sub(r"\W", "_", BAKE.name)
FOLDER = f"/Game/Trodden/{NAME}"

COLOURS = ("basecolor", "clean", "dirt")
COMPRESSION = {
    "basecolor": unreal.TextureCompressionSettings.TC_DEFAULT,
    "clean": unreal.TextureCompressionSettings.TC_DEFAULT,
    "dirt": unreal.TextureCompressionSettings.TC_DEFAULT,
    "mask": unreal.TextureCompressionSettings.TC_MASKS,
    "passes": unreal.TextureCompressionSettings.TC_GRAYSCALE,
    "splash": unreal.TextureCompressionSettings.TC_GRAYSCALE,
    "rub": unreal.TextureCompressionSettings.TC_MASKS,
    "wear": unreal.TextureCompressionSettings.TC_MASKS,
    "normal": unreal.TextureCompressionSettings.TC_NORMALMAP,
    "orm": unreal.TextureCompressionSettings.TC_MASKS,
    "layers": unreal.TextureCompressionSettings.TC_HDR,
}


def import_texture(file, kind):
    """Imports a file of the bake and sets its flags."""
    # With virtual texturing on, a name that ends in .1001 would make Unreal join all tiles into one texture.
    name = re.sub(r"[._](\d{4})$", r"_Tile\1", Path(file).stem)
    copy = Path(unreal.Paths.convert_relative_path_to_full(unreal.Paths.project_saved_dir())) / "Trodden" / NAME
    copy.mkdir(parents=True, exist_ok=True)
    copy /= name + Path(file).suffix
    shutil.copyfile(BAKE / file, copy)
    task = unreal.AssetImportTask()
    task.set_editor_property("filename", str(copy))
    task.set_editor_property("destination_path", FOLDER)
    task.set_editor_property("destination_name", name)
    task.set_editor_property("automated", True)
    task.set_editor_property("replace_existing", True)
    unreal.AssetToolsHelpers.get_asset_tools().import_asset_tasks([task])
    texture = unreal.load_asset(f"{FOLDER}/{name}")
    if texture is None:
        raise RuntimeError(f"{file} could not be imported")
    texture.set_editor_property("srgb", kind in COLOURS)
    texture.set_editor_property("compression_settings", COMPRESSION[kind])
    texture.set_editor_property("max_texture_size", 0)
    texture.set_editor_property("virtual_texture_streaming", False)
    texture.set_editor_property("address_x", unreal.TextureAddress.TA_CLAMP)
    texture.set_editor_property("address_y", unreal.TextureAddress.TA_CLAMP)
    unreal.EditorAssetLibrary.save_loaded_asset(texture)
    return texture


def import_all(entry):
    """Imports all images of a tile or sheet; gives its mask and what else is known of it."""
    import_texture(entry["basecolor"], "basecolor")
    import_texture(entry["orm"], "orm")
    others = {}
    for lone in ("passes", "splash", "rub", "wear", "normal", "clean", "dirt"):
        if lone in entry:
            others[lone] = import_texture(entry[lone], lone)
    layers = entry.get("layers", [])
    for file in [layers] if isinstance(layers, str) else layers:
        import_texture(file, "layers")
    return import_texture(entry["mask"], "mask"), others


class Function:
    """A material function that is being built."""

    def __init__(self, name):
        path = f"{FOLDER}/{name}"
        self.row = 0
        # Inputs and outputs by name. Materials know them by numbers of their own, which new ones would not have.
        self.pins = {}
        if unreal.EditorAssetLibrary.does_asset_exist(path):
            self.asset = unreal.load_asset(path)
            self.clear()
        else:
            tools = unreal.AssetToolsHelpers.get_asset_tools()
            self.asset = tools.create_asset(name, FOLDER, unreal.MaterialFunction, unreal.MaterialFunctionFactoryNew())

    def clear(self):
        """Deletes all nodes but the inputs and outputs."""
        names = {
            unreal.MaterialExpressionFunctionInput: "input_name",
            unreal.MaterialExpressionFunctionOutput: "output_name",
        }
        nodes = [node for node in unreal.ObjectIterator(unreal.MaterialExpression) if node.get_outer() == self.asset]
        for node in nodes:
            kind = type(node)
            if kind in names:
                self.pins[(kind, str(node.get_editor_property(names[kind])))] = node
            else:
                unreal.MaterialEditingLibrary.delete_material_expression_in_function(self.asset, node)

    def pin(self, kind, name, x, **properties):
        """An input or output: the one that an earlier run made, if there is one."""
        node = self.pins.get((kind, name))
        if node is None:
            return self.node(kind, x, **properties)
        for key, value in properties.items():
            node.set_editor_property(key, value)
        return node

    def node(self, kind, x, **properties):
        self.row += 160
        node = unreal.MaterialEditingLibrary.create_material_expression_in_function(self.asset, kind, x, self.row)
        for name, value in properties.items():
            node.set_editor_property(name, value)
        return node

    def input(self, name, kind, preview=(0.0, 0.0, 0.0, 0.0)):
        kind = getattr(unreal.FunctionInputType, f"FUNCTION_INPUT_{kind}")
        return self.pin(
            unreal.MaterialExpressionFunctionInput, name, -900, input_name=name, input_type=kind,
            preview_value=unreal.Vector4f(*preview), use_preview_value_as_default=True)

    def texture_input(self, name, image, sampler):
        """An input for a texture, which is `image` where nothing is linked to it."""
        node = self.input(name, "TEXTURE2D")
        shown = self.node(unreal.MaterialExpressionTextureObject, -1100, texture=image, sampler_type=sampler)
        self.connect(shown, node, "Preview")
        return node

    def custom(self, file, x, inputs, channels):
        """A Custom node with the code of a file beside this script; `inputs` are names and nodes."""
        pins = []
        for name in inputs:
            pin = unreal.CustomInput()
            pin.set_editor_property("input_name", name)
            pins.append(pin)
        node = self.node(
            unreal.MaterialExpressionCustom, x, code=(BAKE / "shaders" / file).read_text(encoding="utf-8"),
            output_type=getattr(unreal.CustomMaterialOutputType, f"CMOT_FLOAT{channels}"), inputs=pins,
            description=Path(file).stem)
        for name, source in inputs.items():
            self.connect(source, node, name)
        return node

    def output(self, name, source, channels):
        mask = self.node(
            unreal.MaterialExpressionComponentMask, 300, **{c: c in channels for c in "rgba"})
        self.connect(source, mask, "")
        node = self.pin(unreal.MaterialExpressionFunctionOutput, name, 500, output_name=name)
        self.connect(mask, node, "")

    @staticmethod
    def connect(source, node, pin):
        if not unreal.MaterialEditingLibrary.connect_material_expressions(source, "", node, pin):
            raise RuntimeError(f"{pin or 'input'} of {node.get_name()} cannot be connected")

    def save(self):
        unreal.MaterialEditingLibrary.update_material_function(self.asset, None)
        unreal.EditorAssetLibrary.save_loaded_asset(self.asset)


def make_function(tiles):
    """MF_TroddenDirt; `tiles` are entries of the manifest with their masks and wear."""
    function = Function("MF_TroddenDirt")
    colour = function.input("BaseColor", "VECTOR3", (0.5, 0.5, 0.5, 0.0))
    roughness = function.input("Roughness", "SCALAR", (0.35, 0.0, 0.0, 0.0))
    amount = function.input("Amount", "VECTOR4", (1.0, 1.0, 1.0, 1.0))
    offset = function.input("Offset", "VECTOR3", (0.0, 0.0, 0.0, 0.0))
    position = function.node(unreal.MaterialExpressionWorldPosition, -900)
    world = function.node(unreal.MaterialExpressionSubtract, -700)
    function.connect(position, world, "A")
    function.connect(offset, world, "B")
    masks = None
    for entry, mask, wear in tiles:
        texture, worn = (function.node(
            unreal.MaterialExpressionTextureObject, -600, texture=image,
            sampler_type=unreal.MaterialSamplerType.SAMPLERTYPE_MASKS) for image in (mask, wear))
        place = function.node(
            unreal.MaterialExpressionConstant4Vector, -600,
            constant=unreal.LinearColor(*entry["world"]["origin"], *entry["world"]["size"]))
        pins = {"World": world, "Mask": texture, "Wear": worn, "Place": place}
        tile = function.custom("trodden_dirt.hlsl", -300, pins, 4)
        if masks is not None:
            both = function.node(unreal.MaterialExpressionAdd, -150)
            function.connect(masks, both, "A")
            function.connect(tile, both, "B")
            tile = both
        masks = tile
    mixed = function.custom(
        "trodden_mix.hlsl", 100,
        {"Masks": masks, "Amount": amount, "FloorColour": colour, "FloorRoughness": roughness}, 4)
    function.output("BaseColor", mixed, "rgb")
    function.output("Roughness", mixed, "a")
    function.save()


def make_wall_function(mask, splash):
    """MF_TroddenWallDirt; mask and splash of a sheet are shown where a material gives none."""
    function = Function("MF_TroddenWallDirt")
    types = unreal.MaterialSamplerType
    inputs = {
        "UV": function.node(unreal.MaterialExpressionTextureCoordinate, -900),
        "Mask": function.texture_input("Mask", mask, types.SAMPLERTYPE_MASKS),
        "Splash": function.texture_input("Splash", splash, types.SAMPLERTYPE_LINEAR_GRAYSCALE),
        "Amount": function.input("Amount", "VECTOR4", (1.0, 1.0, 1.0, 1.0)),
        "WallColour": function.input("BaseColor", "VECTOR3", (0.5, 0.5, 0.5, 0.0)),
        "WallRoughness": function.input("Roughness", "SCALAR", (0.5, 0.0, 0.0, 0.0)),
    }
    mixed = function.custom("trodden_wall.hlsl", 100, inputs, 4)
    function.output("BaseColor", mixed, "rgb")
    function.output("Roughness", mixed, "a")
    function.save()


def main():
    manifest = json.loads((BAKE / "manifest.json").read_text(encoding="utf-8"))
    entries = manifest["floor"]["tiles"]
    sheets = (manifest.get("walls") or {}).get("sheets", [])
    with unreal.ScopedSlowTask(len(entries) + len(sheets), "Importing trodden textures") as task:
        task.make_dialog(True)
        tiles = []
        for entry in entries:
            task.enter_progress_frame(1)
            mask, others = import_all(entry)
            tiles.append((entry, mask, others["wear"]))
        walls = []
        for sheet in sheets:
            task.enter_progress_frame(1)
            mask, others = import_all(sheet)
            walls.append((mask, others["splash"]))
    make_function(tiles)
    if walls:
        make_wall_function(*walls[0])
    unreal.log(f"{len(tiles)} tiles and {len(sheets)} sheets are in {FOLDER}")
    unreal.log("Put MF_TroddenDirt into your floor material, MF_TroddenWallDirt into your wall material")


main()
