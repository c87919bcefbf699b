# SPDX-License-Identifier: Apache-2.0
"""Real models, in the folder that STRAKE_DATA names."""

from __future__ import annotations

import os
import re
import zipfile
from pathlib import Path
from typing import Any

import pytest

ifcopenshell = pytest.importorskip("ifcopenshell")

import strake  # noqa: E402
from conversions import Outcome, convert  # noqa: E402
from glb_reader import Glb  # noqa: E402

DATA = Path(os.environ.get("STRAKE_DATA", "")) / "ifc"
pytestmark = pytest.mark.skipif("STRAKE_DATA" not in os.environ, reason="needs STRAKE_DATA")
BUILDING = "LTplus-AG_ifc-lite"


def converted(name: str, folder: Path) -> Outcome:
    """Converts a file of the folder, which itself is not written to."""
    link = folder / Path(name).name
    link.symlink_to(DATA / name)
    return convert(link)


def expected(name: str, but: tuple[str, ...] = ("IfcSpace", "IfcOpeningElement")) -> list[Any]:
    """Returns the products that IfcOpenShell finds a shape of."""
    model: Any = ifcopenshell.open(DATA / name)
    return [p for p in model.by_type("IfcProduct") if p.Representation and not any(p.is_a(kind) for kind in but)]


def overlap(a: Glb, b: Glb) -> bool:
    """Whether boxes of objects of two scenes overlap."""
    boxes = [[glb.box(i) for i in glb.ids] for glb in (a, b)]
    return any(
        all(low_a[k] < high_b[k] and low_b[k] < high_a[k] for k in range(3)) for low_a, high_a in boxes[0] for low_b, high_b in boxes[1]
    )


def test_duplex_is_whole(tmp_path: Path) -> None:
    name = "ThatOpen_engine_web-ifc/duplex.ifc"
    outcome = converted(name, tmp_path)
    products = expected(name)
    assert len(products) == 215
    assert sorted(outcome.glb.ids) == sorted(p.GlobalId for p in products)
    assert outcome.reported("skipped") == []
    for product in products:
        assert outcome.glb.node(product.GlobalId)["name"] == product.Name
        assert outcome.glb.attributes(product.GlobalId)["class"] == product.is_a()
    wall = outcome.glb.attributes("2O2Fr$t4X7Zf8NOew3FNtn")
    assert wall["Pset_WallCommon"]["IsExternal"] is True
    assert wall["PSet_Revit_Dimensions"]["Length"].endswith(" m")
    assert outcome.glb.path("2O2Fr$t4X7Zf8NOew3FNtn")[-1] == "Level 1"


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("ThatOpen_engine_web-ifc/duplex.ifc", "youshengCode_IfcSampleFiles/Ifc2s3_Duplex_Electrical.ifc"),
        ("buildingSMART_BCF-XML/Architectural.ifc", "buildingSMART_BCF-XML/MEP.ifc"),
        (f"{BUILDING}/building-architecture.ifc", f"{BUILDING}/Building-Structural.ifc"),
        (f"{BUILDING}/building-architecture.ifc", f"{BUILDING}/Building-Hvac.ifc"),
    ],
)
def test_disciplines_of_one_building_lie_in_each_other(tmp_path: Path, first: str, second: str) -> None:
    outcomes = [converted(name, tmp_path) for name in (first, second)]
    assert all(outcome.reported("skipped") == [] for outcome in outcomes)
    assert overlap(outcomes[0].glb, outcomes[1].glb)


def test_names_and_double_ids(tmp_path: Path) -> None:
    unicode = converted("opensourceBIM_TestFiles/revit2013_unicode.ifc", tmp_path).glb
    assert any(ord(letter) > 127 for node in unicode.nodes for letter in str(node))
    doubles = converted("opensourceBIM_TestFiles/doubleguids.ifc", tmp_path)
    assert len(doubles.glb.ids) == len(set(doubles.glb.ids))
    assert any(line["code"] == "ifc-double-id" for line in doubles.reported("warning"))


def test_the_pair_that_a_real_bcf_names_is_found(tmp_path: Path) -> None:
    folder = "buildingsmart-community_Community-Sample-Test-Files"
    with zipfile.ZipFile(DATA.parent / "bcf" / folder / "ROOT-Vebo interne modelkwaliteit.bcfzip") as archive:
        (view,) = [name for name in archive.namelist() if name.endswith(".bcfv")]
        named = set(re.findall(r'IfcGuid="([^"]+)"', archive.read(view).decode("utf-8")))
    found = strake.clash(strake.load(converted(f"{folder}/ROOT-Vebo.ifczip", tmp_path).output))
    (one,) = [clash for clash in found if {clash.a_id, clash.b_id} == named]
    # The covers of two cavity walls meet in a point, which another program calls an intersection.
    assert one.kind == strake.Kind.CONTACT and abs(one.separation) < 0.001


def test_a_model_is_the_same_bytes_in_every_run(tmp_path: Path) -> None:
    """It has round faces, of which a kernel makes triangles by where in memory it keeps them: half of the runs gave another scene."""
    name = "youshengCode_IfcSampleFiles/Ifc2s3_Duplex_Electrical.ifc"
    found = set()
    for number in range(6):
        folder = tmp_path / str(number)
        folder.mkdir()
        link = folder / Path(name).name
        link.symlink_to(DATA / name)
        found.add(convert(link, threads=1 + number % 3, hash_seed=number).output.read_bytes())
    assert len(found) == 1
