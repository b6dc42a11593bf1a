# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints as JSON what VTK's own reader finds in .vtp files, and what stands in .pvd files, one line per file."""
import json
import sys
import xml.etree.ElementTree

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def arrays(data):
    result = {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetAbstractArray(i)
        result[array.GetName()] = [array.GetComponent(j, 0) for j in range(array.GetNumberOfTuples())]
    return result


def cells(cell_array):
    offsets, connectivity = cell_array.GetOffsetsArray(), cell_array.GetConnectivityArray()
    ends = [int(offsets.GetComponent(i, 0)) for i in range(offsets.GetNumberOfTuples())]
    return [[int(connectivity.GetComponent(j, 0)) for j in range(a, b)] for a, b in zip(ends, ends[1:])]


def read_vtp(file):
    reader = vtkXMLPolyDataReader()
    failed = []
    reader.AddObserver("ErrorEvent", lambda *_: failed.append(True))
    reader.SetFileName(file)
    reader.Update()
    surface = reader.GetOutput()
    if failed or reader.GetErrorCode() != 0:
        sys.exit(f"{file}: VTK cannot read it")
    return {
        "points": [surface.GetPoint(i) for i in range(surface.GetNumberOfPoints())],
        "bounds": surface.GetBounds(),
        "vertices": cells(surface.GetVerts()),
        "lines": cells(surface.GetLines()),
        "polygons": cells(surface.GetPolys()),
        "point_data": arrays(surface.GetPointData()),
        "cell_data": arrays(surface.GetCellData()),
    }


def read_pvd(file):
    root = xml.etree.ElementTree.parse(file).getroot()
    assert root.tag == "VTKFile" and root.get("type") == "Collection"
    return [[float(step.get("timestep")), step.get("file")] for step in root.find("Collection")]


for name in sys.argv[1:]:
    print(json.dumps(read_pvd(name) if name.endswith(".pvd") else read_vtp(name)))
