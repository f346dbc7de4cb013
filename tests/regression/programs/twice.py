"""Runs the Unreal script of a bake twice and says what became of its material function."""

import pathlib
import runpy
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import unreal  # noqa: E402

PINS = (unreal.MaterialExpressionFunctionInput, unreal.MaterialExpressionFunctionOutput)


def run(script):
    runpy.run_path(script, run_name="__main__")
    function = next(asset for path, asset in unreal.assets.items() if path.endswith("/MF_TroddenDirt"))
    return function, [node for node in unreal.nodes if isinstance(node, PINS)], len(unreal.nodes)


first, second = run(sys.argv[1]), run(sys.argv[1])
assert first == second, "the function, its inputs and outputs are other ones, or it has more nodes"
assert not unreal.deleted, unreal.deleted
textures = {path.rsplit("_", 2)[-2]: asset.values for path, asset in unreal.assets.items() if "_Tile" in path}
kinds = sorted(path.rsplit("_", 2)[-2] for path in unreal.assets if "_Tile" in path)
both = ["BaseColor", "Clean", "Dirt", "Mask", "Normal", "ORM"]
assert kinds == sorted(2 * both + ["Passes", "Rub", "Splash", "Wear"]), kinds
colours = sorted(kind for kind, values in textures.items() if values["srgb"])
assert colours == ["BaseColor", "Clean", "Dirt"], colours
# One sampler for all textures of a function.
customs = [node for node in unreal.nodes if isinstance(node, unreal.MaterialExpressionCustom)]
sampling = [node.values["code"] for node in customs if "Texture2DSample" in node.values["code"]]
assert len(sampling) == 2 and all("GetMaterialSharedSampler" in code for code in sampling), sampling
walls = {str(node.values["input_name"]) for node in unreal.nodes if isinstance(node, PINS[0])}
assert walls == {"BaseColor", "Roughness", "Amount", "Offset", "Mask", "Splash"}, walls
print("ok")
