# SPDX-License-Identifier: Apache-2.0
"""Loads IfcOpenShell without what no importer needs of it (decision 0124)."""

from __future__ import annotations

import contextlib
import io
import sys


def load_ifcopenshell() -> None:
    """Loads IfcOpenShell. Raises ImportError where that cannot be done.

    Where `lark` is installed it compiles a grammar of views and one of streams at each start, a third of the CPU time that it takes to
    load, and reads neither by itself. It does without where there is none.
    """
    has_lark = "lark" in sys.modules
    if not has_lark:
        sys.modules["lark"] = None  # type: ignore[assignment]  # a module that is None cannot be imported
    try:
        # It prints that it has no streams.
        with contextlib.redirect_stderr(io.StringIO()):
            import ifcopenshell  # noqa: F401
    finally:
        if not has_lark:
            del sys.modules["lark"]
