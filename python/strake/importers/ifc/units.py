# SPDX-License-Identifier: Apache-2.0
"""Units of a project, and values as a selection compares them."""

from __future__ import annotations

import math
from typing import Any

from strake.importers.ifc.entity import Entity, Model, RawEntity
from strake.importers.report import Report

_PREFIXES = {
    "EXA": "E", "PETA": "P", "TERA": "T", "GIGA": "G", "MEGA": "M", "KILO": "k", "HECTO": "h", "DECA": "da",
    "DECI": "d", "CENTI": "c", "MILLI": "m", "MICRO": "u", "NANO": "n", "PICO": "p", "FEMTO": "f", "ATTO": "a",
}  # fmt: skip
_SI = {
    "METRE": "m", "SQUARE_METRE": "m2", "CUBIC_METRE": "m3", "GRAM": "g", "SECOND": "s", "RADIAN": "rad", "STERADIAN": "sr",
    "KELVIN": "K", "DEGREE_CELSIUS": "degC", "AMPERE": "A", "VOLT": "V", "WATT": "W", "NEWTON": "N", "PASCAL": "Pa",
    "JOULE": "J", "HERTZ": "Hz", "LUX": "lx", "LUMEN": "lm", "CANDELA": "cd", "MOLE": "mol", "OHM": "ohm", "COULOMB": "C",
    "FARAD": "F", "HENRY": "H", "SIEMENS": "S", "TESLA": "T", "WEBER": "Wb", "BECQUEREL": "Bq", "GRAY": "Gy", "SIEVERT": "Sv",
}  # fmt: skip
_CONVERTED = {
    "FOOT": "ft", "INCH": "in", "YARD": "yd", "MILE": "mi", "SQUARE FOOT": "ft2", "CUBIC FOOT": "ft3", "SQUARE INCH": "in2",
    "CUBIC INCH": "in3", "SQUARE YARD": "yd2", "CUBIC YARD": "yd3", "DEGREE": "deg", "POUND": "lb", "MINUTE": "min", "HOUR": "h",
    "DAY": "d", "LITRE": "l", "FAHRENHEIT": "degF",
}  # fmt: skip
_POWERS = {
    "EXA": 18, "PETA": 15, "TERA": 12, "GIGA": 9, "MEGA": 6, "KILO": 3, "HECTO": 2, "DECA": 1,
    "DECI": -1, "CENTI": -2, "MILLI": -3, "MICRO": -6, "NANO": -9, "PICO": -12, "FEMTO": -15, "ATTO": -18,
}  # fmt: skip
# Units of values that are plain numbers: SI without a prefix. Lengths are never plain, since a selection takes plain
# numbers for millimetres.
_PLAIN = {"m2", "m3", "kg", "g", "s", "rad", "sr", "K", "degC", "A", "V", "W", "N", "Pa", "J", "Hz", "lx", "lm", "cd"}
_NO_VALUE = object()
# Where all versions have them in IfcPropertySingleValue.
NOMINAL_VALUE, UNIT = 2, 3
# The kind of unit that values of a measure have.
MEASURES = {
    "IfcLengthMeasure": "LENGTHUNIT",
    "IfcPositiveLengthMeasure": "LENGTHUNIT",
    "IfcNonNegativeLengthMeasure": "LENGTHUNIT",
    "IfcAreaMeasure": "AREAUNIT",
    "IfcVolumeMeasure": "VOLUMEUNIT",
    "IfcMassMeasure": "MASSUNIT",
    "IfcTimeMeasure": "TIMEUNIT",
    "IfcPlaneAngleMeasure": "PLANEANGLEUNIT",
    "IfcPositivePlaneAngleMeasure": "PLANEANGLEUNIT",
    "IfcThermodynamicTemperatureMeasure": "THERMODYNAMICTEMPERATUREUNIT",
    "IfcPowerMeasure": "POWERUNIT",
    "IfcPressureMeasure": "PRESSUREUNIT",
    "IfcForceMeasure": "FORCEUNIT",
    "IfcEnergyMeasure": "ENERGYUNIT",
    "IfcElectricVoltageMeasure": "ELECTRICVOLTAGEUNIT",
    "IfcElectricCurrentMeasure": "ELECTRICCURRENTUNIT",
    "IfcFrequencyMeasure": "FREQUENCYUNIT",
    "IfcIlluminanceMeasure": "ILLUMINANCEUNIT",
    "IfcLuminousFluxMeasure": "LUMINOUSFLUXUNIT",
    "IfcVolumetricFlowRateMeasure": "VOLUMETRICFLOWRATEUNIT",
}


class Units:
    """The units of a project."""

    def __init__(self, model: Model, report: Report) -> None:
        self._tables = model.tables
        self._names: dict[str, str] = {}
        # By classes of values, as IfcLengthMeasure, which have one value: the unit of the project.
        self._name_of_measure: dict[str, str] = {}
        for unit in _units_of(model):
            kind = getattr(unit, "UnitType", None)
            if isinstance(kind, str):
                self._names.setdefault(kind, unit_name(unit))
        self.length_name = self._names.get("LENGTHUNIT", "m")
        if model.by_type("IfcProject") and "LENGTHUNIT" not in self._names:
            report.warning("ifc-no-unit", "the project states no unit of length: it is taken to be the metre")

    def value(self, value: Any, own_unit: Entity | None = None, kind: str | None = None) -> Any:
        """Returns a nominal value as an attribute: text, truth or a number, with its unit where that is not plain."""
        if value is None:
            return None
        if isinstance(value, Entity):
            kind = kind or MEASURES.get(value.is_a())
            wrapped = value.get("wrappedValue", _NO_VALUE)
            value = str(value) if wrapped is _NO_VALUE else wrapped
        if isinstance(value, (list, tuple)):
            return [self.value(item, own_unit, kind) for item in value]
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            return value
        name = unit_name(own_unit) if own_unit is not None else self._name_of(kind)
        return self._number(value, name)

    def single(self, data: Any) -> Any:
        """Returns the value of an IfcPropertySingleValue, as IfcOpenShell has it. Half of a file are such: they are asked for no more than
        that takes."""
        nominal = data.get_argument(NOMINAL_VALUE)
        if nominal is None:
            return None
        name = self._name_of_measure.get(nominal.is_a()) if type(nominal) is RawEntity else None
        if name is None or data.get_argument(UNIT) is not None:
            return self._any_single(Entity(data, self._tables))
        value = nominal.get_argument(0)
        kind = type(value)
        if kind is str or kind is bool:
            return value
        return self._number(value, name) if kind is int or kind is float else self._any_single(Entity(data, self._tables))

    def _any_single(self, item: Entity) -> Any:
        value = item.at(NOMINAL_VALUE)
        if isinstance(value, Entity) and value.get("wrappedValue", _NO_VALUE) is not _NO_VALUE:
            measure = value.is_a()
            self._name_of_measure[measure] = self._name_of(MEASURES.get(measure))
        return self.value(value, item.at(UNIT))

    def _name_of(self, kind: str | None) -> str:
        return self._names.get(kind or "", "m" if kind == "LENGTHUNIT" else "")

    def length(self, value: float) -> Any:
        """Returns a length of the project's unit as an attribute."""
        return self._number(value, self.length_name)

    @staticmethod
    def _number(value: int | float, name: str) -> Any:
        if isinstance(value, int) and (not name or name in _PLAIN):
            return value
        if not math.isfinite(value):
            return str(value)
        # The last digits of a double are noise of the exporter: 0.1937500000000122 is 0.19375.
        rounded = float(f"{value:.12g}")
        number = int(rounded) if rounded.is_integer() and abs(rounded) < 1e15 else rounded
        if not name or name in _PLAIN:
            return number
        return f"{number} {name}"


def _units_of(model: Model) -> list[Entity]:
    for project in model.by_type("IfcProject")[:1]:
        units = getattr(project.UnitsInContext, "Units", None)
        return [unit for unit in units if isinstance(unit, Entity)] if isinstance(units, tuple) else []
    return []


# A unit may be derived from itself in a file that somebody made up.
_DEEPEST_UNIT = 4


def project_length_unit(model: Model) -> Entity | None:
    """Returns the unit of length of the project; nothing where it states none."""
    return next((unit for unit in _units_of(model) if getattr(unit, "UnitType", None) == "LENGTHUNIT"), None)


def millimetres_of(unit: Entity | None, depth: int = 0) -> float | None:
    """Returns how many millimetres a unit of length has; nothing where that is not known."""
    if unit is None or depth > _DEEPEST_UNIT:
        return None
    if unit.is_a("IfcSIUnit"):
        power = _POWERS.get(unit.Prefix) if unit.Prefix else 0
        return None if power is None or unit.Name != "METRE" else 1000.0 * 10.0**power
    if unit.is_a("IfcConversionBasedUnit"):
        factor = unit.ConversionFactor
        of = millimetres_of(factor.UnitComponent, depth + 1) if factor is not None else None
        value = getattr(factor.ValueComponent, "wrappedValue", None) if factor is not None else None
        return of * float(value) if of is not None and isinstance(value, (int, float)) and value > 0 else None
    return None


def unit_name(unit: Entity, depth: int = 0) -> str:
    """Returns the name of a unit as a selection has it where it knows it: mm, ft2, kg."""
    if depth > _DEEPEST_UNIT:
        return ""
    if unit.is_a("IfcSIUnit"):
        name = _SI.get(unit.Name, str(unit.Name).lower())
        return _PREFIXES.get(unit.Prefix or "", "") + name
    if unit.is_a("IfcConversionBasedUnit"):
        name = str(unit.Name or "")
        return _CONVERTED.get(name.upper().strip("'").replace("_", " "), name.lower())
    if unit.is_a("IfcDerivedUnit"):
        return "".join(
            f"{'' if i == 0 else '.'}{unit_name(element.Unit, depth + 1)}{'' if element.Exponent == 1 else element.Exponent}"
            for i, element in enumerate(unit.Elements or ())
        )
    return str(getattr(unit, "Currency", None) or getattr(unit, "Name", None) or "")
