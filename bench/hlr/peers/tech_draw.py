# SPDX-License-Identifier: Apache-2.0
"""FreeCAD's TechDraw on a scene of meshes:

    python3 tech_draw.py SCENE.obj X,Y,Z LINES

Writes the visible sharp lines into the file LINES (kind, two points of the model in mm) and prints one line, RESULT
and JSON: seconds of the projection alone. Every connected mesh becomes a shell with coplanar triangles as one face.
Exits with 77 where FreeCAD is not installed.
"""
import json
import sys
import time

NOT_INSTALLED = 77
sys.path.append('/usr/lib/freecad-python3/lib')
try:
    import FreeCAD
    import Mesh
    import Part
    import TechDraw
except ImportError:
    sys.exit(NOT_INSTALLED)

BENT_MM = 0.01  # corners this near to a plane lie in it


def shapes_of(path):
    document = FreeCAD.newDocument()
    Mesh.insert(path, document.Name)
    for item in document.Objects:
        if not hasattr(item, 'Mesh'):
            continue
        for mesh in item.Mesh.getSeparateComponents():
            shape = Part.Shape()
            shape.makeShapeFromMesh(mesh.Topology, BENT_MM)
            yield shape.removeSplitter()


def paper_axes(direction):
    """Those that OCCT gives a view of which only the direction is known (gp_Ax2)."""
    x, y, z = direction
    a, b, c = abs(x), abs(y), abs(z)
    if b <= a and b <= c:
        right = FreeCAD.Vector(-z, 0, x) if a > c else FreeCAD.Vector(z, 0, -x)
    elif a <= b and a <= c:
        right = FreeCAD.Vector(0, -z, y) if b > c else FreeCAD.Vector(0, z, -y)
    else:
        right = FreeCAD.Vector(-y, x, 0) if a > b else FreeCAD.Vector(y, -x, 0)
    right.normalize()
    return right, FreeCAD.Vector(direction).normalize().cross(right)


def write_lines(shape, direction, path):
    right, up = paper_axes(direction)
    with open(path, 'w', encoding='ascii') as out:
        for edge in shape.Edges:
            points = [right * v.X + up * v.Y for v in edge.Vertexes]
            if len(points) == 2:
                print('sharp', *points[0], *points[1], file=out)


def main():
    path, toward, lines = sys.argv[1:]
    direction = FreeCAD.Vector(*(float(x) for x in toward.split(',')))
    begin = time.time()
    scene = Part.makeCompound(list(shapes_of(path)))
    loaded, cpu = time.time(), time.process_time()
    sharp = TechDraw.project(scene, direction)[0]
    hidden, hidden_cpu = time.time(), time.process_time()
    write_lines(sharp, direction, lines)
    print('RESULT ' + json.dumps({
        'version': 'FreeCAD ' + '.'.join(FreeCAD.Version()[:3]), 'load_s': loaded - begin, 'wall_s': hidden - loaded,
        'cpu_s': hidden_cpu - cpu}))


main()
