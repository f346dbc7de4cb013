"""Checks the extension in Blender as a module: `check.py trodden.zip FOLDER [PICTURES]`, called by `run`.

PICTURES, if given, is a folder that gets the rendered pictures.
"""

import importlib
import math
import os
import pathlib
import subprocess
import sys
import threading
import time
import types

import bpy
import numpy

ARCHIVE, OUT = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
PICTURES = pathlib.Path(sys.argv[3]).resolve() if len(sys.argv) > 3 and sys.argv[3] else OUT / "pictures"
MODULE = "bl_ext.user_default.trodden"
failed = []


def check(right, what):
    print(f"{'ok  ' if right else 'BAD '} {what}", flush=True)
    if not right:
        failed.append(what)


def traces():
    """What an add-on could leave behind."""
    found = {f"class {name}" for name in dir(bpy.types) if "trodden" in name.lower()}
    found |= {f"operator {name}" for name in dir(bpy.ops) if name == "trodden" and dir(bpy.ops.trodden)}
    found |= {f"property {name}" for name in dir(bpy.types.Scene) if name == "trodden"}
    for name in dir(bpy.app.handlers):
        handlers = getattr(bpy.app.handlers, name)
        if type(handlers) is list:
            found |= {f"handler {each}" for each in handlers if MODULE in each.__module__}
    return found


def fails(operator, **values):
    """The words with which an operator fails."""
    try:
        operator(**values)
    except RuntimeError as error:
        return str(error)
    return ""


def room(module):
    """A plan of 9 x 6 m, open in the west and the east, with a pillar."""
    plan = numpy.zeros((120, 180), dtype=bool)
    plan[10:110, 10:170] = True
    plan[45:75, :] = True
    plan[54:66, 84:96] = False
    file = OUT / "room.png"
    module.write_png(file, plan)
    return file


def look_down(width, height, middle):
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", max(width, height)
    camera.location = (*middle, 30.0)
    bpy.context.scene.collection.objects.link(camera)
    scene = bpy.context.scene
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = round(width * 20), round(height * 20)
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 4, False
    scene.view_settings.view_transform = "Standard"
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    background = next(node for node in scene.world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)


def grey(file):
    """Lightness of a picture, row 0 at the bottom."""
    image = bpy.data.images.load(str(file))
    pixels = numpy.empty(image.size[0] * image.size[1] * 4, dtype=numpy.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(image.size[1], image.size[0], 4)[:, :, :3].mean(axis=2)
    bpy.data.images.remove(image)
    return pixels


def render(name):
    bpy.context.scene.render.filepath = str(PICTURES / f"{name}.png")
    bpy.ops.render.render(write_still=True)
    return grey(PICTURES / f"{name}.png")


def blocks(picture, rows, columns):
    """Means of a picture's blocks."""
    height, width = picture.shape
    down, across = ([k * size // count for k in range(count + 1)] for size, count in ((height, rows), (width, columns)))
    return numpy.array([[picture[a:b, c:d].mean() for c, d in zip(across, across[1:])] for a, b in zip(down, down[1:])])


def counts():
    return {kind: len(getattr(bpy.data, kind)) for kind in ("objects", "meshes", "materials", "images", "node_groups")}


class Layout:
    """Stands in for a panel's layout, since there is no window: complains of properties, operators, icons not there."""

    icons = bpy.types.UILayout.bl_rna.functions["operator"].parameters["icon"].enum_items

    def __init__(self):
        self.drawn = []

    def column(self):
        return self

    def separator(self):
        pass

    def prop(self, data, name, slider=False):
        assert name in data.bl_rna.properties, name
        self.drawn.append(name)

    def operator(self, name, icon):
        assert name.split(".")[1] in dir(bpy.ops.trodden) and icon in self.icons, name
        self.drawn.append(name)

    def progress(self, factor, text):
        assert 0.0 <= factor <= 1.0
        self.drawn.append(text)


def draw():
    """What the panels show."""
    panel, bake = (importlib.import_module(f"{MODULE}.{name}") for name in ("panel", "bake"))
    for area in ("VIEW_3D", "IMAGE_EDITOR"):
        shown = types.SimpleNamespace(layout=Layout())
        context = types.SimpleNamespace(scene=bpy.context.scene, area=types.SimpleNamespace(type=area))
        panel.draw_panel(shown, context)
        wanted = "trodden.scale" if area == "IMAGE_EDITOR" else "trodden.show_plan"
        check({wanted, "trodden.bake", "film"} <= set(shown.layout.drawn), f"the panel of {area} has its parts")
    bpy.ops.trodden.show_plan()
    check(any(image.name == "room.png" for image in bpy.data.images), "the plan can be shown")


def stand_in(operator):
    """An operator's functions on a plain object: Blender makes operators itself, and modal ones only in a window."""
    made = type("StandIn", (), {name: value for name, value in vars(operator).items() if name[:2] != "__"})()
    made.said = []
    made.report = lambda kind, words: made.said.append((kind, words))
    return made


def event(kind, value="NOTHING", x=0, y=0):
    return types.SimpleNamespace(type=kind, value=value, mouse_x=x, mouse_y=y)


def click():
    """Two clicks in an image editor whose picture is shown at 2 screen pixels per pixel, 100 from the left."""
    tools = importlib.import_module(f"{MODULE}.tools")
    settings = bpy.context.scene.trodden
    view = types.SimpleNamespace(region_to_view=lambda x, y: (x / 360, y / 240))
    region = types.SimpleNamespace(type="WINDOW", x=100, y=0, view2d=view)
    headers = []
    context = types.SimpleNamespace(
        area=types.SimpleNamespace(regions=[region], header_text_set=headers.append),
        space_data=types.SimpleNamespace(image=bpy.data.images["room.png"]),
        window_manager=types.SimpleNamespace(modal_handler_add=lambda _operator: None))
    scale = stand_in(tools.TRODDEN_OT_scale)
    before = settings.metres_per_pixel
    results = [scale.invoke(context, None), scale.modal(context, event("MOUSEMOVE")),
               scale.modal(context, event("LEFTMOUSE", "PRESS", 110, 30)),
               scale.modal(context, event("LEFTMOUSE", "PRESS", 150, 60))]
    # 20 and 15 pixels; the dialog's default is a metre.
    right = math.isclose(settings.metres_per_pixel, 1 / 25, rel_tol=1e-5)
    check(right and results[-1] == {"FINISHED"} and headers[-1] is None,
          f"two clicks give {settings.metres_per_pixel:.4f} m per pixel")
    settings.metres_per_pixel = before


def run_modal():
    """A bake beside a window: it is asked by a timer, and the panel shows how far it is."""
    bake, panel = (importlib.import_module(f"{MODULE}.{name}") for name in ("bake", "panel"))
    manager = types.SimpleNamespace(windows=[], event_timer_remove=lambda _timer: None)
    context = types.SimpleNamespace(
        scene=bpy.context.scene, preferences=bpy.context.preferences, window_manager=manager, selected_objects=[],
        area=types.SimpleNamespace(type="VIEW_3D"))
    operator = stand_in(bake.TRODDEN_OT_bake)
    started, result, words = operator.start(context), {"PASS_THROUGH"}, set()
    while started and result == {"PASS_THROUGH"}:
        shown = types.SimpleNamespace(layout=Layout())
        panel.draw_panel(shown, context)
        words |= {text for text in shown.layout.drawn if text.endswith(" s")}
        time.sleep(0.05)
        result = operator.modal(context, event("TIMER"))
    check(result == {"FINISHED"} and len(words) > 1, f"beside a window: {', '.join(sorted(words))}")
    check(bake.TRODDEN_OT_bake.poll(context), "another bake can follow")


def settle():
    """The first bake and import: how the plan's dirt looks in Blender."""
    settings = bpy.context.scene.trodden
    words = fails(bpy.ops.trodden.bake)
    check("choose a plan" in words, f"without a plan: {words.strip()}")
    (OUT / "broken.png").write_bytes(b"no image")
    settings.plan = str(OUT / "broken.png")
    words = fails(bpy.ops.trodden.bake)
    check("broken.png" in words, f"with a broken plan: {words.strip()}")

    plan = importlib.import_module(f"{MODULE}.plan")
    settings.plan = str(room(plan))
    # 180 pixels from side to side are 9 m.
    bpy.ops.trodden.set_scale(x0=0, y0=60, x1=180, y1=60, metres=9.0)
    check(math.isclose(settings.metres_per_pixel, 0.05, rel_tol=1e-6), "two points and 9 m give the scale")
    check("far apart" in fails(bpy.ops.trodden.set_scale, x0=1, y0=1, x1=1, y1=1), "one point twice is refused")
    settings.people, settings.use, settings.passes = 60, "hall", 60000
    check(bpy.ops.trodden.bake() == {"FINISHED"}, "the plan is baked and imported")
    names = sorted(thing.name for thing in bpy.data.objects)
    check({"room", "floor_0_0", "walls_0"} <= set(names), f"objects: {', '.join(names)}")
    floor = bpy.data.objects["floor_0_0"]
    width, height = floor.dimensions[:2]
    check(abs(width - 9.0) < 0.2 and abs(height - 5.0) < 0.2, f"the floor is {width:.2f} x {height:.2f} m")
    return floor


def compare(floor):
    """The render from above against the program's own still."""
    for thing in bpy.data.objects:
        thing.hide_render = thing.type == "MESH" and thing != floor
    look_down(9.0, 6.0, (4.5, 3.0))
    baked = render("baked")
    still = grey(OUT / "bakes/room/preview/floor.png")
    # Blocks of 0.5 m; those that walls touch are left out.
    ours, theirs = blocks(baked, 12, 18)[2:10, 2:16], blocks(still, 12, 18)[2:10, 2:16]
    pillar = numpy.zeros(ours.shape, dtype=bool)
    pillar[2:6, 5:9] = True
    ours, theirs = ours[~pillar], theirs[~pillar]
    agreement = numpy.corrcoef(ours, theirs)[0, 1]
    check(agreement > 0.9, f"render and still agree block by block: correlation {agreement:.3f}")
    check(abs(ours - theirs).mean() < 0.1, f"mean difference of render and still {abs(ours - theirs).mean():.3f}")
    # The lane beside the pillar against the rooms' corners: the dirt, not the walls, is what agrees.
    for name, picture in (("render", baked), ("still", still)):
        cells = blocks(picture, 12, 18)
        depth = cells[1, [1, 2, 15, 16]].mean() - cells[3:9, 4:7].mean()
        check(depth > 0.05, f"the lane of the {name} is darker than the corners by {depth:.3f}")
    return baked


def slide(settings, baked):
    settings.live = True
    dirty = render("live")
    settings.film = settings.prints = settings.edge = settings.marks = 0.0
    clean = render("clean")
    settings.film = 2.0
    film = render("film")
    settings.film = settings.prints = settings.edge = settings.marks = 1.0
    inner = (slice(10, 110), slice(15, 165))
    check(clean[inner].mean() - dirty[inner].mean() > 0.03,
          f"sliders move the dirt: clean {clean[inner].mean():.3f}, dirty {dirty[inner].mean():.3f}")
    # The lane between the openings against the room's corners.
    def lane(picture):
        return picture[30:36, 10:60].mean() - picture[12:18, 15:45].mean()
    check(lane(film) < lane(clean) - 0.02, f"film alone darkens the lane: {lane(film):.3f}, clean {lane(clean):.3f}")
    settings.live = False
    check(abs(render("again") - baked).mean() < 0.01, "the baked floor comes back")


def dress(settings):
    """The walls in a material of one's own, under the bake's dirt, against the bake's own colours."""
    dirt, scene = (importlib.import_module(f"{MODULE}.{name}") for name in ("trodden_blender", "scene"))
    bake, walls = pathlib.Path(settings.bake), bpy.data.objects["walls_0"]
    baked, walls.hide_render = walls.data.materials[0], False
    own = scene.new_material("plaster", (0.8, 0.8, 0.8))
    group = dirt.make_wall_group(bake, scene.read_manifest(bake))
    dirt.dress_walls(bake, own, group)
    dirt.dress_walls(bake, own, group)
    check([material.name for material in bpy.data.materials if material.name.startswith("plaster")]
          == ["plaster", "plaster room walls 0"], "walls get one copy of a material")
    theirs = grey(next((bake / "walls").glob("wall_basecolor.1001.png")))
    side = max(theirs.shape)
    theirs = theirs.repeat(side // theirs.shape[0], axis=0).repeat(side // theirs.shape[1], axis=1)
    ours = grey(scene.project(bpy.context, walls, side, OUT / "dressed"))
    # Where the wall is touched, and where it is clean; the image holds more than the strips.
    seen = ours > 0.1
    soiled, clean = seen & (theirs < numpy.median(theirs[seen]) - 0.06), seen & (theirs > numpy.median(theirs[seen]) - 0.01)
    fall = ours[clean].mean() - ours[soiled].mean()
    check(soiled.sum() > 100 and 0.05 < fall, f"the dirt is on them: darker by {fall:.3f} at {soiled.sum()} texels")
    walls.data.materials[0], walls.hide_render = baked, True


def tiles(module):
    """A floor of many tiles: one image of each kind, and the dirt where it was baked."""
    dirt, scene = (importlib.import_module(f"{MODULE}.{name}") for name in ("trodden_blender", "scene"))
    bake = OUT / "bakes/tiles"
    scenario = OUT / "tiles.toml"
    scenario.write_text(
        f'[plan]\nimage = "{room(module).as_posix()}"\nmetres_per_pixel = 0.05\n[crowd]\npeople = 40\n'
        '[texture]\nfloor_texels_per_metre = 20\ntile = 64\ntarget = "blender"\n[look]\ntotal_passes = 60000\n')
    subprocess.run([os.environ["TRODDEN"], "bake", scenario, "-o", bake, "--floor-only", "--quiet"], check=True)
    group = dirt.make_group(bake, scene.read_manifest(bake))
    dirt.make_group(bake, scene.read_manifest(bake))
    images = [node.image for node in group.nodes if node.type == "TEX_IMAGE"]
    found = [(image.source, len(image.tiles)) for image in images]
    check(found == [("TILED", 6), ("TILED", 6)], f"images of a floor of 6 tiles: {found}")
    bpy.ops.mesh.primitive_plane_add(size=1.0, location=(4.5, 3.0, 8.0))
    plane = bpy.context.object
    plane.scale = (9.0, 6.0, 1.0)
    plane.data.materials.append(scene.new_material("tiled", (0.6, 0.6, 0.6)))
    dirt.lay_over(plane.data.materials[0], group)
    ours = blocks(render("tiles"), 12, 18)[2:10, 2:16]
    theirs = blocks(grey(bake / "preview/floor.png"), 12, 18)[2:10, 2:16]
    open_floor = numpy.ones(ours.shape, dtype=bool)
    open_floor[2:6, 5:9] = False
    agreement = numpy.corrcoef(ours[open_floor], theirs[open_floor])[0, 1]
    check(agreement > 0.9, f"dirt over tiles lies where it was baked: correlation {agreement:.3f}")
    bpy.data.objects.remove(plane)


def update(settings, floor):
    before, mesh = counts(), floor.data.name
    bpy.ops.trodden.update()
    check(counts() == before, f"an update makes no doubles: {counts()}")
    settings.people = 20
    bpy.ops.trodden.bake()
    check(counts() == before and bpy.data.objects["floor_0_0"].data.name == mesh, "another bake neither")
    root = bpy.data.objects["room"]
    root.location.z += 3.0
    own = bpy.data.materials.new("own")
    bpy.data.objects["walls_0"].data.materials[0] = own
    settings.origin = (10.0, 0.0, 0.0)
    bpy.ops.trodden.update()
    check(tuple(root.location) == (10.0, 0.0, 3.0), "the scene goes with its place, and stays where it was put")
    check(bpy.data.objects["walls_0"].data.materials[0] == own, "a material of one's own stays")
    settings.origin = (0.0, 0.0, 0.0)


def outline(settings):
    """A floor that stands 2 m up, away from the origin, and is turned; a box stands on it."""
    bpy.ops.mesh.primitive_plane_add(size=1.0, location=(40.0, 30.0, 2.0), rotation=(0.0, 0.0, math.radians(90)))
    slab = bpy.context.object
    slab.name, slab.scale = "slab", (4.0, 6.0, 1.0)
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=(40.0, 30.0, 2.5))
    box = bpy.context.object
    slab.select_set(True)
    bpy.context.view_layer.update()
    plan = importlib.import_module(f"{MODULE}.plan")
    scene = importlib.import_module(f"{MODULE}.scene")
    drawn, (x, y), height = plan.outline(scene.triangles([slab, box]), 0.05)
    check(drawn.shape == (100, 140) and abs(drawn.sum() * 0.05 ** 2 - 23.0) < 0.3 and abs(height - 2.0) < 1e-4,
          f"outline: {drawn.shape}, {drawn.sum() * 0.05 ** 2:.2f} m2 at {height:.2f} m")
    settings.source, settings.name, settings.people = "MESH", "slab", 30
    check(bpy.ops.trodden.bake() == {"FINISHED"}, "a floor of meshes is baked")
    near = [a - b for a, b in zip(settings.origin, (36.5, 27.5, 2.0))]
    check(max(map(abs, near)) < 1e-3, f"the dirt stands where the mesh does: {tuple(settings.origin)}")
    check(any(node.type == "GROUP" for node in slab.material_slots[0].material.node_tree.nodes), "it lies on the mesh")
    check(not box.material_slots, "what stands on it keeps its material")

    layers = box.data.uv_layers
    layers.remove(layers[0])
    slab.select_set(False)
    box.select_set(True)
    words = fails(bpy.ops.trodden.project)
    check("has no UV map" in words, f"without texture coordinates: {words.strip()}")
    box.select_set(False)
    slab.select_set(True)
    settings.size = 256
    bpy.ops.trodden.project()
    picture = grey(OUT / "bakes/projected/slab_trodden.png")
    check(picture.min() > 0.0 and picture.std() > 0.004, f"dirt on its own UVs: spread {picture.std():.4f}")
    settings.source, settings.name = "PLAN", ""


def cancel(settings):
    """Progress is seen, and a cancelled bake leaves the earlier one."""
    bake = importlib.import_module(f"{MODULE}.bake")
    settings.people, settings.quick = 5000, False
    manifest = OUT / "bakes/room/manifest.json"
    before, shares = manifest.stat().st_mtime_ns, []

    def watch():
        end = time.monotonic() + 20.0
        while bake.current is None and time.monotonic() < end:
            time.sleep(0.01)
        run = bake.current
        while run.share < 0.2 and run.running() and time.monotonic() < end:
            shares.append(run.share)
            time.sleep(0.02)
        shares.append(run.share)
        run.cancel()

    watcher = threading.Thread(target=watch)
    watcher.start()
    result = bpy.ops.trodden.bake()
    watcher.join()
    steps = len(set(shares))
    check(shares == sorted(shares) and steps > 1, f"progress grows: {steps} steps to {shares[-1]:.2f}")
    check(result == {"CANCELLED"} and bake.current is None, "a cancelled bake ends")
    left = sorted(path.name for path in (OUT / "bakes").iterdir())
    check(manifest.stat().st_mtime_ns == before and not [name for name in left if name[0] == "."],
          f"the earlier bake stays, nothing half done: {', '.join(left)}")


def main():
    PICTURES.mkdir(parents=True, exist_ok=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    before = traces()
    bpy.ops.extensions.package_install_files(filepath=str(ARCHIVE), repo="user_default", enable_on_install=True)
    check(hasattr(bpy.types.Scene, "trodden"), f"installed into Blender {bpy.app.version_string}")
    bpy.context.preferences.addons[MODULE].preferences.program = os.environ["TRODDEN"]
    settings = bpy.context.scene.trodden
    settings.folder = str(OUT / "bakes")
    floor = settle()
    slide(settings, compare(floor))
    dress(settings)
    tiles(importlib.import_module(f"{MODULE}.plan"))
    update(settings, floor)
    draw()
    click()
    run_modal()
    outline(settings)
    cancel(settings)
    bpy.ops.preferences.addon_disable(module=MODULE)
    check(traces() <= before, f"nothing stays behind: {', '.join(sorted(traces() - before)) or 'nothing'}")
    bpy.ops.preferences.addon_enable(module=MODULE)
    check(hasattr(bpy.types.Scene, "trodden"), "it can be enabled again")
    print(f"{len(failed)} failed" if failed else "all is well")
    return 1 if failed else 0


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    # Blender 4.2 as a module crashes when Python ends after any import of glTF, with this extension and without.
    os._exit(status)
