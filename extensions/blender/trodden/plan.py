"""Plans: their scale by two points, and a plan drawn from meshes. Knows nothing of Blender's scene."""

import struct
import zlib
from pathlib import Path

import numpy

# Blockers are what reaches into this part of a person's height [m].
BODY = (0.3, 1.8)
# A floor may have steps of this height [m].
STEP = 0.3
# A face points up if its normal is within about 45 degrees of the vertical.
UP = 0.7
# Black around the floor [m]: without it the building would be open on all sides.
MARGIN = 0.5
LARGEST = 16384


def scale(a, b, metres):
    """Metres per pixel from two points [px] and their distance [m]."""
    pixels = float(numpy.hypot(b[0] - a[0], b[1] - a[1]))
    if pixels < 1.0:
        raise ValueError("the two points are the same: click two places that are far apart")
    if not metres > 0.0:
        raise ValueError("the distance has to be more than 0 m")
    return metres / pixels


def _normals(triangles):
    cross = numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    area = numpy.linalg.norm(cross, axis=1)
    return cross[:, 2] / numpy.maximum(area, 1e-12), area / 2


def floor_height(triangles):
    """The height [m] at which most of the upward faces lie."""
    up, area = _normals(triangles)
    flat = up > UP
    if not flat.any():
        raise ValueError("no face of the selected meshes points up: select the floor")
    heights = triangles[flat, :, 2].mean(axis=1)
    bins = numpy.round(heights / 0.1).astype(int)
    best = max(set(bins.tolist()), key=lambda value: area[flat][bins == value].sum())
    return float(numpy.average(heights[bins == best], weights=area[flat][bins == best]))


def floor_of(triangles, height):
    """The triangles that point up near a height."""
    up, area = _normals(triangles)
    return triangles[(up > UP) & (numpy.abs(triangles[:, :, 2].mean(axis=1) - height) < STEP) & (area > 0)]


def _fill(mask, corners):
    """Sets the pixels whose centres lie in a triangle; corners in pixels."""
    low = numpy.maximum(numpy.floor(corners.min(axis=0)).astype(int), 0)
    high = numpy.minimum(numpy.ceil(corners.max(axis=0)).astype(int), mask.shape[::-1])
    if (high <= low).any():
        return
    x, y = numpy.meshgrid(numpy.arange(low[0], high[0]) + 0.5, numpy.arange(low[1], high[1]) + 0.5)
    sides = []
    for k in range(3):
        (ax, ay), (bx, by) = corners[k], corners[(k + 1) % 3]
        sides.append((bx - ax) * (y - ay) - (by - ay) * (x - ax))
    # Both directions of rotation; a hair's breadth more, so that two triangles leave no seam.
    inside = numpy.all([side >= -1e-6 for side in sides], axis=0) | numpy.all([side <= 1e-6 for side in sides], axis=0)
    mask[low[1]:high[1], low[0]:high[0]] |= inside


def _draw_line(mask, a, b):
    count = int(numpy.ceil(2 * numpy.abs(b - a).max())) + 1
    points = numpy.floor(numpy.linspace(a, b, count)).astype(int)
    there = ((points >= 0) & (points < mask.shape[::-1])).all(axis=1)
    mask[points[there, 1], points[there, 0]] = True


def outline(triangles, metres_per_pixel, height=None):
    """Draws triangles (n, 3 corners, xyz in metres) from above.

    Returns the plan (rows from the top, True is floor), the world's place of its lower left corner, and the floor's
    height. Floor is what points up near that height; what stands on it at a person's height is wall.
    """
    triangles = numpy.asarray(triangles, dtype=float)
    height = floor_height(triangles) if height is None else height
    floors = floor_of(triangles, height)
    if len(floors) == 0:
        raise ValueError(f"no face points up near the height {height:.2f} m")
    least, most = floors[:, :, :2].min(axis=(0, 1)), floors[:, :, :2].max(axis=(0, 1))
    origin = least - MARGIN
    # Less a hair's breadth, so that a whole number of pixels stays one.
    size = numpy.ceil((most + MARGIN - origin) / metres_per_pixel - 1e-4).astype(int)
    if size.max() > LARGEST:
        raise ValueError(f"the plan would have {size.max()} pixels, more than {LARGEST}: use more metres per pixel")
    free = numpy.zeros((size[1], size[0]), dtype=bool)
    blocked = numpy.zeros_like(free)
    for triangle in floors:
        _fill(free, (triangle[:, :2] - origin) / metres_per_pixel)
    z = triangles[:, :, 2] - height
    for triangle in triangles[(z.max(axis=1) > BODY[0]) & (z.min(axis=1) < BODY[1])]:
        corners = (triangle[:, :2] - origin) / metres_per_pixel
        _fill(blocked, corners)
        for k in range(3):
            _draw_line(blocked, corners[k], corners[(k + 1) % 3])
    return (free & ~blocked)[::-1], (float(origin[0]), float(origin[1])), height


def write_png(path, plan):
    """Writes a plan as an 8-bit grey PNG: white floor, black walls."""
    rows = numpy.where(plan, 255, 0).astype(numpy.uint8)
    raw = numpy.hstack([numpy.zeros((rows.shape[0], 1), numpy.uint8), rows]).tobytes()

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", rows.shape[1], rows.shape[0], 8, 0, 0, 0, 0)
    Path(path).write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))
