# SPDX-License-Identifier: Apache-2.0
"""NumPy is loaded when there are arrays, and not before."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import strake


def after(lines: str) -> str:
    """What a program of its own prints that runs these lines, and whether it has loaded NumPy."""
    program = f"import sys, strake\n{lines}\nprint('numpy' in sys.modules)"
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr
    return ended.stdout.strip()


@pytest.mark.parametrize(
    ("lines", "loaded"),
    [
        ("m = strake.load({ship!r}, threads=2); assert len(m) == 400", "False"),
        ("m = strake.load({ship!r}); strake.clash(m, clearance=25, threads=2).save({out!r})", "False"),
        ("m = strake.load({ship!r}); strake.draw(m, 'top', hidden='dashed').save({out!r} + '.svg')", "False"),
        ("m = strake.load({ship!r}); assert m.boxes.shape == (400, 2, 3)", "True"),
        ("m = strake.load({ship!r}); assert strake.clash(m).array.dtype.names", "True"),
        ("m = strake.load({ship!r}); assert m.ids.dtype == object", "True"),
    ],
)
def test_files_are_read_tested_and_drawn_without_it(ship_file: Path, tmp_path: Path, lines: str, loaded: str) -> None:
    assert after(lines.format(ship=str(ship_file), out=str(tmp_path / "c.json"))) == loaded


@pytest.mark.parametrize("lines", ["strake.load({ship!r}, threads='two')", "strake.clash(strake.load({ship!r}), clearance=[1])"])
def test_wrong_arguments_are_told_without_it(ship_file: Path, lines: str) -> None:
    call = lines.format(ship=str(ship_file))
    assert after(f"try: {call}\nexcept strake.UsageError as error: print(error.where)").split()[-1] == "False"


def test_numbers_and_truth_values_of_numpy_are_numbers_and_truth_values(ship: strake.Model) -> None:
    found = strake.clash(ship, clearance=np.float32(25), threads=np.int64(2))
    assert len(found) == len(strake.clash(ship, clearance=25))
    assert len(strake.clash(ship, a=np.ones(len(ship), dtype=np.bool_))) > 0
    with pytest.raises(strake.UsageError):
        strake.clash(ship, threads=np.float64(2))  # type: ignore[arg-type]
