# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice infill: a mesh object that follows its base and its properties."""

from __future__ import annotations

import json
import traceback
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.features.jobs.screen import attach_view, is_asked_by_user, revive_view, screen
from freecad_volfrep.features.properties.quantities import set_value
from freecad_volfrep.preferences import largest_automatic, triangles_drawn
from freecad_volfrep.saved_names import saved_module

from .applicable import CONTROLS, show_applicable
from .freshness import fingerprint_of, is_of
from .infill_results import Asked, install, loaded, tell_driven, with_radius
from .properties import (
    ensure_properties,
    is_spoiled,
    out_of_range,
    refuse_spoiled,
    wrong_types,
)
from .values import specification_of

if TYPE_CHECKING:
    import Mesh

    from freecad_volfrep.features.jobs.screen import Screen
    from volfrep import LatticeSpec
    from volfrep.jobs.pipeline import FilledMesh
    from volfrep.mesh.triangle_mesh import TriangleMesh
    from volfrep.util.cache import StageCache

UP_TO_DATE = "Up to date"
OUT_OF_DATE = "Out of date: AutoUpdate is off, use Update Lattice Infill"
LARGE = "Out of date: a large job, use Update Lattice Infill"
FAILED = "Failed: see the report view"
BEING_MADE = "Out of date: the mesh of these values is not there yet"
CHANGED = "Out of date: values have changed since this mesh was asked for; recompute"
CANCELLED = (
    "Cancelled: the mesh is that of the last finished update; use Update Lattice Infill to try "
    "again."
)
CANCELLED_FIRST = "Cancelled: there is no mesh yet; use Update Lattice Infill to make it."
REVIVED = (
    "Saved by a FreeCAD without VOLFREP: recompute, and whatever was changed there is followed"
)


class LatticeInfill:
    """Proxy of a ``Mesh::FeaturePython`` that fills its Base with a lattice.

    What is kept between two runs (the base's mesh and the stages' results) lives here and is
    not saved; everything that is saved is a property.
    """

    # Of a proxy that FreeCAD has made of a damaged file, without a call of ours.
    _forced = False
    _reader: Any = None
    _cache: Any = None
    _is_to_begin = False
    _arrived: Any = None
    being_made: Asked | None = None
    _beside: Asked | None = None
    was_cancelled = False

    def __init__(self, obj: App.DocumentObject) -> None:
        self._forget()
        obj.Proxy = self
        ensure_properties(obj)

    def execute(self, obj: App.DocumentObject) -> None:
        """Bring the mesh up to date; called by FreeCAD's recompute.

        In the window a recompute of the user's returns at once, and the mesh comes later; a
        script's waits for it. A cancelled job is no error: the last mesh stays, and `Status` says
        so.

        Raises:
            VolfrepError: one sentence; the object turns Invalid and its last mesh stays.
        """
        from volfrep.util.errors import Cancelled, VolfrepError

        if is_spoiled(obj):
            ensure_properties(obj)
        forced, self._forced = self._forced, False
        self.was_cancelled = False
        beside = screen() if is_asked_by_user() else None
        obj.Status = FAILED  # what stays if something fails that is not the input's fault
        try:
            self._run(obj, forced, beside)
        except VolfrepError as error:
            message = str(error)
        except Cancelled:
            self.was_cancelled = True
            obj.Status = CANCELLED if obj.Mesh.CountFacets else CANCELLED_FIRST
            App.Console.PrintMessage(f"VOLFREP, {obj.Label}: {obj.Status}\n")
            return
        except MemoryError:
            message = "Not enough memory: choose larger cells or a coarser deviation."
        except Exception as error:  # whatever it is, the user gets a sentence and keeps the mesh
            App.Console.PrintLog(f"VOLFREP, {obj.Label}:\n{traceback.format_exc()}\n")
            message = (
                f"The engine failed with a {type(error).__name__} ({error}), which is a defect of "
                "VOLFREP: please report it with the traceback in the report view's log messages."
            )
        else:
            return
        obj.Status = message
        App.Console.PrintError(f"VOLFREP, {obj.Label}: {message}\n")
        raise VolfrepError(message)

    def update(self, obj: App.DocumentObject) -> bool:
        """Compute now, AutoUpdate or not; returns whether the mesh fits the properties then.

        What is being made beside is not wanted any more.
        """
        self.being_made = None
        self._forced, self.was_cancelled = True, False
        obj.touch()
        obj.Document.recompute()
        self._forced = False  # where a failing base kept the object from being executed
        return bool(obj.isValid()) and not self.was_cancelled

    def begin(self, obj: App.DocumentObject) -> Asked | None:
        """Ask for the mesh of the present values, AutoUpdate or not, without waiting for it.

        Whoever asks has it made and lets it `arrive`; until then a recompute leaves the infill as
        it is. Returns None where there is nothing to make: the mesh fits the values, or they make
        no sense, and the object is invalid.
        """
        self.being_made, self.was_cancelled = None, False
        self._forced = self._is_to_begin = True
        obj.touch()
        obj.Document.recompute()
        self._forced = self._is_to_begin = False
        return self.being_made

    def arrive(
        self,
        obj: App.DocumentObject,
        come: tuple[FilledMesh, Mesh.Mesh] | None,
        error: BaseException | None,
    ) -> bool:
        """Install what `begin` has asked for, or say why there is none.

        Where values have changed meanwhile the object stays touched. Returns whether the mesh is
        there.

        Args:
            obj: the infill.
            come: what has come, and FreeCAD's mesh of it (`infill_results.loaded`).
            error: why nothing has.
        """
        asked, self.being_made = self.being_made, None
        assert asked is not None
        self.was_cancelled, self._arrived = False, (asked, come, error)
        obj.touch()
        obj.Document.recompute()
        self._arrived = None
        if error is None and self.differs(obj, asked):
            obj.Status = CHANGED
            obj.touch()
        return bool(obj.isValid()) and error is None

    def onChanged(self, obj: App.DocumentObject, name: str) -> None:  # noqa: N802
        """Show the properties that apply now, and no others."""
        if name in CONTROLS and not wrong_types(obj) and not out_of_range(obj):
            show_applicable(obj)

    def inputs(self, obj: App.DocumentObject) -> tuple[TriangleMesh, LatticeSpec, StageCache]:
        """What the present mesh was made of: the solid, the specification, the stages' results.

        The solid lies as the mesh does before the object's Placement moves it.

        Raises:
            VolfrepError: the mesh does not fit the properties.
        """
        from volfrep.io.solid import check_solid
        from volfrep.util.errors import VolfrepError

        require_engine()
        spec, solid = self.read(obj)
        if not is_of(obj.Fingerprint, obj, spec, solid):
            raise VolfrepError(f"'{obj.Label}' is out of date: update it first.")
        spec = with_radius(spec, json.loads(obj.Report).get("target"))
        return check_solid(solid, obj.Base.Label), spec, self._cache

    def wanted(self, obj: App.DocumentObject) -> tuple[TriangleMesh, LatticeSpec, StageCache]:
        """As `inputs`, of the present properties: whether or not the mesh was made of them.

        Raises:
            VolfrepError: a property makes no sense, or there is no solid.
        """
        from volfrep.io.solid import check_solid

        require_engine()
        spec, solid = self.read(obj)
        return check_solid(solid, obj.Base.Label), spec, self._cache

    def onDocumentRestored(self, obj: App.DocumentObject) -> None:  # noqa: N802
        """Bring an object of an older file up to the present table of properties.

        A file that was written without windows has no view: it gets one where there are windows.
        What cannot be computed says so at once.
        """
        from volfrep.util.errors import VolfrepError

        ensure_properties(obj)
        try:
            refuse_spoiled(obj)
        except VolfrepError as error:
            obj.Status = str(error)
            App.Console.PrintWarning(f"VOLFREP, {obj.Label}: {error}\n")
        attach_view(obj)

    def dumps(self) -> None:
        """Nothing to save beside the properties."""

    def loads(self, state: Any) -> None:
        """Start with empty hands after a file was opened."""
        self._forget()

    __getstate__ = dumps  # FreeCAD 0.20
    __setstate__ = loads

    def _forget(self) -> None:
        self._forced = False
        self._reader: Any = None
        self._cache: Any = None
        self.made: Any = None
        self._is_to_begin, self._arrived = False, None
        self.being_made, self._beside = None, None
        self.was_cancelled = False

    def _run(self, obj: App.DocumentObject, forced: bool, beside: Screen | None) -> None:
        if self._arrived is not None:
            asked, come, error = self._arrived
            if error is not None:
                raise error
        elif self.being_made is not None and not (beside and self._is_stale(obj)):
            obj.Status = BEING_MADE
            return
        else:
            self.being_made = None
            asked = self._asked(obj, forced)
            if asked is None:
                return
            if self._is_to_begin or beside is not None:
                self.being_made, obj.Status = asked, BEING_MADE
                if beside is not None:
                    self._beside = asked
                    beside.update(obj, asked)
                return
            filled = run_job(asked.title, asked.call)
            come = filled, loaded(filled)
        install(obj, asked, *come)
        obj.Status = UP_TO_DATE

    def _is_stale(self, obj: App.DocumentObject) -> bool:
        """Whether a recompute has asked for what is being made, for values that have changed."""
        known = self.being_made
        return known is not None and known is self._beside and self.differs(obj, known)

    def _asked(self, obj: App.DocumentObject, forced: bool) -> Asked | None:
        """What is to be made now; None for nothing, and `Status` says why."""
        require_engine()
        from volfrep.design.forecast import forecast_fill
        from volfrep.jobs.pipeline import filled_mesh
        from volfrep.jobs.rough_radius import solve_target_roughly
        from volfrep.worker.engine_process import Call

        spec, solid = self.read(obj)
        fingerprint = fingerprint_of(obj, spec, solid)
        tell_driven(obj, "Density", spec.density)
        if is_of(obj.Fingerprint, obj, spec, solid) and obj.Mesh.CountFacets == obj.Triangles:
            obj.Fingerprint = fingerprint  # which was an earlier release's
            set_value(obj, "Mass", obj.Volume.Value * spec.density / 1000.0)
            obj.Status = UP_TO_DATE
            return None
        forecast = forecast_fill(solid, solve_target_roughly(solid, spec))
        obj.Expected = str(forecast)
        if not obj.AutoUpdate and not forced:
            obj.Status = OUT_OF_DATE
            return None
        if forecast.triangles > largest_automatic() and not forced:
            obj.Status = LARGE
            App.Console.PrintMessage(f"VOLFREP, {obj.Label}: {LARGE}; {forecast}\n")
            return None
        options = {"cache": self._cache, "show": triangles_drawn()}
        call = Call(filled_mesh, (solid, obj.Base.Label, spec), options)
        return Asked(spec, fingerprint, job_title("Filling {label}", obj.Base), call)

    def differs(self, obj: App.DocumentObject, asked: Asked) -> bool:
        """Whether the present values are others than those of a mesh that was asked for."""
        from volfrep.util.errors import VolfrepError

        try:
            spec, solid = self.read(obj)
        except VolfrepError:
            return True
        now = fingerprint_of(obj, spec, solid)
        return bool(spec.density != asked.spec.density or now != asked.fingerprint)

    def solid_identity(self, solid: TriangleMesh) -> tuple[Any, ...]:
        """What counts of the solid that `read` has returned last, for a digest."""
        identity: tuple[Any, ...] = self._reader.identity(solid)
        return identity

    def read(self, obj: App.DocumentObject) -> tuple[LatticeSpec, TriangleMesh]:
        """The specification and the solid of the present properties, not checked.

        Raises:
            VolfrepError: a property makes no sense, or there is no solid.
        """
        from freecad_volfrep.bridge.solids import SolidReader, parent_placement
        from volfrep.util.cache import StageCache
        from volfrep.util.errors import VolfrepError

        refuse_spoiled(obj)
        spec = specification_of(obj)
        if obj.Base is None:
            raise VolfrepError("There is no solid to fill: choose one as Base.")
        self._reader = self._reader or SolidReader()
        self._cache = self._cache or StageCache()
        return spec, self._reader.read(obj.Base, parent_placement(obj))


# Saved files find the class under this name, wherever the file it is written in moves to.
LatticeInfill.__module__ = saved_module("features")


def revive_infill(obj: App.DocumentObject) -> None:
    """Make a lattice infill of an object that has its properties, but has lost its proxy."""
    from volfrep.util.errors import VolfrepError

    LatticeInfill(obj)
    obj.Status = REVIVED
    try:
        refuse_spoiled(obj)
    except VolfrepError as error:
        obj.Status = str(error)
    revive_view(obj)
