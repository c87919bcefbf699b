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
# The quickest of those that give the tree the triangles of the scene as they are.
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


def empty_tree():
    try:
        return ifcopenshell.geom.tree(backend='opencascade.trianglebvh')
    except TypeError:  # before 0.9 one tree takes all
        return ifcopenshell.geom.tree()


class Clock:
    """Adds up seconds of the wall, and of threads by `cpu`, between start and stop."""

    def __init__(self):
        self.wall_s = self.cpu_s = 0

    def start(self, cpu):
        self.cpu = cpu
        self.begin = time.perf_counter(), cpu()

    def stop(self):
        self.wall_s += time.perf_counter() - self.begin[0]
        self.cpu_s += self.cpu() - self.begin[1]


def tree_of(model, threads, clock):
    """A tree of all elements. An element lasts until the next one, so that each is added at once; other threads triangulate
    meanwhile, which is not timed."""
    tree = empty_tree()
    iterator = ifcopenshell.geom.iterator(ifcopenshell.geom.settings(), model, threads,
                                          geometry_library=TRIANGULATED_BY)
    more = iterator.initialize()
    while more:
        element = iterator.get()
        clock.start(time.thread_time)
        tree.add_element(element)
        clock.stop()
        more = iterator.next()
    return tree


def clashes_in(tree, proxies, clock):
    """Every crossing once, with how deep it is at worst."""
    clock.start(time.process_time)
    clashes = tree.clash_intersection_many(proxies, proxies, tolerance=TOLERANCE_M, check_all=True)
    clock.stop()
    return clashes


def name_of(element):
    # Before 0.9 it is one of the wrapper, which has no names for its arguments.
    return element.Name if hasattr(element, 'Name') else element.get_argument(2)


def write_pairs(clashes, path):
    pairs = {tuple(sorted(int(name_of(element)) for element in (clash.a, clash.b))) for clash in clashes}
    with open(path, 'w', encoding='ascii') as out:
        out.writelines(f'{a} {b}\n' for a, b in sorted(pairs))


def main():
    scene, threads, pairs = sys.argv[1:]
    begin = time.perf_counter()
    ifc = scene.removesuffix('.obj') + '.ifc'
    write_ifc(objects_of(scene), ifc)
    model = ifcopenshell.open(ifc)
    clock = Clock()
    tree = tree_of(model, int(threads), clock)
    load_s = time.perf_counter() - begin - clock.wall_s
    clashes = clashes_in(tree, model.by_type('IfcBuildingElementProxy'), clock)
    write_pairs(clashes, pairs)
    print('RESULT ' + json.dumps({'version': 'IfcOpenShell ' + ifcopenshell.version, 'load_s': load_s,
                                  'wall_s': clock.wall_s, 'cpu_s': clock.cpu_s}))


main()
