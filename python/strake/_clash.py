# SPDX-License-Identifier: Apache-2.0
"""Clash detection."""

from __future__ import annotations

import contextlib
import enum
import html
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, overload

from strake import _core
from strake._arguments import (
    Length,
    PathLike,
    Progress,
    Selection,
    check_names,
    count,
    length,
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
from strake._errors import OutputError, UsageError
from strake._model import Diagnostic, Model, _position, model_core, optional_sag
from strake._numpy import np, npt

if TYPE_CHECKING:
    import pandas
    import pyarrow

_CSV = ("standard", "excel", "excel-comma")

# Rows that a Parquet file gets at once: a row group of it.
_ROWS_AT_ONCE = 131_072


class Kind(enum.IntEnum):
    """Classes of results, from the least to the most severe (docs/clash.md)."""

    NO_HIT = 0
    CLEARANCE_VIOLATION = 1
    CONTACT = 2
    HIT = 3


class Relation(enum.IntEnum):
    """How a stands to b (docs/clash.md)."""

    SEPARATE = 0
    ABUT_OUTSIDE = 1
    ABUT_INSIDE = 2
    INTERFERE = 3
    A_IN_B = 4
    B_IN_A = 5
    DUPLICATE = 6
    CROSS = 7


class Flag(enum.IntFlag):
    """What else is to be known of a result (docs/clash.md)."""

    BORDERLINE = 1
    UNCERTAIN = 2
    OPEN = 4
    INVERTED = 8


class Clash(NamedTuple):
    """One pair of objects that is not NO_HIT. Lengths are mm."""

    test: str
    a: int
    """Number of the object in its model."""
    b: int
    a_id: str
    b_id: str
    kind: Kind
    relation: Relation
    flags: Flag
    separation: float
    """The distance, or minus the depth."""
    lower: float
    upper: float
    """The true separation lies between lower and upper."""
    depth: float
    distance: float
    point: tuple[float, float, float]
    """The deepest point, or the middle between the closest two."""
    push_out: tuple[float, float, float]
    """Unit vector along which a moves away from b; zero where there is none."""
    volume: float | None
    """Of the common part, mm3, where it was asked for and is known."""
    allowed: str | None
    """The rule that allows it."""
    key: str
    """The same tomorrow: decisions are looked up by it."""


class Group(NamedTuple):
    """Clashes about one thing."""

    id: str
    name: str
    worst: Kind
    separation: float
    """The least of the worst kind, mm."""
    rows: npt.NDArray[np.uint32]
    """Rows of Clashes.array."""


class Clashes(Sequence[Clash]):
    """What clash() found."""

    def __init__(self, core: _core.ClashRun, model: Model) -> None:
        self._core = core
        self.model = model

    def __len__(self) -> int:
        return len(self.array)

    @cached_property
    def array(self) -> npt.NDArray[np.void]:
        """A structured array of all results, read-only.

        Fields: test (number in `tests`), a and b (numbers of objects, a < b), kind (Kind), relation (Relation), flags
        (Flag), separation, lower, upper, depth, distance (mm), point, point_on_a, point_on_b (3, mm), push_out (3, unit
        vector), volume (mm3, NaN where not known), allowed (rule, or -1), regions (how many; 0 where not told).
        """
        return np.asarray(_core.clash_rows(self._core, run_options(None, None)))

    @property
    def tests(self) -> list[str]:
        """Names of the tests; "" without rules."""
        return self._core.tests

    @cached_property
    def _allowing(self) -> list[list[str]]:
        return self._core.allowing_rules

    @overload
    def __getitem__(self, index: int) -> Clash: ...
    @overload
    def __getitem__(self, index: slice) -> list[Clash]: ...
    def __getitem__(self, index: int | slice) -> Clash | list[Clash]:
        if isinstance(index, slice):
            return [self._record(i) for i in range(*index.indices(len(self)))]
        return self._record(_position(index, len(self)))

    def __iter__(self) -> Iterator[Clash]:
        return (self._record(i) for i in range(len(self)))

    def _record(self, i: int) -> Clash:
        row: Any = self.array[i]
        test, a, b, allowed = int(row["test"]), int(row["a"]), int(row["b"]), int(row["allowed"])
        volume = float(row["volume"])
        return Clash(
            test=self.tests[test],
            a=a,
            b=b,
            a_id=str(self.model.ids[a]),
            b_id=str(self.model.ids[b]),
            kind=Kind(int(row["kind"])),
            relation=Relation(int(row["relation"])),
            flags=Flag(int(row["flags"])),
            separation=float(row["separation"]),
            lower=float(row["lower"]),
            upper=float(row["upper"]),
            depth=float(row["depth"]),
            distance=float(row["distance"]),
            point=tuple(row["point"].tolist()),
            push_out=tuple(row["push_out"].tolist()),
            volume=None if np.isnan(volume) else volume,
            allowed=None if allowed < 0 else self._allowing[test][allowed],
            key=_core.clash_key(self._core, test, a, b),
        )

    @property
    def summary(self) -> dict[str, int]:
        """Counts: hit, contact, clearance_violation, allowed, and what could not be compared."""
        return self._core.summary

    @property
    def hash(self) -> str:
        """Equal for equal results."""
        return self._core.hash

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What the tests noticed, as sets that are empty and rules that do nothing."""
        return [Diagnostic(*one) for one in self._core.diagnostics]

    @cached_property
    def groups(self) -> list[Group]:
        """Results put together as `group_by` said, or by element: the object with most of them first takes its own."""
        return [Group(id, name, Kind(worst), d, rows) for id, name, worst, d, rows in _core.clash_groups(self._core)]

    def table(self, rows: int = 20) -> str:
        """Returns the worst results as the program shows them, at most so many."""
        return self._core.table(count(rows, "rows"))

    def __repr__(self) -> str:
        counts = self.summary
        return f"<strake.Clashes: {counts['hit']} hits, {counts['contact']} contacts, {counts['clearance_violation']} clearance violations>"

    def __str__(self) -> str:
        return self.table()

    def _repr_html_(self, most: int = 50) -> str:
        names = ("kind", "separation", "relation", "point", "a_id", "b_id")
        head = "".join(f"<th>{name}</th>" for name in names)
        body = "".join(f"<tr>{''.join(_cells(one))}</tr>" for one in self[:most])
        more = len(self) - most
        rest = f"<p>… and {more} more</p>" if more > 0 else ""
        return f"<p>{html.escape(repr(self)[1:-1])}</p><table><tr>{head}</tr>{body}</table>{rest}"

    def save(
        self,
        path_to: PathLike,
        columns: Sequence[str] = (),
        threads: int | None = None,
        progress: Progress | None = None,
        *,
        csv: Literal["standard", "excel", "excel-comma"] = "standard",
        page_geometry: Literal["auto", "all", "near", "boxes", "none"] = "auto",
        bcf_version: Literal["2.1", "3.0"] = "2.1",
        bcf_most: int = 200,
        bcf_contacts: bool = False,
        bcf_date: str = "",
        bcf_author: str = "",
    ) -> None:
        """Writes .json (schemas/clash.schema.json), .csv or another format of the program, the bytes that it writes.

        A file is whole or not there.

        Args:
            path_to: its suffix says the format: .json, .csv, .xlsx, .bcf, .html, .xml, .svg, .png ...
            columns: attributes of both objects that are written, too, as "DN" or "@DN".
            threads, progress: as in load().
            csv: RFC 4180, or for a double click in Excel, also where its decimal sign is the comma.
            page_geometry: what a page shows of the model.
            bcf_version, bcf_most, bcf_contacts: the version of .bcf, at most how many topics it has, and whether of contacts, too.
            bcf_date, bcf_author: when ("2026-01-31", or with "T12:00:00Z") topics were made, and by whom.

        Raises: UsageError, OutputError.
        """
        form = _core.WrittenForm()
        form.columns = [name.removeprefix("@") for name in texts(columns, "columns")]
        form.csv = one_of(csv, _CSV, "csv")
        form.page_geometry = one_of(page_geometry, ("auto", "all", "near", "boxes", "none"), "page_geometry")
        form.bcf_3 = one_of(bcf_version, ("2.1", "3.0"), "bcf_version") == "3.0"
        form.bcf_most, form.bcf_contacts = count(bcf_most, "bcf_most"), truth(bcf_contacts, "bcf_contacts")
        form.bcf_date, form.bcf_author = text(bcf_date, "bcf_date"), text(bcf_author, "bcf_author")
        _core.save_clashes(self._core, path(path_to, "path_to"), form, run_options(threads, progress))

    def save_pictures(
        self,
        folder: PathLike,
        most: int = 50,
        picture_format: Literal["svg", "png"] = "svg",
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> tuple[int, int]:
        """Writes a folder with a picture of each group, or of each clash without groups, the worst first, and an index.

        Returns how many pictures there are, and how many more were left out. Raises: UsageError; OutputError where the folder
        holds something else.
        """
        is_png = one_of(picture_format, ("svg", "png"), "picture_format") == "png"
        options = run_options(threads, progress)
        drawn, left_out = _core.save_pictures(self._core, path(folder, "folder"), count(most, "most"), is_png, options)
        return drawn, left_out

    def save_pair_log(
        self,
        path_to: PathLike,
        csv: Literal["standard", "excel", "excel-comma"] = "standard",
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> None:
        """Writes every pair that was looked at in detail as .csv: its class, NO_HIT too, and what it cost.

        clash(log_pairs=True) keeps them. Raises: UsageError, OutputError.
        """
        options = run_options(threads, progress)
        into = path(path_to, "path_to")
        if into.suffix != ".csv":
            raise UsageError(f"{shown(str(into))} is no .csv", "path_to", "give a name that ends with .csv")
        if not self._core.logs_pairs:
            raise UsageError("the pairs were not kept", "path_to", "ask for them: clash(model, log_pairs=True)")
        _core.save_pair_log(self._core, into, one_of(csv, _CSV, "csv"), options)

    def columns(self) -> dict[str, npt.NDArray[Any]]:
        """Returns flat columns by name: those of `array`, points split in x, y, z, with ids and names of both objects."""
        rows = self.array
        flat = _flat(rows)
        for side in ("a", "b"):
            flat[f"{side}_id"] = self.model.ids[rows[side]]
            flat[f"{side}_name"] = self.model.names[rows[side]]
        return flat

    def to_pandas(self) -> pandas.DataFrame:
        """Returns a data frame with columns(); test, kind and relation are categories.

        Raises: ImportError where pandas is not installed.
        """
        try:
            import pandas
        except ImportError as error:
            raise ImportError("Clashes.to_pandas() needs pandas: pip install pandas") from error
        columns: dict[str, Any] = dict(self.columns())
        for name, words in (
            ("test", self.tests),
            ("kind", [kind.name for kind in Kind]),
            ("relation", [relation.name for relation in Relation]),
        ):
            columns[name] = pandas.Categorical.from_codes(columns[name], words)
        return pandas.DataFrame(columns)

    def to_arrow(self) -> pyarrow.Table:
        """Returns an Arrow table with columns(), and with `key`, `status` and `group` as CSV has them.

        Test, kind, relation, ids, names, statuses and groups are dictionaries; a result of no group has none.

        Raises: ImportError where pyarrow is not installed.
        """
        try:
            import pyarrow
        except ImportError as error:
            raise ImportError("Clashes.to_arrow() needs pyarrow: pip install 'strake[arrow]'") from error
        return pyarrow.table(self._arrow_columns(slice(None)))

    def to_parquet(self, path_to: PathLike) -> None:
        """Writes the table of to_arrow() as a Parquet file, some rows at once: for the millions. Whole or not at all.

        Names stand in it once, however many rows have them. Raises: UsageError, OutputError; ImportError where pyarrow is
        not installed.
        """
        try:
            import pyarrow
            import pyarrow.parquet
        except ImportError as error:
            raise ImportError("Clashes.to_parquet() needs pyarrow: pip install 'strake[arrow]'") from error
        final = path(path_to, "path_to")
        first = pyarrow.table(self._arrow_columns(slice(0, _ROWS_AT_ONCE)))
        try:
            with tempfile.NamedTemporaryFile(dir=final.parent, suffix=".parquet", delete=False) as made:
                part = made.name
            try:
                with pyarrow.parquet.ParquetWriter(part, first.schema, compression="zstd") as writer:
                    writer.write_table(first)
                    for begin in range(_ROWS_AT_ONCE, len(self), _ROWS_AT_ONCE):
                        writer.write_table(pyarrow.table(self._arrow_columns(slice(begin, begin + _ROWS_AT_ONCE))))
                os.replace(part, final)
            finally:
                with contextlib.suppress(FileNotFoundError):
                    os.remove(part)
        except OSError as error:
            raise OutputError(f"cannot be written: {error.strerror or error}", str(final)) from error

    def _arrow_columns(self, which: slice) -> dict[str, Any]:
        """Returns some rows of columns() as Arrow arrays; words, ids and names as dictionaries."""
        import pyarrow

        rows = self.array[which]
        columns: dict[str, Any] = {}
        for name, values in _flat(rows).items():
            columns[name] = pyarrow.array(values)
        words: dict[str, tuple[str, Any]] = {
            "test": ("test", self.tests),
            "kind": ("kind", [kind.name for kind in Kind]),
            "relation": ("relation", [relation.name for relation in Relation]),
        }
        for side in ("a", "b"):
            words[f"{side}_id"] = (side, self.model.ids)
            words[f"{side}_name"] = (side, self.model.names)
        for name, (field, texts_of) in words.items():
            codes = pyarrow.array(rows[field].astype(np.int32))
            columns[name] = pyarrow.DictionaryArray.from_arrays(codes, pyarrow.array(texts_of, pyarrow.string()))
        begin, end, _ = which.indices(len(self))
        keys, statuses, groups = _core.clash_words(self._core, begin, end)
        columns["key"] = pyarrow.array(keys, pyarrow.string())
        columns["status"] = _dictionary(statuses)
        columns["group"] = _dictionary([group or None for group in groups])
        return columns


def _dictionary(texts: Sequence[str | None]) -> pyarrow.DictionaryArray:
    import pyarrow

    return pyarrow.array(texts, pyarrow.string()).dictionary_encode()


def _flat(rows: npt.NDArray[Any]) -> dict[str, npt.NDArray[Any]]:
    """Returns the fields of rows, points split in x, y, z."""
    flat: dict[str, npt.NDArray[Any]] = {}
    for field in rows.dtype.names or ():
        if rows[field].ndim == 1:
            flat[field] = rows[field]
        else:
            for k, axis in enumerate("xyz"):
                flat[f"{field}_{axis}"] = rows[field][:, k]
    return flat


def _cells(one: Clash) -> Iterator[str]:
    point = ", ".join(f"{x:.0f}" for x in one.point)
    for cell in (one.kind.name, f"{one.separation:.3f}", one.relation.name, point, one.a_id, one.b_id):
        yield f"<td>{html.escape(cell)}</td>"


def clash(
    model: Model,
    a: Selection | None = None,
    b: Selection | None = None,
    *,
    rules: PathLike | None = None,
    profile: str | None = None,
    clearance: Length = 0.0,
    touch_gap: Length = 1.0,
    touch_overlap: Length = 1.0,
    contacts: Literal["list", "count", "off"] = "list",
    within_files: bool = False,
    contact_distance: Length | None = None,
    thickness_cap: bool = True,
    volumes: bool = False,
    curves: bool = False,
    regions: int = 8,
    group_by: Literal["element", "proximity", "test", "files", "assembly"] | None = None,
    group_distance: Length | None = None,
    group_contacts: bool = False,
    sort: Literal["depth", "volume", "size"] = "depth",
    classes: str | Sequence[str] | None = None,
    list_exempted: bool = False,
    log_pairs: bool = False,
    sag: Length | None = None,
    weld: Length | None = None,
    obstructions: bool = False,
    insulation: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Clashes:
    """Finds the pairs of objects, one of set a and one of set b, that collide, touch, or come too near.

    Args:
        model: what is tested.
        a, b: the sets: a selection ("PIPE*", docs/selection.md), several, or (N,) bool as Model.select() returns. None:
            everything; where neither is given and the model has several files, only pairs of two files count unless
            `within_files`.
        rules: a rules file (docs/rules.md). It has sets and tolerances: give none besides.
        profile: "plant", "ship" ...: leave out what is no clash in such a model.
        clearance: pairs nearer than this violate it; "@INSU + 25mm" adds what both objects state as that attribute.
        touch_gap, touch_overlap: up to this far apart, and this deep, is a contact.
        contacts: "list" them, "count" those that are nothing else, or leave them "off".
        contact_distance: what the numbers of the source cannot tell apart; None: from the precision of the files.
        thickness_cap: whether touch_overlap is at most a quarter of the thinner part.
        volumes: measure the common volume of hits.
        curves: check lines, too.
        regions: how many separate places of a pair are listed in files.
        group_by, group_distance, group_contacts: the groups of `Clashes.groups`, which are then saved, too.
        sort: what comes first in tables and groups: the deepest, the largest common volume (measured then, as by `volumes`),
            or the largest group.
        classes: results of these alone: "hit", "contact", "clearance".
        list_exempted: list the pairs that rules exempt in what is saved.
        log_pairs: keep what Clashes.save_pair_log() writes.
        sag, weld: how fine curves are, and which seams close; None: by the tolerances, and by the precision of the files.
        obstructions, insulation: take in bodies of these categories.
        threads, progress: as in load().

    Raises: UsageError; InputError for a rules file; KeyboardInterrupt at Ctrl-C.
    """
    options = {name: value for name, value in dict(locals()).items() if name in CLASH_OPTIONS}
    core = model_core(model)
    request = request_of(len(model), a, b, **options)
    return Clashes(_core.clash(core, request, run_options(threads, progress)), model)


CLASH_OPTIONS = options_of(clash, "threads", "progress")
"""The arguments of clash() that say what is tested, but for the sets, with their defaults."""

# What a rules file says itself, besides the sets.
_OF_RULES = ("profile", "clearance", "touch_gap", "touch_overlap", "contact_distance", "within_files")


def request_of(objects: int, a: Selection | None, b: Selection | None, **options: Any) -> _core.ClashRequest:
    """Returns what clash() is asked for, with these of CLASH_OPTIONS, over a model of so many objects.

    Raises: UsageError; TypeError for an option that clash() has not.
    """
    check_names(options, CLASH_OPTIONS, "clash")
    settings = CLASH_OPTIONS | options
    request = _core.ClashRequest()
    request.a = pick(a, objects, "a")
    request.b = pick(b, objects, "b")
    if settings["rules"] is not None:
        given_options = {"a": a is not None, "b": b is not None} | {name: settings[name] != CLASH_OPTIONS[name] for name in _OF_RULES}
        given_options["profile"] = bool(settings["profile"])
        _refuse_beside_rules(given_options)
    for name, value in settings.items():
        field, made = _TAKES[name]
        setattr(request, field, made(value, name))
    listed = request.contacts == "list" and (not request.classes or "contact" in request.classes)
    if request.group_contacts and not listed:
        raise UsageError("contacts that are not listed cannot be put into groups", "group_contacts")
    if (request.group_distance_mm is not None or request.group_contacts) and settings["group_by"] is None:
        where = "group_contacts" if request.group_distance_mm is None else "group_distance"
        raise UsageError("there are no groups", where, "give group_by")
    if request.sort == "size" and settings["group_by"] is None:
        raise UsageError("only groups have a size", "sort", "give group_by")
    request.volumes = request.volumes or request.sort == "volume"
    return request


def _contacts(value: Any, name: str) -> str:
    if not isinstance(value, str) or value not in ("list", "count", "off"):
        raise UsageError(f"there is no way {shown(value)}", name, "write list, count or off")
    return value


def _sort(value: Any, name: str) -> str:
    return one_of(value, ("depth", "volume", "size"), name)


def _classes(value: Any, name: str) -> list[str]:
    return [one_of(one, ("hit", "contact", "clearance", "clearance_violation"), name) for one in texts(value, name)]


def _group_by(value: Any, name: str) -> str:
    if value is None or (isinstance(value, str) and not value):
        return ""
    return one_of(value, ("element", "proximity", "test", "files", "assembly"), name)


def _optional_path(value: Any, name: str) -> str:
    return "" if value is None else str(path(value, name))


def clearance_text(clearance: Length, name: str = "clearance") -> str:
    """A clearance as the program takes it. Raises: UsageError."""
    return text(clearance, name) if isinstance(clearance, str) else f"{length(clearance, name)!r}mm"


def _refuse_beside_rules(given_options: Mapping[str, bool]) -> None:
    for name, is_given in given_options.items():
        if is_given:
            raise UsageError("a rules file says this itself", name, "leave it out, or write it there")


# By argument of clash(): the field of a request, and what makes its value of what is given.
_TAKES: dict[str, tuple[str, Callable[[Any, str], Any]]] = {
    "rules": ("rules", _optional_path),
    "profile": ("profile", optional_text),
    "clearance": ("clearance", clearance_text),
    "touch_gap": ("touch_gap_mm", length),
    "touch_overlap": ("touch_overlap_mm", length),
    "contacts": ("contacts", _contacts),
    "within_files": ("within_files", truth),
    "contact_distance": ("contact_distance_mm", optional_length),
    "thickness_cap": ("thickness_cap", truth),
    "volumes": ("volumes", truth),
    "curves": ("curves", truth),
    "regions": ("regions", count),
    "group_by": ("group_by", _group_by),
    "group_distance": ("group_distance_mm", optional_length),
    "group_contacts": ("group_contacts", truth),
    "sort": ("sort", _sort),
    "classes": ("classes", _classes),
    "list_exempted": ("list_exempted", truth),
    "log_pairs": ("log_pairs", truth),
    "sag": ("sag_mm", optional_sag),
    "weld": ("weld_mm", weld_of),
    "obstructions": ("obstructions", truth),
    "insulation": ("insulation", truth),
}
