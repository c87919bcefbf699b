# SPDX-License-Identifier: Apache-2.0
"""Reads workbooks (.xlsx) by their XML, as a spreadsheet would: every cell with its type."""
import re
import xml.etree.ElementTree as ElementTree
import zipfile

MAIN = '{http://schemas.openxmlformats.org/spreadsheetml/2006/main}'
RELATION = '{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id'


def decoded(text):
    """What a reader makes of "_x0041_"."""
    return re.sub('_x([0-9a-fA-F]{4})_', lambda match: chr(int(match[1], 16)), text)


def column_number(reference):
    number = 0
    for letter in re.match('[A-Z]+', reference)[0]:
        number = number * 26 + ord(letter) - 64
    return number - 1


class Workbook:
    """The sheets of a file by name: rows of cells, texts and numbers; None where a cell is empty."""

    def __init__(self, path):
        with zipfile.ZipFile(path) as archive:
            self.names = archive.namelist()
            assert archive.testzip() is None
            self.dates = {entry.date_time for entry in archive.infolist()}
            self.parts = {name: archive.read(name) for name in self.names}
        links = {link.get('Id'): link.get('Target') for link in self.xml('xl/_rels/workbook.xml.rels')}
        self.parts_of_sheets = {sheet.get('name'): 'xl/' + links[sheet.get(RELATION)]
                                for sheet in self.xml('xl/workbook.xml').find(MAIN + 'sheets')}
        self.sheets = {name: self.rows(part) for name, part in self.parts_of_sheets.items()}

    def xml(self, part):
        return ElementTree.fromstring(self.parts[part])

    def rows(self, part):
        rows = []
        for number, row in enumerate(self.xml(part).find(MAIN + 'sheetData')):
            assert row.get('r') == str(number + 1)
            cells = []
            for cell in row:
                assert cell.find(MAIN + 'f') is None, 'a formula'
                cells += [None] * (column_number(cell.get('r')) - len(cells))
                if cell.get('t') == 'inlineStr':
                    cells.append(decoded(cell.find(f'{MAIN}is/{MAIN}t').text or ''))
                else:
                    cells.append(float(cell.find(MAIN + 'v').text))
            rows.append(cells)
        return rows

    def table(self, name):
        """The rows of a sheet with heads, each by them."""
        heads, *rows = self.sheets[name]
        return [dict(zip(heads, row + [None] * (len(heads) - len(row)), strict=True)) for row in rows]
