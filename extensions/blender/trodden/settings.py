"""What the panel holds: one group of properties on each scene, and where the program is."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from . import scene

USES = ("office", "school", "station", "shop", "museum", "hospital", "home", "hall")
LOOKS = ("commuters", "heavy", "wet", "paper")
FLOORS = ("vinyl", "dark", "terrazzo", "concrete", "wood", "carpet", "tile", "stone", "asphalt", "paving")


def choices(names):
    return [(name, name.capitalize(), "") for name in names]


def amount(name, description):
    return FloatProperty(
        name=name, description=description, default=1.0, min=0.0, max=4.0,
        update=lambda settings, _context: scene.set_amounts(settings))


class TroddenSettings(bpy.types.PropertyGroup):
    source: EnumProperty(name="From", items=[
        ("PLAN", "Plan", "A floor plan: an image, a drawing or a scenario"),
        ("MESH", "Selected meshes", "The floor of the selected meshes, seen from above"),
    ])
    plan: StringProperty(name="Plan", subtype="FILE_PATH", description="PNG, JPEG, SVG, PDF, DXF or a scenario (TOML)")
    metres_per_pixel: FloatProperty(
        name="Metres per pixel", min=0.0, max=10.0, precision=4, default=0.0,
        description="The plan's scale; 0 reads it from the plan, or guesses it from doors")
    outline_metres_per_pixel: FloatProperty(
        name="Metres per pixel", min=0.01, max=1.0, precision=3, default=0.05,
        description="How finely the meshes are drawn as a plan")
    people: IntProperty(name="People", min=1, max=100_000, default=400, description="How many people are simulated")
    seed: IntProperty(name="Seed", min=0, default=1, description="Another number, another crowd")
    use: EnumProperty(name="Use", items=[("AUTO", "Guessed", "From the plan"), *choices(USES)])
    look: EnumProperty(name="Look", items=choices(LOOKS))
    material: EnumProperty(name="Floor", items=choices(FLOORS))
    passes: IntProperty(
        name="Age in people", min=1, max=1_000_000_000, default=20_000,
        description="People who have walked on the floor; the simulated ones stand for them")
    quick: BoolProperty(name="Quick", default=True, description="A first look: 25 texels per metre")
    folder: StringProperty(
        name="Folder", subtype="DIR_PATH", default="//trodden", description="Each bake is a folder in this one")
    name: StringProperty(name="Name", description="Of the bake; left out: the plan's name")
    bake: StringProperty(name="Bake", subtype="DIR_PATH", description="The bake that is shown")
    # Only what was baked from meshes stands elsewhere than at the world's origin.
    origin: FloatVectorProperty(
        name="Place", subtype="TRANSLATION", description="The plan's lower left corner in the world",
        update=lambda settings, _context: scene.set_amounts(settings))
    of_meshes: BoolProperty(options={"HIDDEN"})
    live: BoolProperty(
        name="Sliders on the imported floor",
        description="Lays the dirt over a clean floor instead of the baked colours",
        update=lambda settings, _context: scene.show_floor(settings))
    colour: FloatVectorProperty(
        name="Clean floor", subtype="COLOR", min=0.0, max=1.0, default=(0.565, 0.539, 0.491),
        description="Colour of new floor materials")
    film: amount("Film", "The grey film of all steps: the lane")
    prints: amount("Prints", "Single prints and stains")
    edge: amount("Edge", "The dirty line along the walls, and dust")
    marks: amount("Marks", "Heel marks and gum")
    size: IntProperty(name="Pixels", min=64, max=16384, default=2048, description="Side of a projected texture")


class TroddenPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: StringProperty(
        name="Program", subtype="FILE_PATH",
        description="The trodden program; left out: the one on the PATH, or the one that Cargo has installed")

    def draw(self, _context):
        self.layout.prop(self, "program")


CLASSES = (TroddenSettings, TroddenPreferences)
