"""Formulations: the ways to pose a patch to the native solver and to read its arrays back.

There are four: the patch alone, a patch that is symmetric in itself, a patch joined with the image that a Mirror
modifier adds, and a cage. `choose_formulation` decides once which one holds; all other code uses its result.
"""
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .. import native
from ..model import mirror
from ..model.beside import Beside
from ..model.border import CODES, UNSET, clamp_instead, fill_border, needs_surroundings
from ..model.cage import CagePatch
from ..model.line_surface import LineState
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.surroundings import Surroundings, join_images
from ..model.view import View
from ..native_call import call
from ..targets import mirror_target

# Arguments of reflines.PanelSmoother by their names.
PressSettings = Mapping[str, "str | float | bool"]


@dataclass(frozen=True)
class Press:
    """The result of an automatic press of Smooth, as arrays of the patch."""
    positions: np.ndarray  # #V x 3, world space
    stray: np.ndarray      # #F, see native.SmoothPanelReport
    verdict: np.ndarray    # #F, likewise
    told: "native.SmoothPanelReport"
    cage_move: float = 0.0  # largest move of a cage's vertices, which is more than its surface's


@dataclass(frozen=True)
class Formulation:
    """The patch alone. Below a Mirror modifier its seam is clamped, so that both halves join smoothly."""
    patch: Patch
    view: View

    @property
    def is_symmetric(self) -> bool:
        """True where the solve keeps the symmetry of the patch."""
        return False

    @property
    def image_sign(self) -> np.ndarray | None:
        """The signs of an object-space vector's components after mirroring (3), where targets must have both halves;
        None where there is one half, or `complete_target` adds the other.
        """
        return None

    @property
    def partner(self) -> np.ndarray | None:
        """The mirror images of all that is solved, which keep equal moves; None where there is no symmetry."""
        return None

    @property
    def follow_sign(self) -> np.ndarray | None:
        """Returns these signs for handles that are followed without targets, and so need both halves."""
        return self.image_sign

    def choose_directions(self) -> "dict[str, np.ndarray | tuple[np.ndarray, np.ndarray] | None]":
        """Returns the directions as arguments of the native constructors: the lines', and those that cross them, or
        those of a set of lights with their eyes.
        """
        families = self.view.families
        if families is None:
            return {"view_direction": self.view.view_direction, "line_direction": self.view.both_directions}
        return {"view_direction": self.view.view_direction, "line_direction": families.lines,
                "eye_directions": families.eyes, "blockers": families.blockers}

    def choose_press_directions(self) -> dict[str, np.ndarray]:
        """Returns the directions as arguments of the native presses, which add the crossed lines themselves."""
        return {"view_direction": self.view.view_direction, "line_direction": self.view.line_direction}

    def choose_own_border(self) -> np.ndarray:
        """Returns the codes of the vertices (#V) that have a border of their own, border.UNSET for the others."""
        own = self.patch.border
        if self.patch.mirror is not None and self.patch.mirror.image:
            own = np.where(self.patch.mirror.seam, CODES["clamped"], own)
        return own

    def choose_border(self, border: str) -> str | np.ndarray:
        """Returns the border, or its codes vertex by vertex (#V), as the native module takes it: clamped where it
        would follow its neighbours, which the automatic press of Smooth alone does.
        """
        return clamp_instead(fill_border(self.choose_own_border(), border))

    def read_around(self) -> Surroundings:
        """Returns the surroundings of all that is solved."""
        return self.patch.around

    def choose_share(self) -> np.ndarray | None:
        """Returns each solved vertex's share of the limit, as Patch.share has it."""
        return self.patch.share

    async def choose_ranges(self, _optimizer: "native.ShapeOptimizer") -> np.ndarray | None:
        """Returns the share of the limit of each vertex of the optimizer's triangles, as Patch.share has it."""
        return self.choose_share()

    def choose_edges(self, border: str, *,
                     fair: bool = False) -> dict[str, "str | np.ndarray | tuple[np.ndarray, np.ndarray] | None"]:
        """Returns what holds at the border as arguments of the native module; `fair` moves what has no border of its
        own in the native press.
        """
        codes = self.choose_border(border)
        around = self.read_around() if fair or needs_surroundings(codes) else None
        edges = {"border": codes, "around": None if around is None else (around.V, around.F)}
        return {**edges, "fair_border": self.choose_own_border() == UNSET} if fair else edges

    def read_beside(self) -> Beside | None:
        """Returns what the border of all that is solved can follow."""
        return self.patch.beside

    def find_following(self, border: str) -> np.ndarray:
        """Returns which vertices are to follow what lies beside them: #V, bool."""
        own = self.choose_own_border()
        return np.where(own == UNSET, CODES[border], own) == CODES["follow"]

    async def choose_press_edges(self, V: np.ndarray, F: np.ndarray, border: str, *,
                                 fair: bool) -> dict[str, "str | np.ndarray | tuple[np.ndarray, np.ndarray] | None"]:
        """Returns what holds at the border of the solved triangles (#V x 3, #F x 3) as arguments of the native press.
        A border that is faired moves to where the joined faces beside it tell, and follows no others.
        """
        edges, beside = self.choose_edges(border, fair=fair), self.read_beside()
        if beside is None or fair:
            return edges
        joined = self.read_around()
        found = await call(native.reflines.continue_over_gap, V, F, beside.V, beside.F, around=(joined.V, joined.F),
                           gap=beside.gap, reach=beside.reach)
        follows = self.find_following(border) & found.followed
        if not follows.any():
            return edges
        return {"border": np.where(follows, CODES["follow"], self.fill_codes(border)), "around": (found.V, found.F)}

    async def build(self, border: str, progress: "native.Progress | None", *, sparse: bool) -> "native.ShapeOptimizer":
        """Builds the native optimizer; `sparse` samples the surface of a cage more coarsely."""
        return await call(
            native.reflines.ShapeOptimizer.create, self.patch.V, self.patch.F, **self.choose_directions(),
            progress=progress, **self.choose_edges(border), partner=self.partner,
            face_of_triangle=self.patch.face_of_triangle, **self.patch.creases.build_arguments())

    def read_positions(self, optimizer: "native.ShapeOptimizer") -> np.ndarray:
        """Reads the solved positions of the patch's vertices: #V x 3, world space."""
        return optimizer.positions

    async def read_lines(self, optimizer: "native.ShapeOptimizer") -> LineState:
        """Reads the lines at the vertices of the optimizer's triangles, see read_triangles."""
        return LineState(optimizer.positions, await call(native.reflines.vertex_theta, optimizer))

    def read_triangles(self, _optimizer: "native.ShapeOptimizer") -> np.ndarray:
        """Reads the triangles that lines are read on: #F x 3; of a patch joined with its image its own half."""
        return self.patch.F

    def choose_triangles(self, _optimizer: "native.ShapeOptimizer", chosen: np.ndarray) -> np.ndarray:
        """Returns the numbers of the optimizer's triangles that lie in chosen faces (#mesh faces, bool)."""
        return np.flatnonzero(chosen[self.patch.face_of_triangle])

    async def spread_weights(self, _optimizer: "native.ShapeOptimizer", weights: np.ndarray) -> np.ndarray:
        """Returns weights of the patch's vertices (#V) for all vertices of the optimizer's triangles."""
        return weights

    def measure_cage_move(self, _optimizer: "native.ShapeOptimizer") -> float:
        """Measures the largest move of a cage's vertices, world units; 0 where vertices are those of the surface."""
        return 0.0

    def complete_target(self, wanted: "native.Target") -> "native.Target":
        """Returns the target for all that is solved, from one that was built for it."""
        return wanted

    def read_residual(self, _optimizer: "native.ShapeOptimizer", residual: np.ndarray) -> np.ndarray:
        """Returns the residual of the patch's triangles (#F) from that of all that is solved."""
        return residual[:len(self.patch.F)]

    def hold_marked_creases(self) -> np.ndarray:
        """Returns which vertices the automatic press of Smooth holds: #V, bool. The automatic rule would take noise for
        creases, and the native press keeps by itself what bends.
        """
        held = np.zeros(len(self.patch.V), dtype=bool)
        if self.patch.creases.rule != "none":
            held[self.patch.creases.marked.ravel()] = True
        return held

    def choose_press_mesh(self) -> dict[str, np.ndarray | None]:
        """Returns the mesh that the native press takes, with what of it stays and is alike, as its arguments."""
        return {"V": self.patch.V, "F": self.patch.F, "fixed": self.hold_marked_creases(), "partner": self.partner,
                "face_of_triangle": self.patch.face_of_triangle}

    async def build_smoother(self, border: str, settings: PressSettings, *, fair: bool) -> "native.PanelSmoother":
        """Builds the native smoother, where `fair` with a border that moves, too; raises the module's errors."""
        mesh, beside = self.choose_press_mesh(), self.read_beside()
        return await call(
            native.reflines.PanelSmoother.create, **mesh, **self.choose_press_directions(),
            parts_gap=None if beside is None or not self.find_following(border).any() else beside.gap,
            **await self.choose_press_edges(mesh["V"], mesh["F"], border, fair=fair), **settings)

    def build_joint_panel(self, border: str, settings: PressSettings) -> "native.JointPanel":
        """Builds the panel of a press of several from a patch that follows what lies beside it; raises the module's
        errors.
        """
        beside, around = self.read_beside(), self.read_around()
        codes = np.where(self.find_following(border), CODES["follow"], self.fill_codes(border))
        mesh = self.choose_press_mesh()
        return native.reflines.JointPanel(
            **mesh, **self.choose_press_directions(), border=codes, around=(around.V, around.F),
            beside=(beside.V, beside.F), gap=beside.gap, reach=beside.reach, **settings)

    def fill_codes(self, border: str) -> np.ndarray:
        """Returns the codes of choose_border for each vertex of all that is solved."""
        codes = self.choose_border(border)
        return np.full(len(self.choose_own_border()), CODES[codes]) if isinstance(codes, str) else codes

    def read_pressed(self, positions: np.ndarray) -> np.ndarray:
        """Returns the patch's positions (#V x 3) from those that the native smoother returns."""
        return positions

    def read_press(self, positions: np.ndarray, told: "native.SmoothPanelReport") -> Press:
        """Converts what the native smoother returns to arrays of the patch."""
        return Press(self.read_pressed(positions), told.stray, told.verdict, told)


class SymmetricFormulation(Formulation):
    """A patch that is symmetric in itself: mirror images keep equal moves."""

    @property
    def is_symmetric(self) -> bool:
        return True

    @property
    def image_sign(self) -> np.ndarray | None:
        return self.patch.mirror.sign

    @property
    def partner(self) -> np.ndarray | None:
        return self.patch.mirror.partner

    async def spread_weights(self, _optimizer: "native.ShapeOptimizer", weights: np.ndarray) -> np.ndarray:
        """Returns the smaller weight of two mirror images for both."""
        return np.minimum(weights, weights[self.patch.mirror.partner])


class JoinedFormulation(Formulation):
    """A patch joined along the seam with the image that a Mirror modifier adds."""

    @property
    def is_symmetric(self) -> bool:
        return True

    @property
    def follow_sign(self) -> np.ndarray | None:
        return self.patch.mirror.sign

    def join(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns positions (world space), triangles, and mirror images of both halves."""
        local, F, partner = mirror.join_with_image(self.patch.mirror, self.patch.local, self.patch.F)
        return self.patch.to_world(local), F, partner

    def choose_own_border(self) -> np.ndarray:
        own = self.patch.border
        return np.append(own, own[self.partner[len(own):]])

    def choose_share(self) -> np.ndarray | None:
        own = self.patch.share
        return None if own is None else np.concatenate([own, own[self.partner[len(own):]]])

    @property
    def partner(self) -> np.ndarray | None:
        return self.join()[2]

    def read_around(self) -> Surroundings:
        around, partner, own = self.patch.around, self.partner, len(self.patch.V)
        seam = mirror.find_seam(self.patch.mirror, self.to_local(around.V))
        return join_images(around, self.mirror_places(around.V), seam, own, partner[:own], len(partner))

    def read_beside(self) -> Beside | None:
        beside = self.patch.beside
        return None if beside is None else beside.add_image(self.mirror_places(beside.V))

    def mirror_places(self, places: np.ndarray) -> np.ndarray:
        """Returns the mirror images of places in world space: #places x 3."""
        return self.patch.to_world(self.to_local(places) * self.patch.mirror.sign)

    def to_local(self, places: np.ndarray) -> np.ndarray:
        """Transforms places in world space to object space: #places x 3."""
        matrix = self.patch.matrix
        return (places - matrix[:3, 3]) @ np.linalg.inv(matrix[:3, :3]).T

    async def build(self, border: str, progress: "native.Progress | None", *, sparse: bool) -> "native.ShapeOptimizer":
        V, F, partner = self.join()
        return await call(
            native.reflines.ShapeOptimizer.create, V, F, **self.choose_directions(), progress=progress,
            **self.choose_edges(border), partner=partner,
            face_of_triangle=np.tile(self.patch.face_of_triangle, 2), **self.patch.creases.build_arguments(partner))

    async def spread_weights(self, _optimizer: "native.ShapeOptimizer", weights: np.ndarray) -> np.ndarray:
        return np.append(weights, weights[self.join()[2][len(weights):]])

    def read_positions(self, optimizer: "native.ShapeOptimizer") -> np.ndarray:
        return self.read_own_half(optimizer.positions)

    def read_own_half(self, positions: np.ndarray) -> np.ndarray:
        """Returns the patch's positions from those of both halves."""
        own = len(self.patch.V)
        return self.patch.V + (positions - self.join()[0])[:own]

    def choose_press_mesh(self) -> dict[str, np.ndarray | None]:
        V, F, partner = self.join()
        own = self.hold_marked_creases()
        return {"V": V, "F": F, "fixed": np.append(own, own[partner[len(own):]]), "partner": partner,
                "face_of_triangle": np.tile(self.patch.face_of_triangle, 2)}

    def read_pressed(self, positions: np.ndarray) -> np.ndarray:
        return self.read_own_half(positions)

    def read_press(self, positions: np.ndarray, told: "native.SmoothPanelReport") -> Press:
        own = len(self.patch.F)
        return Press(self.read_pressed(positions), told.stray[:own], told.verdict[:own], told)

    def complete_target(self, wanted: "native.Target") -> "native.Target":
        """Returns the target of both halves. An eye of its own sees no half as the other: then there are both already.
        """
        if self.view.families is not None:
            return wanted
        sign = mirror.compute_theta_sign(self.patch.mirror, self.patch.matrix, self.view.line_direction)
        return mirror_target.mirror_target(wanted, sign)


class CageFormulation(Formulation):
    """A cage, whose vertices are the unknowns; symmetric where moves along the view keep it so."""
    patch: CagePatch

    @property
    def is_symmetric(self) -> bool:
        return self.patch.is_symmetric_for(self.view.view_direction)

    @property
    def image_sign(self) -> np.ndarray | None:
        return np.where(np.arange(3) == self.patch.mirror_axis, -1.0, 1.0) if self.is_symmetric else None

    def choose_own_border(self) -> np.ndarray:
        """Returns the codes of the cage's vertices; the image of a Mirror modifier has those of the mesh's own half."""
        cage, index = self.patch.cage, self.patch.index
        own = np.full(len(cage.V), UNSET)
        own[index] = self.patch.border
        image = cage.partner[index]
        added = (image >= 0) & ~np.isin(image, index)
        own[image[added]] = self.patch.border[added]
        return own

    def choose_share(self) -> np.ndarray | None:
        if self.patch.share is None:
            return None
        share = np.tile([-1.0, 1.0], (len(self.patch.cage.V), 1))
        image = self.patch.cage.partner[self.patch.index]
        share[image[image >= 0]] = self.patch.share[image >= 0]
        share[self.patch.index] = self.patch.share
        return share

    async def choose_ranges(self, optimizer: "native.CageOptimizer") -> np.ndarray | None:
        """Returns the shares of the cage's vertices subdivided as its positions are."""
        share = self.choose_share()
        if share is None:
            return None
        spread = await self.subdivide(optimizer, np.column_stack([share, np.zeros(len(share))]))
        return np.clip(spread[:, :2], [-1.0, 0.0], [0.0, 1.0])

    async def subdivide(self, optimizer: "native.CageOptimizer", values: np.ndarray) -> np.ndarray:
        """Returns three values of each vertex of the cage (#cage x 3) for the vertices of the optimizer's triangles."""
        subdivision = await call(native.reflines.Subdivision.create, **self.patch.cage.build_topology_arguments(),
                                 vertices=len(values))
        return subdivision.positions(values)[optimizer.refined]

    async def build(self, border: str, progress: "native.Progress | None", *, sparse: bool) -> "native.CageOptimizer":
        return await call(
            native.reflines.CageOptimizer.create, **self.patch.cage.build_arguments(self.is_symmetric),
            **self.choose_directions(), progress=progress, border=self.choose_border(border), sparse=sparse,
            **self.patch.creases.build_cage_arguments())

    def read_triangles(self, optimizer: "native.CageOptimizer") -> np.ndarray:
        return optimizer.triangles

    def choose_triangles(self, optimizer: "native.CageOptimizer", chosen: np.ndarray) -> np.ndarray:
        own = self.patch.cage.own_faces  # the images of the mesh's faces come after them, in their order
        return np.flatnonzero(chosen[optimizer.parent % own])

    def read_positions(self, optimizer: "native.ShapeOptimizer") -> np.ndarray:
        return self.patch.V + (optimizer.cage_positions - self.patch.cage.V)[self.patch.index]

    async def spread_weights(self, optimizer: "native.CageOptimizer", weights: np.ndarray) -> np.ndarray:
        """Returns the weights of the cage subdivided as its positions are."""
        cage, index = self.patch.cage, self.patch.index
        own = np.ones(len(cage.V))
        image = cage.partner[index]
        own[image[image >= 0]] = weights[image >= 0]
        own[index] = weights
        refined = await self.subdivide(optimizer, np.repeat(own[:, None], 3, axis=1))
        return np.clip(refined[:, 0], 0.0, 1.0)

    def measure_cage_move(self, optimizer: "native.CageOptimizer") -> float:
        return float(np.linalg.norm(optimizer.cage_positions - self.patch.cage.V, axis=1).max())

    def read_residual(self, optimizer: "native.ShapeOptimizer", residual: np.ndarray) -> np.ndarray:
        """Returns the root mean square over the surface of each face, for all triangles of that face: #F."""
        faces = len(self.patch.cage.sizes)
        squared, area = (np.bincount(optimizer.parent, values, faces)
                         for values in (optimizer.area * residual**2, optimizer.area))
        return self.spread_to_triangles(np.sqrt(squared / np.maximum(area, 1e-300)))

    def spread_to_triangles(self, values: np.ndarray) -> np.ndarray:
        """Returns the values of the cage's faces (#faces) for the patch's triangles: #F."""
        own = np.flatnonzero(self.patch.faces)
        return np.repeat(values[own], self.patch.cage.sizes[own] - 2)

    async def build_smoother(self, border: str, settings: PressSettings, *, fair: bool) -> "native.PanelSmoother":
        if fair:
            raise Refusal(f"{self.patch.name}: the border of a cage cannot be faired: switch Fair Border off, or solve "
                          "for the mesh")
        arguments = self.patch.cage.build_arguments(self.is_symmetric)
        arguments["limit_surface"] = arguments.pop("limit")
        return await call(
            native.reflines.PanelSmoother.create_for_cage, **arguments, **self.choose_press_directions(),
            border=self.choose_border(border), **settings)

    def read_pressed(self, positions: np.ndarray) -> np.ndarray:
        return self.patch.V + (positions - self.patch.cage.V)[self.patch.index]

    def read_press(self, positions: np.ndarray, told: "native.SmoothPanelReport") -> Press:
        return Press(self.read_pressed(positions), self.spread_to_triangles(told.stray),
                     self.spread_to_triangles(told.verdict), told, told.largest_control_move)


def choose_formulation(patch: Patch, view: View) -> Formulation:
    """Chooses the formulation of a patch: by its kind, and by whether view and light are symmetric about its plane."""
    if isinstance(patch, CagePatch):
        return CageFormulation(patch, view)
    plane = patch.mirror
    if plane is None or not plane.is_whole or not mirror.is_symmetric_setup(
            plane, patch.matrix, view.view_direction, view.line_direction):
        return Formulation(patch, view)
    return JoinedFormulation(patch, view) if plane.image else SymmetricFormulation(patch, view)
