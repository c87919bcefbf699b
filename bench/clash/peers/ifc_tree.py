# SPDX-License-Identifier: Apache-2.0
"""IfcOpenShell's clash tree on a scene of meshes:

    python3 ifc_tree.py SCENE.obj THREADS PAIRS

The tree reads IFC alone: the scene is written as SCENE.ifc first, every object as a proxy with its own triangles. Writes
the pairs that clash_intersection_many finds into the file PAIRS (numbers of two objects, in the order of the scene) and
prints one line, RESULT and JSON: seconds of the tree and of the clash, files and triangulation left out. Exits with 77
where IfcOpenShell is not installed.
"""
import json
import sys
import time

NOT_INSTALLED = 77
try:
    import ifcopenshell
    import ifcopenshell.geom
except ImportError:
    sys.exit(NOT_INSTALLED)

TOLERANCE_M = 0.0  # how far one may protrude into the other
# Of those that triangulate meshes the quickest that all of 0.8 have; the tree gets the same triangles from each.
TRIANGULATED_BY = 'cgal-simple'


def objects_of(path):
    """Points and triangles of each object, in its own numbers from 1."""
    points, objects, base = [], [], 0
    with open(path, encoding='utf-8') as lines:
        for line in lines:
            word, _, rest = line.partition(' ')
            if word == 'o':
                base += len(points)
                points, triangles = [], []
                objects.append((points, triangles))
            elif word == 'v':
                points.append(tuple(float(x) for x in rest.split()))
            elif word == 'f':
                triangles.append(tuple(int(corner.split('/')[0]) - base for corner in rest.split()))
    return objects


class IfcFile:
    """An IFC4 file in millimetres of proxies, each at the origin."""

    def __init__(self):
        self.file = ifcopenshell.file(schema='IFC4')
        make = self.file.create_entity
        origin = make('IfcCartesianPoint', (0.0, 0.0, 0.0))
        axes = make('IfcAxis2Placement3D', origin)
        self.context = make('IfcGeometricRepresentationContext', None, 'Model', 3, 1e-6, axes)
        unit = make('IfcSIUnit', None, 'LENGTHUNIT', 'MILLI', 'METRE')
        make('IfcProject', ifcopenshell.guid.new(), Name='scene', RepresentationContexts=[self.context],
             UnitsInContext=make('IfcUnitAssignment', [unit]))
        self.place = make('IfcLocalPlacement', None, axes)

    def add(self, name, points, triangles):
        make = self.file.create_entity
        mesh = make('IfcTriangulatedFaceSet', make('IfcCartesianPointList3D', points), None, None, triangles)
        shape = make('IfcShapeRepresentation', self.context, 'Body', 'Tessellation', [mesh])
        return make('IfcBuildingElementProxy', ifcopenshell.guid.new(), Name=name, ObjectPlacement=self.place,
                    Representation=make('IfcProductDefinitionShape', None, None, [shape]))


def write_ifc(objects, path):
    ifc = IfcFile()
    for number, (points, triangles) in enumerate(objects):
        if triangles:
            ifc.add(str(number), points, triangles)
    ifc.file.write(path)


def elements_of(model, threads):
    """Every element, triangulated; all held, so that the tree is timed alone."""
    iterator = ifcopenshell.geom.iterator(ifcopenshell.geom.settings(), model, threads,
                                          geometry_library=TRIANGULATED_BY)
    elements = []
    if iterator.initialize():
        while True:
            elements.append(iterator.get())
            if not iterator.next():
                break
    return elements


class Clock:
    """Seconds of the wall and of all threads since the last call."""

    def __init__(self):
        self.last = time.perf_counter(), time.process_time()

    def __call__(self):
        now = time.perf_counter(), time.process_time()
        lap = now[0] - self.last[0], now[1] - self.last[1]
        self.last = now
        return lap


def clashes_of(elements, proxies):
    """Every crossing once, with how deep it is at worst."""
    tree = ifcopenshell.geom.tree(backend='opencascade.trianglebvh')
    for element in elements:
        tree.add_element(element)
    return tree.clash_intersection_many(proxies, proxies, tolerance=TOLERANCE_M, check_all=True)


def write_pairs(clashes, path):
    pairs = {tuple(sorted(int(element.Name) for element in (clash.a, clash.b))) for clash in clashes}
    with open(path, 'w', encoding='ascii') as out:
        out.writelines(f'{a} {b}\n' for a, b in sorted(pairs))


def main():
    scene, threads, pairs = sys.argv[1:]
    clock = Clock()
    ifc = scene.removesuffix('.obj') + '.ifc'
    write_ifc(objects_of(scene), ifc)
    model = ifcopenshell.open(ifc)
    elements = elements_of(model, int(threads))
    proxies = model.by_type('IfcBuildingElementProxy')
    load_s, _ = clock()
    clashes = clashes_of(elements, proxies)
    wall_s, cpu_s = clock()
    write_pairs(clashes, pairs)
    print('RESULT ' + json.dumps({
        'version': 'IfcOpenShell ' + ifcopenshell.version, 'load_s': load_s, 'wall_s': wall_s, 'cpu_s': cpu_s}))


main()
