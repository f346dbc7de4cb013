"""Brings a bake into the scene. How dirt lies on a material stands in trodden_blender.py, which each bake has too."""

import json
from pathlib import Path

import bpy
import numpy
from mathutils import Vector

from . import trodden_blender as dirt

GROUP = "Trodden dirt "
LIVE = "Trodden floor "
# How far an imported object has been moved from the world's origin by the plan's place; the rest is the user's.
PLACED = "trodden_placed"


def triangles(objects):
    """All triangles of meshes as they are seen, in the world: (n, 3 corners, xyz)."""
    parts = []
    depsgraph = bpy.context.evaluated_depsgraph_get()
    for thing in objects:
        seen = thing.evaluated_get(depsgraph)
        mesh = seen.to_mesh()
        mesh.calc_loop_triangles()
        points = numpy.empty(len(mesh.vertices) * 3)
        mesh.vertices.foreach_get("co", points)
        corners = numpy.empty(len(mesh.loop_triangles) * 3, dtype=numpy.int32)
        mesh.loop_triangles.foreach_get("vertices", corners)
        matrix = numpy.array(thing.matrix_world)
        points = points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
        found = points[corners.reshape(-1, 3)]
        # A mirrored object has its faces the other way round.
        parts.append(found[:, ::-1] if numpy.linalg.det(matrix[:3, :3]) < 0 else found)
        seen.to_mesh_clear()
    return numpy.concatenate(parts) if parts else numpy.empty((0, 3, 3))


def read_manifest(bake):
    file = Path(bake) / "manifest.json"
    if not file.is_file():
        raise ValueError(f"{bake} holds no bake: bake first, or choose the folder of a bake")
    manifest = json.loads(file.read_text(encoding="utf-8"))
    if manifest.get("target", {}).get("name") != "blender":
        raise ValueError("this bake is for another program: bake it here, or with --target blender")
    return manifest


def objects_of(bake):
    return [thing for thing in bpy.data.objects if thing.get(dirt.TAG, "").startswith(f"{bake.name}/")]


def bring_in(bake, origin, with_scene):
    """Imports a bake, or updates what an earlier call has made of it. Returns its node group."""
    bake = Path(bake)
    manifest = read_manifest(bake)
    if with_scene and (bake / "scene.glb").is_file():
        dirt.import_scene(bake)
        place(bake, origin)
    dirt.make_wall_group(bake, manifest)
    return dirt.make_group(bake, manifest)


def place(bake, origin):
    """Moves what was imported of a bake with the plan's place."""
    for thing in objects_of(bake):
        if thing.parent is None:
            thing.location += Vector(origin) - Vector(thing.get(PLACED, (0.0, 0.0, 0.0)))
            thing[PLACED] = origin[:]


def group_of(bake):
    return bpy.data.node_groups.get(GROUP + Path(bake).name) if bake else None


def group_nodes(group=None):
    """The nodes of all materials that lay a bake's dirt, or any bake's, over a floor."""
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else ():
            tree = node.node_tree if node.type == "GROUP" else None
            if tree is not None and (tree == group if group else tree.name.startswith(GROUP)):
                yield node


def set_amounts(settings):
    """Gives all nodes of the bake, and its objects, what the sliders and the place say."""
    group = group_of(settings.bake)
    for node in group_nodes(group) if group else ():
        for name in dirt.AMOUNTS:
            node.inputs[name].default_value = getattr(settings, name.lower())
        node.inputs["Offset"].default_value = settings.origin
    if group:
        place(Path(settings.bake), settings.origin)


def new_material(name, colour):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = 0.35
    return material


def lay_over(objects, group, colour):
    """Lays dirt over all materials of objects; one without any gets a plain floor."""
    for thing in objects:
        if not any(slot.material for slot in thing.material_slots):
            thing.data.materials.clear()
            thing.data.materials.append(new_material(f"{thing.name} floor", colour))
        for slot in thing.material_slots:
            if slot.material:
                dirt.lay_over(slot.material, group)


def show_floor(settings):
    """Gives the imported floor its baked material, or a clean one on which the sliders lay the dirt."""
    bake, group = Path(settings.bake), group_of(settings.bake)
    if group is None:
        return
    for thing in objects_of(bake):
        tag = thing[dirt.TAG]
        baked = next((material for material in bpy.data.materials if material.get(dirt.TAG) == tag), None)
        if thing.type != "MESH" or not tag.startswith(f"{bake.name}/floor_") or baked is None:
            continue
        name = LIVE + bake.name
        if settings.live:
            # Otherwise a saved file would lose it while it is not shown.
            baked.use_fake_user = True
            shown = bpy.data.materials.get(name) or new_material(name, settings.colour)
            dirt.lay_over(shown, group)
        else:
            shown = baked
        # Materials of the user's own stay.
        if thing.data.materials[0] in (baked, bpy.data.materials.get(name)):
            thing.data.materials[0] = shown
    set_amounts(settings)


def project(context, thing, size, folder):
    """Bakes an object's colour, dirt included, to its own texture coordinates; returns the image's file."""
    if not thing.data.uv_layers:
        raise ValueError(f"{thing.name} has no UV map: unwrap it first")
    if not any(slot.material for slot in thing.material_slots):
        raise ValueError(f"{thing.name} has no material: lay the dirt over it first")
    name = f"{thing.name} trodden"
    image = bpy.data.images.get(name)
    if image and tuple(image.size) != (size, size):
        image.scale(size, size)
    image = image or bpy.data.images.new(name, size, size)
    scene, targets = context.scene, []
    selected, active, engine = list(context.selected_objects), context.view_layer.objects.active, scene.render.engine
    samples = scene.cycles.samples
    try:
        for material in {slot.material for slot in thing.material_slots if slot.material}:
            nodes = material.node_tree.nodes
            node = nodes.new("ShaderNodeTexImage")
            targets.append((nodes, node, nodes.active))
            node.image = image
            nodes.active = node
        for other in selected:
            other.select_set(False)
        thing.select_set(True)
        context.view_layer.objects.active = thing
        scene.render.engine = "CYCLES"
        scene.cycles.samples = 1
        bpy.ops.object.bake(type="DIFFUSE", pass_filter={"COLOR"}, margin=8, use_clear=True)
    finally:
        for nodes, node, before in targets:
            nodes.remove(node)
            nodes.active = before
        scene.render.engine, scene.cycles.samples = engine, samples
        thing.select_set(False)
        for other in selected:
            other.select_set(True)
        context.view_layer.objects.active = active
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{bpy.path.clean_name(thing.name)}_trodden.png"
    image.filepath_raw, image.file_format = str(file), "PNG"
    image.save()
    return file
