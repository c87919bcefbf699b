# SPDX-License-Identifier: Apache-2.0
"""Every option of the program's verbs has its counterpart here, or a reason why not: a new option that has neither fails."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from typing import Any

import pytest

import strake
from strake import _clash, _drawing

Counterpart = tuple[Callable[..., Any], str] | str
"""A function and one of its arguments, or in words what is instead."""

OF_VIEW = "view: a mapping of its options"
SAME_RESULT = "how the work is done; results are the same: run_program()"
BASELINE = "a baseline that benchmarks compare with: run_program()"
OF_PROJECT = "Project.clash(arguments=...) and run_program()"
DECISIONS = "Project.set_status(); with a file of decisions run_program()"
DIAGNOSTICS = "Model.diagnostics"
BY_TILES = "strake.cluster.clash() and strake.cluster.draw()"
RUNNING: dict[str, Counterpart] = {
    "--distribution": SAME_RESULT,
    "--help": "help()",
    "--json": "results are objects",
    "--output": "save()",
    "--quiet": "nothing is printed",
    **dict.fromkeys(("--scheduler", "--tile-folder", "--worker-memory", "--worker-threads"), BY_TILES),
    "--stats": "run_program()",
    "--threads": (strake.clash, "threads"),
    "--wait": OF_PROJECT,
}
READING: dict[str, Counterpart] = {
    "--georeference": (strake.load, "georeference"),
    "--strict": DIAGNOSTICS,
    "--unit": (strake.load, "unit"),
    "--up-axis": (strake.load, "up_axis"),
}
DRAW: dict[str, Counterpart] = {
    **RUNNING,
    **READING,
    **dict.fromkeys(("--direction", "--eye", "--field-of-view", "--limits", "--near", "--section", "--target", "--up"), OF_VIEW),
    **{
        "--" + name.replace("_", "-"): (strake.draw, name)
        for name in (
            *("break_lines", "centre_lines", "contact_distance", "flush_seams", "hatch", "hidden", "hidden_layers", "insulation"),
            *("intersections", "obstructions", "own_polylines", "paper", "sag", "scale", "select", "sharp_angle", "single_line"),
            *("smooth", "stage", "style", "thin", "title", "uncut", "view", "visible_only", "weld"),
        )
    },
    "--bucketing": SAME_RESULT,
    "--culling": SAME_RESULT,
    "--full": "run_program()",
    "--global": SAME_RESULT,
    "--project": (strake.Project, "file"),
    "--save": (strake.Project.store_view, "name"),
    "--sheet": (strake.Sheet.read, "file"),
    "--solver": SAME_RESULT,
    "--stored": (strake.Project.draw, "view"),
    "--verify": "run_program()",
}
CLASH: dict[str, Counterpart] = {
    **RUNNING,
    **READING,
    **{
        "--" + name.replace("_", "-"): (strake.clash, name)
        for name in (
            *("a", "b", "clearance", "contact_distance", "contacts", "curves", "group_by", "group_contacts", "group_distance"),
            *("insulation", "list_exempted", "log_pairs", "obstructions", "profile", "regions", "rules", "sag", "sort"),
            *("thickness_cap", "touch_gap", "touch_overlap", "volumes", "weld"),
        )
    },
    **{
        "--" + name.replace("_", "-"): (strake.Clashes.save, name)
        for name in ("bcf_author", "bcf_contacts", "bcf_date", "bcf_version", "columns", "csv", "page_geometry")
    },
    "--bcf-history": OF_PROJECT,
    "--bcf-max-topics": (strake.Clashes.save, "bcf_most"),
    "--broad-phase": SAME_RESULT,
    "--by": OF_PROJECT,
    "--class": (strake.clash, "classes"),
    "--decisions": DECISIONS,
    "--deeper": DECISIONS,
    "--fail-on": "Clashes.summary",
    "--full": OF_PROJECT,
    "--match-files": DECISIONS,
    "--max-pairs": "run_program()",
    "--max-spheres": BASELINE,
    "--narrow-phase": BASELINE,
    "--picture-format": (strake.Clashes.save_pictures, "picture_format"),
    "--pictures": (strake.Clashes.save_pictures, "folder"),
    "--project": (strake.Project, "file"),
    "--self": (strake.clash, "within_files"),
    "--top": (strake.Clashes.table, "rows"),
    "--top-pictures": (strake.Clashes.save_pictures, "most"),
    "--verify": OF_PROJECT,
    "--write-decisions": DECISIONS,
}


def options_of(*verb: str) -> set[str]:
    """The long names of a verb's options, by its help."""
    text = strake.run_program([*verb, "--help"]).stdout
    return set(re.findall(r"^  (?:-\w,)?(--[a-z][a-z-]*)", text, re.MULTILINE))


@pytest.mark.parametrize(("verb", "counterparts"), [("draw", DRAW), ("clash", CLASH)], ids=["draw", "clash"])
def test_every_option_has_its_counterpart(verb: str, counterparts: dict[str, Counterpart]) -> None:
    options = options_of(verb)
    assert len(options) > 30
    assert options == set(counterparts)


@pytest.mark.parametrize("counterparts", [DRAW, CLASH], ids=["draw", "clash"])
def test_counterparts_are_there(counterparts: dict[str, Counterpart]) -> None:
    for option, one in counterparts.items():
        if isinstance(one, str):
            continue
        function, argument = one
        assert argument in inspect.signature(function).parameters, (option, argument)


@pytest.mark.parametrize("module", [_drawing, _clash], ids=["draw", "clash"])
def test_each_argument_is_taken_into_a_request(module: Any) -> None:
    """The signature tells names and defaults alone: the table says what becomes of each, and of nothing else."""
    options = module.DRAW_OPTIONS if module is _drawing else module.CLASH_OPTIONS
    assert len(options) > 20
    assert set(module._TAKES) == set(options)
    fields = [field for field, _ in module._TAKES.values()]
    assert len(set(fields)) == len(fields)


def test_views_have_the_options_of_views() -> None:
    for option, one in DRAW.items():
        if one == OF_VIEW:
            assert option.removeprefix("--").replace("-", "_") in _drawing._VIEW_OPTIONS
