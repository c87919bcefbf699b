# SPDX-License-Identifier: Apache-2.0
"""Exact clash detection and hidden-line drawings of ship, plant and building models.

    import strake

    model = strake.load("ship.glb")
    clashes = strake.clash(model, clearance=25)
    clashes.save("clashes.json")
    strake.draw(model, "iso", hidden="dashed").save("ship.svg")

Lengths are millimetres where they are numbers, and have their unit where they are texts: 25, "25mm",
"1in". Coordinates are millimetres of the model, z up. Results have the bytes that the program `strake`
writes, for any number of threads.

Every foreseeable failure is a `strake.Error`; Ctrl-C ends a call soon, as KeyboardInterrupt.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from strake import cluster
    from strake._clash import Clash, Clashes, Flag, Group, Kind, Relation, clash
    from strake._drawing import LINE_KINDS, LINE_STATES, Drawing, Lines, draw
    from strake._errors import (
        Cancelled,
        Error,
        InputError,
        InternalError,
        OutOfMemory,
        OutputError,
        UsageError,
    )
    from strake._model import Diagnostic, Mesh, Model, Object, generate, load
    from strake._program import evaluate, run_program
    from strake._project import Project
    from strake._sheet import Sheet, SheetDrawing

    __version__: str

__all__ = [
    "LINE_KINDS",
    "LINE_STATES",
    "Cancelled",
    "Clash",
    "Clashes",
    "Diagnostic",
    "Drawing",
    "Error",
    "Flag",
    "Group",
    "InputError",
    "InternalError",
    "Kind",
    "Lines",
    "Mesh",
    "Model",
    "Object",
    "OutOfMemory",
    "OutputError",
    "Project",
    "Relation",
    "Sheet",
    "SheetDrawing",
    "UsageError",
    "__version__",
    "clash",
    "cluster",
    "draw",
    "evaluate",
    "generate",
    "load",
    "run_program",
]

# What is requested is loaded then: an importer, which is a program of its own, needs none of it.
_MODULE_OF = {
    name: module
    for module, names in {
        "strake._clash": ("Clash", "Clashes", "Flag", "Group", "Kind", "Relation", "clash"),
        "strake._drawing": ("LINE_KINDS", "LINE_STATES", "Drawing", "Lines", "draw"),
        "strake._errors": ("Cancelled", "Error", "InputError", "InternalError", "OutOfMemory", "OutputError", "UsageError"),
        "strake._model": ("Diagnostic", "Mesh", "Model", "Object", "generate", "load"),
        "strake._program": ("evaluate", "run_program"),
        "strake._project": ("Project",),
        "strake._sheet": ("Sheet", "SheetDrawing"),
    }.items()
    for name in names
}


def __getattr__(name: str) -> object:
    if name == "__version__":
        value = import_module("strake._core").version()
    elif name == "cluster":
        return import_module("strake.cluster")
    elif name in _MODULE_OF:
        value = getattr(import_module(_MODULE_OF[name]), name)
    else:
        raise AttributeError(f"module 'strake' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
