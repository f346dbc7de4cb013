"""The operators beside the bake: dirt on objects of one's own, and the scale by two clicks."""

import bpy
from bpy.props import FloatProperty

from . import bake, plan, scene


class TRODDEN_OT_lay_over(bpy.types.Operator):
    """Lay the dirt over the materials of the selected objects, by their place in the world"""
    bl_idname = "trodden.lay_over"
    bl_label = "Lay over Selected"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        settings = context.scene.trodden
        group, meshes = scene.group_of(settings.bake), bake.chosen_meshes(context)
        if group is None or not meshes:
            self.report({"ERROR"}, "Import a bake first" if group is None else "No mesh is selected")
            return {"CANCELLED"}
        try:
            scene.lay_over(meshes, group, settings.colour)
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        scene.set_amounts(settings)
        return {"FINISHED"}


class TRODDEN_OT_project(bpy.types.Operator):
    """Bake the selected objects' colour, dirt included, to textures on their own UV maps"""
    bl_idname = "trodden.project"
    bl_label = "Bake to Own UVs"

    def execute(self, context):
        settings, meshes = context.scene.trodden, bake.chosen_meshes(context)
        if not meshes:
            self.report({"ERROR"}, "No mesh is selected")
            return {"CANCELLED"}
        try:
            for thing in meshes:
                file = scene.project(context, thing, settings.size, bake.folder_of(settings) / "projected")
                self.report({"INFO"}, f"Wrote {file}")
        except (ValueError, OSError, RuntimeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class TRODDEN_OT_show_plan(bpy.types.Operator):
    """Open the plan in a window of its own, where its scale can be clicked"""
    bl_idname = "trodden.show_plan"
    bl_label = "Show Plan"

    def execute(self, context):
        try:
            image = bpy.data.images.load(bpy.path.abspath(context.scene.trodden.plan), check_existing=True)
        except RuntimeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if not bpy.app.background:
            bpy.ops.wm.window_new()
            area = context.window_manager.windows[-1].screen.areas[0]
            area.type = "IMAGE_EDITOR"
            area.spaces.active.image = image
            area.spaces.active.show_region_ui = True
        return {"FINISHED"}


class TRODDEN_OT_scale(bpy.types.Operator):
    """Click two points of the plan whose distance you know"""
    bl_idname = "trodden.scale"
    bl_label = "Scale by Two Clicks"

    @classmethod
    def poll(cls, context):
        return context.area is not None and context.area.type == "IMAGE_EDITOR" and context.space_data.image is not None

    def invoke(self, context, _event):
        self.points = []
        context.window_manager.modal_handler_add(self)
        context.area.header_text_set("Click the first of two points whose distance you know; Esc cancels")
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type in {"ESC", "RIGHTMOUSE"}:
            context.area.header_text_set(None)
            return {"CANCELLED"}
        if event.type != "LEFTMOUSE" or event.value != "PRESS":
            return {"PASS_THROUGH"}
        # The button was pressed in the side bar, the points lie in the window's main part.
        region = next(region for region in context.area.regions if region.type == "WINDOW")
        across, up = region.view2d.region_to_view(event.mouse_x - region.x, event.mouse_y - region.y)
        width, height = context.space_data.image.size
        self.points.append((across * width, up * height))
        if len(self.points) < 2:
            context.area.header_text_set("Click the second point; Esc cancels")
            return {"RUNNING_MODAL"}
        context.area.header_text_set(None)
        a, b = self.points
        bpy.ops.trodden.set_scale("INVOKE_DEFAULT", x0=a[0], y0=a[1], x1=b[0], y1=b[1])
        return {"FINISHED"}


class TRODDEN_OT_set_scale(bpy.types.Operator):
    """Set the scale from two points of the plan and their distance"""
    bl_idname = "trodden.set_scale"
    bl_label = "Distance of the Two Points"
    bl_options = {"UNDO"}

    x0: FloatProperty(options={"HIDDEN"})
    y0: FloatProperty(options={"HIDDEN"})
    x1: FloatProperty(options={"HIDDEN"})
    y1: FloatProperty(options={"HIDDEN"})
    metres: FloatProperty(name="Metres", min=0.0, default=1.0, precision=3)

    def invoke(self, context, _event):
        # Without a window there is nobody to ask.
        return self.execute(context) if bpy.app.background else context.window_manager.invoke_props_dialog(self)

    def execute(self, context):
        try:
            metres_per_pixel = plan.scale((self.x0, self.y0), (self.x1, self.y1), self.metres)
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        context.scene.trodden.metres_per_pixel = metres_per_pixel
        return {"FINISHED"}


CLASSES = (TRODDEN_OT_lay_over, TRODDEN_OT_project, TRODDEN_OT_show_plan, TRODDEN_OT_scale, TRODDEN_OT_set_scale)
