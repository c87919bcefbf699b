# SPDX-License-Identifier: Apache-2.0
"""Entities of a model, and what they state by name.

IfcOpenShell has such a class, too. It looks each name up in the schema again, and for one that the class does not have it goes
through the rules of the schema, a module of megabytes. Half of our questions are of that kind (decisions 0118, 0124).
"""

from __future__ import annotations

from typing import Any

import ifcopenshell
from ifcopenshell import ifcopenshell_wrapper

# What IfcOpenShell has of an entity.
RawEntity: Any = ifcopenshell_wrapper.entity_instance
# Where a class has an attribute: its number, or one of these.
_NOWHERE, _INVERSE = -1, -2
_STATED_CATEGORY, _INVERSE_CATEGORY = 1, 2
_ABSENT = object()
# What the class of IfcOpenShell calls when it has found out that a name is inverse.
_inverse: Any = getattr(RawEntity, "_get_inverse", getattr)


class Tables:
    """What the schema of a model says of its classes, so far as it was asked for."""

    __slots__ = ("kinds", "places")

    def __init__(self) -> None:
        # By class, then by name of an attribute.
        self.places: dict[str, dict[str, int]] = {}
        # By a class and one that it may be made from.
        self.kinds: dict[tuple[str, str], bool] = {}


class Entity:
    """An entity, or a value with a type. Attributes are those of its class: `wall.Name`, `wall.HasOpenings`.

    One that the class does not have raises AttributeError, what the file states wrongly RuntimeError.
    """

    __slots__ = ("_of_class", "_tables", "data")

    def __init__(self, data: Any, tables: Tables) -> None:
        self.data = data
        self._tables = tables
        self._of_class: dict[str, int] | None = None

    def __getattr__(self, name: str) -> Any:
        found = self.get(name, _ABSENT)
        if found is _ABSENT:
            raise AttributeError(name)
        return found

    def get(self, name: str, otherwise: Any = None) -> Any:
        """Returns an attribute, and something else where the class has none of that name: quicker than to raise an exception, and
        than to catch it."""
        of_class = self._of_class
        if of_class is None:
            kind = self.data.is_a()
            of_class = self._tables.places.get(kind)
            if of_class is None:
                of_class = self._tables.places[kind] = {}
            self._of_class = of_class
        place = of_class.get(name)
        if place is None:
            place = of_class[name] = self._place_of(name)
        if place >= 0:
            return self.at(place)
        if place == _INVERSE:
            tables = self._tables
            return tuple([Entity(one, tables) for one in _inverse(self.data, name)])
        return otherwise

    def at(self, place: int) -> Any:
        """Returns what the class states at a place, counted from 0: quicker than by name, where all versions have it there."""
        value = self.data.get_argument(place)
        kind = type(value)
        if kind is RawEntity:
            return Entity(value, self._tables)
        return self._wrapped(value) if kind is tuple else value

    def __repr__(self) -> str:
        return repr(self.data)

    def is_a(self, kind: str | None = None) -> Any:
        """Returns the name of the class; with a name, whether it is of that class or of one made from it."""
        own = self.data.is_a()
        if kind is None or kind == own:
            return own if kind is None else True
        known = self._tables.kinds.get((own, kind))
        if known is None:
            known = self._tables.kinds[own, kind] = bool(self.data.is_a(kind))
        return known

    def id(self) -> int:
        """Returns the number of the entity in the file, #1 and so on."""
        return int(self.data.id())

    def attribute_names(self) -> list[str]:
        """Returns the names of what the class itself states, inverse attributes not among them."""
        return [str(name) for name in self.data.get_attribute_names()]

    def _wrapped(self, values: tuple[Any, ...]) -> tuple[Any, ...]:
        tables = self._tables
        return tuple(
            [Entity(one, tables) if type(one) is RawEntity else self._wrapped(one) if type(one) is tuple else one for one in values]
        )

    def _place_of(self, name: str) -> int:
        category = self.data.get_attribute_category(name)
        if category == _STATED_CATEGORY:
            return int(self.data.get_argument_index(name))
        return _INVERSE if category == _INVERSE_CATEGORY else _NOWHERE


class Model:
    """A file that was read. `file` is what IfcOpenShell has of it."""

    def __init__(self, file: ifcopenshell.file) -> None:
        self.file: Any = file
        self.tables = Tables()
        self.schema = str(file.schema)
        self.schema_identifier = str(file.schema_identifier)
        # Faces that are split before kernels see them, by product (importers/ifc/pinched.py).
        self.pinched: dict[int, list[int]] = {}

    def by_type(self, kind: str) -> list[Entity]:
        """Returns the entities of a class and of those made from it."""
        return [Entity(data, self.tables) for data in self.file.by_type(kind)]

    def by_id(self, number: int) -> Entity:
        """Returns the entity of a number."""
        return Entity(self.file.by_id(number), self.tables)


def is_a(entity: Entity, kind: str) -> bool:
    """Whether an entity is of that class, or of one made from it; never of a class that its schema does not have."""
    try:
        return bool(entity.is_a(kind))
    except RuntimeError:
        return False


def number_of(entity: Entity) -> int:
    """Returns the number of an entity in the file, #1 and so on."""
    return entity.id()
