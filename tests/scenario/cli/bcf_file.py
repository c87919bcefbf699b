# SPDX-License-Identifier: Apache-2.0
"""A reader of BCF that shares nothing with the program: zip and XML of the standard library, and what the specification
of 2.1 and 3.0 says of names, order and words. Where BCF_XSD names a folder with the schemas of the two versions in folders
called 2.1 and 3.0, xmllint validates each file by them."""
import os
import re
import shutil
import struct
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile
import zlib
from pathlib import Path

GUID = re.compile('[a-f0-9]{8}-[a-f0-9]{4}-[a-f0-9]{4}-[a-f0-9]{4}-[a-f0-9]{12}')
DATE = re.compile(r'\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ')
TOPIC = ['ReferenceLink', 'ReferenceLinks', 'Title', 'Priority', 'Index', 'Labels', 'CreationDate', 'CreationAuthor',
         'ModifiedDate', 'ModifiedAuthor', 'DueDate', 'AssignedTo', 'Stage', 'Description', 'BimSnippet', 'DocumentReference',
         'DocumentReferences', 'RelatedTopic', 'RelatedTopics', 'Comments', 'Viewpoints']
SCHEMAS = {'markup.bcf': 'markup', 'viewpoint.bcfv': 'visinfo', 'bcf.version': 'version', 'extensions.xml': 'extensions'}


class Bcf:
    """A BCF file, checked as it is read: `fault` is called with what is wrong."""

    def __init__(self, path, fault):
        self.path, self.fault = path, fault
        with zipfile.ZipFile(path) as archive:
            self.check(archive.testzip() is None, 'an entry is damaged')
            self.entries = archive.infolist()
            self.bytes = {entry.filename: archive.read(entry) for entry in self.entries}
        self.version = ElementTree.fromstring(self.bytes['bcf.version']).get('VersionId')
        self.topics = [self.topic(entry.filename[:-1]) for entry in self.entries if entry.filename.endswith('/')]
        self.check_archive()
        self.validate()

    def check(self, holds, what):
        if not holds:
            self.fault(f'{self.path}: {what}')

    def check_archive(self):
        names = [entry.filename for entry in self.entries]
        self.check(len(set(names)) == len(names), 'a name stands there twice')
        self.check(all(entry.date_time == (1980, 1, 1, 0, 0, 0) for entry in self.entries), 'the time of a run')
        self.check(names[0] == 'bcf.version', 'bcf.version does not come first')
        self.check(('extensions.xml' in names) == (self.version == '3.0'), 'extensions.xml')
        for name in names:
            self.check(re.fullmatch(r'bcf\.version|extensions\.xml|[0-9a-f-]{36}/(markup\.bcf|viewpoint\.bcfv|snapshot\.png)?',
                                    name), f'the name {name!r}')
            if '/' in name:
                self.check(name.split('/')[0] + '/' in names[:names.index(name) + 1], f'no folder before {name}')

    def topic(self, folder):
        """The facts of a topic, whatever the version."""
        markup = ElementTree.fromstring(self.bytes[f'{folder}/markup.bcf'])
        topic = markup.find('Topic')
        three = self.version == '3.0'
        self.check(GUID.fullmatch(folder) and topic.get('Guid') == folder, f'the GUID of {folder}')
        self.check([e.tag for e in markup][:2] == ['Header', 'Topic'], 'the order of a markup')
        order = [TOPIC.index(e.tag) for e in topic]
        self.check(order == sorted(order), f'the order of a topic: {[e.tag for e in topic]}')
        self.check(three or not {'Comments', 'Viewpoints'} & {e.tag for e in topic}, 'what is within a topic')
        comments = list(topic.find('Comments') if three else markup.findall('Comment'))
        views = list(topic.find('Viewpoints') if three else markup.findall('Viewpoints'))
        changed = [c.findtext('ModifiedDate') for c in comments if c.find('ModifiedDate') is not None]
        if topic.find('ModifiedDate') is not None:
            changed.append(topic.findtext('ModifiedDate'))
        for date in [topic.findtext('CreationDate'), *(c.findtext('Date') for c in comments), *changed]:
            self.check(DATE.fullmatch(date), f'the date {date}')
        for guid in [e.get('Guid') for e in [*comments, *views]]:
            self.check(GUID.fullmatch(guid), f'the GUID {guid}')
        return {'guid': folder, 'title': topic.findtext('Title'), 'status': topic.get('TopicStatus'),
                'type': topic.get('TopicType'), 'priority': topic.findtext('Priority'),
                'labels': [e.text for e in (topic.find('Labels') if three else topic.findall('Labels'))],
                'modified': (topic.findtext('ModifiedDate'), topic.findtext('ModifiedAuthor')),
                'created': topic.findtext('CreationDate'), 'author': topic.findtext('CreationAuthor'),
                'assignee': topic.findtext('AssignedTo'), 'description': topic.findtext('Description'),
                'files': [e.findtext('Filename') for e in markup.iter('File')],
                'comments': [(c.findtext('Date'), c.findtext('Author'), c.findtext('Comment')) for c in comments],
                'comment_guids': [c.get('Guid') for c in comments],
                'edited': [(c.findtext('ModifiedDate'), c.findtext('ModifiedAuthor')) for c in comments],
                'projects': [e.get('IfcProject') for e in markup.iter('File')],
                'file_dates': [e.findtext('Date') for e in markup.iter('File')],
                'view': self.view(folder, views[0]) if views else None}

    def view(self, folder, pointer):
        self.check(pointer.findtext('Viewpoint') == 'viewpoint.bcfv' and pointer.findtext('Snapshot') == 'snapshot.png',
                   'the first viewpoint has the names that readers of 2.1 look for')
        root = ElementTree.fromstring(self.bytes[f'{folder}/viewpoint.bcfv'])
        self.check(root.get('Guid') == pointer.get('Guid'), 'the GUID of a viewpoint')
        self.check([e.tag for e in root] in (['Components', 'PerspectiveCamera'],
                                             ['Components', 'PerspectiveCamera', 'ClippingPlanes']), 'the order of a viewpoint')
        self.check([e.tag for e in root.find('Components')] == ['Selection', 'Visibility', 'Coloring'],
                   'the order of components')

        def vector(element):
            return tuple(float(element.findtext(axis)) for axis in 'XYZ')
        camera = root.find('PerspectiveCamera')
        self.check((camera.find('AspectRatio') is not None) == (self.version == '3.0'), 'AspectRatio')
        self.check(45 <= float(camera.findtext('FieldOfView')) <= 60, 'FieldOfView')
        colors = {color.get('Color'): [self.component(c) for c in color.iter('Component')]
                  for color in root.find('Components/Coloring')}
        self.check(all(re.fullmatch('FF[0-9A-F]{6}', color) for color in colors), f'the colours {list(colors)}')
        return {'eye': vector(camera.find('CameraViewPoint')), 'direction': vector(camera.find('CameraDirection')),
                'up': vector(camera.find('CameraUpVector')), 'colors': colors,
                'selection': [self.component(c) for c in root.find('Components/Selection')],
                'planes': [(vector(p.find('Location')), vector(p.find('Direction'))) for p in root.iter('ClippingPlane')],
                'size': png_size(self.bytes[f'{folder}/snapshot.png'])}

    @staticmethod
    def component(element):
        return element.get('IfcGuid') or (element.findtext('OriginatingSystem'), element.findtext('AuthoringToolId'))

    def validate(self):
        """By the schemas, where they are."""
        schemas = os.environ.get('BCF_XSD')
        if not schemas or not shutil.which('xmllint'):
            return
        with tempfile.TemporaryDirectory() as folder:
            groups = {}
            for number, (name, content) in enumerate(self.bytes.items()):
                if schema := SCHEMAS.get(name.rsplit('/', 1)[-1]):
                    path = Path(folder, f'{number}.xml')
                    path.write_bytes(content)
                    groups.setdefault(schema, []).append(path)
            for schema, paths in groups.items():
                done = subprocess.run(['xmllint', '--noout', '--nonet', '--schema', f'{schemas}/{self.version}/{schema}.xsd',
                                       *paths], capture_output=True, text=True, check=False)
                self.check(done.returncode == 0, done.stderr[:2000])


def png_size(content):
    """Width and height of a PNG whose checksums are right."""
    assert content.startswith(b'\x89PNG\r\n\x1a\n')
    at, size = 8, None
    while at < len(content):
        length, kind = struct.unpack('>I4s', content[at:at + 8])
        body = content[at + 4:at + 8 + length]
        assert zlib.crc32(body) == struct.unpack('>I', content[at + 8 + length:at + 12 + length])[0]
        if kind == b'IHDR':
            size = struct.unpack('>II', body[4:12])
        at += 12 + length
    return size


def rewrite(path, target, change):
    """Writes a copy in which change(name, root) had its way with the root of each markup.bcf."""
    with zipfile.ZipFile(path) as archive, zipfile.ZipFile(target, 'w', zipfile.ZIP_DEFLATED) as copy:
        for entry in archive.infolist():
            content = archive.read(entry)
            if entry.filename.endswith('markup.bcf'):
                root = ElementTree.fromstring(content)
                change(root)
                content = ElementTree.tostring(root)
            copy.writestr(entry.filename, content)


def add_comment(markup, guid, date, author, text):
    """Adds a comment where the version has them."""
    parent, at = markup.find('Topic/Comments'), None
    if parent is None:
        parent, at = markup, 2
    comment = ElementTree.Element('Comment', {'Guid': guid})
    for name, value in (('Date', date), ('Author', author), ('Comment', text)):
        ElementTree.SubElement(comment, name).text = value
    parent.insert(len(parent) if at is None else at, comment)


def assign(topic, name):
    """Sets who sees to a topic, in the place that the schemas have for it."""
    element = topic.find('AssignedTo')
    if element is None:
        element = ElementTree.Element('AssignedTo')
        topic.insert(list(topic).index(topic.find('Description')), element)
    element.text = name


def approve(topic, date, author):
    """Approves a topic, and says when and by whom it was changed."""
    topic.set('TopicStatus', 'Approved')
    for name, value in (('ModifiedDate', date), ('ModifiedAuthor', author)):
        element = topic.find(name)
        if element is None:
            element = ElementTree.SubElement(topic, name)
        element.text = value
