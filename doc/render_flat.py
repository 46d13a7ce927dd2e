#!/usr/bin/env python3
"""Draws flows in two dimensions: ./doc/render_flat.py PICTURE.png TITLE=FILE.vtu[+STRUCTURE.vtu...] [TITLE=FILE.vtu ...]

One panel per fluid: the mesh, coloured by speed [m/s], and structures on top. Needs python3-vtk9 and python3-matplotlib (Debian packages).
"""
import sys
import vtk
from vtk.util.numpy_support import vtk_to_numpy
import numpy
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def draw_structure(axes, grid):
    points = vtk_to_numpy(grid.GetPoints().GetData())[:, :2]
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    axes.add_collection(PolyCollection(points[cells], facecolor="orangered", edgecolor="black", linewidth=0.2))


def draw(axes, title, path):
    path, *structures = path.split("+")
    grid = read(path)
    x, y = vtk_to_numpy(grid.GetPoints().GetData())[:, :2].T
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    first = offsets[:-1][numpy.diff(offsets) == 3]  # isolated nodes are cells of one node
    triangles = vtk_to_numpy(grid.GetCells().GetConnectivityArray())[first[:, None] + numpy.arange(3)]
    speed = numpy.linalg.norm(vtk_to_numpy(grid.GetPointData().GetArray("velocity")), axis=1)
    colours = axes.tripcolor(x, y, triangles, speed, shading="gouraud", cmap="viridis")
    axes.triplot(x, y, triangles, linewidth=0.15, color="black")
    for structure in structures:
        draw_structure(axes, read(structure))
    axes.set_aspect("equal")
    axes.set_title(title, fontsize=9)
    axes.tick_params(labelsize=6)
    plt.colorbar(colours, ax=axes, shrink=0.8).ax.tick_params(labelsize=6)


panels = [panel.split("=", 1) for panel in sys.argv[2:]]
figure, all_axes = plt.subplots((len(panels) + 2) // 3, 3, figsize=(10, 3.1 * ((len(panels) + 2) // 3)), squeeze=False)
for axes in all_axes.flat[len(panels):]:
    axes.axis("off")
for axes, (title, path) in zip(all_axes.flat, panels):
    draw(axes, title, path)
plt.tight_layout()
plt.savefig(sys.argv[1], dpi=90)
