# SPDX-License-Identifier: Apache-2.0
"""Blender's Line Art on a scene of meshes:

    blender -b --factory-startup -t THREADS -P line_art.py -- SCENE.obj X,Y,Z DEGREES LINES KINDS

Bakes lines of KINDS (some of contour,sharp,intersection; edges sharper than DEGREES are sharp) seen orthographically
from X,Y,Z. Writes the visible ones into the file LINES (kind, two points of the model in mm) and prints one line,
RESULT and JSON: seconds of the baking alone. The modifiers share one computation, so that kinds can be told apart at
little cost, and none is shown in the viewport: each that is would have Blender compute everything again. The scene is
imported in metres: Line Art computes in single precision.
"""
import json
import math
import sys
import time

import bpy
from mathutils import Vector

MM_PER_UNIT = 1000
SWITCHES = {'contour': 'use_contour', 'sharp': 'use_crease', 'intersection': 'use_intersection'}
ALL_SWITCHES = (*SWITCHES.values(), 'use_material', 'use_edge_mark', 'use_loose', 'use_light_contour', 'use_shadow')


def load(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.obj_import(filepath=path, forward_axis='Y', up_axis='Z', global_scale=1 / MM_PER_UNIT)


def set_camera(direction):
    """An orthographic camera that holds the whole scene."""
    scene = bpy.context.scene
    corners = [o.matrix_world @ Vector(c) for o in scene.objects for c in o.bound_box]
    low = Vector(min(c[k] for c in corners) for k in range(3))
    high = Vector(max(c[k] for c in corners) for k in range(3))
    size = (high - low).length
    camera = bpy.data.cameras.new('view')
    camera.type = 'ORTHO'
    camera.ortho_scale = 1.05 * size
    camera.clip_start, camera.clip_end = 0.01, 3 * size
    eye = bpy.data.objects.new('view', camera)
    eye.location = (low + high) / 2 + direction * size
    # Not by mathutils, which is in single precision: in an isometric view the last bit of the camera's rotation
    # decides about a seventh of what Line Art finds visible.
    x, y, z = direction
    eye.rotation_euler = math.atan2(math.hypot(x, y), z), 0, math.atan2(x, -y)
    scene.collection.objects.link(eye)
    scene.camera = eye
    scene.render.resolution_x = scene.render.resolution_y = 4096
    scene.frame_start = scene.frame_end = 1
    bpy.context.view_layer.update()


def line_art(kinds, sharp_deg):
    """A drawing with a layer and a modifier for each kind of line."""
    bpy.ops.object.gpencil_add(type='LRT_SCENE')
    drawing = bpy.context.object
    modifiers = [m for m in drawing.grease_pencil_modifiers if m.type == 'GP_LINEART']
    material = modifiers[0].target_material
    for number, kind in enumerate(kinds):
        drawing.data.layers.new(kind)
        m = modifiers[0] if number == 0 else drawing.grease_pencil_modifiers.new(kind, 'GP_LINEART')
        m.source_type = 'SCENE'
        m.target_layer, m.target_material = kind, material
        m.use_cache = number > 0
        for other in ALL_SWITCHES:
            if hasattr(m, other):
                setattr(m, other, other == SWITCHES[kind])
        m.crease_threshold = math.radians(180 - sharp_deg)
        m.chaining_image_threshold = 0
        m.show_viewport = False
    return drawing


def write_lines(drawing, kinds, path):
    with open(path, 'w', encoding='ascii') as out:
        for kind in kinds:
            for frame in drawing.data.layers[kind].frames:
                for stroke in frame.strokes:
                    points = [' '.join(str(MM_PER_UNIT * c) for c in p.co) for p in stroke.points]
                    out.writelines(f'{kind} {a} {b}\n' for a, b in zip(points, points[1:]))


def main():
    path, toward, sharp_deg, lines, kinds = sys.argv[sys.argv.index('--') + 1:]
    direction = Vector(float(x) for x in toward.split(',')).normalized()
    begin = time.time()
    load(path)
    set_camera(direction)
    kinds = kinds.split(',')
    drawing = line_art(kinds, float(sharp_deg))
    loaded, cpu = time.time(), time.process_time()
    bpy.ops.object.lineart_bake_strokes()
    hidden, hidden_cpu = time.time(), time.process_time()
    write_lines(drawing, kinds, lines)
    print('RESULT ' + json.dumps({
        'version': 'Blender ' + bpy.app.version_string, 'load_s': loaded - begin, 'wall_s': hidden - loaded,
        'cpu_s': hidden_cpu - cpu}))


main()
