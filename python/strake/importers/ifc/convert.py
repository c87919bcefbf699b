# SPDX-License-Identifier: Apache-2.0
"""An IFC file from its bytes to the scene."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from typing import Any

import ifcopenshell
from ifcopenshell import ifcopenshell_wrapper

from strake.importers.command import Job
from strake.importers.ifc.attributes import AttributeReader
from strake.importers.ifc.conversion import Conversion, convert_products
from strake.importers.ifc.entity import Entity, Model
from strake.importers.ifc.georeference import read_map_conversion
from strake.importers.ifc.kernels import SAG_M
from strake.importers.ifc.products import Ids, Products, choose_products, report_left_out
from strake.importers.ifc.solids import manifold3d_files
from strake.importers.ifc.source import open_model, origin_of
from strake.importers.ifc.spatial import Parents, SpatialGroups
from strake.importers.ifc.units import Units
from strake.importers.report import Report
from strake.importers.scene_writer import Group

# The longest text of a kernel that is reported for a product.
_MAX_MESSAGE = 400


def convert(job: Job) -> None:
    """Converts the file of the job."""
    with tempfile.TemporaryDirectory(prefix=".strake-ifc-", dir=job.output.parent) as name:
        folder = Path(name)
        model = open_model(job.input, job.report, folder)
        job.kept.append(model)
        job.made_by = f"ifcopenshell {ifcopenshell.version}"
        job.format = model.schema_identifier
        job.depends_on = [ifcopenshell.__file__, ifcopenshell_wrapper.__file__, *manifold3d_files()]
        units = Units(model, job.report)
        job.unit = units.length_name
        products = choose_products(model)
        sys.stdout.flush()
        sag_m = SAG_M if job.sag_mm is None else job.sag_mm / 1000
        parents = Parents()
        conversion = convert_products(model, products.solid, job.threads, job.report, folder, sag_m, job.attempt, parents)
        if conversion.slow_cuts:
            what = f"{conversion.slow_cuts} products with openings or half-spaces are cut by Open CASCADE"
            job.report.note("ifc-slow-cuts", f"{what}; manifold3d takes a tenth of its time: pip install 'strake[ifc]'")
        job.kept.append(conversion)
        _write(job, model, units, products, conversion, parents)


def _write(job: Job, model: Model, units: Units, products: Products, conversion: Conversion, parents: Parents) -> None:
    report = job.report
    ids = Ids(report)
    attributes = AttributeReader(model, units)
    with job.scene(unit_mm=1.0) as scene:
        origin = origin_of(model)
        groups = SpatialGroups(model, scene, attributes, origin, parents)
        for product in products.solid:
            number = product.id()
            placed = conversion.placed.get(number)
            if placed is None and number not in conversion.failed:
                continue
            object_id = ids.of(product)
            if placed is None:
                _report_missing(product, object_id, conversion, report)
                continue
            shape = scene.known_shape(placed.key, placed.middle) or scene.add_shape(conversion.shapes.get(placed.key))
            if shape.middle != placed.middle:
                shape = type(shape)(shape.mesh, placed.middle)
            parent, stated = _read(groups, attributes, product, report, object_id)
            if parent is None:
                stated = {**origin, **stated}
            scene.object(object_id, product.Name or product.is_a(), shape, placed.matrix(), parent, stated)
            if remarks := conversion.remarks_of(number):
                message = f"{product.is_a()} '{product.Name or ''}': {'; '.join(remarks)[:_MAX_MESSAGE]}"
                report.warning("ifc-remark", message, object_id)
        if scene.object_count == 0:
            why = next(iter(conversion.failed.values()), "it has no product with a body")
            report.fail(f"nothing in it becomes an object: {why}"[:_MAX_MESSAGE], "leave it out, or export it with bodies")
    if on_map := read_map_conversion(model, report):
        job.place_on_map(on_map.crs, on_map.to_map)
        where = f"east {on_map.eastings_mm / 1000:g} m, north {on_map.northings_mm / 1000:g} m on {on_map.crs}"
        report.note("ifc-map-conversion", f"it lies {where}: an attribute of the site, applied where that is asked for")
    report_left_out(products, len(conversion.bodyless), report)


def _report_missing(product: Entity, object_id: str, conversion: Conversion, report: Report) -> None:
    name = f"{product.is_a()} '{product.Name or ''}'"
    if product.id() in conversion.empty and getattr(product, "HasOpenings", None):
        report.warning("ifc-cut-away", f"{name} is left out: its openings leave nothing of it", object_id)
    else:
        report.skipped("ifc-no-shape", f"{name} is left out: {conversion.failed[product.id()]}"[:_MAX_MESSAGE], object_id)


def _read(
    groups: SpatialGroups, attributes: AttributeReader, product: Entity, report: Report, object_id: str
) -> tuple[Group | None, dict[str, Any]]:
    """Returns the group and the attributes of a product. A file may state anything: what is at fault costs only these."""
    try:
        return groups.above(product), attributes.of(product)
    except Exception as fault:
        message = f"the attributes of {product.is_a()} '{product.Name or ''}' cannot be read: {type(fault).__name__}: {fault}"
        report.warning("ifc-attributes", message[:_MAX_MESSAGE], object_id)
        return None, {"class": product.is_a()}
