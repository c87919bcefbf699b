# SPDX-License-Identifier: Apache-2.0
"""The examples run, and say what they are about."""

import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[1]


@pytest.mark.parametrize(
    ("name", "last"),
    [
        ("find_clashes.py", "['clashes.csv', 'clashes.json']"),
        ("draw_views.py", " mm"),
        ("made_of_arrays.py", "336.0 mm: clear"),
    ],
)
def test_examples(name: str, last: str) -> None:
    done = subprocess.run([sys.executable, FOLDER / "examples" / name], capture_output=True, text=True, check=True)
    assert done.stdout.rstrip().endswith(last)


def test_the_benchmark_finds_what_it_times() -> None:
    code = [sys.executable, FOLDER / "bench/million_rows.py", "2000"]
    assert "results" in subprocess.run(code, capture_output=True, text=True, check=True).stdout
