# SPDX-License-Identifier: GPL-3.0-or-later
"""What an artist's mesh has beside its shape (UV maps, colours, numbers, materials) on its way through a run and back.

A layer that has one value at each vertex goes as an array at vertices, which remeshing interpolates ("blender.uv"). One
that has seams, where the corners at a vertex differ, cannot: there each vertex carries where it was in the mesh at the
start ("blender.rest"), and the layer is looked up there (seams.py). Materials are numbers of triangles, which
remeshing copies ("blender.material").
"""
from __future__ import annotations

import json
import pathlib
from collections import Counter
from typing import Any, NamedTuple

import bpy
import numpy as np

from .evaluated import Triangles
from .meshes import set_attribute
from .seams import SEAM, Seamed

ENDING = "_carried.npz"  # behind the name of the sheet's mesh file, beside the scene
MATERIAL, REST = "blender.material", "blender.rest"
CORNERS = "blender.corner_uv"
SHEET = "blender.sheet"  # where a scene has several: the number of each triangle's


class Layer(NamedTuple):
    """kind: uv, color, or the type of an attribute at vertices; array: the frames' array, "" if it is looked up;
    values: at the corners of the triangles at the start (m x 3 x components)."""
    kind: str
    name: str
    array: str
    values: Any


def _uv_layers(mesh: bpy.types.Mesh, corner: Any) -> list[tuple[str, str, Any]]:
    """The active one first."""
    found = []
    for layer in sorted(mesh.uv_layers, key=lambda layer: not layer.active_render):
        values = np.empty(2 * len(mesh.loops), np.float32)
        layer.data.foreach_get("uv", values)
        found.append(("uv", layer.name, values.reshape(-1, 2)[corner].astype(float)))
    return found


def _color_layers(mesh: bpy.types.Mesh, triangle: Any, corner: Any) -> list[tuple[str, str, Any]]:
    found = []
    for layer in mesh.color_attributes:
        values = np.empty(4 * len(layer.data), np.float32)
        layer.data.foreach_get("color", values)
        rows = {"POINT": triangle, "CORNER": corner}.get(layer.domain)
        if rows is not None:
            found.append(("color", layer.name, values.reshape(-1, 4)[rows].astype(float)))
    return found


ATTRIBUTES = {"FLOAT": ("value", 1), "FLOAT_VECTOR": ("vector", 3)}  # at vertices, which go along
OWN = ("thickness", "triangle_thickness", "velocity", "slab", "touch")  # what a run has of these names
BUILT_IN = ("position", "material_index", "shade_smooth", "sharp_face", "sharp_edge", "crease_edge", "crease_vert",
            "bevel_weight_edge", "bevel_weight_vert", "custom_normal", "freestyle_edge", "freestyle_face", "id",
            "uv_seam")


def _foreign_attributes(mesh: bpy.types.Mesh) -> list[Any]:
    """Those that are neither Blender's own nor UV maps, nor colours."""
    known = {*OWN, *BUILT_IN, *(layer.name for layer in mesh.uv_layers), *(c.name for c in mesh.color_attributes)}
    return [each for each in mesh.attributes if each.name not in known and not each.name.startswith(".")]


def left_out(mesh: bpy.types.Mesh) -> list[str]:
    """The names of attributes that do not go along."""
    return [each.name for each in _foreign_attributes(mesh)
            if each.domain != "POINT" or each.data_type not in ATTRIBUTES] + \
        [each.name for each in mesh.color_attributes if each.domain not in ("POINT", "CORNER")]


def _attribute_layers(mesh: bpy.types.Mesh, triangle: Any) -> list[tuple[str, str, Any]]:
    found = []
    for each in _foreign_attributes(mesh):
        if each.domain == "POINT" and each.data_type in ATTRIBUTES:
            name, width = ATTRIBUTES[each.data_type]
            values = np.empty(width * len(each.data), np.float32)
            each.data.foreach_get(name, values)
            found.append((each.data_type, each.name, values.reshape(-1, width)[triangle].astype(float)))
    return found


def _at_vertices(values: Any, triangle: Any, vertices: int) -> Any:
    """Corner values as those of vertices (n x components); None if they have seams."""
    result = np.zeros((vertices, values.shape[2]))
    result[triangle.ravel()] = values.reshape(-1, values.shape[2])
    return None if len(triangle) and np.abs(result[triangle] - values).max() > SEAM else result


def collect(mesh: bpy.types.Mesh, shape: Triangles) -> tuple[dict[str, Any], dict[str, Any], list[Layer]]:
    """Arrays at vertices and at triangles that go along, and the layers that they are."""
    at_vertices: dict[str, Any] = {}
    layers = []
    count: Counter[str] = Counter()
    for kind, name, values in (*_uv_layers(mesh, shape.corner), *_color_layers(mesh, shape.triangle, shape.corner),
                               *_attribute_layers(mesh, shape.triangle)):
        smooth = _at_vertices(values, shape.triangle, len(shape.position))
        number = f".{count[kind]}" if count[kind] else ""
        array = "" if smooth is None else f"blender{number}.{kind.lower()}"
        count[kind] += 1
        if smooth is not None:
            at_vertices[array] = smooth if smooth.shape[1] > 1 else smooth[:, 0]
        layers.append(Layer(kind, name, array, values))
    if any(not layer.array for layer in layers):
        at_vertices[REST] = shape.position
    slots = np.zeros(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("material_index", slots)
    at_triangles = {MATERIAL: slots[shape.face]} if slots.any() else {}
    return at_vertices, at_triangles, layers


def corner_arrays(layers: list[Layer]) -> dict[str, Any]:
    """Those at triangles that stay in the mesh file: u and v at the corners, where the first UV map has seams, for
    programs other than Blender, which look them up there as it does."""
    first = next((layer for layer in layers if layer.kind == "uv"), None)
    return {} if first is None or first.array else {CORNERS: first.values.reshape(-1, 6)}


def file_of(mesh_file: pathlib.Path) -> pathlib.Path:
    return mesh_file.with_name(mesh_file.stem + ENDING)


def keep(mesh_file: pathlib.Path, layers: list[Layer], shape: Triangles) -> None:
    """Writes what looking up takes, and what the arrays of the run are, beside the mesh file."""
    said = [{"kind": layer.kind, "name": layer.name, "array": layer.array} for layer in layers]
    looked_up = {f"values_{i}": layer.values for i, layer in enumerate(layers) if not layer.array}
    if looked_up:
        looked_up |= {"position": shape.position, "triangle": shape.triangle}
    np.savez(file_of(mesh_file), layers=np.array(json.dumps(said)), **looked_up)


class Carried:
    """What the frames of a run carry of the artist's mesh."""

    def __init__(self, file: pathlib.Path) -> None:
        self.layers: list[Layer] = []
        self.seamed: dict[int, Seamed] = {}
        self.looked_up: dict[int, tuple[bytes, Any]] = {}
        with np.load(file) as kept:
            for i, said in enumerate(json.loads(str(kept["layers"]))):
                values = None if said["array"] else kept[f"values_{i}"]
                self.layers.append(Layer(said["kind"], said["name"], said["array"], values))
                if values is not None:
                    self.seamed[i] = Seamed(kept["position"], kept["triangle"], values)

    def put(self, mesh: bpy.types.Mesh, frame: Any, materials: bool = True) -> None:
        """Gives the frame's mesh its layers and, if they shall be those, the materials of its faces."""
        triangle = np.asarray(frame["triangle"])
        for i, layer in enumerate(self.layers):
            if layer.array:
                values = np.asarray(frame[layer.array])[triangle] if layer.array in frame else None
                if layer.kind in ATTRIBUTES and layer.array in frame:
                    set_attribute(mesh, layer.name, layer.kind, "POINT", frame[layer.array])
                    continue
            else:
                values = self._values_of(i, frame, triangle) if REST in frame else None
            if values is not None:
                _put_layer(mesh, layer, values.reshape(-1, values.shape[2]))
        if materials and MATERIAL in frame and len(mesh.materials) > 1:  # else a preset's, which the whole sheet has
            mesh.polygons.foreach_set("material_index", np.asarray(frame[MATERIAL]).astype(np.int32).ravel())

    def _values_of(self, i: int, frame: Any, triangle: Any) -> Any:
        rest = np.asarray(frame[REST])
        key = rest.tobytes() + triangle.tobytes()
        if i not in self.looked_up or self.looked_up[i][0] != key:  # the same as long as the mesh is
            self.looked_up[i] = (key, self.seamed[i].look_up(rest, triangle))
        return self.looked_up[i][1]


def _put_layer(mesh: bpy.types.Mesh, layer: Layer, values: Any) -> None:
    flat = np.ascontiguousarray(values, np.float32).ravel()
    if layer.kind == "uv":
        target = mesh.uv_layers.get(layer.name) or mesh.uv_layers.new(name=layer.name, do_init=False)
        target.data.foreach_set("uv", flat)
        return
    target = mesh.color_attributes.get(layer.name)
    if target is None:
        target = mesh.color_attributes.new(layer.name, "FLOAT_COLOR", "CORNER")
    target.data.foreach_set("color", flat)


_kept: dict[pathlib.Path, tuple[int, Carried | None]] = {}


def beside(run: str, mesh_file: str) -> Carried | None:
    """What is carried by the run of a file, whose scene names this mesh file, if the add-on has written that: it is in
    the folder of the run, the one above, or where the scene says."""
    folder = pathlib.Path(bpy.path.abspath(run)).resolve().parent
    name = file_of(pathlib.Path(mesh_file)) if mesh_file else pathlib.Path(ENDING)
    file = next((place for place in (folder / name.name, folder.parent / name.name, folder / name) if place.is_file()),
                None)
    if file is None:
        return None
    stamp = file.stat().st_mtime_ns
    if file not in _kept or _kept[file][0] != stamp:
        try:
            _kept[file] = (stamp, Carried(file))
        except (OSError, ValueError, KeyError) as error:
            print(f"Sheet: {file}: UV maps and colours do not come back: {error}")
            _kept[file] = (stamp, None)
    return _kept[file][1]
