"""The kernels of the simulation as a WebAssembly module, and how a page plays them.

No physics is written in JavaScript: `python -m drapery.web.wasm.build` compiles the kernels of
`drapery.cloth` from their Python source to one module, of which a page holds the kernels that it
calls (`drapery.web.wasm.module.smallest_module`). A page plays plans, one for each panel
of cloth. A plan is one binary file that Python writes: a picture of the memory that the kernels
read. `cloth.js` is an ES module without dependencies; it copies plans into the module's memory and
calls the kernels.

    import { Cloth } from "./cloth.js";
    const cloth = await Cloth.load(moduleBytes, planBytes);
    cloth.step(1);                     // one time step of `cloth.info.step` seconds
    draw(cloth.vertices, cloth.light);

`Cloth.load(module, plan)`: module is an ArrayBuffer, Uint8Array or WebAssembly.Module; cloths that
are loaded with the same object share one instance and its memory. plan: an ArrayBuffer or
Uint8Array. The promise is rejected with an Error of one line where WebAssembly, its SIMD or its
compilation (a content policy without `wasm-unsafe-eval`) is missing, and for a plan that is damaged
or written for another version of the module.

| of a cloth | what |
|---|---|
| `info` | the header of the plan: see below |
| `step(n = 1)` | makes n time steps; throws an Error if the cloth has blown up |
| `time` | simulated time [s] |
| `positions` | Float32Array [N * 3]: the particles in the panel's own frame [m], row by row |
| `velocities` | Float32Array [N * 3]: their velocities [m/s] |
| `vertices` | Float32Array [V * 3]: the thick cloth in the frame of the body [m] |
| `normals` | Float32Array [V * 3]: unit normals |
| `light` | Float32Array [V]: brightness 0..1 of each vertex, of the plan's light without shadows |
| `setWind(x, y, z)` | the free mean wind in the frame of the body [m/s]; gusts do not jump |
| `setGusts(seed, phase = 0)` | the seed of the gusts, 0 to 4294967295; how far ahead they are [s] |
| `pull(index, x, y, z)` | pulls a particle and those near it to a place in the panel's frame |
| `release()` | ends the pull |
| `reset()` | back to the start: rest shape, time 0, the plan's own wind |
| `picture(tables = {})` | `{ data, width, height }`, RGBA: see below |
| `free()` | gives the memory back; the cloth cannot be used any more |

The plan of the first cloth on a player also has the player: `array("figure")` and
`array("figureLight")` are its vertices [m] and their light. Tables of one period of its motion hold
where its boxes, its bones and the pins of the cloth are; a cloth with such tables begins the period
again as often as it ends.

A plan that is written with `picture=True` also draws: by the same rasteriser as in Python, with the
camera of the settings' own still. After `reset()` and `step(info.steps)` its pixels are those of
`drapery render` with the same settings. `tables` replaces the plan's `materials`, `layers` and
`atlas`, for example by those of another design. Shadows need Python.

The arrays are views of the module's memory. Read the properties again after every call of this
module: memory that grows moves. They hold the start before the first step.

The header of a plan (`info`), JSON: `columns`, `rows` of the grid; `step` [s]; `size` of the panel
[m]; `origin` of the panel in the body [m]; `frame`: 3 rows of 4, from places in the picture to
those in the panel [m]; `pins`: numbers of pinned particles; `wind`: the plan's mean wind [m/s], and
`heading`, to where it blows [degrees from +z towards +x]; `vertices`: V; `method` of stepping.
Triangles, texture coordinates and materials of the thick cloth do not move: the viewer has them
from the scene, in the same order of vertices (front sheet, back sheet, four for each edge of the
rim).

A plan as bytes, little-endian: the length of the header (4 bytes), the header, padded with blanks
to a multiple of 16 bytes, then the memory image. The header also has what the loader needs:
`calls`: by purpose, the name of the exported kernel, the place of its arguments and what it means
that it fails; `image`: the image's length in memory, which is at least that in the file, the rest
is 0; `pointers`: places of 32-bit pointers in the image, whose values count from its start;
`functions`: places of the addresses of kernels that kernels call, with their names; `fields`: the
places, types and lengths of the arrays and numbers that the loader uses, and the call that writes
them, if it is not `play`; `module`: the hash of the sources for which it is valid. Numba's
data models give the order of a kernel's arguments in the image; none of it is written by hand.

From Python: `drapery.web.wasm.plan.plans_of(played)` gives the plans of a subject's cloths,
and `drapery.web.wasm.module.read_module()` the module.
"""
