"""Messages of the live cloth to the page: one for the constant parts, and one for each moment.

A message is a JSON header followed by arrays of numbers, all little-endian. Its first four bytes
give the header's length. Blanks pad the header, and zeros pad each array, to a multiple of four
bytes. The header's `arrays` gives each array's name, type, length and start; starts count from the
end of the header.

`scene`: panes, triangles, materials: everything that is the same in successive moments.
`moment`: positions and light of the vertices that have moved, and cameras that have changed.
"""

import json
from collections.abc import Mapping
from dataclasses import astuple, dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array
from drapery.render import Camera, Light, Model, Topology, bake_normal_maps, composite_layers
from drapery.render.drawlist import make_topology
from drapery.render.identity_cache import IdentityCache
from drapery.web.panes import Pane, ViewerState

TYPES = {"float32": "<f4", "uint32": "<u4", "int32": "<i4", "uint8": "|u1"}
Run = tuple[int, int]
"""A run of vertices: the first one and the number of vertices."""


def pack(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """A message as bytes."""
    listed, parts, at = [], [], 0
    for name, array in arrays.items():
        kind = array.dtype.name
        data = np.ascontiguousarray(array).astype(TYPES[kind], copy=False).tobytes()
        listed.append([name, kind, array.size, at])
        parts.append(data + bytes(-len(data) % 4))
        at += len(parts[-1])
    text = json.dumps({**header, "arrays": listed}, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return b"".join([len(text).to_bytes(4, "little"), text, *parts])


def unpack(message: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """The header and the arrays of a message, each [n]."""
    start = 4 + int.from_bytes(message[:4], "little")
    header = json.loads(message[4:start])
    arrays = {
        name: np.frombuffer(message, TYPES[kind], count, start + at)
        for name, kind, count, at in header.pop("arrays")
    }
    return header, arrays


@dataclass
class MessageEncoder:
    """Encodes messages for one viewer; each moment holds only what has changed since the last.

    which: "all" panes, or only the first or last. shape: width and height of the viewer [pixels].
    flat: whether layers that always look the same become one texture, which draws faster.
    """

    which: str = "all"
    shape: tuple[int, int] = (1, 1)
    flat: bool = True
    _version: int = 0
    _topology: Topology | None = None
    _layout: object = None
    _cut: object = None
    _cameras: list[Camera] = field(default_factory=list)
    _moved: list[tuple[Array, Array, Light]] = field(default_factory=list)
    _lit_of: tuple[Topology, NDArray[np.bool_]] | None = None
    _recent: IdentityCache[Topology] = field(default_factory=lambda: IdentityCache(2))

    def forget(self) -> None:
        """Forget what was sent, so that the next messages hold everything."""
        self._topology = None

    def reframe(self, shape: tuple[int, int]) -> None:
        """Set the width and height of the viewer."""
        if shape != self.shape:
            self.shape, self._cut = shape, None

    def messages(self, shown: ViewerState) -> list[bytes]:
        """The messages for this moment; they include the scene if it differs from the last one.

        Raises OptionError for what cannot be drawn.
        """
        shown = _arranged(shown, self.which, self.shape)
        panes = [_DrawnPane(pane) for pane in shown.panes]
        constant = self._constant([model for pane in panes for model in pane.models])
        found = []
        if not self._knows(constant, shown, [len(pane.models) for pane in panes]):
            self._version += 1
            self._moved, self._cut = [], None
            found.append(self._scene(constant, shown, panes))
        return [*found, self._moment(constant, shown, panes)]

    def _constant(self, models: list[Model]) -> Topology:
        """The constant parts of the models, cached here: all tabs share the renderer's cache."""
        arrays = tuple(
            part
            for model in models
            for part in (
                model.mesh.triangles,
                model.mesh.uvs,
                model.material_index,
                *model.materials,
            )
        )
        shapes = [model.mesh.positions.shape for model in models]
        return self._recent.get(arrays, shapes, lambda: make_topology(models))

    def _knows(self, topology: Topology, shown: ViewerState, counts: list[int]) -> bool:
        labels = [(pane.label, pane.flat, pane.scene.background) for pane in shown.panes]
        samples = max(pane.scene.samples for pane in shown.panes)
        layout = (counts, labels, shown.columns, shown.grip, samples)
        known = self._layout == layout and _equal(self._topology, topology)
        self._layout = layout
        if not known or self._topology is None:
            self._topology = topology
        return known

    def _scene(self, topology: Topology, shown: ViewerState, panes: list["_DrawnPane"]) -> bytes:
        starts, materials = topology.vertex_start, np.zeros(len(topology.uvs), np.int32)
        materials[topology.triangles] = topology.triangle_material[:, None]
        tables = topology.material_tables
        if self.flat:
            tables = composite_layers(tables)
        kinds = np.stack([tables.material_alpha, tables.material_lit], axis=1)
        header = {
            "kind": "scene",
            "version": self._version,
            "columns": shown.columns,
            "vertices": len(topology.uvs),
            "atlas": tables.atlas.shape[1::-1],
            "samples": max(pane.scene.samples for pane in shown.panes),
            "panes": _pane_headers(topology, panes),
            "grip": [_run(starts, first + g) for first in _firsts(panes) for g in shown.grip],
        }
        arrays: dict[str, NDArray[Any]] = {
            "uvs": topology.uvs,
            "triangles": topology.triangles.astype(np.uint32),
            "triangleMaterials": topology.triangle_material,
            "vertexMaterials": materials,
            "materials": np.concatenate([tables.material_layers, kinds], axis=1, dtype=np.int32),
            "layers": np.concatenate(
                [tables.layer_rects, tables.layer_tints], axis=1, dtype=np.int32
            ),
            "atlas": tables.atlas,
        }
        return pack(header, arrays)

    def _moment(self, constant: Topology, shown: ViewerState, panes: list["_DrawnPane"]) -> bytes:
        models = [(model, pane.pane.scene.light) for pane in panes for model in pane.models]
        states = [(model.mesh.positions, model.mesh.normals, light) for model, light in models]
        new = [number for number, state in enumerate(states) if not self._is_known(number, state)]
        self._moved = states
        runs = [_run(constant.vertex_start, number) for number in new]
        lit = self._lit(constant)
        light = [
            np.where(lit[first : first + count], models[number][1].brightness(_flat(normals)), 1)
            for number, (first, count) in zip(new, runs, strict=True)
            for normals in [states[number][1]]
        ]
        header: dict[str, Any] = {
            "kind": "moment",
            "version": self._version,
            "time": round(shown.time, 4),
            "runs": runs,
            "tints": [pane.pane.scene.light.tint for pane in panes],
        }
        if shown.wind is not None:
            speed, heading, on = shown.wind
            header["wind"] = [round(speed, 2), round(heading, 1), on]
        cameras = self._views(shown)
        if cameras is not None:
            header["cameras"] = cameras
        nothing = np.zeros((0, 3), np.float32)
        arrays = {
            "positions": np.concatenate([nothing, *(_flat(states[number][0]) for number in new)]),
            "light": np.concatenate([nothing[:, 0], *light]).astype(np.float32, copy=False),
        }
        return pack(header, arrays)

    def _lit(self, constant: Topology) -> NDArray[np.bool_]:
        """Which vertices are lit, shape [V]."""
        if self._lit_of is None or self._lit_of[0] is not constant:
            shines = np.zeros(len(constant.uvs), np.bool_)
            shines[
                constant.triangles[
                    constant.material_tables.material_lit[constant.triangle_material]
                ]
            ] = True
            self._lit_of = constant, shines
        return self._lit_of[1]

    def _is_known(self, number: int, state: tuple[Array, Array, Light]) -> bool:
        if number >= len(self._moved):
            return False
        old = self._moved[number]
        return old[0] is state[0] and old[1] is state[1] and old[2] == state[2]

    def _views(self, shown: ViewerState) -> dict[str, Any] | None:
        """The cameras if they have changed. `cut`: whether the viewer resets the user's view."""
        cut = self._cut is None or self._cut != (shown.cut,)
        self._cut = (shown.cut,)
        # A live body is framed once after each cut; the camera of a scene may move.
        if not cut and shown.live:
            return None
        rows = -(-len(shown.panes) // shown.columns)
        aspect = (self.shape[0] / shown.columns) / (self.shape[1] / rows)
        cameras = [pane.framing(aspect) for pane in shown.panes]
        if not cut and cameras == self._cameras:
            return None
        self._cameras = cameras
        return {"cut": cut, "list": [astuple(camera) for camera in cameras]}


def _arranged(shown: ViewerState, which: str, shape: tuple[int, int]) -> ViewerState:
    """The panes that a viewer shows; a portrait viewer shows a row of scenes as a column."""
    count = len(shown.panes)
    if which != "all" and count > 1:
        return replace(
            shown, panes=shown.panes[:1] if which == "left" else shown.panes[-1:], columns=1
        )
    # Banners are tall: two of them fit side by side in any viewer.
    if count > 1 and shown.columns == count and not shown.live and shape[0] < shape[1]:
        return replace(shown, columns=1)
    return shown


class _DrawnPane:
    """A pane and the models to draw; their textures include the effect of normal maps."""

    def __init__(self, pane: Pane) -> None:
        self.pane = pane
        self.models: tuple[Model, ...] = bake_normal_maps(pane.scene).models


def _pane_headers(topology: Topology, panes: list[_DrawnPane]) -> list[dict[str, Any]]:
    """Each pane's label, background and run of triangles."""
    firsts = [*_firsts(panes), sum(len(pane.models) for pane in panes)]
    owner = np.searchsorted(topology.vertex_start, topology.triangles[:, 0], "right") - 1
    cuts = np.searchsorted(owner, firsts)
    return [
        {
            "label": drawn.pane.label,
            "flat": drawn.pane.flat,
            "background": drawn.pane.scene.background,
            "triangles": [int(cuts[number]), int(cuts[number + 1] - cuts[number])],
        }
        for number, drawn in enumerate(panes)
    ]


def _firsts(panes: list[_DrawnPane]) -> list[int]:
    """The index of each pane's first model."""
    counts = [len(pane.models) for pane in panes]
    return [sum(counts[:number]) for number in range(len(counts))]


def _flat(vectors: Array) -> NDArray[np.float32]:
    return np.asarray(vectors, np.float32).reshape(-1, 3)


def _run(starts: NDArray[np.int64], model: int) -> Run:
    return int(starts[model]), int(starts[model + 1] - starts[model])


def _equal(a: Topology | None, b: Topology) -> bool:
    """Whether two draw lists are equal except for the positions of their vertices."""
    if a is None or a is b:
        return a is b
    pairs: list[tuple[NDArray[Any], NDArray[Any]]] = [
        (a.triangles, b.triangles),
        (a.triangle_material, b.triangle_material),
        (a.uvs, b.uvs),
        (a.vertex_start, b.vertex_start),
    ]
    names = (
        *("material_layers", "material_alpha", "material_lit"),
        *("layer_rects", "layer_tints", "atlas"),
    )
    pairs += [
        (getattr(a.material_tables, name), getattr(b.material_tables, name)) for name in names
    ]
    return all(x is y or np.array_equal(x, y) for x, y in pairs)
