"""Bakes plans and floors with the trodden program, and lays the dirt over materials."""

import bpy

from . import bake, panel, settings, tools

CLASSES = (*settings.CLASSES, *bake.CLASSES, *tools.CLASSES, *panel.CLASSES)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.trodden = bpy.props.PointerProperty(type=settings.TroddenSettings)


def unregister():
    bake.stop()
    del bpy.types.Scene.trodden
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
