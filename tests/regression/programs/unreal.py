"""As much of Unreal's module as the script of a bake uses: assets and the nodes of material functions."""

import pathlib
import types

assets, nodes, deleted = {}, [], []


class Thing:
    def __init__(self, outer=None, name=""):
        self.outer, self.name, self.values = outer, name, {}

    def set_editor_property(self, key, value):
        self.values[key] = value

    def get_editor_property(self, key):
        return self.values[key]

    def get_outer(self):
        return self.outer

    def get_name(self):
        return self.name


class MaterialExpression(Thing):
    pass


KINDS = ["FunctionInput", "FunctionOutput", "WorldPosition", "Subtract", "TextureObject", "TextureCoordinate", "Constant4Vector", "Add", "Custom",
         "ComponentMask"]
for kind in KINDS:
    globals()[f"MaterialExpression{kind}"] = type(f"MaterialExpression{kind}", (MaterialExpression,), {})


class Names:
    """Constants: each is its name."""

    def __getattr__(self, name):
        return name


TextureCompressionSettings = TextureAddress = FunctionInputType = CustomMaterialOutputType = MaterialSamplerType = Names()
AssetImportTask = CustomInput = Thing
MaterialFunction = "MaterialFunction"


def MaterialFunctionFactoryNew():
    return None


def Vector4f(*values):
    return values


LinearColor = Vector4f


def create_asset(name, folder, kind, factory):
    path = f"{folder}/{name}"
    assert path not in assets, f"{path} is there already"
    assets[path] = Thing(name=name)
    return assets[path]


def import_asset_tasks(tasks):
    for task in tasks:
        path = f"{task.values['destination_path']}/{task.values['destination_name']}"
        assets.setdefault(path, Thing(name=path)).values.clear()


class AssetToolsHelpers:
    @staticmethod
    def get_asset_tools():
        return types.SimpleNamespace(create_asset=create_asset, import_asset_tasks=import_asset_tasks)


class EditorAssetLibrary:
    does_asset_exist = staticmethod(assets.__contains__)
    save_loaded_asset = staticmethod(lambda asset: None)

    @staticmethod
    def delete_asset(path):
        deleted.append(path)
        del assets[path]


class MaterialEditingLibrary:
    update_material_function = staticmethod(lambda function, instance: None)
    connect_material_expressions = staticmethod(lambda source, output, node, pin: True)

    @staticmethod
    def create_material_expression_in_function(function, kind, x, y):
        nodes.append(kind(function, f"{kind.__name__}_{len(nodes)}"))
        return nodes[-1]

    @staticmethod
    def delete_material_expression_in_function(function, node):
        nodes.remove(node)


class ScopedSlowTask:
    def __init__(self, steps, text):
        self.make_dialog = self.enter_progress_frame = lambda value: None

    def __enter__(self):
        return self

    def __exit__(self, *trouble):
        return False


class Paths:
    project_saved_dir = staticmethod(lambda: "saved")
    convert_relative_path_to_full = staticmethod(lambda path: str(pathlib.Path(path).resolve()))


def load_asset(path):
    return assets.get(path)


def ObjectIterator(kind):
    return list(nodes)


def log(text):
    print(text)
