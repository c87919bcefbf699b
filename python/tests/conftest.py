# SPDX-License-Identifier: Apache-2.0
"""A generated ship for all tests, and the program."""

from pathlib import Path

import pytest

import strake


@pytest.fixture(scope="session")
def ship_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("ship") / "ship.glb"
    strake.generate(objects=400, seed=3).save(file)
    return file


@pytest.fixture(scope="session")
def ship(ship_file: Path) -> strake.Model:
    return strake.load(ship_file)


@pytest.fixture(scope="session")
def large_ship() -> strake.Model:
    """Long enough to be interrupted."""
    return strake.generate(objects=20_000, seed=1, turned=True)
