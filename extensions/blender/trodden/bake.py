"""The operators that bake: prepare a plan, run the program, bring the result in."""

import time
from pathlib import Path

import bpy

from . import plan, program, scene

# The bake that runs now: there is one at a time.
current = None


def folder_of(settings):
    """Where bakes go. A file that is not saved yet has no folder of its own."""
    if settings.folder.startswith("//") and not bpy.data.filepath:
        return Path.home() / "trodden"
    return Path(bpy.path.abspath(settings.folder))


def chosen_meshes(context):
    return [thing for thing in context.selected_objects if thing.type == "MESH"]


def prepare(context):
    """Writes the scenario; returns the command, the bake's folder, the plan's place, and the meshes that are floor."""
    settings = context.scene.trodden
    preferences = context.preferences.addons[__package__].preferences
    executable = program.find(bpy.path.abspath(preferences.program))
    if executable is None:
        raise ValueError("the trodden program was not found: choose it in this add-on's preferences")
    folder = folder_of(settings)
    origin, metres_per_pixel, floors = (0.0, 0.0, 0.0), settings.metres_per_pixel or None, []
    if settings.source == "MESH":
        meshes = chosen_meshes(context)
        if not meshes:
            raise ValueError("no mesh is selected: select the floor, and what stands on it")
        metres_per_pixel = settings.outline_metres_per_pixel
        drawn, (x, y), height = plan.outline(scene.triangles(meshes), metres_per_pixel)
        name, origin = settings.name or bpy.path.clean_name(meshes[0].name), (x, y, height)
        # What stands on the floor keeps its material: the dirt is known from above only.
        floors = [thing for thing in meshes if len(plan.floor_of(scene.triangles([thing]), height))]
        folder.mkdir(parents=True, exist_ok=True)
        source = folder / f"{name}.outline.png"
        plan.write_png(source, drawn)
    else:
        source = Path(bpy.path.abspath(settings.plan))
        if not settings.plan or not source.is_file():
            raise ValueError("choose a plan first")
        name = settings.name or source.stem
    folder.mkdir(parents=True, exist_ok=True)
    bake = folder / name
    if source.suffix.lower() != ".toml":
        file = folder / f"{name}.blender.toml"
        file.write_text(program.scenario(
            source.resolve(), metres_per_pixel, settings.people, settings.seed,
            None if settings.use == "AUTO" else settings.use, settings.look, settings.material, settings.passes),
            encoding="utf-8")
        source = file
    command = [executable, "bake", str(source), "--target", "blender", "--force", "--color", "never", "-o", str(bake)]
    return command + (["--quick"] if settings.quick else []), bake, origin, floors


class TRODDEN_OT_bake(bpy.types.Operator):
    """Walk a crowd through the plan and bring in the dirt that it leaves"""
    bl_idname = "trodden.bake"
    bl_label = "Bake"
    bl_options = {"UNDO"}

    timer = None

    @classmethod
    def poll(cls, _context):
        return current is None

    def start(self, context):
        global current
        try:
            command, self.bake, self.origin, floors = prepare(context)
            current = program.Run(command)
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return False
        self.of_meshes = context.scene.trodden.source == "MESH"
        # By name: an undo while the program runs makes all objects anew.
        self.meshes = [thing.name for thing in floors]
        return True

    def execute(self, context):
        """Waits for the bake: for scripts, and for Blender without a window."""
        if not self.start(context):
            return {"CANCELLED"}
        while current.running():
            time.sleep(0.05)
        return self.finish(context)

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        if not self.start(context):
            return {"CANCELLED"}
        self.timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        for window in context.window_manager.windows:
            for area in window.screen.areas:
                area.tag_redraw()
        return {"PASS_THROUGH"} if current.running() else self.finish(context)

    def cancel(self, context):
        """Blender ends the operator, as when another file is opened."""
        stop()
        self.clear(context)

    def clear(self, context):
        global current
        current = None
        if self.timer:
            context.window_manager.event_timer_remove(self.timer)
            self.timer = None

    def finish(self, context):
        run = current
        self.clear(context)
        errors, warnings = run.messages()
        if run.cancelled:
            self.report({"INFO"}, "The bake was cancelled; an earlier one is as it was")
            return {"CANCELLED"}
        if run.process.returncode != 0:
            self.report({"ERROR"}, " ".join(errors) or f"trodden ended with {run.process.returncode}")
            return {"CANCELLED"}
        for warning in warnings:
            self.report({"WARNING"}, warning)
        settings = context.scene.trodden
        # The place of a plan is the user's, unless meshes were baked before.
        if self.of_meshes or settings.of_meshes:
            settings.bake = ""
            settings.origin = self.origin
        settings.bake, settings.of_meshes = str(self.bake), self.of_meshes
        meshes = [bpy.data.objects[name] for name in self.meshes if name in bpy.data.objects]
        return bring_in(self, context, meshes)


def stop():
    """Ends the bake that runs, if any."""
    if current is not None:
        current.cancel()
        current.end()


def bring_in(operator, context, meshes):
    """Imports the bake of the settings, or lays it over the meshes that it was made from."""
    settings = context.scene.trodden
    try:
        bake = Path(bpy.path.abspath(settings.bake))
        group = scene.bring_in(bake, settings.origin, with_scene=not settings.of_meshes)
        scene.lay_over(meshes, group, settings.colour)
        scene.show_floor(settings)
    except (ValueError, OSError, RuntimeError) as error:
        operator.report({"ERROR"}, str(error))
        return {"CANCELLED"}
    return {"FINISHED"}


class TRODDEN_OT_cancel(bpy.types.Operator):
    """Stop the bake; an earlier one stays as it was"""
    bl_idname = "trodden.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, _context):
        return current is not None

    def execute(self, _context):
        current.cancel()
        return {"FINISHED"}


class TRODDEN_OT_update(bpy.types.Operator):
    """Import the bake, or update what was imported of it; your materials and places stay"""
    bl_idname = "trodden.update"
    bl_label = "Import / Update"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        return bring_in(self, context, [])


CLASSES = (TRODDEN_OT_bake, TRODDEN_OT_cancel, TRODDEN_OT_update)
