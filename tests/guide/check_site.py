#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_site.py PROJECT COMPONENTS OUT: builds the site of `./run docs` in OUT and looks whether it has a page for each
installed header and for no other, the classes and functions that a program begins with, and the guide; whether its
links lead somewhere; and whether a comment with a fault fails the build. 77: no Doxygen here."""
import shutil
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# Functions stand on the pages of their headers.
FUNCTIONS = {
    'clash/clash.hpp': ['detect', 'scene_options', 'one_set'],
    'clash/group.hpp': ['group_results'],
    'drawing/drawing.hpp': ['lay_out'],
    'drawing/write.hpp': ['write_svg', 'write_pdf'],
    'generate/ship.hpp': ['generate_ship'],
    'geometry/closest.hpp': ['closest_points'],
    'hlr/hlr.hpp': ['draw'],
    'io/reader.hpp': ['read_models'],
    'io/writer.hpp': ['write_glb'],
    'model/scene.hpp': ['make_scene'],
    'model/selection.hpp': ['pick'],
    'parallel/for_each.hpp': ['for_each', 'for_each_with'],
    'parallel/reduce.hpp': ['reduce'],
    'parallel/transform.hpp': ['transform'],
    'report/clash.hpp': ['write_clash_json'],
}
CLASSES = ['AtomicFile', 'Result', 'parallel::Team', 'parallel::Context', 'geometry::Part', 'model::Model', 'model::Scene',
           'model::Selection', 'clash::Report', 'clash::Pair', 'rules::Rules', 'hlr::Drawing', 'sheets::SheetFile']
PAGES = ['index', 'library', 'clash', 'hlr', 'rules', 'selection', 'project', 'sources', 'patterns', 'patterns_team',
         'formats_primitives', 'decisions', 'decisions_0058_what_is_public', 'project_architecture', 'project_changelog', 'modules', 'examples',
         'find_clashes_8cpp-example']


class Page(HTMLParser):
    """What a page refers to, and the places in it."""

    def __init__(self, text):
        super().__init__()
        self.links, self.places = set(), set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ('href', 'src') and value:
                self.links.add(value)
            elif name in ('id', 'name') and value:
                self.places.add(value)


def broken_links(site, texts):
    pages = {name: Page(text) for name, text in texts.items()}
    for name, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            target = unquote(parts.path) or name
            if parts.scheme or parts.netloc:
                continue
            if not (site / target).is_file():
                yield f'{name}: {link} leads nowhere'
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].places:
                yield f'{name}: there is no place {link}'


def page_of(header):
    return 'group__header__' + header.removesuffix('.hpp').replace('_', '__').replace('/', '__') + '.html'


def faults(site, texts, headers):
    if len(headers) < 60:
        yield f'only {len(headers)} headers'
    shown = {name for name in texts if name.startswith('group__header__')}
    yield from (f'no page of {header}' for header in headers if page_of(header) not in shown)
    yield from (f'{name} is of no installed header' for name in sorted(shown - {page_of(header) for header in headers}))
    for header, functions in FUNCTIONS.items():
        text = texts.get(page_of(header), '')
        yield from (f'{header}: {name}() is not told of' for name in functions if f'</span>{name}()' not in text)
    for name in CLASSES:
        file = 'strake_1_1' + name.replace('::', '_1_1') + '.html'
        if f'class{file}' not in texts and f'struct{file}' not in texts:
            yield f'no page of {name}'
    yield from (f'no page {name}.html' for name in PAGES if f'{name}.html' not in texts)
    yield from broken_links(site, texts)


def main():
    if not shutil.which('doxygen'):
        print('no Doxygen here: ./run docs installs it')
        sys.exit(77)
    project, components, out = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3]).resolve()
    sys.path.insert(0, str(project / 'scripts'))
    import make_docs  # pylint: disable=import-outside-toplevel
    make_docs.main([components, out])
    site = make_docs.Site(make_docs.read_components(components), out)
    texts = {path.name: path.read_text(encoding='utf-8') for path in (out / 'html').glob('*.html')}
    found = list(faults(out / 'html', texts, [header for header in site.headers if site.has_page(header)]))
    wrong = out / 'input/wrong.hpp'
    wrong.write_text('namespace strake {\n/// As @ref nowhere.\nvoid wrong();\n}\n', encoding='utf-8')
    try:
        make_docs.run_doxygen(site, out)
        found.append('a reference to nowhere passes')
    except make_docs.Faults:
        pass
    if found:
        sys.exit('\n'.join(found))


if __name__ == '__main__':
    main()
