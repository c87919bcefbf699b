# SPDX-License-Identifier: Apache-2.0
"""Results as arrays, records and tables."""

from __future__ import annotations

import builtins
import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import strake


@pytest.fixture(scope="module")
def clashes(ship: strake.Model) -> strake.Clashes:
    return strake.clash(ship, clearance=25)


def test_rows_are_those_of_the_document(tmp_path: Path, clashes: strake.Clashes) -> None:
    clashes.save(tmp_path / "clashes.json")
    document = json.loads((tmp_path / "clashes.json").read_text())
    assert len(clashes) == len(document["results"])
    for one, stated in zip(clashes, document["results"], strict=True):
        assert (one.kind.name, one.relation.name, one.key) == (stated["class"], stated["relation"], stated["key"])
        assert one.separation == pytest.approx(stated["d_mm"], abs=1e-6)
        assert one.point == pytest.approx(stated["point_mm"], abs=1e-6)


def test_array(clashes: strake.Clashes) -> None:
    rows = clashes.array
    assert not rows.flags.writeable
    np.testing.assert_array_equal(rows["depth"], np.maximum(-rows["separation"], 0))
    np.testing.assert_array_equal(rows["distance"], np.maximum(rows["separation"], 0))
    for name, kind in (("hit", strake.Kind.HIT), ("contact", strake.Kind.CONTACT)):
        assert (rows["kind"] == kind).sum() == clashes.summary[name]
    assert clashes[-1] == list(clashes)[-1]
    assert clashes[1:3] == [clashes[1], clashes[2]]
    with pytest.raises(IndexError):
        clashes[len(clashes)]


def test_sets_by_arrays(ship: strake.Model) -> None:
    pipes = ship.select("PIP*")
    by_array = strake.clash(ship, a=pipes, b=~pipes).array
    by_text = strake.clash(ship, a="PIP*", b="not PIP*").array
    assert len(by_text) > 0
    assert by_array.tobytes() == by_text.tobytes()


def test_contacts(ship: strake.Model) -> None:
    listed, counted, off = (strake.clash(ship, contacts=how) for how in ("list", "count", "off"))  # type: ignore[arg-type]
    assert listed.summary == counted.summary == off.summary
    assert len(off) <= len(counted) < len(listed)
    assert not (off.array["kind"] == strake.Kind.CONTACT).any()


def test_groups(clashes: strake.Clashes, ship: strake.Model) -> None:
    rows = np.concatenate([group.rows for group in clashes.groups])
    is_grouped = clashes.array["kind"] != strake.Kind.CONTACT
    np.testing.assert_array_equal(np.sort(rows), np.flatnonzero(is_grouped))
    for group in clashes.groups:
        assert group.worst == clashes.array["kind"][group.rows].max()
    assert len(strake.clash(ship, clearance=25, group_by="files").groups) == 1


def test_tables(clashes: strake.Clashes) -> None:
    assert "hits" in repr(clashes)
    assert str(clashes) == clashes.table()
    page = clashes._repr_html_()
    assert page.count("<tr>") == 51
    assert f"{len(clashes) - 50} more" in page


def test_data_frames(clashes: strake.Clashes) -> None:
    pytest.importorskip("pandas")
    frame = clashes.to_pandas()
    assert len(frame) == len(clashes)
    assert frame["kind"].value_counts()["HIT"] == clashes.summary["hit"]
    assert frame["a_id"][5] == clashes[5].a_id
    assert frame["point_x"][5] == clashes[5].point[0]


def test_arrow_tables(clashes: strake.Clashes) -> None:
    pytest.importorskip("pyarrow")
    table = clashes.to_arrow()
    assert table.num_rows == len(clashes)
    assert table["kind"][5].as_py() == clashes[5].kind.name
    assert table["b_id"][5].as_py() == clashes[5].b_id
    assert table["point_z"][5].as_py() == clashes[5].point[2]
    assert table["key"].to_pylist() == [clash.key for clash in clashes]
    assert set(table["status"].to_pylist()) == {"new"}
    assert set(table["group"].to_pylist()) == {None}


def test_arrow_tables_have_the_words_of_csv(ship: strake.Model, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    clashes = strake.clash(ship, group_by="element")
    clashes.save(tmp_path / "x.csv")
    with open(tmp_path / "x.csv", newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    table = clashes.to_arrow()
    assert table["key"].to_pylist() == [row["key"] for row in rows]
    assert [group or "" for group in table["group"].to_pylist()] == [row["group"] for row in rows]
    assert any(table["group"].to_pylist())


def test_parquet_files(clashes: strake.Clashes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pyarrow")
    import pyarrow.parquet

    file = tmp_path / "clashes.parquet"
    clashes.to_parquet(file)
    rows = repr(clashes.to_arrow().to_pylist())
    assert repr(pyarrow.parquet.read_table(file).to_pylist()) == rows
    monkeypatch.setattr("strake._clash._ROWS_AT_ONCE", 7)
    clashes.to_parquet(tmp_path / "some.parquet")
    assert pyarrow.parquet.ParquetFile(tmp_path / "some.parquet").num_row_groups == -(-len(clashes) // 7)
    assert repr(pyarrow.parquet.read_table(tmp_path / "some.parquet").to_pylist()) == rows
    with pytest.raises(strake.OutputError):
        clashes.to_parquet(tmp_path / "none" / "x.parquet")
    assert sorted(made.name for made in tmp_path.iterdir()) == ["clashes.parquet", "some.parquet"]


def test_what_is_not_installed_is_named(clashes: strake.Clashes, monkeypatch: pytest.MonkeyPatch) -> None:
    usual = builtins.__import__

    def without(name: str, *rest: Any, **others: Any) -> Any:
        if name in ("pandas", "pyarrow", "trimesh"):
            raise ImportError(name)
        return usual(name, *rest, **others)

    monkeypatch.setattr(builtins, "__import__", without)
    for call, name in (
        (clashes.to_pandas, "pandas"),
        (clashes.to_arrow, r"'strake\[arrow\]'"),
        (lambda: clashes.to_parquet("x.parquet"), r"'strake\[arrow\]'"),
        (clashes.model.to_trimesh, "trimesh"),
    ):
        with pytest.raises(ImportError, match=f"pip install {name}"):
            call()  # type: ignore[operator]


def test_drawings(ship: strake.Model) -> None:
    drawing = strake.draw(ship, hidden="dashed")
    lines = drawing.lines
    assert lines.starts[0] == 0
    assert lines.starts[-1] == len(lines.points)
    assert (np.diff(lines.starts) >= 2).all()
    assert len(lines.kinds) == len(lines.states) == len(lines.objects) == len(lines.starts) - 1
    width, height = drawing.size
    assert ((lines.points >= 0) & (lines.points <= [width, height])).all()
    assert (drawing.segments["state"] == 0).sum() == drawing.summary["visible"]
    assert drawing._repr_svg_().startswith("<?xml")
    assert drawing.scale in repr(drawing)


def test_hidden_lines_are_found_when_they_are_requested(ship: strake.Model) -> None:
    drawing, quick = strake.draw(ship), strake.draw(ship, visible_only=True)
    assert drawing.svg == quick.svg
    assert (drawing.segments["state"] == 1).any()
    assert not (quick.segments["state"] == 1).any()
