# SPDX-License-Identifier: Apache-2.0
"""Where a file lies on a map: IfcMapConversion to a coordinate system of projected coordinates."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from strake.importers.ifc.entity import Entity, Model
from strake.importers.ifc.units import millimetres_of, project_length_unit
from strake.importers.report import Report

# Scales of map projections are within a percent of 1; a factor of a thousand is a unit that was taken for another.
_MAX_SCALE = 0.01


class MapConversion(NamedTuple):
    """The conversion of a file."""

    crs: str
    eastings_mm: float
    northings_mm: float
    height_mm: float
    to_map: NDArray[np.float64]
    """4x4, rows first, from millimetres of the project to millimetres east, north and up."""


def conversion_of(model: Model) -> Entity | None:
    """Returns the first map conversion of a file; IFC2x3 has none."""
    if model.schema == "IFC2X3":
        return None
    found = sorted(model.by_type("IfcMapConversion"), key=lambda entity: entity.id())
    return found[0] if found else None


def read_map_conversion(model: Model, report: Report) -> MapConversion | None:
    """Returns where a file lies on a map; nothing where it says nothing, or nothing usable, which is then told."""
    conversion = conversion_of(model)
    if conversion is None:
        return None
    crs = conversion.TargetCRS
    name = str(crs.Name or "") if crs is not None else ""
    project_mm = millimetres_of(project_length_unit(model)) or 1000.0
    map_unit = getattr(crs, "MapUnit", None) if crs is not None else None
    map_mm = (millimetres_of(map_unit) if map_unit is not None else None) or project_mm
    abscissa, ordinate = _number(conversion.XAxisAbscissa, 1.0), _number(conversion.XAxisOrdinate, 0.0)
    length = math.hypot(abscissa, ordinate)
    east, north, up = (_number(getattr(conversion, key), 0.0) for key in ("Eastings", "Northings", "OrthogonalHeight"))
    stated = _number(conversion.Scale, math.nan)
    scale = project_mm / map_mm if math.isnan(stated) else stated
    factors = [_number(getattr(conversion, key, None), 1.0) for key in ("FactorX", "FactorY", "FactorZ")]
    along = [scale * factor * map_mm / project_mm for factor in factors]
    if any(abs(factor - 1) > _MAX_SCALE for factor in along) and all(0.99 <= scale * f <= 1.01 for f in factors):
        # Written as if both were in one unit.
        report.warning(
            "ifc-map-scale",
            f"the map conversion has the scale {scale:g}, although the map is in units of {map_mm:g} mm and the project in "
            f"units of {project_mm:g} mm: it is taken for that beside their ratio",
        )
        along = [scale * factor for factor in factors]
    if not name or not length > 0 or not all(math.isfinite(v) for v in (east, north, up, length)) or not all(f > 0 for f in along):
        report.warning("ifc-map-unusable", "the map conversion names no map, no direction or no scale: it is not applied")
        return None
    cosine, sine = abscissa / length, ordinate / length
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]]) @ np.diag(along)
    matrix[:3, 3] = np.array([east, north, up]) * map_mm
    return MapConversion(name, east * map_mm, north * map_mm, up * map_mm, matrix)


def map_attributes(model: Model) -> dict[str, object]:
    """Returns what the file says of its place on the map, as attributes; nothing where it says nothing."""
    conversion = conversion_of(model)
    if conversion is None:
        return {}
    values = {name: getattr(conversion, name, None) for name in _NAMES}
    target = conversion.TargetCRS
    if target is not None and target.Name:
        values["TargetCRS"] = target.Name
    return {"MapConversion": {name: value for name, value in values.items() if value is not None}}


_NAMES = ("Eastings", "Northings", "OrthogonalHeight", "XAxisAbscissa", "XAxisOrdinate", "Scale")


def _number(value: object, otherwise: float) -> float:
    return float(value) if isinstance(value, (int, float)) else otherwise
