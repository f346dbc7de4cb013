"""Holds the worlds of bakes, as libsdformat reads them, against scene.glb and the manifest.

    load.py READER BAKE...

READER is tests/sdf/load.cpp, built. Exits with 1 and says what differs.
"""

import json
import pathlib
import struct
import subprocess
import sys


class Check:
    def __init__(self):
        self.failures = 0

    def right(self, what, right):
        self.failures += not right
        print(f"{'ok ' if right else 'BAD'}  {what}")


def meshes_of_glb(file):
    """Corners of triangles by the name of their node, in glTF's frame."""
    bytes_ = file.read_bytes()
    length = struct.unpack_from("<I", bytes_, 12)[0]
    gltf, binary = json.loads(bytes_[20:20 + length]), bytes_[28 + length:]
    found = {}

    def read(accessor):
        accessor = gltf["accessors"][accessor]
        kind = {5123: "H", 5125: "I", 5126: "f"}[accessor["componentType"]]
        count = accessor["count"] * {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        return struct.unpack_from(f"<{count}{kind}", binary, gltf["bufferViews"][accessor["bufferView"]]["byteOffset"])

    for node in (node for node in gltf["nodes"] if "mesh" in node):
        primitive, = gltf["meshes"][node["mesh"]]["primitives"]
        flat = read(primitive["attributes"]["POSITION"])
        points = list(zip(flat[::3], flat[1::3], flat[2::3]))
        found[node["name"]] = [points[n] for n in read(primitive["indices"])]
    return found


def turned(point, quaternion):
    w, (x, y, z) = quaternion[0], quaternion[1:]
    cross = lambda a, b: (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    across = [2.0 * c for c in cross((x, y, z), point)]
    return [p + w * a + c for p, a, c in zip(point, across, cross((x, y, z), across))]


def placed(part, point):
    return [p + q for p, q in zip(turned(point, part["turn"]), part["place"])]


def prism(part):
    """Outline from above, lowest and greatest height."""
    if "box" in part:
        x, y, z = (side / 2 for side in part["box"])
        corners = [placed(part, (i * x, j * y, 0.0)) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        return [corner[:2] for corner in corners], part["place"][2] - z, part["place"][2] + z
    corners = [placed(part, (x, y, 0.0)) for x, y in part["points"]]
    return [corner[:2] for corner in corners], corners[0][2], corners[0][2] + part["height"]


def area(outline):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(outline, outline[1:] + outline[:1])) / 2


def bounds(points):
    return [(min(values), max(values)) for values in zip(*points)]


def near(a, b, off=2e-3):
    return all(abs(p - q) <= off for pair in zip(a, b) for p, q in zip(*pair))


def main(reader, bakes):
    check = Check()
    for bake in map(pathlib.Path, bakes):
        print(bake.name)
        read = subprocess.run([reader, bake / "scene.sdf"], capture_output=True, text=True, check=False)
        check.right(f"libsdformat has nothing to say{read.stderr and ': ' + read.stderr}", read.returncode == 0)
        if read.returncode:
            continue
        world, manifest = json.loads(read.stdout), json.loads((bake / "manifest.json").read_text())
        check.right("the manifest lists it", "scene.sdf" in manifest["files"])
        check.right(f"{world['world']}: SDFormat 1.9, static, one sun, 1 kHz",
                    [world[k] for k in ("version", "static", "lights", "step")] == ["1.9", True, 1, 0.001])
        meshes = meshes_of_glb(bake / "scene.glb")
        hulls = {name for name in meshes if name.startswith("UCX_")}
        visuals = [part for part in world["parts"] if part["kind"] == "visual"]
        shown = {part["part"] for part in visuals}
        check.right(f"shows {shown} of scene.glb, no hulls", {part["mesh"] for part in visuals} == {"scene.glb"}
                    and shown == ({""} if not hulls else set(meshes) - hulls))

        # As Gazebo leaves the axes of glTF alone, the visual's pose has to raise the walls.
        tops = [placed(visuals[0], point) for point in meshes["wall_tops"]]
        solids = [part for part in world["parts"] if part["kind"] == "collision"]
        check.right("the ground is level", [part["plane"] for part in solids if "plane" in part] == [[0, 0, 1]])
        prisms = [(part["name"], *prism(part)) for part in solids if "plane" not in part]
        check.right(f"{len(prisms)} solids, all with an area", all(area(outline) > 0 and low < high
                                                                   for _, outline, low, high in prisms))
        walls = [solid for solid in prisms if solid[0].startswith("wall_tops")]
        reach = bounds([[*corner, height] for _, outline, *span in walls for corner in outline for height in span])
        check.right(f"walls reach as far as those that are seen: {reach}", near(reach, bounds(tops)))
        height = reach[2][1]
        level = [[p[:2] for p in tops[n:n + 3]] for n in range(0, len(tops), 3)
                 if all(abs(p[2] - height) < 1e-3 for p in tops[n:n + 3])]
        lintels = [outline for _, outline, low, high in prisms if low > 0.5 and high > height - 1e-3]
        seen, felt = sum(map(area, level)), sum(area(o) for o in lintels) + sum(area(o) for _, o, *_ in walls)
        check.right(f"walls and lintels cover {felt:.2f} m2, their tops {seen:.2f} m2", abs(felt / seen - 1) < 0.01)
    return check.failures


if __name__ == "__main__":
    sys.exit(1 if main(sys.argv[1], sys.argv[2:]) else 0)
