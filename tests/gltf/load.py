"""Loads the scene of a bake with trimesh, as a tool of somebody else's would, and holds it against the manifest.

    load.py BAKE...

Exits with 1 and says what differs.
"""

import json
import pathlib
import sys

import numpy as np
import trimesh
from PIL import Image


class Check:
    def __init__(self):
        self.failures = 0

    def near(self, what, found, wanted, tolerance):
        """`tolerance` is a share of what is wanted."""
        self.right(f"{what:<36} {found:12.4f}   {wanted:12.4f} wanted", abs(found - wanted) <= tolerance * abs(wanted))

    def right(self, what, right):
        self.failures += not right
        print(f"{'ok ' if right else 'BAD'}  {what}")


def shoelace(points):
    """Area on the right of a loop."""
    x, y = np.array(points).T
    return 0.5 * np.sum(np.roll(x, -1) * y - x * np.roll(y, -1))


def length(outline):
    """Length of a loop without its openings."""
    points = np.array(outline["points"])
    edges = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    edges[[edge for edge, _ in outline["openings"]]] = 0.0
    return edges.sum()


def parts(scene, kind):
    """Meshes by the start of their node's name, in the plan's frame: x, y, height."""
    found = {}
    for node in sorted(scene.graph.nodes_geometry):
        transform, name = scene.graph[node]
        # Godot makes colliders of nodes of such names.
        node = node.removesuffix("-col")
        if node.startswith(kind):
            mesh = scene.geometry[name].copy().apply_transform(transform)
            x, height, minus_y = mesh.vertices.T
            mesh.vertices = np.column_stack([x, -minus_y, height])
            found[node] = mesh
    return found


def floor(check, tiles, manifest):
    wanted = sum(shoelace(outline["points"]) for outline in manifest["outlines"])
    check.near("floor, m2", sum(mesh.area for mesh in tiles.values()), wanted, 1e-5)
    check.right("floor lies level and looks up", all(np.all(mesh.face_normals[:, 2] > 0.999) for mesh in tiles.values()))
    entries = manifest["floor"]["tiles"]
    check.right(f"{len(tiles)} tiles", len(tiles) == len(entries))
    places = []
    for mesh in tiles.values():
        # trimesh has v upward.
        uv = mesh.visual.uv
        errors = []
        for entry in entries:
            low, high = np.array(entry["min_m"]), np.array(entry["max_m"])
            errors.append(np.abs(low + uv * (high - low) - mesh.vertices[:, :2]).max())
        places.append(min(errors))
    check.right(f"coordinates say where in its tile a corner lies, to {max(places):.1e} m", max(places) < 0.1)


def walls(check, sheets, manifest):
    entry = manifest["walls"]
    wanted = sum(length(outline) for outline in manifest["outlines"]) * entry["height_m"]
    check.near("walls, m2", sum(mesh.area for mesh in sheets.values()), wanted, 1e-4)
    check.right(f"{len(sheets)} sheets", len(sheets) == len(entry["sheets"]))
    upright = all(np.abs(mesh.face_normals[:, 2]).max() < 1e-3 for mesh in sheets.values())
    check.right("walls stand upright", upright)
    worst = 0.0
    # Their names count upward, in the manifest's order.
    in_order = sorted(sheets, key=lambda node: (len(node), node))
    for sheet, node in zip(entry["sheets"], in_order):
        # How large a triangle is on the sheet follows from its size in metres.
        size = np.array([sheet["width_px"], sheet["height_px"]])
        mesh = sheets[node]
        worst = max(worst, outside(mesh, sheet))
        texels = (mesh.visual.uv * size)[mesh.faces]
        a, b = texels[:, 1] - texels[:, 0], texels[:, 2] - texels[:, 0]
        area = 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
        off = np.abs(area / entry["texels_per_metre"] ** 2 - mesh.area_faces)
        check.right(f"texels of sheet {sheet['basecolor']} are as large as they should be", off.max() < 0.02)
    check.right(f"walls lie on their strips, to {worst:.2f} texels", worst < 0.6)


def outside(mesh, sheet):
    """How far corners lie outside of all strips of a sheet, texels."""
    size = np.array([sheet["width_px"], sheet["height_px"]])
    texels = mesh.visual.uv * [1, -1] * size + [0, sheet["height_px"]]
    beyond = np.full(len(texels), np.inf)
    for strip in sheet["strips"]:
        left, top, width, height = strip["rect_px"]
        low, high = np.array([left, top]), np.array([left + width, top + height])
        beyond = np.minimum(beyond, np.maximum(low - texels, texels - high).max(axis=1))
    return max(beyond.max(), 0.0)


def wall_faces(check, bake, sheets, manifest):
    """Extras say which wall face a triangle shows: their areas are those of the manifest's strips."""
    nodes = {node["name"].removesuffix("-col"): node for node in document(bake)["nodes"]}
    height = manifest["walls"]["height_m"]
    for number, sheet in enumerate(manifest["walls"]["sheets"]):
        wanted, found = {}, {}
        for strip in sheet["strips"]:
            wanted[strip["face"]] = wanted.get(strip["face"], 0.0) + (strip["to_m"] - strip["from_m"]) * height
        extras = nodes[f"walls_{number}"]["extras"]
        areas = np.split(sheets[f"walls_{number}"].area_faces, extras["first_triangles"][1:])
        for face, area in zip(extras["wall_faces"], areas):
            found[face] = found.get(face, 0.0) + area.sum()
        off = max(abs(found.get(face, 0.0) - area) for face, area in wanted.items())
        check.right(f"extras of walls_{number} tell its {len(wanted)} wall faces, to {off:.4f} m2",
                    set(found) == set(wanted) and off < 0.02)


def plain(check, scene):
    """Coordinates of surfaces without an image are metres: a tiling material has its size."""
    for name in ("wall_tops", "clean_wall"):
        mesh = scene.geometry.get(name)
        if mesh is None:
            continue
        texels = mesh.visual.uv[mesh.faces]
        a, b = texels[:, 1] - texels[:, 0], texels[:, 2] - texels[:, 0]
        area = 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
        check.near(f"{name} in its coordinates, m2", area.sum(), mesh.area, 1e-3)


def light_maps(check, bake):
    """Second coordinates: within the light map, and as dense everywhere in it."""
    gltf, binary = parts_of_file(bake)
    for mesh in gltf["meshes"]:
        attributes = mesh["primitives"][0]["attributes"]
        place, uv = (read(gltf, binary, attributes[name]) for name in ("POSITION", "TEXCOORD_1"))
        corners = read(gltf, binary, mesh["primitives"][0]["indices"]).reshape(-1, 3)
        a, b = place[corners[:, 1]] - place[corners[:, 0]], place[corners[:, 2]] - place[corners[:, 0]]
        area = 0.5 * np.linalg.norm(np.cross(a, b), axis=1)
        texels = uv[corners] * 1024
        a, b = texels[:, 1] - texels[:, 0], texels[:, 2] - texels[:, 0]
        # Slivers say little, unless there is nothing else.
        large = area > min(0.01, 0.5 * area.max())
        density = np.sqrt(0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])[large] / area[large])
        check.right(f"light map of {mesh['name']}: {density.min():.2f} to {density.max():.2f} texels per metre",
                    uv.min() >= 0.0 and uv.max() <= 1.0 and density.max() < 1.05 * density.min())


def read(gltf, binary, index):
    """The numbers of an accessor."""
    accessor = gltf["accessors"][index]
    kind = {5126: "<f4", 5125: "<u4", 5123: "<u2"}[accessor["componentType"]]
    each = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]]
    start = gltf["bufferViews"][accessor["bufferView"]]["byteOffset"]
    numbers = np.frombuffer(binary, kind, accessor["count"] * each, start)
    return numbers if each == 1 else numbers.reshape(-1, each).astype(float)


def cameras(check, bake, manifest):
    """Each still has its camera: place, direction and angle of view."""
    gltf = document(bake)
    for still in manifest["stills"]:
        name, camera = pathlib.Path(still["file"]).stem, still["camera"]
        node = next((node for node in gltf["nodes"] if node["name"] == name), None)
        if node is None:
            # The clean twin has the camera of the dirty one.
            check.right(f"{name} has a camera", name.endswith("_clean"))
            continue
        place = trimesh.transformations.quaternion_matrix(np.roll(node["rotation"], 1))
        heading, pitch = np.radians([camera["heading_deg"], camera["pitch_deg"]])
        x, y, z = camera["position_m"]
        ahead = [np.cos(heading) * np.cos(pitch), np.sin(pitch), -np.sin(heading) * np.cos(pitch)]
        right = np.abs(place[:3, :3] @ [0, 0, -1] - ahead).max() < 1e-6 and place[:3, :3] @ [0, 1, 0] @ [0, 1, 0] > 0.0
        right = right and np.allclose(node["translation"], [x, z, -y])
        lens = gltf["cameras"][node["camera"]]["perspective"]
        width = 2 * np.degrees(np.arctan(np.tan(lens["yfov"] / 2) * lens["aspectRatio"]))
        check.right(f"{name} has its camera, {width:.2f} degrees wide", right and abs(width - camera["fov_deg"]) < 1e-6)


def lamps(check, bake, tiles, manifest, wanted):
    """Lamps hang below the walls' height over the floor and shine down."""
    gltf = document(bake)
    nodes = [node for node in gltf["nodes"] if "KHR_lights_punctual" in node.get("extensions", {})]
    check.right(f"{len(nodes)} lamps", (len(nodes) > 10) == wanted)
    for node in nodes:
        x, height, minus_y = node["translation"]
        corners = np.concatenate([mesh.triangles[:, :, :2] for mesh in tiles.values()]) - [x, -minus_y]
        # On the left of all three sides of a triangle.
        over = np.any(np.all(np.cross(corners, np.roll(corners, -1, axis=1)) >= 0.0, axis=1))
        down = trimesh.transformations.quaternion_matrix(np.roll(node["rotation"], 1))[:3, :3] @ [0, 0, -1]
        right = over and down[1] < -0.999999 and 0 < manifest["walls"]["height_m"] - height < 0.05
        if not right:
            check.right(f"{node['name']} hangs over the floor and shines down", False)


def parts_of_file(bake):
    """JSON and binary chunk of scene.glb."""
    file = (bake / "scene.glb").read_bytes()
    binary = 20 + int.from_bytes(file[12:16], "little")
    return json.loads(file[20:binary]), file[binary + 8:]


def document(bake):
    return parts_of_file(bake)[0]


def images(check, meshes, bake, manifest, embedded):
    """Base colour and ORM of every part are there; those beside the scene are files that the manifest names."""
    entries = manifest["floor"]["tiles"] + manifest["walls"]["sheets"]
    files = {entry["basecolor"]: Image.open(bake / entry["basecolor"]) for entry in entries}
    for node, mesh in meshes.items():
        material = mesh.visual.material
        colour, orm = material.baseColorTexture, material.metallicRoughnessTexture
        there = colour is not None and orm is not None and min(colour.size) > 1 and min(orm.size) > 1
        if there and embedded:
            there = max(colour.size) <= 2048 and max(orm.size) <= 2048
        elif there:
            there = any(image.size == colour.size and image.tobytes() == colour.convert(image.mode).tobytes()
                        for image in files.values())
        check.right(f"{node} has its images, {colour.size if colour else None}", there)


def main(bakes):
    check = Check()
    for bake in map(pathlib.Path, bakes):
        print(bake.name)
        manifest = json.loads((bake / "manifest.json").read_text())
        scene = trimesh.load_scene(bake / "scene.glb", process=False)
        height = manifest["walls"]["height_m"]
        least, greatest = scene.bounds
        check.near("height, m", greatest[1], height, 1e-5)
        check.right("the floor is at 0", least[1] == 0.0)
        # Outer walls may stand a little beyond the plan.
        low, high = np.array([least[0], -greatest[2]]), np.array([greatest[0], -least[2]])
        size = np.array([manifest["plan"]["width_m"], manifest["plan"]["height_m"]])
        check.right(f"it lies where the plan does: {low} to {high} m", np.all(low > -0.5) and np.all(high < size + 0.5))
        tiles, sheets = parts(scene, "floor"), parts(scene, "walls_")
        floor(check, tiles, manifest)
        walls(check, sheets, manifest)
        meshes = [node["name"] for node in document(bake)["nodes"] if "mesh" in node]
        check.right(f"{len(meshes)} meshes, colliders for Godot only",
                    all(name.endswith("-col") == (bake.name == "godot") for name in meshes))
        light_maps(check, bake)
        wall_faces(check, bake, sheets, manifest)
        plain(check, scene)
        cameras(check, bake, manifest)
        lamps(check, bake, tiles, manifest, wanted=bake.name == "lamps")
        images(check, tiles | sheets, bake, manifest, embedded=bake.name == "embedded")
    return check.failures


if __name__ == "__main__":
    sys.exit(1 if main(sys.argv[1:]) else 0)
