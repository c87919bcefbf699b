# SPDX-License-Identifier: Apache-2.0
"""DXF as an independent library reads it, beside the neutral JSON of the same drawing."""
import math
import sys
from collections import Counter, defaultdict

# The package of Debian serves another Python, too: it is Python alone.
sys.path.append('/usr/lib/python3/dist-packages')
import ezdxf  # noqa: E402
from ezdxf.lldxf.encoding import decode_dxf_unicode  # noqa: E402

LAYERS = {'contour': 'AM_0', 'boundary': 'AM_0_BOUNDARY', 'intersection': 'AM_0_INTERSECTION', 'section': 'AM_0_SECTION',
          'hatch': 'AM_8', 'polyline': 'AM_4', 'smooth': 'AM_4_SMOOTH', 'sharp': 'AM_0_EDGE', 'non_manifold': 'AM_0_EDGE',
          'single_line': 'AM_0_PIPE'}
HIDDEN = {'hidden_by_self': 'AM_3_SELF', 'hidden_by_other': 'AM_3'}
CURVES = ('ARC', 'CIRCLE', 'ELLIPSE')
# A tiny arc is its chord, mm; the grid that ends of lines are rounded to, and then some.
TINY, GRID = 0.0101, 0.002


def read(path):
    """The document, and what an audit finds wrong or mends."""
    document = ezdxf.readfile(path)
    audit = document.audit()
    return document, [error.message for error in [*audit.errors, *audit.fixes]]


def shown(value):
    """What a program shows of a value: ezdxf leaves it as it is written."""
    return decode_dxf_unicode(value).replace('^ ', '^')


def object_of(entity):
    """(id, name, file), as the entity says itself."""
    return tuple(shown(tag.value) for tag in entity.get_xdata('STRAKE') if tag.code == 1000)


def segments_of(entity):
    """The straight lines of a LINE or LWPOLYLINE, in micrometres, ends in order."""
    if entity.dxftype() == 'LINE':
        points = [entity.dxf.start, entity.dxf.end]
        points = [(p.x, p.y) for p in points]
    else:
        points = [(x, y) for x, y, *_ in entity.get_points()]
        if entity.closed:
            points.append(points[0])
    grid = [(round(x * 1000), round(y * 1000)) for x, y in points]
    return [tuple(sorted(pair)) for pair in zip(grid, grid[1:])]


def unit(v):
    length = math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return [x / length for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def distance(p, a, b):
    """From a point to a straight line between two others."""
    ax, ay, bx, by = a[0] - p[0], a[1] - p[1], b[0] - p[0], b[1] - p[1]
    dx, dy = bx - ax, by - ay
    length = dx * dx + dy * dy
    t = min(1, max(0, -(ax * dx + ay * dy) / length)) if length else 0
    return math.hypot(ax + t * dx, ay + t * dy)


class View:
    """What the JSON of a drawing says that its DXF must hold: true size, or paper in perspective."""

    def __init__(self, view, hidden):
        self.scale = view['sheet']['scale']
        self.height = view['sheet']['height_mm']
        self.perspective = view['view']['projection'] == 'perspective'
        direction, up = view['view']['direction'], view['view']['up']
        right = cross(up, direction)
        self.right, self.up = unit(right), unit(cross(direction, right))
        self.straight = Counter()
        self.chords = defaultdict(list)  # of (layer, object): (a, b) in mm
        self.ids = [(one['id'], one['name'], one['file']) for one in view['objects']]
        curves = view.get('curves', [])
        for piece in view['pieces']:
            layer = self.layer(piece, hidden)
            if layer is None:
                continue
            a, b = (self.place(piece, end) for end in 'ab')
            pair = tuple(sorted((round(x * 1000), round(y * 1000)) for x, y in (a, b)))
            if pair[0] == pair[1]:
                continue
            if 'curve_index' in piece and self.width(curves[piece['curve_index']]) >= .01:
                self.chords[layer, self.ids[piece['object_index']][0]].append((a, b))
            else:
                self.straight[(layer, *pair)] += 1

    def layer(self, piece, hidden):
        if piece['state'] == 'visible':
            return LAYERS[piece['kind']]
        # Hidden edges of smooth surfaces get no ink.
        return HIDDEN.get(piece['state']) if hidden and piece['kind'] != 'smooth' else None

    def width(self, curve):
        """Half the minor axis of a curve, mm at true size."""
        (ux, uy), (vx, vy) = curve['u_paper_mm'], curve['v_paper_mm']
        mean, off = (ux * ux + vx * vx + uy * uy + vy * vy) / 2, math.hypot((ux * ux + vx * vx - uy * uy - vy * vy) / 2,
                                                                            ux * uy + vx * vy)
        major = math.sqrt(mean + off)
        return abs(ux * vy - uy * vx) / major * self.scale if major else 0

    def place(self, piece, end):
        if self.perspective:
            x, y = piece[end + '_paper_mm']
            return x, self.height - y
        mm = piece[end + '_mm']
        return dot(self.right, mm), dot(self.up, mm)


def differences(document, view, sag):
    """What is in the DXF and not in the view, or the other way round: a list of texts, empty where they agree."""
    reported = []
    straight, curves = Counter(), defaultdict(list)
    for entity in document.modelspace():
        layer = entity.dxf.layer
        if entity.dxftype() in CURVES:
            curves[layer, object_of(entity)[0]].append(entity)
            continue
        for segment in segments_of(entity):
            straight[(layer, *segment)] += 1
    for layer, a, b in (straight - view.straight).elements():
        if math.dist(a, b) / 1000 > TINY:
            reported.append(f'{layer}: {a} to {b} is no line of the view')
    missing = view.straight - straight
    reported += [f'{layer}: {a} to {b} is missing' for layer, a, b in missing.elements()]
    for key in set(curves) | set(view.chords):
        flat = [[(p[0], p[1]) for p in entity.flattening(GRID / 4)] for entity in curves[key]]
        arcs = [pair for points in flat for pair in zip(points, points[1:])]
        chords = view.chords[key]
        for points in flat:
            for p in points[::max(1, len(points) // 12)]:
                off = min((distance(p, a, b) for a, b in chords), default=math.inf)
                if off > sag + GRID:
                    reported.append(f'{key}: an arc is {off} mm from all its chords at {p}')
        for a, b in chords:
            if math.dist(a, b) <= TINY:
                continue
            for p in (a, b, ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)):
                off = min((distance(p, *arc) for arc in arcs), default=math.inf)
                if off > sag + GRID:
                    reported.append(f'{key}: a chord is {off} mm from all arcs at {p}')
    return reported
