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
kinds = sorted(path.rsplit("_", 2)[-2] for path in unreal.assets if "_Tile" in path)
assert kinds == [
    "BaseColor", "BaseColor", "Mask", "Mask", "Normal", "Normal", "ORM", "ORM", "Passes", "Rub", "Splash", "Wear"], kinds
print("ok")
