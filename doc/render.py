#!/usr/bin/env python3
"""Renders frames of a run: ./doc/render.py OUTPUT_DIRECTORY PICTURE.png TIME [TIME ...]

Reads solution.pvd, draws the water's surface coloured by speed and the structure by displacement, off screen, one
panel per time. Needs python3-vtk9 and python3-matplotlib (Debian packages).
"""
import os
import sys
import xml.etree.ElementTree as ElementTree

import vtk
from vtk.util import numpy_support
import numpy
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt


def data_sets(directory):
    """{time: [(name, path)]} of a solution.pvd."""
    sets = {}
    for entry in ElementTree.parse(os.path.join(directory, "solution.pvd")).iter("DataSet"):
        name = os.path.basename(entry.get("file"))
        sets.setdefault(float(entry.get("timestep")), []).append((name, os.path.join(directory, entry.get("file"))))
    return sets


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def add_magnitude(grid, vector, name):
    array = grid.GetPointData().GetArray(vector)
    values = numpy_support.vtk_to_numpy(array)
    magnitude = numpy_support.numpy_to_vtk(numpy.linalg.norm(values, axis=1).copy(), deep=1)
    magnitude.SetName(name)
    grid.GetPointData().AddArray(magnitude)
    grid.GetPointData().SetActiveScalars(name)


def surface(grid):
    """The boundary, with the nodes that the output writes once per cell merged."""
    clean = vtk.vtkStaticCleanUnstructuredGrid() if hasattr(vtk, "vtkStaticCleanUnstructuredGrid") else None
    if clean is not None:
        clean.SetInputData(grid)
        clean.Update()
        grid = clean.GetOutput()
    extract = vtk.vtkDataSetSurfaceFilter()
    extract.SetInputData(grid)
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(extract.GetOutputPort())
    normals.ConsistencyOn()
    normals.AutoOrientNormalsOn()
    normals.SetFeatureAngle(50)
    normals.Update()
    return normals.GetOutput()


def colours(first, last, n=256):
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(n)
    for i in range(n):
        s = i / (n - 1)
        table.SetTableValue(i, *[(1 - s) * a + s * b for a, b in zip(first, last)], 1)
    return table


def actor(poly, table, low, high, opacity=1.0, edges=False):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(poly)
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(low, high)
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    result.GetProperty().SetOpacity(opacity)
    result.GetProperty().SetPointSize(3)
    result.GetProperty().SetAmbient(0.35)
    result.GetProperty().SetDiffuse(0.7)
    result.GetProperty().SetSpecular(0.15)
    if edges:
        result.GetProperty().EdgeVisibilityOn()
        result.GetProperty().SetEdgeColor(0.35, 0.2, 0.1)
    return result


def draw(files, bounds, size=(900, 620)):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    flat = bounds[5] - bounds[4] < 1e-9
    for name, path in files:
        grid = read(path)
        if name.startswith("fluid"):
            add_magnitude(grid, "velocity", "speed")
            renderer.AddActor(actor(surface(grid), colours((0.05, 0.25, 0.55), (0.75, 0.92, 1.0)), 0, 2.5))
        else:
            add_magnitude(grid, "displacement", "moved")
            renderer.AddActor(actor(surface(grid), colours((0.95, 0.75, 0.45), (0.75, 0.25, 0.1)), 0, 0.05, edges=True))
    cube = vtk.vtkOutlineSource()
    cube.SetBounds(bounds)
    cube.Update()
    frame = vtk.vtkPolyDataMapper()
    frame.SetInputConnection(cube.GetOutputPort())
    outline = vtk.vtkActor()
    outline.SetMapper(frame)
    outline.GetProperty().SetColor(0.4, 0.4, 0.4)
    renderer.AddActor(outline)

    renderer.RemoveAllLights()
    for place, strength in (((0.5, 3, 3), 0.75), ((3, 2, 1), 0.35), ((-2, 3, 1), 0.35)):
        light = vtk.vtkLight()
        light.SetPosition(*place)
        light.SetFocalPoint(0.3, 0.1, 0.07)
        light.SetIntensity(strength)
        renderer.AddLight(light)
    camera = renderer.GetActiveCamera()
    centre = [(bounds[2 * d] + bounds[2 * d + 1]) / 2 for d in range(3)]
    width = bounds[1] - bounds[0]
    camera.SetFocalPoint(*centre)
    camera.SetViewUp(0, 1, 0)
    if flat:
        camera.ParallelProjectionOn()
        camera.SetPosition(centre[0], centre[1], 1)
        camera.SetParallelScale((bounds[3] - bounds[2]) / 2 * 1.05)
    else:
        camera.SetPosition(centre[0] + 0.55 * width, centre[1] + 0.55 * width, centre[2] + 1.7 * width)
        camera.SetViewAngle(28)
    renderer.ResetCameraClippingRange()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    columns, rows, _ = image.GetDimensions()
    pixels = numpy_support.vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1)
    return pixels[::-1]


def main():
    directory, picture, *times = sys.argv[1:]
    sets = data_sets(directory)
    chosen = [min(sets, key=lambda t: abs(t - float(time))) for time in times]
    depth = max(read(path).GetBounds()[5] for _, path in sets[min(sets)])
    # The tank of the dam-break scenes; the camera does not move from frame to frame.
    bounds = (0, 0.584, 0, 0.36, 0, depth if depth > 1e-9 else 0)
    columns = min(3, len(chosen))
    rows = -(-len(chosen) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(4.6 * columns, 3.3 * rows), squeeze=False)
    for axis in axes.flat:
        axis.axis("off")
    for axis, time in zip(axes.flat, chosen):
        axis.imshow(draw(sets[time], bounds))
        axis.set_title(f"t = {time:.2f} s", fontsize=11)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main()
