# SPDX-License-Identifier: Apache-2.0
"""Which kernel of IfcOpenShell makes which shapes, and how fine curved ones are."""

from __future__ import annotations

import ifcopenshell
import ifcopenshell.geom

Entity = ifcopenshell.entity_instance

# The furthest that a chord is from its curve, in metres.
SAG_M = 0.001
# The largest angle between two chords, in radians: small circles are round, too.
ANGLE = 0.5

FAST = "cgal-simple"
EXACT = "opencascade"
# What is tried for a product, one after the other, until one gives a shape.
AFTER_FAST = (FAST, EXACT, "cgal")
AFTER_EXACT = (EXACT, FAST, "cgal")


def geometry_settings() -> ifcopenshell.geom.settings:
    """Returns the settings that are the same for all kernels."""
    settings = ifcopenshell.geom.settings()
    settings.set("mesher-linear-deflection", SAG_M)
    settings.set("mesher-angular-deflection", ANGLE)
    settings.set("weld-vertices", True)
    settings.set("no-normals", True)
    settings.set("use-world-coords", False)
    settings.set("apply-default-materials", True)
    return settings


def kernels_for(product: Entity) -> tuple[str, ...]:
    """Returns the kernels that are tried for a product, one after the other."""
    return AFTER_FAST
