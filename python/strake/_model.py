# SPDX-License-Identifier: Apache-2.0
"""Models: read, made of arrays, looked at, written."""

from __future__ import annotations

import operator
import sysconfig
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, overload

from strake import _core
from strake._arguments import (
    Length,
    PathLike,
    Progress,
    count,
    length,
    number,
    path,
    paths,
    run_options,
    several,
    shown,
    text,
    texts,
    truth,
)
from strake._errors import UsageError
from strake._numpy import np, npt

if TYPE_CHECKING:
    import trimesh

_AXES = {"x": 0, "y": 1, "z": 2}
_UNMOVED = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)


class Diagnostic(NamedTuple):
    """One thing that a run noticed about its input and survived."""

    severity: str
    """"note", "warning", or "skipped": what it names is absent."""
    code: str
    """A lasting name of the kind, as "unit-doubtful"."""
    message: str
    where: str
    """A file with line or offset, or an object."""


class Object(NamedTuple):
    """What a user would point at: a glTF node with a mesh, an RVM group with primitives, an OBJ group."""

    number: int
    """Its place in Model.objects: what arrays call it."""
    id: str
    """Durable, and unique within its file."""
    name: str
    path: str
    """Names of the groups above, joined by "/"."""
    file: str
    """The label of its file."""
    category: str
    """"physical", "obstruction" or "insulation"."""
    attributes: dict[str, str]
    """What it states, and what it inherits from the groups above."""


class Mesh(NamedTuple):
    """An object for Model.from_arrays()."""

    name: str
    vertices: npt.ArrayLike
    """(V, 3), mm; float32 arrays are known to be rounded."""
    triangles: npt.ArrayLike
    """(T, 3), whole numbers of vertices; the outward side is counter-clockwise."""
    attributes: Mapping[str, str] | None = None
    placement: npt.ArrayLike | None = None
    """(3, 4) or (4, 4), from the vertices to the model; objects that share arrays share their shape."""
    path: str = ""
    """Names of groups above, joined by "/"."""
    color: Sequence[int] | None = None
    """Red, green, blue and perhaps alpha, 0 to 255; what is transparent hides nothing."""


class Objects(Sequence[Object]):
    """The objects of a model in their durable order, each made when it is asked for."""

    def __init__(self, core: _core.Model) -> None:
        self._core = core

    def __len__(self) -> int:
        return len(self._core)

    @overload
    def __getitem__(self, index: int) -> Object: ...
    @overload
    def __getitem__(self, index: slice) -> list[Object]: ...
    def __getitem__(self, index: int | slice) -> Object | list[Object]:
        if isinstance(index, slice):
            return [self._at(i) for i in range(*index.indices(len(self)))]
        return self._at(_position(index, len(self)))

    def _at(self, i: int) -> Object:
        return Object(i, *self._core.object(i))

    def __repr__(self) -> str:
        return f"<{len(self)} objects>"


def _position(index: int, count: int) -> int:
    try:
        i = operator.index(index)
    except TypeError:
        raise TypeError(f"an object is asked for by its number, and {shown(index)} is none") from None
    if not -count <= i < count:
        raise IndexError(f"there is no object {shown(i)} of {count}")
    return i + count if i < 0 else i


_Array = TypeVar("_Array", bound="npt.NDArray[Any]")


def _kept(array: _Array) -> _Array:
    """An array of which a model has one: nobody changes it, as results read it."""
    array.flags.writeable = False
    return array


class Model:
    """Objects of one or several files, as load(), generate() and from_arrays() make them. It never changes."""

    def __init__(self, core: _core.Model) -> None:
        self._core = core

    def __len__(self) -> int:
        """The number of objects."""
        return len(self._core)

    def __repr__(self) -> str:
        labels = [file[0] for file in self._core.files]
        named = ", ".join(labels[:3]) + (f" and {len(labels) - 3} more" if len(labels) > 3 else "")
        return f"<strake.Model of {named}: {len(self)} objects, {self._core.bodies} bodies>"

    @cached_property
    def objects(self) -> Objects:
        """The objects in their durable order, by file and id."""
        return Objects(self._core)

    def __iter__(self) -> Iterator[Object]:
        return iter(self.objects)

    @property
    def files(self) -> list[dict[str, Any]]:
        """Of each file label, format, unit, up_axis and bytes."""
        return [dict(zip(("label", "format", "unit", "up_axis", "bytes"), file, strict=True)) for file in self._core.files]

    @cached_property
    def ids(self) -> npt.NDArray[np.object_]:
        """(N,) ids of the objects."""
        return _kept(np.array(self._core.ids, dtype=object))

    @cached_property
    def names(self) -> npt.NDArray[np.object_]:
        """(N,) names of the objects."""
        return _kept(np.array(self._core.names, dtype=object))

    @cached_property
    def placements(self) -> npt.NDArray[np.float64]:
        """(B, 3, 4) from the shape of each body to the model, mm."""
        return _kept(_core.placements(self._core))

    @cached_property
    def object_of_body(self) -> npt.NDArray[np.uint32]:
        """(B,) number of the object that each body belongs to."""
        return _kept(_core.object_of_body(self._core))

    @cached_property
    def boxes(self) -> npt.NDArray[np.float64]:
        """(N, 2, 3) least and greatest corner of each object, mm; NaN for objects of which nothing could be placed."""
        return _kept(_core.boxes(self._core, run_options(None, None)))

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What reading noticed, at most a hundred of each kind."""
        return [Diagnostic(*one) for one in self._core.diagnostics]

    def select(self, expression: str | Sequence[str]) -> npt.NDArray[np.bool_]:
        """Returns (N,) whether each object is picked by one of the selections (docs/selection.md).

        Raises: UsageError, with the column where the text stops making sense.
        """
        wanted = texts(expression, "expression")
        if not wanted:
            raise UsageError("no selection is given", "expression")
        return _core.select(self._core, wanted, run_options(None, None))

    def mesh(self, i: int, sag: Length = 0.5) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.uint32]]:
        """Returns vertices (V, 3), mm of the model, and triangles (T, 3) of object i.

        Curved primitives are tessellated with chords no farther than `sag` from the surface; lines have no triangles.
        Raises: IndexError; UsageError for a sag below a micrometre.
        """
        try:
            at = _position(i, len(self))
        except TypeError as error:
            raise UsageError(str(error), "i") from None
        return _core.mesh(self._core, at, sag_of(sag, "sag"))

    def save(self, path_to: PathLike, threads: int | None = None, progress: Progress | None = None) -> None:
        """Writes a .glb or an .obj, whole or not at all. Raises: UsageError, OutputError."""
        _core.save(self._core, path(path_to, "path_to"), run_options(threads, progress))

    @classmethod
    def from_arrays(cls, meshes: Iterable[Mesh | tuple[Any, ...]], label: str = "arrays") -> Model:
        """Makes a model of meshes: Mesh records, or tuples of name, vertices, triangles and perhaps attributes.

        `label` is what results call the file. Names that repeat gain "#2" in their ids.
        Raises: UsageError for arrays of another shape or type, for numbers that are not finite, for corners that are no
        vertices; it names the mesh.
        """
        builder = _core.ModelBuilder(text(label, "label"))
        shapes: dict[tuple[int, int], int] = {}
        kept: list[object] = []  # so that no other array gets the place of one that is remembered
        for given in several(meshes, "meshes", "Mesh records, or tuples of name, vertices and triangles"):
            try:
                mesh = Mesh(*given)
            except TypeError:
                message = f"{shown(given)} is no mesh" if not isinstance(given, tuple) else f"a tuple of {len(given)} is no mesh"
                raise UsageError(message, "meshes", "give Mesh records, or tuples of name, vertices and triangles") from None
            key = (id(mesh.vertices), id(mesh.triangles))
            try:
                if key not in shapes:
                    shapes[key] = _add_shape(builder, mesh)
                    kept.append(mesh)
                _add_object(builder, mesh, shapes[key])
            except UsageError as error:
                raise UsageError(error.message, f"mesh {mesh.name!r}", error.mend) from None
        if not kept:
            raise UsageError("no mesh is given", "meshes")
        return cls(builder.finish())

    @classmethod
    def from_trimesh(cls, scene: trimesh.Scene | trimesh.Trimesh, unit: str | None = None, label: str = "trimesh") -> Model:
        """Makes a model of a trimesh scene, or of one mesh.

        `unit` is what its numbers are in; None: what the scene says (`units`), or millimetres.
        Nodes of a scene become objects; those that show one geometry share its shape.
        Raises: UsageError.
        """
        if not hasattr(scene, "graph") and not (hasattr(scene, "vertices") and hasattr(scene, "faces")):
            raise UsageError(f"{shown(scene)} is neither a scene nor a mesh of trimesh", "scene")
        given = getattr(scene, "units", None) if unit is None else text(unit, "unit")
        scale = _unit_mm(str(given or "mm"), "unit")
        if not hasattr(scene, "graph"):
            name = str(getattr(scene, "metadata", {}).get("name") or "mesh")
            return cls.from_arrays([Mesh(name, scene.vertices, scene.faces, placement=np.eye(3, 4) * scale)], label)
        meshes = []
        for node in scene.graph.nodes_geometry:
            placement, name = scene.graph[node]
            geometry = scene.geometry[name]
            if hasattr(geometry, "faces"):
                meshes.append(Mesh(str(node), geometry.vertices, geometry.faces, placement=np.asarray(placement)[:3] * scale))
        return cls.from_arrays(meshes, label)

    def to_trimesh(self, sag: Length = 0.5) -> trimesh.Scene:
        """Returns a trimesh scene in mm with a mesh per object that has triangles, named by its id.

        Raises: ImportError where trimesh is not installed.
        """
        try:
            import trimesh
        except ImportError as error:
            raise ImportError("Model.to_trimesh() needs trimesh: pip install trimesh") from error
        scene = trimesh.Scene()
        for i, name in enumerate(self.ids):
            vertices, triangles = self.mesh(i, sag)
            if len(triangles):
                mesh = trimesh.Trimesh(vertices, triangles, process=False)
                scene.add_geometry(mesh, node_name=name, geom_name=name)
        scene.units = "mm"
        return scene


def _add_shape(builder: _core.ModelBuilder, mesh: Mesh) -> int:
    vertices = _array(mesh.vertices, "vertices")
    if vertices.dtype.kind not in "fiu" or vertices.ndim != 2 or vertices.shape[1] != 3:
        raise UsageError(f"vertices are {vertices.dtype} of shape {vertices.shape}", mend="give numbers of shape (V, 3)")
    triangles = _array(mesh.triangles, "triangles")
    if triangles.size == 0:
        triangles = np.zeros((0, 3), dtype=np.uint32)
    if triangles.dtype.kind not in "iu" or triangles.ndim != 2 or triangles.shape[1] != 3:
        raise UsageError(f"triangles are {triangles.dtype} of shape {triangles.shape}", mend="give whole numbers of shape (T, 3)")
    if triangles.size and (triangles.min() < 0 or triangles.max() >= len(vertices)):
        raise UsageError(f"a triangle has a corner that is none of {len(vertices)} vertices")
    return builder.add_shape(
        np.array(vertices, dtype=np.float64, order="C"),
        np.array(triangles, dtype=np.uint32, order="C"),
        vertices.dtype == np.float32,
    )


def _array(given: npt.ArrayLike, what: str) -> npt.NDArray[Any]:
    try:
        return np.asarray(given)
    except (TypeError, ValueError):
        raise UsageError(f"{what} are {shown(given)}", mend="give an array of as many numbers in each row") from None


def _add_object(builder: _core.ModelBuilder, mesh: Mesh, shape: int) -> None:
    if not isinstance(mesh.name, str):
        raise UsageError(f"{shown(mesh.name)} is no name")
    attributes = []
    if mesh.attributes is not None and not isinstance(mesh.attributes, Mapping):
        raise UsageError(f"attributes are {shown(mesh.attributes)}", mend="give a dict of texts")
    for name, value in (mesh.attributes or {}).items():
        if not isinstance(name, str) or not isinstance(value, str):
            raise UsageError(f"attribute {name!r} is {shown(value)}", mend="give names and values as texts")
        attributes.append((text(name, "attributes"), text(value, "attributes")))
    if not isinstance(mesh.path, str):
        raise UsageError(f"path is {shown(mesh.path)}", mend="give names of groups, joined by /")
    groups = [name for name in text(mesh.path, "path").split("/") if name]
    builder.add_object(text(mesh.name, "name"), groups, attributes, _color(mesh.color), shape, _placement(mesh.placement))


def _placement(given: npt.ArrayLike | None) -> Sequence[float]:
    if given is None:
        return _UNMOVED
    matrix = _array(given, "numbers of a placement")
    if matrix.dtype.kind not in "fiu" or matrix.shape not in ((3, 4), (4, 4)):
        raise UsageError(f"a placement is {matrix.dtype} of shape {matrix.shape}", mend="give numbers of shape (3, 4)")
    if matrix.shape == (4, 4) and np.isfinite(matrix).all() and not np.array_equal(matrix[3], (0, 0, 0, 1)):
        raise UsageError("the last row of a placement is not 0, 0, 0, 1", mend="transpose the matrix where its last column is")
    flat: list[float] = matrix[:3].astype(np.float64).ravel().tolist()
    return flat


def _color(given: Sequence[int] | None) -> tuple[int, int, int, int] | None:
    if given is None:
        return None
    values = [number(part, "color") for part in several(given, "color", "red, green, blue and perhaps alpha")]
    parts = [int(value) for value in values]
    if len(parts) not in (3, 4) or parts != values or not all(0 <= part <= 255 for part in parts):
        raise UsageError(f"{shown(given)} is no colour", mend="give red, green, blue and perhaps alpha as whole numbers, 0 to 255")
    red, green, blue = parts[:3]
    return red, green, blue, parts[3] if len(parts) == 4 else 255


def read_arguments(
    files: PathLike | Iterable[PathLike], unit: str | float | None, up_axis: str | None
) -> tuple[list[Path], float | None, int | None, Path]:
    """Returns files, unit in mm, number of the axis and folder of importers. Raises: UsageError."""
    unit_mm = None if unit is None else _unit_mm(unit, "unit")
    if up_axis is not None and (not isinstance(up_axis, str) or up_axis not in _AXES):
        raise UsageError(f"{shown(up_axis)} is no axis", "up_axis", "write x, y or z")
    axis = None if up_axis is None else _AXES[up_axis]
    # An environment that nobody activated has its importers beside this Python, and not in PATH.
    return paths(files, "files"), unit_mm, axis, Path(sysconfig.get_path("scripts"))


def load(
    files: PathLike | Iterable[PathLike],
    unit: str | float | None = None,
    up_axis: str | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    georeference: bool = False,
) -> Model:
    """Reads model files (RVM, glTF, OBJ, STL, PLY; IFC and others where an importer is installed) into one model.

    A project file gives its model as it was read last, without its files being read again.

    Args:
        files: a path, or several; or one project.
        unit: what the numbers of the files are in, as "mm", "m" or "in", or how many millimetres it has; None: what
            they state.
        up_axis: "x", "y" or "z"; None: what their format states.
        threads: how many work; None: as many as the process can run at a time.
        progress: called with the fraction of a step and its name, from this thread, some twenty times a second. What it
            raises ends the call.
        georeference: put files whose importer says where they lie on a map there: x east, y north (docs/formats/ifc.md).
            Without it coordinates are those of each file.

    Raises: InputError for a file that cannot be read, with where; UsageError.
    """
    given, unit_mm, axis, importers = read_arguments(files, unit, up_axis)
    on_map, options = truth(georeference, "georeference"), run_options(threads, progress)
    if projects := [file for file in given if _core.is_project(file)]:
        if len(given) > 1:
            raise UsageError(f"{projects[0]} is a project, and is read alone", "files", "Project.add() adds files to it")
        for name, is_given in (("unit", unit is not None), ("up_axis", axis is not None), ("georeference", on_map)):
            if is_given:
                raise UsageError(f"{projects[0]} is a project, and its files were read already", name, "leave it out")
        return Model(_core.project_model(projects[0], options))
    return Model(_core.load(given, unit_mm, axis, on_map, importers, options))


def model_core(model: Any, name: str = "model") -> _core.Model:
    """What the extension knows a model as. Raises: UsageError."""
    if not isinstance(model, Model):
        raise UsageError(f"{shown(model)} is no strake.Model", name, "strake.load() reads one")
    return model._core


def sag_of(value: Length, name: str) -> float:
    """The distance of chords from their curve, mm. Raises: UsageError."""
    sag_mm = length(value, name)
    if sag_mm < 0.001:
        raise UsageError(f"{value!r} is finer than the grid of 1um", name)
    return sag_mm


def optional_sag(value: Length | None, name: str) -> float | None:
    """As sag_of(), where None stays None."""
    return None if value is None else sag_of(value, name)


def _unit_mm(unit: str | float, name: str) -> float:
    if not isinstance(unit, str):
        mm = number(unit, name)
        if not 0 < mm < 1e12:
            raise UsageError(f"{unit!r} is no length", name, "write how many millimetres the unit has")
        return mm
    try:
        return _core.unit_mm(text(unit, name))
    except UsageError as error:
        raise UsageError(error.message, name, error.mend) from None


def generate(
    kind: str = "usual",
    objects: int = 1000,
    seed: int = 1,
    *,
    turned: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Model:
    """Makes a ship section with planted clashes, as `strake generate ship` does: for trials and tests.

    Args:
        kind: "usual", "slender", "dense", "repeated" or "unlike".
        objects: how many it has, 100 to 5,000,000.
        seed: equal seeds give equal ships.
        turned: whether no face lies along an axis.

    Raises: UsageError.
    """
    many, which, is_turned = count(objects, "objects"), count(seed, "seed"), truth(turned, "turned")
    return Model(_core.generate(text(kind, "kind"), many, which, is_turned, run_options(threads, progress)))
