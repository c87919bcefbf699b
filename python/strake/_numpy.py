# SPDX-License-Identifier: Apache-2.0
"""NumPy, which is loaded when the first array is asked for or given: it takes several times as long as the rest of strake, and who reads
models, finds clashes and writes files needs none (decision 0126)."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any, TypeGuard

__all__ = ["is_array", "np", "npt", "or_of_numpy"]

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt
else:

    class _Later:
        """A module that is loaded when something of it is asked for."""

        def __init__(self, name: str) -> None:
            self._name = name

        def __getattr__(self, name: str) -> object:
            value = getattr(import_module(self._name), name)
            setattr(self, name, value)
            return value

    np, npt = _Later("numpy"), _Later("numpy.typing")


def or_of_numpy(types: tuple[type, ...], *names: str) -> Any:
    """These types and those of NumPy; without the latter where nobody has loaded it, so that no value can be of them."""
    return (*types, *(getattr(np, name) for name in names)) if "numpy" in sys.modules else types


def is_array(value: object) -> TypeGuard[npt.NDArray[Any]]:
    """Whether a value is an array of NumPy."""
    return isinstance(value, or_of_numpy((), "ndarray"))
