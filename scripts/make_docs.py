#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_docs.py COMPONENTS OUT: the guide and the API reference as a site, OUT/html. COMPONENTS is the components.txt of
a configured build: what it installs is what is documented. Pages, examples and headers are copied to OUT/input, line for
line, with links as Doxygen spells them; any fault that Doxygen finds is one of this run."""
import html
import posixpath
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
THEME = Path('/usr/share/doxygen-awesome-css')
STYLES = ['doxygen-awesome.css', 'doxygen-awesome-sidebar-only.css']
# The parts of the navigation, each of a folder: (label, title, folder, the pages to begin with); others follow by name.
PARTS = [
    ('guide', 'Using Strake', 'docs', ['library', 'clash', 'rules', 'selection', 'reading-results', 'project',
                                        'hlr', 'hidden-line-algorithms', 'drawing', 'sheets', 'evaluation']),
    ('patterns', 'Parallel patterns', 'docs/patterns', []),
    ('decisions', 'Decisions', 'docs/decisions', []),
    ('sources', 'The project', '.', ['ARCHITECTURE', 'HACKING', 'CONTRIBUTING', 'SECURITY', 'CHANGELOG']),
]
CODE_SPAN = r'(?P<tick>`+)(?!`)(?P<code>(?:(?!\n\n).)+?)(?<!`)(?P=tick)(?!`)'
LINK = r'(?P<image>!?)\[(?P<text>(?:[^\[\]`]|`[^`]*`)*)\]\((?P<to>[^()\s]+)\)'
SPANS = re.compile(f'{CODE_SPAN}|{LINK}|(?P<dashes>(?<!-)--(?=\\w))', re.DOTALL)


class Faults(Exception):
    """What Doxygen has told of already."""


def identifier(path):
    """A label of Doxygen for a file."""
    return re.sub(r'\W+', '_', re.sub(r'(/README)?\.(md|hpp)$', '', path)).strip('_').lower()


def slug(heading):
    """What the sections of a page are called in links, as on GitHub."""
    return re.sub(r'[^\w\- ]', '', heading.strip().lower()).replace(' ', '-')


def read_components(path):
    components = []
    for line in Path(path).read_text(encoding='utf-8').splitlines():
        fact, *values = line.split()
        if fact == 'component':
            components.append({'name': values[0]})
        else:
            components[-1][fact] = values
    return components


def files_of(entries, folder, suffix):
    """Files and folders, the folders as the files in them."""
    for entry in entries:
        path = folder / entry
        yield from sorted(path.rglob(f'*{suffix}')) if path.is_dir() else [path] * (path.suffix == suffix)


class Site:
    """What there is to link to, and what was found wrong."""

    def __init__(self, components, out):
        self.components, self.input = components, out / 'input'
        self.pages = {path.relative_to(ROOT).as_posix() for folder in ('.', 'docs', 'tests/fuzz')
                      for path in (ROOT / folder).glob('**/*.md' if folder == 'docs' else '*.md')}
        self.examples = sorted(path.relative_to(ROOT / 'examples').as_posix()
                               for path in (ROOT / 'examples').rglob('*.cpp'))
        self.headers, self.pictures, self.listings, self.faults = {}, set(), set(), []
        for component in components:
            for path in files_of(component['headers'], ROOT / 'include/strake', '.hpp'):
                self.headers[path.relative_to(ROOT / 'include/strake').as_posix()] = component['name']
        self.names = {name for header in self.headers for name in declared(self.text_of(header))}
        self.sections = {page: sections_of((ROOT / page).read_text(encoding='utf-8')) for page in self.pages}

    def header_page(self, name):
        """The page of the one header that is meant by a name such as team.hpp or strake/io/reader.hpp."""
        found = [header for header in self.headers if f'/strake/{header}'.endswith(f'/{name}')]
        return header_id(found[0]) if len(found) == 1 and self.has_page(found[0]) else None

    def text_of(self, header):
        return (ROOT / 'include/strake' / header).read_text(encoding='utf-8')

    def has_page(self, header):
        """Not a part of others, which has nothing in it for users."""
        return not re.search(r'^namespace \S+::detail \{', self.text_of(header), re.MULTILINE)

    def target(self, page, to):
        """What a link on a page is in the site: a reference, or an address."""
        path, _, section = to.partition('#')
        path = posixpath.normpath(posixpath.join(posixpath.dirname(page), path)) if path else page
        if f'{path}/README.md' in self.pages:
            path += '/README.md'
        if path in self.pages and (not section or section in self.sections[path]):
            return f'@ref {page_id(path)}' + (f'-{section}' if section else '')
        if path == 'examples' and not section:
            return 'examples.html'
        if path.startswith('examples/') and path[9:] in self.examples:
            return example_address(path[9:])
        if (ROOT / path).is_file() and not section:
            if path.endswith(('.png', '.svg')):
                self.pictures.add(path)
                return f'pictures/{posixpath.basename(path)}'
            self.listings.add(path)
            return f'@ref {identifier(path)}'
        self.faults.append(f'{page}: the link to {to} leads nowhere')
        return to

    def code_span(self, text):
        """Names of headers, examples and what headers declare are links."""
        name = text.removeprefix('include/')
        header = self.header_page(name) if name.endswith('.hpp') else None
        call = 'strake::' + re.sub(r'\(.*', '', text.removeprefix('strake::'))
        if header or ('::' in text and call in self.names):
            return linked(f'@ref {header or call}', f'`{text}`')
        if name.startswith('examples/') and name[9:] in self.examples:
            return linked(example_address(name[9:]), f'`{text}`')
        # Doxygen ends a code span with one tick at an apostrophe.
        return f'``{text}``' if "'" in text else f'`{text}`'

    def span(self, page, match):
        """A code span, link or option, as it stands in the site."""
        if match['dashes']:
            return '\\--'
        if match['code']:
            return self.code_span(match['code']) if match['tick'] == '`' else match[0]
        if re.match(r'\w+:', match['to']):
            return match[0]
        to = self.target(page, match['to'])
        if match['image']:
            return f'<img src="{to}" alt="{html.escape(match["text"])}"/>'
        return linked(to, match['text'])

    def page(self, page):
        """The text of a page for Doxygen."""
        sections = iter(self.sections[page])
        out = []
        for is_code, text in blocks((ROOT / page).read_text(encoding='utf-8')):
            heading = not is_code and re.match(r'(#+) (.*)\n$', text)
            if heading:
                name = next(sections)
                title = SPANS.sub(lambda match: match[0] if match['code'] else self.span(page, match), heading[2])
                if re.match(r'docs/decisions/\d', page) and heading[1] == '#':
                    title = f'{Path(page).name[:4]} {title.removeprefix(Path(page).name[:4] + " ")}'
                label = page_id(page) if heading[1] == '#' else f'{page_id(page)}-{name}'
                out.append(f'{heading[1]} {title} {{#{label}}}\n')
            else:
                out.append(text if is_code else SPANS.sub(lambda match: self.span(page, match), text))
        if len(self.sections[page]) > 4 and page not in ('README.md', 'CHANGELOG.md'):
            out.insert(1, '@tableofcontents')
        return ''.join(out)


def blocks(text):
    """The text in pieces: (whether it is code, its lines). A heading is a piece of its own."""
    kind, lines, fenced, blank = None, [], False, True
    for line in text.splitlines(keepends=True):
        fence = line.startswith('```')
        code = fenced or fence or (line.startswith('    ') and (blank or kind == 'code'))
        now = 'code' if code else 'heading' if line.startswith('#') else kind if not line.strip() and kind == 'code' else 'text'
        if lines and (now != kind or now == 'heading'):
            yield kind == 'code', ''.join(lines)
            lines = []
        kind, blank, fenced = now, not line.strip(), fenced != fence
        lines.append(line)
    yield kind == 'code', ''.join(lines)


def sections_of(text):
    """The names of the sections of a page, in order, that of its title first."""
    names = []
    for is_code, block in blocks(text):
        if not is_code and block.startswith('#'):
            name = slug(block.lstrip('#'))
            names.append(name if name not in names else f'{name}-{sum(other.startswith(name) for other in names)}')
    return names


def linked(to, text):
    """A link of Doxygen, which shows no code within the text of a link."""
    code = re.fullmatch(r'`([^`]+)`', text)
    if code and '"' not in text:
        shown = code[1] if to.startswith('@ref') else html.escape(code[1])
        return f'<tt>{to} "{shown}"</tt>' if to.startswith('@ref') else f'<a href="{to}"><tt>{shown}</tt></a>'
    return f'[{text.replace("`", "")}]({to})'


def page_id(page):
    return 'mainpage' if page == 'README.md' else identifier(page.removeprefix('docs/') if page.count('/') else f'project/{page}')


def header_id(header):
    return 'header_' + identifier(header)


def example_address(name):
    """Where Doxygen puts an example: it writes signs of a name in letters of its own."""
    return name.replace('/', '_2').replace('.', '_8') + '-example.html'


def declared(text):
    """The names that a header declares for its users, in order."""
    space = re.search(r'^namespace (\S+) \{$', text, re.MULTILINE)
    code = re.sub(r'^namespace detail \{.*?^\}  // namespace detail|//.*?$', '', text, flags=re.MULTILINE | re.DOTALL)
    names = re.findall(r'^(?:enum class|enum|class|struct|using) (?:\[\[nodiscard\]\] )?(\w+)(?=[\s:{<])'
                       r'|^(?!template|namespace|using|class|struct|enum|static_assert)[\w\[][^(;={}#/]*?\b(\w+)\(',
                       code, re.MULTILINE)
    return list(dict.fromkeys(f'{space[1]}::{of_type or function}' for of_type, function in names)) if space else []


def brief_of(text):
    """The names that a header declares, where it says nothing of itself before its namespace."""
    if re.search(r'^///.*\n(?=namespace|// IWYU)', text, re.MULTILINE):
        return ''
    return '@brief ' + ', '.join(f'@ref {name} "{name.split("::")[-1]}"' for name in declared(text))


def documented(text, header, site):
    """A header for Doxygen: all that it declares stands on its own page; as many lines."""
    def links(match):
        return re.sub(r'\bdocs/[\w/-]+\.md\b', lambda to: f'[{to[0]}]({site.target("README.md", to[0])})', match[0])
    text = re.sub(r'///.*$', links, text, flags=re.MULTILINE)
    if not site.has_page(header):
        return text
    group = f'/** @addtogroup {header_id(header)}\n'
    opened = re.sub(r'^(namespace (\S+) \{)\n\n(.*?)^(\}  // namespace \2)$',
                    lambda match: f'{match[1]} {group}@{{ */\n{match[3]}/** @}} */ {match[4]}',
                    text, flags=re.MULTILINE | re.DOTALL)
    if opened == text and declared(text):
        site.faults.append(f'{header}: no namespace that begins with a blank line and ends with its name')
    return re.sub(r'^\n((?:^///.*\n)+)(?=namespace|// IWYU)',
                  lambda match: group + re.sub(r'^///', '', match[1], flags=re.MULTILINE).rstrip('\n') + ' */\n',
                  opened, count=1, flags=re.MULTILINE)


def component_words(site):
    """What the table in docs/library.md says of each component."""
    text = (ROOT / 'docs/library.md').read_text(encoding='utf-8')
    rows = re.findall(r'^\| `(\w+)` \| (.*?) \| [^|]*\|$', text, re.MULTILINE)
    return {name: SPANS.sub(lambda match: site.span('docs/library.md', match), words) for name, words in rows}


def component_page(site, component, words):
    """A component's page: what it is, how it is linked, its guide and its headers."""
    name = component['name']
    pages = [path.relative_to(ROOT).as_posix() for path in files_of(component['pages'], ROOT, '.md')]
    pages = [page for page in pages if page in site.pages and (page.count('/') < 2 or page.endswith('README.md'))]
    headers = [header for header, owner in site.headers.items() if owner == name]
    shown = [header for header in headers if site.has_page(header)]
    inner = ', '.join(f'`strake/{header}`' for header in headers if header not in shown)
    lines = [f'/** @defgroup component_{name} {name}', words, '',
             f'- In CMake: `find_package(strake COMPONENTS {name})`',
             '- It needs ' + (', '.join(f'@ref component_{other}' for other in component['depends']) or 'no other component')]
    if pages:
        lines.append('- In the guide: ' + ', '.join(f'@ref {page_id(page)}' for page in pages))
    if inner:
        lines += ['', f'Parts of the others, which include them: {inner}.']
    lines.append('*/')
    for header in shown:
        text = site.text_of(header)
        lines += [f'/** @defgroup {header_id(header)} {header}', f'@ingroup component_{name}',
                  brief_of(text), '', f'    #include <strake/{header}>', '*/']
    return '\n'.join(lines)


def namespace_pages(site):
    """Which component a namespace belongs to."""
    components = {}
    for header, component in site.headers.items():
        text = site.text_of(header)
        for name in re.findall(r'^namespace (strake(?:::\w+)?) \{$', text, re.MULTILINE):
            components.setdefault(name, {})[component] = None
    return '\n'.join(
        f'/** @namespace {name}\n@brief Of ' + ' and '.join(f'@ref component_{component}' for component in owners) + '. */'
        for name, owners in components.items())


def index_pages(site):
    """The pages above the others; the main page names them."""
    names = []
    for name, title, folder, order in PARTS:
        if f'{folder}/README.md' in site.pages and folder != '.':
            names.append(page_id(f'{folder}/README.md'))
            continue
        names.append(name)
        pages = sorted(page for page in site.pages if posixpath.dirname(page) == folder.strip('.') and page != 'README.md')
        if name == 'guide':
            pages += [*(page for page in site.pages if page.startswith('docs/formats/')), 'python/README.md', 'docs/pictures/README.md', *sorted(site.listings)]
        if name == 'sources':
            pages += ['tests/fuzz/README.md']
        pages.sort(key=lambda page: order.index(Path(page).stem) if Path(page).stem in order else len(order))
        lines = [f'# {title} {{#{name}}}', ''] + [
            f'- @subpage {page_id(page) if page in site.pages else identifier(page)}' for page in pages]
        (site.input / f'{name}_index.md').write_text('\n'.join(lines) + '\n', encoding='utf-8')
    return '\n'.join(['', '## On this site {#on_this_site}', ''] + [f'- @subpage {name}' for name in names] + [
        '- [Components and headers](modules.html)', '- [Examples](examples.html)', ''])


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding='utf-8')


def make_input(site):
    """All that Doxygen reads."""
    for header in site.headers:
        text = site.text_of(header)
        write(site.input / 'include/strake' / header, documented(text, header, site))
    texts = {page: site.page(page) for page in sorted(site.pages)}
    for page in sorted(site.pages):
        guide = f'{posixpath.dirname(page)}/README.md'
        if guide in ('docs/patterns/README.md', 'docs/decisions/README.md') and page != guide:
            # The first link of the guide to a page of it makes it one.
            texts[guide] = re.sub(rf'\[([^\]]*)\]\(@ref {page_id(page)}\)', rf'@subpage {page_id(page)} "\1"',
                                  texts[guide], count=1)
    words = component_words(site)
    for component in site.components:
        if component['name'] not in words:
            site.faults.append(f'docs/library.md: its table does not name the component {component["name"]}')
    write(site.input / 'components.dox', '\n'.join(
        component_page(site, component, words.get(component['name'], '')) for component in site.components)
        + '\n' + namespace_pages(site))
    texts['README.md'] += index_pages(site)
    for page, text in texts.items():
        write(site.input / page, text)
    for path in site.listings:
        language = {'.toml': '.py', '.cpp': '.cpp', '.hpp': '.cpp'}.get(Path(path).suffix, '.txt')
        text = (ROOT / path).read_text(encoding='utf-8')
        write(site.input / f'{path}.md', f'# {path} {{#{identifier(path)}}}\n\n```{{{language}}}\n{text}```\n')
    shutil.copytree(ROOT / 'examples', site.input / 'examples', dirs_exist_ok=True)
    write(site.input / 'examples.dox', '\n'.join(f'/** @example {name} */' for name in site.examples))


def style():
    """The settings that give the site its looks."""
    styles = [THEME / name for name in STYLES]
    if not all(path.exists() for path in styles):
        print('docs: no doxygen-awesome-css here: the site has the looks of Doxygen itself', file=sys.stderr)
        styles = []
    return ['HTML_EXTRA_STYLESHEET = ' + ' '.join(f'"{path}"' for path in styles + [ROOT / 'docs/site/strake.css'])]


def run_doxygen(site, out):
    version = re.search(r'project\(strake VERSION (\S+)', (ROOT / 'CMakeLists.txt').read_text(encoding='utf-8'))[1]
    settings = [f'@INCLUDE = "{ROOT / "docs/site/Doxyfile"}"', f'LAYOUT_FILE = "{ROOT / "docs/site/layout.xml"}"',
                f'PROJECT_NUMBER = {version}', f'OUTPUT_DIRECTORY = "{out}"', *style()]
    done = subprocess.run(['doxygen', '-'], input='\n'.join(settings), cwd=site.input, text=True,
                          stderr=subprocess.PIPE, check=False)
    sys.stderr.write(done.stderr.replace(f'{site.input}/', ''))
    if done.returncode != 0:
        raise Faults('docs: Doxygen found faults')
    for picture in site.pictures:
        target = out / 'html/pictures' / posixpath.basename(picture)
        target.parent.mkdir(exist_ok=True)
        shutil.copyfile(ROOT / picture, target)


def main(arguments):
    components, out = arguments[0], Path(arguments[1]).resolve()
    for folder in ('input', 'html'):
        shutil.rmtree(out / folder, ignore_errors=True)
    (out / 'input').mkdir(parents=True)
    site = Site(read_components(components), out)
    make_input(site)
    if site.faults:
        sys.exit('\n'.join(site.faults))
    try:
        run_doxygen(site, out)
    except Faults as faults:
        sys.exit(str(faults))
    print(f'{out / "html/index.html"}')


if __name__ == '__main__':
    main(sys.argv[1:])
