"""The panel, in the side bar of the 3D view and of the image editor."""

import bpy

from . import bake, scene


def draw_panel(self, context):
    layout, settings = self.layout, context.scene.trodden
    layout.use_property_split, layout.use_property_decorate = True, False
    layout.prop(settings, "source")
    if settings.source == "PLAN":
        layout.prop(settings, "plan")
        layout.prop(settings, "metres_per_pixel")
        if context.area.type == "IMAGE_EDITOR":
            layout.operator("trodden.scale", icon="DRIVER_DISTANCE")
        else:
            layout.operator("trodden.show_plan", icon="IMAGE_DATA")
    else:
        layout.prop(settings, "outline_metres_per_pixel")
    column = layout.column()
    # A scenario says all this itself.
    column.enabled = settings.source == "MESH" or not settings.plan.lower().endswith(".toml")
    for name in ("people", "use", "look", "material", "passes", "seed"):
        column.prop(settings, name)
    for name in ("quick", "folder", "name"):
        layout.prop(settings, name)
    if bake.current is None:
        layout.operator("trodden.bake", icon="PLAY")
    else:
        layout.progress(factor=bake.current.share, text=bake.current.said())
        layout.operator("trodden.cancel", icon="CANCEL")
    layout.separator()
    layout.prop(settings, "bake")
    layout.operator("trodden.update", icon="IMPORT")
    column = layout.column()
    column.enabled = scene.group_of(settings.bake) is not None
    column.prop(settings, "live")
    column.prop(settings, "colour")
    for name in ("film", "prints", "edge", "marks"):
        column.prop(settings, name, slider=True)
    column.prop(settings, "origin")
    column.operator("trodden.lay_over", icon="MATERIAL")
    column.prop(settings, "size")
    column.operator("trodden.project", icon="UV")


class TRODDEN_PT_view(bpy.types.Panel):
    bl_label = bl_category = "Trodden"
    bl_space_type, bl_region_type = "VIEW_3D", "UI"
    draw = draw_panel


class TRODDEN_PT_image(bpy.types.Panel):
    bl_label = bl_category = "Trodden"
    bl_space_type, bl_region_type = "IMAGE_EDITOR", "UI"
    draw = draw_panel


CLASSES = (TRODDEN_PT_view, TRODDEN_PT_image)
