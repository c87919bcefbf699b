# SPDX-License-Identifier: Apache-2.0
"""Entities of a model. Their attributes are those of the schema of the file, which no type of Python says."""

from __future__ import annotations

from typing import Any, TypeAlias

Entity: TypeAlias = Any
Model: TypeAlias = Any


def is_a(entity: Entity, kind: str) -> bool:
    """Whether an entity is of that class, or of one made from it; never of a class that its schema does not have."""
    try:
        return bool(entity.is_a(kind))
    except RuntimeError:
        return False


def number_of(entity: Entity) -> int:
    """Returns the number of an entity in the file, #1 and so on."""
    return int(entity.id())
