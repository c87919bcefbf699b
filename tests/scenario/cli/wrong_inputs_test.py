#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""wrong_inputs_test.py STRAKE: every option and every kind of file, wrong in several ways. Each answer names the place and a mend."""
import json
import re
import shlex
import struct

from scenario import Scenario, cube, main, rvm

# A command line, what the answer names (the option, or the file with its place) and what it says besides.
LENGTH = [('25', '25mm'), ('-1', 'negative'), ('-1mm', 'negative'), ('1,5mm', 'write 1.5mm'), ('5e-400mm', 'too small'),
          ('1e400mm', 'too large'), ('1e300mm', 'longer than a kilometre'), ('nan', 'is not a length'),
          ('wide', 'is not a length'), ('25furlong', 'um, mm, cm'), ("''", 'the value is empty')]
ANGLE = [('20mm', '20deg'), ('steep', 'is not an angle'), ('22,5deg', 'write 22.5deg'), ('nan', 'is not an angle'),
         ("''", 'the value is empty')]
COUNT = [('all', 'whole number'), ('-3', 'whole number'), ('1.5', 'digits'), ('1e3', 'digits'), ("''", 'the value is empty')]
POINT = [('1,2', 'has 2 coordinates, not 3'), ('1,2,3,4', 'has 4 coordinates'), ('1,2,x', "'x' is not a coordinate"),
         ('1,2,3furlong', 'um, mm, cm'), ('1,2,1e300', 'lies outside'), ('1,2,', 'is not a coordinate')]
LENGTHS = ['clash a.obj --clearance', 'clash a.obj --touch-gap', 'clash a.obj --touch-overlap',
           'clash a.obj --contact-distance', 'clash a.obj --group-by proximity --group-distance', 'clash a.obj --sag',
           'clash a.obj --decisions d.csv --deeper',
           'info a.obj --weld', 'draw a.obj -o x.svg --contact-distance',
           'draw a.obj -o x.svg --eye 1m,1m,1m --target 0,0,0 --near', 'draw diff v.view v.view --tolerance']
SECONDS = [('long', 'no number of seconds'), ('-1', 'no number of seconds'), ('1e9', 'from 0 to 3600'), ('nan', 'no number of seconds'),
           ("''", 'the value is empty')]
COUNTS = ['info a.obj --objects', 'project list p.strake --rows', 'clash a.obj --max-pairs', 'clash a.obj --max-spheres', 'clash a.obj --regions', 'clash a.obj --pictures p --top-pictures',
          'generate ship -o x.glb --objects', 'generate ship -o x.glb --seed',
          'generate ship -o x.glb --imported-detail',
          'generate ship -o x.glb --imported-detail 1 --imported-triangles']
CHOICES = ['clash a.obj --fail-on', 'clash a.obj --thickness-cap', 'clash a.obj --contacts', 'clash a.obj --group-by',
           'clash a.obj --sort', 'clash a.obj --csv', 'clash a.obj --page-geometry', 'clash a.obj --pictures p --picture-format',
           'clash a.obj --profile', 'clash a.obj --broad-phase',
           'clash a.obj --narrow-phase', 'clash a.obj --distribution',
           'clash diff c.json c.json --fail-on', 'draw diff v.view v.view --fail-on', 'draw a.obj -o x.svg --view',
           'draw a.obj -o x.svg --hidden', 'draw a.obj -o x.svg --hidden-layers', 'draw a.obj -o x.svg --break-lines', 'clash a.obj -o x.bcf --bcf-version', 'draw a.obj -o x.svg --stage', 'draw a.obj -o x.svg --intersections',
           'draw a.obj -o x.svg --own-polylines', 'draw a.obj -o x.svg --smooth', 'draw a.obj -o x.svg --solver',
           'draw a.obj -o x.svg --flush-seams',
           'draw a.obj -o x.svg --global', 'draw a.obj -o x.svg --culling', 'draw a.obj -o x.svg --distribution',
           'generate ship -o x.glb --kind']


def behind(lines, values):
    """Each command line with each value: a row names the option, the last one of the line."""
    return [(f'{line} {value}', line.split()[-1], stated) for line in lines for value, stated in values]


USAGE = [
    *behind(LENGTHS, LENGTH), *behind(COUNTS, COUNT), *behind(['project remove p.strake a.obj --wait'], SECONDS),
    ('project list p.strake things', 'what', "'things' is not one of"),
    # What only a project has, and files beside it.
    *[(f'{line} {option}', option.split()[0], 'add --project') for line, options in (
        ('clash a.obj', ('--by me', '--full', '--verify')),
        ('draw a.obj -o x.svg', ('--save deck', '--stored deck', '--full', '--verify'))) for option in options],
    *behind(['clash -p p.strake --by', 'draw -p p.strake -o x.svg --save', 'draw -p p.strake -o x.svg --stored', 'clash --project',
             'draw -o x.svg --project'], [("''", 'the value is empty')]),
    ('clash a.obj --project p.strake', "'a.obj'", "'strake project add'"),
    ('draw a.obj --project p.strake -o x.svg', "'a.obj'", "'strake project add'"),
    ('clash --project p.strake --georeference', '--georeference', 'leave it out'),
    ('draw --project p.strake -o x.svg --georeference', '--georeference', 'leave it out'),
    ('clash --project p.strake --decisions d.csv', '--decisions', 'leave one of them out'),
    ('draw --project p.strake --sheet s.toml -o x.svg', '--sheet', 'leave one of them out'),
    ('draw -p p.strake -o x.svg --save deck --stored deck', '--stored', 'leave one of them out'),
    ('draw -p p.strake -o x.svg --full', '--full', '--stored NAME'), ('draw -p p.strake -o x.svg --verify', '--verify', '--stored NAME'),
    *behind(CHOICES, [('sideways', "'sideways' is not one of"), ("''", "'' is not one of")]),
    *behind(['draw a.obj -o x.svg --sharp-angle', 'draw a.obj -o x.svg --eye 1m,1m,1m --target 0,0,0 --field-of-view'], ANGLE),
    *behind(['draw a.obj -o x.svg --target 1,2,3 --eye', 'draw a.obj -o x.svg --eye 1,2,3 --target'], POINT),
    *behind(['draw a.obj -o x.svg --limits'], [
        ('1,2,3', 'has 3 coordinates, not 6'), ('0,0,0,1,1,x', "'x' is not a coordinate"), ('1,1,1,0,0,0', 'is empty'),
        ('0,0,0,1,1,1e300', 'lies outside'), ('0,0,0,1,1,1furlong', 'um, mm, cm'), ('box', 'has 1 coordinate, not 6')]),
    *behind(['draw a.obj -o x.svg --section'], [
        ('z', 'is no section plane'), ('z=', 'as 4.5m'), ('w=1mm', 'neither an axis'), ('0,0,0=1mm', 'neither an axis'),
        ('z=1,5mm', 'write 1.5mm'), ('z=1furlong', 'um, mm, cm'), ('z=1e300mm', 'lies outside'), ('z=5e-400mm', 'too small'),
        ("''", 'the value is empty')]),
    *behind(['draw a.obj -o x.svg --hatch'], [
        ('30,80', 'has no unit'), ('30deg,80', 'has no unit'), ('1,5mm', 'has no unit'), ('30deg,40deg', 'the angle twice'),
        ('80mm,90mm', 'lines twice'), ('200deg', 'between 0deg and 180deg'), ('-1mm', 'negative'), ('0mm', 'no distance'),
        ('1e300mm', 'kilometre'), ('often', 'neither an angle nor a length'), ("'45deg: nobody'", "'nobody' picks no object"),
        ("'45deg: (('", 'column 3')]),
    *behind(['draw a.obj -o x.svg --direction', 'draw a.obj -o x.svg --up'], [
        ('1,1', 'is not a direction'), ('0,0,0', 'is not a direction'), ('north', 'is not a direction'),
        ('1,nan,1', 'is not a direction'), ("''", 'the value is empty')]),
    ('draw a.obj -o x.svg --view top --up 0,0,1', '--up', 'parallel'),
    ('draw a.obj -o x.svg --eye 1,2,3 --target 1,2,3', '--target', 'same point'),
    ('draw a.obj -o x.svg --eye 1m,1m,1m --target 0,0,0 --field-of-view 200deg', '--field-of-view', '160'),
    ('draw a.obj -o x.svg --eye 1m,1m,1m --target 0,0,0 --near 9m', '--near', 'target'),
    ('draw a.obj -o x.svg --eye 1m,1m,1m --target 0,0,0 --near 0', '--near', '1um to 1km'),
    ('draw a.obj -o x.svg --eye 10,0,0 --target 0,0,0', '--eye', 'move the eye away'),
    ('draw a.obj -o x.svg --sharp-angle 200deg', '--sharp-angle', '180deg'),
    *behind(['draw a.obj -o x.svg --scale'], [
        ('100', 'write 1:100'), ('1/50', '1:50'), ('0:1', '1:50'), ('1:-5', '1:50'), ('1:1e300', '1:50'), ('big', '1:50'),
        ("''", 'the value is empty')]),
    *behind(['draw a.obj -o x.svg --paper'], [
        ('A5', 'A4, A3, A2, A1 or A0'), ('A3,up', 'neither landscape nor portrait'), ('900', 'width x height'),
        ('9x9', 'between 100mm and 20m'), ("'900mm x wide'", 'no length of paper'), ("''", 'the value is empty')]),
    *behind(['draw a.obj -o x.svg --bucketing'], [
        ('many', 'off, auto, or a number'), ('0', 'off, auto, or a number'), ('-1', 'off, auto, or a number'),
        ("''", 'the value is empty')]),
    *behind(['info a.obj --threads', 'clash a.obj --threads', 'draw a.obj -o x.svg --threads', 'generate ship -o x.glb --threads'], [
        ('0', 'from 1 to'), ('-1', 'from 1 to'), ('many', 'from 1 to'), ('1e9', 'from 1 to'), ("''", 'the value is empty')]),
    *behind(['info a.obj --unit', 'clash a.obj --unit', 'draw a.obj -o x.svg --unit'], [
        ('cubit', 'um, mm, cm'), ('25', 'um, mm, cm'), ('b.obj=m', 'none of the files'), ('a.obj=', 'um, mm, cm'),
        ("''", 'the value is empty')]),
    ('info a.obj --unit mm --unit m', '--unit', 'more than once'),
    ('info a.obj --up-axis up', '--up-axis', 'write x, y or z'), ("info a.obj --up-axis ''", '--up-axis', 'the value is empty'),
    ('info a.obj --up-axis b.obj=y', '--up-axis', 'none of the files'),
    ('info a.obj --sag 0', '--sag', '1um or more'),
    ('info a.obj --sag 0.1um', '--sag', '1um or more'),
    ('info a.obj --weld 2m', '--weld', 'longer than a metre'),
    *behind(['draw a.obj -o x.svg --select', 'draw a.obj -o x.svg --hatch 45deg --select',
             'draw a.obj -o x.svg --section z=1mm --uncut'], [
        ('nobody', "'nobody' picks no object"), ("'@MATERIAL = AH36'", 'no object has an attribute @MATERIAL'),
        ("'name = nobody'", 'strake info --objects 20'), ("'@ = 3'", 'column 1'), ("'name ='", 'column 7'),
        ("'(a or b'", 'column 8'), ("'a and'", 'column 6'), ('"\'open"', 'column 1'), ("'@DN > wide'", 'column 7'),
        ("'name > 3'", 'column 8'), ("\"name ~ '('\"", 'column 8'), ("'inside(1,2,3)'", 'column 13'),
        ("'inside(0,0,0,1,1,nan)'", 'column 18'), ("'set(x)'", 'no set is called'), ("''", 'the value is empty')]),
    *behind(['clash a.obj --a', 'clash a.obj --b'], [("'name ='", 'column 7'), ("'set(x)'", 'no set is called'),
                                                     ("''", 'the value is empty')]),
    # What does not go together, is missing, too much or misspelt.
    ('', 'no verb is given', 'the verbs are'),
    ('clahs a.obj', "'clahs'", "did you mean 'clash'"),
    ('frobnicate', "'frobnicate'", 'the verbs are'),
    ('--threads 2', '--threads', 'behind'),
    ('help drwa', "'drwa'", "did you mean 'draw'"),
    ('man clash dif', "'dif'", "did you mean 'diff'"),
    ('generate', 'no verb is given', 'ship'),
    ('generate shp', "'shp'", "did you mean 'ship'"),
    ('generate ship', '--output', 'write --output FILE'),
    ('generate ship -o x.glb x', "'x'", 'leave it out'),
    ('generate ship -o x.glb --imported-triangles 9', '--imported-triangles', 'add --imported-detail'),
    ('generate ship -o x.glb --objects 3', 'objects', '100'),
    ('generate ship -o x.step', '-o', '.glb or .obj'),
    ('generate ship -o x.glb --truth t.csv', '--truth', '.json'),
    ('generate ship -o x.glb --truth x.glb', '--truth', '.json'),
    ('completion', 'bash|zsh|fish is not given', 'completion --help'),
    ('completion tcsh', "'tcsh'", 'bash|zsh|fish'),
    ('info', 'no model file', '--help'), ('clash', 'no model file', '--help'), ('draw', 'no model file', '--help'),
    ("info ''", 'FILE', 'the value is empty'),
    ('info a.obj --colour', '--colour', 'info --help'),
    ('info a.obj --object 3', '--object', "did you mean '--objects'"),
    ('clash a.obj --clearence 25mm', '--clearence', "did you mean '--clearance'"),
    ('clash a.obj --clearance', '--clearance', 'wants a value'),
    ('clash a.obj --clearance 1mm --clearance 2mm', '--clearance', 'more than once'),
    ('clash a.obj --clearance @', '--clearance', '@NAME'), ('clash a.obj --clearance @A+@B', '--clearance', '@INSU + 25mm'),
    ('clash a.obj --quiet=maybe', '--quiet', 'takes no value'),
    ('clash a.obj --b x --self', '--self', 'leave one of them out'),
    ('clash a.obj --columns Tag', '--columns', '@Tag,@Area'), ('clash a.obj --columns @', '--columns', '@Tag,@Area'),
    ('clash a.obj --top x', '--top', 'digits only'), ('clash a.obj --top -1', '--top', 'digits only'),
    ('clash a.obj --class foo', '--class', 'hit,contact,clearance'), ('clash a.obj --class hit,,', '--class', 'hit,contact,clearance'),
    ('clash a.obj --list-exempted', '--list-exempted', 'add --rules'),
    ('clash a.obj --rules r.toml --clearance 3mm', '--clearance', 'leave one of them out'),
    ('clash a.obj --sort size', '--sort', 'add --group-by'),
    ('clash a.obj --group-contacts', '--group-contacts', 'add --group-by'),
    ('clash a.obj --group-distance 1m', '--group-distance', 'add --group-by proximity'),
    ('clash a.obj --write-decisions', '--write-decisions', 'add --decisions'),
    ('clash a.obj --deeper 1mm', '--deeper', 'add --decisions'),
    ('clash a.obj --match-files a.obj=b.obj', '--match-files', 'add --decisions'),
    ('clash a.obj --decisions d.txt --write-decisions', '--decisions', '.csv'),
    ("clash a.obj --decisions ''", '--decisions', 'the value is empty'),
    ('clash missing.obj --group-by element --group-distance 0', '--group-distance', 'such as 3m'),
    ('clash a.obj --group-by element --group-contacts --contacts count', '--group-contacts', 'leave out'),
    ('clash a.obj --bcf-max-topics 3', '--bcf-max-topics', 'add -o FILE.bcf'), ('clash a.obj --bcf-version 3.0', '--bcf-version', 'add -o FILE.bcf'),
    ('clash a.obj --bcf-author me', '--bcf-author', 'add -o FILE.bcf'), ('clash a.obj --bcf-contacts', '--bcf-contacts', 'add -o FILE.bcf'),
    ('clash a.obj --bcf-date 2026-13-01 -o x.bcf', '--bcf-date', '2026-01-31'),
    ('clash a.obj --page-geometry all', '--page-geometry', 'add -o FILE.html'),
    ('report -o x.html', '-p', 'no project'), ('report -p p.strake', '-o', 'nowhere'),
    ('report -p p.strake -o x.pdf', '-o', '.html'), ('report -p p.strake -o x.html --page-geometry half', '--page-geometry', 'auto'),
    ('clash a.obj -o x', '-o', '.json or .csv or '),
    ('clash a.obj -o a.obj', '-o', '.json or .csv or '),
    ('clash a.obj -o x.json -o ./x.json', '-o', 'twice'),
    ('clash a.obj --log-pairs x.json', '--log-pairs', '.csv'),
    ('clash a.obj --top-pictures 3', '--top-pictures', '--pictures'),
    ('clash a.obj --bcf-history', '--bcf-history', 'add -o FILE.bcf'),
    *((f'{verb} a.obj {option} {value}', option, 'add --scheduler') for verb in ('clash', 'draw')
      for option, value in (('--worker-memory', '1GiB'), ('--worker-threads', '2'), ('--tile-folder', 't'))),
    *((f"{verb} a.obj --scheduler ''", '--scheduler', 'the value is empty') for verb in ('clash', 'draw')),
    ('clash a.obj -o x.csv --log-pairs x.csv', '--log-pairs', 'its own name'),
    *behind(['clash diff c.json c.json --match-files', 'draw diff v.view v.view --match-files'], [
        ('a.obj', 'names no two files'), ('b.obj=a.obj', 'it has a.obj'), ("''", 'the value is empty')]),
    ('clash diff', 'OLD is not given', 'diff --help'), ('clash diff c.json', 'NEW is not given', 'diff --help'),
    ('clash diff c.json c.json c.json', "'c.json'", 'one word too many'),
    ('clash diff c.json c.json -o x.csv', '-o', '.json'),
    ('clash diff c.json c.json -o c.json', '-o', 'overwritten'),
    ('clash diff c.json c.json --test all', '--test', 'leave it out'), ('clash diff c.json c.json --runs 1 2', '--runs', 'leave it out'),
    ('clash diff c.json c.json -p p.strake', '-p', 'out'), ('draw diff v.view v.view --view deck', '--view', 'leave it out'),
    ('clash diff c.json c.json --runs 1', '--runs', ''), ('info a.obj -p p.strake', "'a.obj'", "'strake project add'"),
    ('clash diff p.strake --runs 1 x', '--runs', ''), ('clash diff p.strake --runs x', '--runs', ''),
    ('draw a.obj', '-o', 'write -o FILE.svg'), ('draw a.obj -o x.doc', '-o', '.svg or .pdf'),
    ('draw a.obj -o x.svg --centre-lines wide', '--centre-lines', 'as 4mm'),
    ('draw a.obj -o x.svg --thin wide', '--thin', 'as 0.5mm'),
    ('draw a.obj -o x.svg --single-line wide', '--single-line', 'DN'),
    ("draw a.obj -o x.svg --style 'color=red: a'", '--style', 'write "#rrggbb"'),
    ("draw a.obj -o x.svg --style 'color=#c00000'", '--style', "write 'color=#c00000: PIPE*'"),
    ("draw a.obj -o x.svg --style 'pen=1mm: nobody'", '--style', ''),
    ('draw a.obj -o x.svg --view top --direction 1,1,1', '--direction', 'leave one of them out'),
    ('draw a.obj -o x.svg --eye 1,2,3', '--eye', 'add --target'),
    ('draw a.obj -o x.svg --target 1,2,3', '--target', 'add --eye'),
    ('draw a.obj -o x.svg --near 1m', '--near', 'add --eye'),
    ('draw a.obj -o x.svg --solver brute-force --global push', '--global', 'leave one of them out'),
    ('draw a.obj -o x.svg --sheet s.toml --view top', '--sheet', 'leave one of them out'),
    ('draw a.obj -o x.svg --visible-only --hidden all', '--visible-only', 'leave out'),
    ('draw a.obj --sheet s.toml', '-o', 'write -o FILE.svg'),
    ('draw a.obj --sheet s.toml --json', '--json', 'leave --json out'),
    ('draw a.obj --sheet s.toml -o x.json', '-o', '.svg'),
    ('draw diff', 'OLD is not given', 'diff --help'), ('draw diff v.view', 'NEW is not given', 'diff --help'),
    ('draw diff v.view v.view -o x.csv', '-o', '.json or .svg'),
    ('draw diff v.view v.view -o v.view', '-o', '.json or .svg'),
    ('evaluate all', "'all'", 'one word too many'), ('evaluate --only nothing', '--only', 'there is no case'),
    ('evaluate --scale big', '--scale', 'a number above 0'), ('evaluate --scale 0', '--scale', 'a number above 0'),
    ('evaluate --scale 100', '--scale', '4 at most'), ('evaluate --repeat 0', '--repeat', 'from 1 to 1000'),
    ('evaluate --repeat often', '--repeat', 'from 1 to 1000'), ('evaluate --limit soon', '--limit', 'a number above 0'),
    ('evaluate --threads 0', '--threads', 'from 1 to'), ('evaluate --threads some', '--threads', 'from 1 to'),
    *((f'cache clear --older-than {value}', '--older-than', '30d') for value in ('30', 'soon', '-1d', '1e300d')),
    ("cache clear --older-than ''", '--older-than', 'the value is empty'),
    ('evaluate --peers nowhere', 'nowhere', '--peers'), ('evaluate --peer-limit never', '--peer-limit', 'a number above 0'),
]

OUTPUT = [
    ('clash --project p.strake', 'p.strake', 'cannot be read'), ('draw --project p.strake -o x.svg', 'p.strake', 'cannot be read'),
    ('info --project a.obj', 'a.obj', 'is no project'), ('clash --project a.obj', 'a.obj', 'is no project'), ('draw --project a.obj -o x.svg', 'a.obj', 'is no project'),
    ('clash a.obj -o no/x.json', 'no/x.json', 'make the folder first'),
    ('clash a.obj -o d.json', 'd.json', 'give the name of a file'),
    ('clash a.obj --log-pairs no/x.csv', 'no/x.csv', 'make the folder first'),
    ('draw a.obj -o no/x.svg', 'no/x.svg', 'make the folder first'),
    ('generate ship -o no/x.glb', 'no/x.glb', 'make the folder first'),
    ('generate ship -o x.glb --truth no/t.json', 'no/t.json', 'make the folder first'),
    ('draw diff v.view v.view -o no/x.svg', 'no/x.svg', 'make the folder first'),
]


def gltf(**changes):
    """A glTF of one triangle, with members changed."""
    data = struct.pack('<9f', 0, 0, 0, 1, 0, 0, 0, 1, 0)
    document = {'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0}],
                'meshes': [{'primitives': [{'attributes': {'POSITION': 0}}]}],
                'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3'}],
                'bufferViews': [{'buffer': 0, 'byteLength': 36}], 'buffers': [{'byteLength': 36, 'uri': 'b.bin'}]}
    return data, json.dumps(document | changes)


WHOLE_RVM = rvm([('/A', (0, 0, 0))])
# Files that cannot be read: the name, what is in it, and what the answer says besides the name and a mend.
MODELS = [
    ('missing.rvm', None, 'cannot be read'), ('folder', None, 'folder'), ('empty.obj', b'', 'is empty'),
    ('letter.txt', b'Dear reader,\n', 'unsupported format'), ('plan.ifc', b'ISO-10303-21;\n', 'IfcConvert'),
    ('part.STEP', b'ISO-10303-21;\n', 'export it'), ('scan.fbx', b'Kaydara\n', 'Blender'),
    ('scan.ply', b'ply\nformat ascii 1.0\n', 'does not end'),
    ('noise.glb', b'\x00\x01\x02\x03' * 9, 'JSON'),
    ('short.glb', b'glTF\x02\0\0\0', 'ends within the GLB header'),
    ('one.glb', b'glTF\x01\0\0\0' + bytes(12), 'version'),
    ('cut.glb', b'glTF\x02\0\0\0\xff\0\0\0\x10\0\0\0JSON', 'export'),
    ('comma.gltf', gltf()[1].replace(', ', ',, ', 1), 'JSON'), ('half.gltf', gltf()[1][:90], 'JSON'),
    ('old.gltf', gltf(asset={'version': '1.0'})[1], 'version'), ('none.gltf', gltf()[1].replace('asset', 'asst'), 'asset'),
    ('lost.gltf', gltf(buffers=[{'byteLength': 36, 'uri': 'lost.bin'}])[1], 'lost.bin'),
    ('far.gltf', gltf(buffers=[{'byteLength': 36, 'uri': '../../etc/passwd'}])[1], 'passwd'),
    ('head.rvm', WHOLE_RVM[:40], 'HEAD'), ('first.rvm', WHOLE_RVM[:10], 'no HEAD chunk'),
    ('first.rev', b'CNTB\n', 'no HEAD chunk'), ('half.rev', b'HEAD\n    1     2\n', 'END chunk'),
    ('lone.att', b'ATTRIBUTES', 'unsupported format'),
    ('none.obj', b'f 1 2 3\n', 'refers to vertex 1'), ('far.obj', b'v 0 0 0\nf 1 1 9\n', 'refers to vertex 9'),
    ('flat.obj', b'v 0 0\nf 1 1 1\n', 'no readable place'), ('nan.obj', b'v nan 0 0\nf 1 1 1\n', 'no readable place'),
    ('word.stl', b'solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 x\n', 'three finite numbers'),
    ('none.stl', b'solid a\nendsolid a\n', 'no faces'), ('cut.stl', b'x' * 80 + struct.pack('<I', 5) + bytes(60), 'of the 5 facets'),
    ('short.stl', b'x' * 30, '84 bytes'),
]
RESULTS = [
    ('missing.json', None, 'cannot be read'), ('empty.json', '', 'empty'), ('letter.json', 'Dear reader,\n', 'JSON'),
    ('list.json', '[]', 'clash'), ('other.json', '{"a": 1}', 'clash'), ('cut.json', 'CUT', 'ends too soon'),
    ('new.json', 'NEW', 'version'), ('model.obj', 'v 0 0 0\n', 'JSON'),
]
VIEWS = [('missing.view', None, 'cannot be read'), ('empty.view', '', 'empty'), ('letter.view', 'Dear reader,\n', 'view'),
         ('list.view', '[]', 'draw'), ('c.json', 'KEEP', 'draw'), ('cut.view', 'CUT', 'ends'), ('new.view', 'NEW', 'version')]

# Text of a file that is wrong, the place that the answer names, and what else it says.
TEST = '[[test]]\nname = "t"\na = "*"\nb = "*"\n'
RULES = [
    ('[[test]\n', 'line 1', ']'), ('clearance = ', 'line 1', 'value'), ('[defaults]\nclearance = 25\n', 'line 2', '25mm'),
    ('[defaults]\nclearance = "25"\n', 'line 2', '25mm'), ('[defaults]\nclearance = "-1mm"\n', 'line 2', 'negative'),
    ('[defaults]\nclearance = "1,5mm"\n', 'line 2', '1.5mm'), ('[defaults]\nclearance = "2km"\n', 'line 2', 'kilometre'),
    ('[defaults]\nclearence = "2mm"\n', 'line 2', 'clearance'), ('[default]\n', 'line 1', 'defaults'),
    ('[[tests]]\n', 'line 1', 'test'), ('[[test]]\n', 'line 1', 'name'), ('[[test]]\nname = ""\n', 'line 1', 'name'),
    ('[[test]]\nname = 3\n', 'line 2', 'text in quotes'), (TEST.replace('"*"', '"name ="', 1), 'line 3', 'column 7'),
    (TEST.replace('"*"', '"set(x)"', 1), 'line 3', "no set is called 'x'"), (TEST + TEST, 'line 5', 'twice'),
    ('[[allowed]]\nname = "x"\n', 'line 1', "'a'"), ('[sets]\nx = "set(x)"\n' + TEST, 'line 2', 'itself'),
    ('a = 1\na = 2\n', 'line 2', 'a'), ('\0', 'line 1', ''), ('[sets]\nx = 3\n' + TEST, 'line 2', 'selection'),
]
VIEW = '[[view]]\nname = "v"\n'
SHEETS = [
    ('', '', 'arrangement = "first-angle"'), ('[[view]]\n', 'line 1', 'name'), (VIEW + VIEW, 'line 3', 'v'),
    (VIEW + 'direction = "askew"\n', 'line 3', '"top", "bottom"'), (VIEW + 'scale = "100"\n', 'line 3', '1:100'),
    (VIEW + 'scale = 100\n', 'line 3', '1:50'), (VIEW + 'select = "name ="\n', 'line 3', 'column 7'),
    (VIEW + 'sections = ["z"]\n', 'line 3', 'z>4500mm'), (VIEW + 'hidden = "dotted"\n', 'line 3', 'dashed'),
    (VIEW + 'limits = "all"\n', 'line 3', 'neither a box nor "auto"'),
    (VIEW + 'limits = { min = [0, 0, 0] }\n', 'line 3', 'both corners'), (VIEW + 'position = ["1mm"]\n', 'line 3', 'list of 2'),
    (VIEW + 'sharp_angle = "200deg"\n', 'line 3', 'angle'), (VIEW + 'hatch = { angel = "9deg" }\n', 'line 3', 'angle'),
    (VIEW + 'titel = "x"\n', 'line 3', 'title'), (VIEW + '[[tag]]\ntext = "x"\n', 'line 3', 'select'),
    (VIEW + '[[tag]]\nselect = "*"\ntext = "x"\nviews = ["w"]\n', 'line 3', "no view 'w'"),
    ('[[tag]]\nselect = "*"\ntext = "x"\nviews = ["w"]\n', 'line 1', 'no views are defined'),
    ('[sheet]\nsize = "A9"\n', 'line 2', 'A3'), ('[sheet]\ntemplate = "t.svg"\n' + VIEW, 't.svg', 'cannot be read'),
    ('[sheet]\ntemplate = "letter.txt"\n' + VIEW, 'letter.txt', 'SVG'), ('arrangement = "second-angle"\n', 'line 1', 'first-angle'),
    ('[arrangement]\nviews = ["tip"]\n', 'line 1', 'top'),
]

SIZE = "<svg xmlns='http://www.w3.org/2000/svg' width='420mm' height='297mm'"
BOX = SIZE + " viewBox='0 0 420 297'"
TEMPLATES = [
    ('', 'there is no element'), ('<html/>', 'not <svg>'), ('<svg/>', 'does not say its size'), (SIZE + '/>', 'viewBox'),
    (BOX.replace('420mm', 'wide') + '/>', '297mm'), (BOX + '><text>', '<text> is not closed'), (BOX + '></text>', 'svg'),
    (BOX + '><script/></svg>', '<script> has no place'), (BOX + " onload='x()'/>", "'onload' has no place"),
    (BOX + "><image href='http://x/y.png'/></svg>", 'http://x/y.png'), (BOX + '><text>{{x</text></svg>', 'write {{name}}'),
    ('<!DOCTYPE svg><svg/>', 'document type'), (BOX + '><g a=1/></svg>', "not in quotes"), ('<!-- ', 'does not end'),
]


class WrongInputs(Scenario):
    def setUp(self):
        super().setUp()
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100))
        for outputs in (('clash', 'c.json'), ('draw', 'v.view')):
            self.text(outputs[0], 'a.obj', '--quiet', '-o', outputs[1])
        (self.folder / 'd.json').mkdir()
        (self.folder / 'folder').mkdir()
        (self.folder / 'b.bin').write_bytes(gltf()[0])
        self.write('s.toml', 'arrangement = "first-angle"\n')
        self.write('letter.txt', 'Dear reader,\n')

    def refused(self, arguments, code, place, stated):
        """Runs it and checks the answer: one line that names the place, says this, and ends in a mend; nothing else is left."""
        before = self.files()
        with self.subTest(shlex.join(arguments)):
            done = self.run_strake(*arguments)
            self.assertEqual((done.returncode, done.stdout), (code, ''), done.stderr)
            errors = [line for line in done.stderr.splitlines() if line.startswith('strake: error: ')]
            self.assertEqual(len(errors), 1, done.stderr)
            self.assertIn(place, errors[0])
            self.assertIn(stated, errors[0])
            self.assertRegex(errors[0], r' \(.+\)$', 'a mend')
            self.assertNotRegex(done.stderr, r'std::|terminate|what\(\)|internal fault|bad_alloc|_[A-Z]\w+_')
        left = set(self.files()) - set(before)
        for name in left:
            (self.folder / name).unlink()
        with self.subTest(shlex.join(arguments)):
            self.assertEqual(left, set())

    def test_command_lines(self):
        for line, place, stated in USAGE:
            self.refused(shlex.split(line), 2, place, stated)
        for line, place, stated in OUTPUT:
            self.refused(shlex.split(line), 3, place, stated)

    def made(self, name, content, whole):
        """Writes a file, or what is left of a whole one."""
        if content == 'CUT':
            content = whole[:len(whole) // 2]
        elif content == 'NEW':
            content = re.sub(rb'("schema_version": ?)[0-9]', rb'\g<1>9', whole, count=1)
        if content is not None and content != 'KEEP':
            (self.folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
        return name

    def test_models(self):
        for name, content, stated in MODELS:
            self.made(name, content, b'')
            for verb in (['info'], ['clash', '-o', 'x.json'], ['draw', '-o', 'x.svg']):
                self.refused([*verb, name], 3, name, stated)

    def test_results_and_drawings(self):
        for verb, good, files in (('clash', 'c.json', RESULTS), ('draw', 'v.view', VIEWS)):
            whole = (self.folder / good).read_bytes()
            for name, content, stated in files:
                self.made(name, content, whole)
                self.refused([verb, 'diff', name, good, '-o', 'x.json'], 3, name, stated)
                self.refused([verb, 'diff', good, name, '-o', 'x.json'], 3, name, stated)

    def test_settings(self):
        for name, option, output, files in (('r.toml', ['clash', '--rules'], 'x.json', RULES),
                                            ('w.toml', ['draw', '--sheet'], 'x.svg', SHEETS)):
            for text, place, stated in files:
                self.write(name, text)
                verb, flag = option
                where = f'{name}, {place}' if place.startswith('line ') else place or name
                with self.subTest(text=text):
                    self.refused([verb, 'a.obj', flag, name, '-o', output], 3, where, stated)
            self.refused([option[0], 'a.obj', option[1], 'missing.toml', '-o', output], 3, 'missing.toml', 'cannot be read')
            self.refused([option[0], 'a.obj', option[1], 'folder', '-o', output], 3, 'folder', 'file')

    def test_templates(self):
        self.write('w.toml', '[sheet]\ntemplate = "t.svg"\n' + VIEW)
        for text, stated in TEMPLATES:
            self.write('t.svg', text)
            with self.subTest(text=text):
                self.refused(['draw', 'a.obj', '--sheet', 'w.toml', '-o', 'x.svg'], 3, 't.svg, line 1', stated)

    def test_there_is_a_row_for_every_option(self):
        named = ' '.join(line for line, _, _ in USAGE + OUTPUT) + ' --rules --sheet'
        flags = {'--help', '--version', '--json', '--stats', '--strict', '--obstructions', '--insulation', '--curves', '--volumes',
                 '--turned', '--fresh', '--attributes', '--formats', '--title', '--output', '--compare'}
        for verb in (['clash'], ['clash', 'diff'], ['draw'], ['draw', 'diff'], ['info'], ['report'], ['evaluate'], ['generate', 'ship'],
                     ['cache', 'list'], ['cache', 'clear'],
                     *(['project', verb] for verb in ('new', 'add', 'update', 'remove', 'list', 'info', 'check', 'export'))):
            for option in self.options(verb) - flags:
                with self.subTest(verb=verb, option=option):
                    self.assertRegex(named, re.escape(option) + r'\b')


if __name__ == '__main__':
    main()
