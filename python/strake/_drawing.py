# SPDX-License-Identifier: Apache-2.0
"""Hidden-line drawings."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any, Literal, NamedTuple

from strake import _core
from strake._arguments import (
    Length,
    PathLike,
    Progress,
    Selection,
    check_names,
    length,
    number,
    numbers,
    one_of,
    optional_length,
    optional_text,
    options_of,
    path,
    pick,
    run_options,
    shown,
    text,
    texts,
    truth,
    weld_of,
)
from strake._errors import UsageError
from strake._model import Diagnostic, Model, model_core, optional_sag
from strake._numpy import np, npt, or_of_numpy

LINE_KINDS: tuple[str, ...] = tuple(_core.LINE_KINDS)
"""Names of the kinds of lines: what `kind` counts."""
LINE_STATES: tuple[str, ...] = tuple(_core.LINE_STATES)
"""Names of the states of lines: what `state` counts."""

_VIEW_OPTIONS = ("view", "direction", "up", "eye", "target", "near", "field_of_view", "limits", "section")
_PENS = {"outline": 0.5, "edge": 0.5, "thin": 0.25, "section": 0.7}


class Lines(NamedTuple):
    """The lines that get ink, joined to chains. Chain i is points[starts[i]:starts[i + 1]]."""

    points: npt.NDArray[np.float64]
    """(P, 2) mm on paper, x to the right and y down from the upper left corner."""
    starts: npt.NDArray[np.uint32]
    """(C + 1,)"""
    kinds: npt.NDArray[np.uint8]
    """(C,) numbers of LINE_KINDS."""
    states: npt.NDArray[np.uint8]
    """(C,) numbers of LINE_STATES."""
    objects: npt.NDArray[np.uint32]
    """(C,) numbers of objects of the model."""


class Drawing:
    """A view on paper, as draw() makes it."""

    def __init__(self, model: Model, request: _core.DrawRequest, core: _core.DrawRun, again: Callable[[], _core.DrawRun]) -> None:
        """`again` draws what the request asks for by then."""
        self.model = model
        self._request = request
        self._core = core
        self._again = again

    @cached_property
    def _whole(self) -> _core.DrawRun:
        """The drawing with all of its lines, which are found when they are asked for."""
        request = self._request
        if request.visible_only or request.keep_hidden:
            return self._core
        request.keep_hidden = True
        return self._again()

    @cached_property
    def svg(self) -> str:
        """SVG in mm of paper, with the bytes that `strake draw` writes."""
        return _core.svg(self._core).decode("utf-8")

    def _repr_svg_(self) -> str:
        return self.svg

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the paper, mm."""
        width, height = self._core.size_mm
        return width, height

    @property
    def scale(self) -> str:
        """As "1:50"."""
        return self._core.scale

    @property
    def summary(self) -> dict[str, int]:
        """The number of lines of each state; hidden ones only where they are shown."""
        return self._core.summary

    @cached_property
    def lines(self) -> Lines:
        """The lines that get ink."""
        return Lines(*_core.chains(self._core))

    @cached_property
    def segments(self) -> npt.NDArray[np.void]:
        """A structured array of all straight pieces, inked or not, hidden or not, without a copy and read-only.

        The first use draws once more, to find lines that are hidden or clipped, unless `visible_only`.

        Fields: object, edge (number among those of the object), kind (LINE_KINDS), state (LINE_STATES), other (the second
        object of an intersection), a and b (3, mm of the model), a_paper and b_paper (2, mm on paper).
        """
        return np.asarray(_core.segments(self._whole))

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What drawing noticed, as objects far from all others."""
        return [Diagnostic(*one) for one in self._core.diagnostics]

    def save(self, path_to: PathLike, threads: int | None = None, progress: Progress | None = None) -> list[Diagnostic]:
        """Writes .svg, .pdf, .dxf, .html (a page, docs/report-page.md), or .json or .view (docs/drawing.md), whole or not at all.

        The last two have all of `segments`.

        Returns what of the drawing could not be written as it is, as characters that the font of a PDF lacks
        (docs/formats/pdf.md). Raises: UsageError, OutputError.
        """
        into, options = path(path_to, "path_to"), run_options(threads, progress)
        noticed = _core.save_drawing(self._core if _core.shows_ink(into) else self._whole, into, options)
        return [Diagnostic(*one) for one in noticed]

    def __repr__(self) -> str:
        width, height = self.size
        return f"<strake.Drawing at {self.scale} on {width:g} x {height:g} mm: {self.summary['visible']} visible lines>"


def draw(
    model: Model,
    view: str | Mapping[str, Any] = "iso",
    *,
    select: Selection | None = None,
    hidden: Literal["off", "dashed", "all"] | bool = "off",
    hidden_layers: Literal["one", "two"] = "one",
    centre_lines: bool | Length = False,
    hatch: str | Sequence[str] | None = None,
    style: str | Sequence[str] | None = None,
    thin: bool | Length = False,
    break_lines: bool = False,
    single_line: Length | None = None,
    scale: str | float | None = None,
    paper: str | None = None,
    title: str = "",
    pens: Mapping[str, float] | None = None,
    stage: Literal["none", "local", "global"] = "global",
    intersections: Literal["off", "objects", "primitives", "parts"] = "primitives",
    own_polylines: Literal["visible", "hidden"] = "visible",
    smooth: Literal["off", "tangent", "on"] = "off",
    flush_seams: bool = True,
    sharp_angle: float = 20.0,
    contact_distance: Length | None = None,
    sag: Length | None = None,
    weld: Length | None = None,
    uncut: str | Sequence[str] | None = None,
    obstructions: bool = False,
    insulation: bool = False,
    visible_only: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Drawing:
    """Draws a view of a model, hidden lines removed.

    Args:
        model: what is drawn.
        view: "iso", "top", "bottom", "front", "back", "left" or "right", or a mapping of: view; direction (to the viewer:
            (1, -2, 1)); up; eye and target (3, mm), for a view in perspective, with near (mm) and field_of_view
            (degrees); limits ((2, 3) mm, the least and the greatest corner, or "auto", which leaves out the few objects
            far from all others); section ("z>4500mm", or several).
        select: objects to draw: a selection (docs/selection.md), several, or (N,) bool. None: all.
        hidden: hidden lines: "off", "dashed" where no line runs beside them, or "all"; True is "dashed".
        hidden_layers: hidden lines as "one" layer, or what an object hides itself and what others hide as "two".
        centre_lines: of round parts: whether, or the diameter on paper from which parts have them (True is 2 mm).
        hatch: how sections are hatched: "30deg,80mm", "30deg", "80mm" or "off", of some objects "30deg: PIPE*", or several, of
            which the first that picks an object counts. None: neighbours differ in angle.
        style: how lines of some objects are drawn: "name=PIPING,color=#c00000,pen=0.35mm,line=dashed: @discipline = PIPING",
            each part before the colon as you like, or several, of which the first that picks an object counts.
        thin: leave out inner lines of an object that are nearer than this to others on paper; True is two pens, and
            "0.5mm+dxf" leaves them out of model space of .dxf, too.
        break_lines: whether lines with zigzags stand where limits cut objects.
        single_line: draw pipes up to this outer diameter as single lines, their axes: a length, or a nominal size as "DN50".
        scale: as "1:50", or 50; None: the largest usual one that fits the paper.
        paper: "A3", "A1,portrait", "900mmx420mm" ...
        title: of the sheet.
        pens: widths in mm on paper of outline, edge, thin and section; None: by the density of the drawing.
        stage: hide nothing, within each object, or among all.
        intersections: lines where bodies pass through each other.
        own_polylines: whether faces hide the lines of their own object.
        smooth: edges where faces turn by less than `sharp_angle` (degrees): none, where a curved surface begins, or all.
        flush_seams: whether edges of parts that join flat are drawn.
        contact_distance: what is nearer by no more than this hides nothing.
        sag, weld: how fine curves are, and which seams close; None: by the paper, and by the precision of the files.
        uncut: selections of what a section leaves whole.
        obstructions, insulation: take in bodies of these categories.
        visible_only: leave out hidden and clipped lines of everything: less time and memory.
        threads, progress: as in load().

    Raises: UsageError, with the argument as `where`; InputError for a view that reaches too far; KeyboardInterrupt.
    """
    options = {name: value for name, value in dict(locals()).items() if name in DRAW_OPTIONS}
    core = model_core(model)
    request = draw_request(view, pick(select, len(model), "select"), **options)
    # Not what tells of progress: it may hold on to the drawing, and its bar is closed later on.
    drawn = _core.draw(core, request, run_options(threads, progress))
    return Drawing(model, request, drawn, lambda: _core.draw(core, request, run_options(threads, None)))


DRAW_OPTIONS = options_of(draw, "select", "threads", "progress")
"""The arguments of draw() that say what a drawing looks like, with their defaults."""


def draw_request(view: str | Mapping[str, Any], select: _core.Pick, *, keep_hidden: bool = False, **options: Any) -> _core.DrawRequest:
    """What draw() asks for with these of DRAW_OPTIONS; `keep_hidden` finds lines that are hidden or clipped though they are not shown.

    Raises: UsageError; TypeError for an option that draw() has not.
    """
    check_names(options, DRAW_OPTIONS, "draw")
    request = _core.DrawRequest()
    _set_view(request, view)
    request.select = select
    request.keep_hidden = truth(keep_hidden, "keep_hidden")
    for name, value in (DRAW_OPTIONS | options).items():
        field, made = _TAKES[name]
        setattr(request, field, made(value, name))
    return request


def _set_view(request: _core.DrawRequest, view: str | Mapping[str, Any]) -> None:
    if isinstance(view, str):
        request.view = text(view, "view")
        return
    if not isinstance(view, Mapping):
        raise UsageError(f"{shown(view)} is no view", "view", "give a name, as 'iso', or a mapping of its options")
    for name in view:
        if name not in _VIEW_OPTIONS:
            raise UsageError(f"there is no option {name!r} of a view", "view", f"write {', '.join(_VIEW_OPTIONS)}")
    if sum(name in view for name in ("view", "direction", "eye")) > 1:
        raise UsageError("view, direction and eye exclude each other", "view")
    request.view = text(view.get("view", "iso"), "view")
    request.direction = _direction(view.get("direction"), "direction")
    request.up = _direction(view.get("up"), "up")
    for name in ("eye", "target"):
        if name in view:
            setattr(request, name, numbers(view[name], 3, name, "x, y and z in millimetres"))
    if "near" in view:
        request.near_mm = length(view["near"], "near")
    if "field_of_view" in view:
        request.field_of_view_deg = number(view["field_of_view"], "field_of_view")
    limits = view.get("limits")
    if isinstance(limits, str) and limits == "auto":
        request.leave_out_far_objects = True
    elif limits is not None:
        request.limits = numbers(limits, 6, "limits", "the least and the greatest corner in millimetres, or 'auto'")
    request.sections = texts(view.get("section"), "section")


def _direction(value: Any, name: str) -> str:
    if value is None or isinstance(value, str):
        return text(value or "", name)
    return ",".join(f"{x:.17g}" for x in numbers(value, 3, name, "x, y and z"))


def _hidden(value: Any, name: str) -> str:
    return text(value, name) if isinstance(value, str) else ("dashed" if truth(value, name) else "off")


def _two_layers(value: Any, name: str) -> bool:
    return one_of(value, ("one", "two"), name) == "two"


def _switch_or_length(value: Any, name: str) -> str:
    """As the program takes it."""
    if isinstance(value, or_of_numpy((bool,), "bool_")):
        return "on" if value else ""
    return _length_text(value, name)


def _length_text(value: Any, name: str) -> str:
    """A length, or other words for one; none is empty."""
    if value is None or isinstance(value, str):
        return text(value or "", name)
    return f"{length(value, name)!r}mm"


def _scale(value: Any, name: str) -> str:
    return text(value or "", name) if value is None or isinstance(value, str) else f"1:{number(value, name):.17g}"


def _pens(pens: Any, name: str) -> list[float] | None:
    if pens is None:
        return None
    if not isinstance(pens, Mapping):
        raise UsageError(f"{shown(pens)} is none", name, f"give a dict of {', '.join(_PENS)} and their widths")
    for pen in pens:
        if pen not in _PENS:
            raise UsageError(f"there is no pen {pen!r}", name, f"write {', '.join(_PENS)}")
    widths = [number(pens.get(pen, usual), f"{name}[{pen!r}]") for pen, usual in _PENS.items()]
    if min(widths) <= 0:
        raise UsageError("a pen has no width", name, "give millimetres of paper")
    return widths


# By argument of draw(): the field of a request, and what makes its value of what is given.
_TAKES: dict[str, tuple[str, Callable[[Any, str], Any]]] = {
    "hidden": ("hidden", _hidden),
    "hidden_layers": ("split_hidden", _two_layers),
    "centre_lines": ("centre_lines", _switch_or_length),
    "hatch": ("hatches", texts),
    "style": ("styles", texts),
    "thin": ("thin", _switch_or_length),
    "break_lines": ("break_lines", truth),
    "single_line": ("single_line", _length_text),
    "scale": ("scale", _scale),
    "paper": ("paper", optional_text),
    "title": ("title", text),
    "pens": ("pens", _pens),
    "stage": ("stage", text),
    "intersections": ("intersections", text),
    "own_polylines": ("own_polylines", text),
    "smooth": ("smooth", text),
    "flush_seams": ("flush_seams", truth),
    "sharp_angle": ("sharp_angle_deg", number),
    "contact_distance": ("contact_distance_mm", optional_length),
    "sag": ("sag_mm", optional_sag),
    "weld": ("weld_mm", weld_of),
    "uncut": ("uncut", texts),
    "obstructions": ("obstructions", truth),
    "insulation": ("insulation", truth),
    "visible_only": ("visible_only", truth),
}
