"""Contact of cloth with boxes and with itself, as kernels. This is an overview.

Assumptions
-----------
- A cloth is particles, edges and faces that move along straight lines in a step. A box is convex
  and rigid; its motion in a step is small beside its size (`box_frame`). A plane is a large box.
- Nothing is inside anything at the start of a step. What is so nevertheless, such as cloth that is
  laid into a box, is pushed out and not held back meanwhile (`begins_inside`, `FREE`).
- Pinned particles are where their path says and move for no contact.
- Other shapes have no kernels here: `colliders.collision_world` sweeps sample points of the cloth
  after the step, and asks this package for contact of the cloth with itself.

Order of a step
---------------
1. A solver moves the cloth without regard to contact (`solvers`).
2. `lanes_contact`: registers of cloths, or of one cloth, are compared with the bounds of the boxes.
   A cloth that may touch one, or that meets itself, is copied to an array [N, 3] of double
   precision; all others go on. A layout of lanes gives only this load and store.
3. `resolve`, for that one cloth: boxes, then the cloth itself, in turns until neither moves it
   (`meet_one`), then the limit on strain with contact again after it (`strain`).
4. A step that contact has torn (`is_torn`) is made again from its start, with contact after each of
   its substeps. Otherwise moved particles get the velocity of their motion over the step, no faster
   than before or than the box that moved them (`moved_velocity`, which the contact that is
   resolved after a step uses too).

Algorithm
---------
Each of the two contacts has three stages, and each stage only a part of the work of the one before:

- Find. Boxes: `near_boxes`, bands of rows against bounds, then codes of planes. Itself:
  `smoothness` leaves out rectangles of a grid that cannot meet themselves, `face_tree` and
  `touching_pairs` list pairs that may come within 1.5 thicknesses in the step.
- Push. Contacts are solved one after another, in a fixed order, by moving ends by inverse mass,
  with Coulomb friction, in a few passes (`box_contact`, `self_contact`). Depths: `box_depths`,
  `pair_distance`.
- Guard. What is left over goes back towards the start of the step until nothing is inside a box
  (`box_guard`) and no pair has crossed (`safe_steps`).

Data
----
`BoxContact` and `SelfContact` are worked out once for each cloth, and never change but
for the poses of boxes. `Candidates` and `ContactWork` are room for one cloth at a time, one for
each thread; they carry one number from step to step (`Candidates.longest`), which changes no
result. So a cloth has the same bits alone, in a crowd and on any number of threads.

What is exact, and what is not
------------------------------
- Exact: no edge or face ends a step in a box at rest, and no two parts of a cloth cross, for any
  speed, if the step began so. The guard tests all edges of what is near, to `SKIN`; pairs stop at
  `LEAST`. Both are 20 µm, since single precision holds no less some metres from the origin.
- Exact: a box moves on as far as its pose says, and what it touches moves with it.
- Not exact: the thickness. Passes end at a fiftieth of it (`TOLERANCE`), and the guard keeps cloth
  out of solids, not at a distance. Edges at pins keep the distance that they begin with
  (`depth_at_pin`). Friction holds cloth but for a slow slide, as tension and
  contact take turns. The nearest point of an edge is found to 0.1 mm (`NEAREST`).
- Not held: cloth between two boxes that move towards each other has no free place. It keeps its
  limit of strain and enters a box as far as that needs (`without_boxes`), and leaves it again as
  far as that allows. Cloth that pins pull apart stretches; `State.worst` and a warning say so.

Constants
---------
Lengths are parts of the distance that the cloth keeps, so that they scale with it.

- Passes: `box_contact.PASSES` 6, and `self_contact.PASSES` 4 in each of `ROUNDS` 3. They decide how
  well contacts that share particles agree, not whether anything is crossed; the guards do.
- Guards: `box_guard.GUARDS` 16, and `self_contact.GUARDS` 24, in the second half of which particles
  stop at once. Each round takes particles out of the motion. After the last one boxes leave it at
  that, and the cloth rests for a step.
- Looking: `CLOSE` 0.5 and `FARTHER` 1.5 say what is looked at first. If boxes move a particle
  farther, the search begins again, so they decide time alone. `touching_pairs.REACH` 1.5 also
  bounds how far contact of the cloth with itself moves a particle: pairs that are not listed cannot
  cross.
- Tearing: `STRETCH` 1.25 is above what a pass of contact does to edges that lie on a box, and below
  what a solver then tears at. `MOST_CONTACTS` 32 bounds the time of methods with hundreds of
  substeps.
- Amplifying: `AMPLIFIED` 4. A point near one end of an edge, of which the other is pinned, moves
  that end by a multiple of its depth.
- Stopping: `HOLD` 0.8 of the thickness. With less, cloths that fall onto each other are pressed
  together, and each meets all others in the steps that follow.

Each of the others is explained where it stands. Measured costs: docs/notes/2026-11-contact.md.
"""
