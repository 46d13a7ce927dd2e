"""The VTU files hold the meshes: their cells, read back, fill the bodies of the scene at time 0, and every field has
a value at each point."""

import base64
import os
import shutil
import struct
import xml.etree.ElementTree as ElementTree
import zlib

from _program import SOURCES, Failures, run

failures = Failures()
FORMATS = {"Float32": ("f", 4), "Int32": ("i", 4), "UInt8": ("B", 1)}


def values_of(array):
    """Numbers of a DataArray: zlib blocks behind a header of sizes, in base64."""
    text = "".join(array.text.split())
    n_blocks = struct.unpack("<I", base64.b64decode(text[:8])[:4])[0]
    header_length = -(-(4 * (3 + n_blocks)) // 3) * 4
    sizes = struct.unpack(f"<{3 + n_blocks}I", base64.b64decode(text[:header_length])[:4 * (3 + n_blocks)])[3:]
    data, begin, result = base64.b64decode(text[header_length:]), 0, b""
    for size in sizes:
        result += zlib.decompress(data[begin:begin + size])
        begin += size
    code, width = FORMATS[array.get("type")]
    return struct.unpack(f"<{len(result) // width}{code}", result)


def read(path):
    piece = ElementTree.parse(path).getroot().find("UnstructuredGrid/Piece")
    points = values_of(piece.find("Points/DataArray"))
    cells = {array.get("Name"): values_of(array) for array in piece.findall("Cells/DataArray")}
    fields = {array.get("Name"): values_of(array) for array in piece.findall("PointData/DataArray")}
    points = [points[3 * i:3 * i + 3] for i in range(len(points) // 3)]
    ends = cells["offsets"]
    connected = [cells["connectivity"][begin:end] for begin, end in zip((0,) + ends[:-1], ends)]
    return points, list(zip(cells["types"], connected)), fields


def volume(points, cell):
    """Signed area or volume of a triangle (5), quadrilateral (9), tetrahedron (10) or hexahedron (12)."""
    kind, nodes = cell
    x = [points[node] for node in nodes]

    def tetrahedron(*corners):
        a, b, c = ([q - p for p, q in zip(x[corners[0]], x[i])] for i in corners[1:])
        return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6

    if kind == 10:
        return tetrahedron(0, 1, 2, 3)
    if kind == 12:
        return sum(tetrahedron(0, *face) for face in [(1, 2, 6), (1, 6, 5), (2, 3, 6), (3, 7, 6), (4, 5, 6), (4, 6, 7)])
    assert kind in (5, 9), f"unexpected cell type {kind}"
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(x, x[1:] + x[:1])) / 2


SCENES = {
    "benchmarks/dam_break_elastic_obstacle_2d.prm": (0.146 * 0.292, 0.012 * 0.08),
    "cookbooks/dam_break_elastic_obstacle.prm": (0.146 * 0.292 * 0.15, 0.012 * 0.08 * 0.15),
}
for scene, (water, obstacle) in SCENES.items():
    shutil.rmtree("results", ignore_errors=True)
    result = run(os.path.join(SOURCES, "parameter_files", scene), "--output", "results", "--set", "End time=1e-4",
                 "--set", "Fluid/Pfem/Spacing=0.01")
    failures.check(result.returncode == 0, f"{scene} runs: {result.stderr}")
    for name, exact in [("fluid", water), ("Obstacle", obstacle)]:
        points, cells, fields = read(f"results/{name}-0001.vtu")
        volumes = [volume(points, cell) for cell in cells]
        failures.check(abs(sum(volumes) / exact - 1) < 1e-5, f"{name}: its cells fill {sum(volumes)} of {exact}")
        failures.check(min(volumes) > 0, f"{name}: no cell is inverted")
        failures.check("velocity" in fields, f"{name}: there is a velocity, of {sorted(fields)}")
        for field, values in fields.items():
            failures.check(len(values) in (len(points), 3 * len(points)), f"{name}: {field} has a value at each point")
failures.finish()
