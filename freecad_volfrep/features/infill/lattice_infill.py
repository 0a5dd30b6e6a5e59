# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice infill: a mesh object that follows its base and its properties."""

from __future__ import annotations

import json
import traceback
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.jobs.job import Job, State
from freecad_volfrep.features.jobs.progress import job_title, run_call
from freecad_volfrep.features.jobs.screen import attach_view, is_asked_by_user, screen
from freecad_volfrep.features.properties.quantities import set_value
from freecad_volfrep.preferences import largest_automatic, triangles_drawn
from freecad_volfrep.saved_names import saved_module
from freecad_volfrep.sentences import report_line
from volfrep.util.errors import Cancelled, VolfrepError

from .applicable import CONTROLS, show_applicable
from .expressions import follow_expressions
from .freshness import fingerprint_of, is_of
from .infill_results import MeshJob, install, loaded, tell_driven, with_radius
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

    from freecad_volfrep.bridge.solids import SolidReader
    from volfrep import LatticeSpec
    from volfrep.design.forecast import Forecast
    from volfrep.io.solid import Solid
    from volfrep.jobs.pipeline import FilledMesh
    from volfrep.mesh.triangle_mesh import TriangleMesh
    from volfrep.util.cache import StageCache

    #: What a job comes to: what was expected, the mesh, and FreeCAD's of it; or no mesh, where it
    #: is larger than what is made unasked.
    Come = tuple[Forecast, FilledMesh | None, Mesh.Mesh | None]

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
    job: Job = Job()
    _reader: Any = None
    _cache: Any = None
    _error: BaseException | None = None
    _checked: tuple[str, Solid] | None = None

    def __init__(self, obj: App.DocumentObject) -> None:
        self._forget()
        obj.Proxy = self
        ensure_properties(obj)

    def execute(self, obj: App.DocumentObject) -> None:
        """Bring the mesh up to date; called by FreeCAD's recompute.

        In the window a recompute of the user's returns at once, and the mesh comes later; a
        script's waits for it. A cancelled job is no error: the last mesh stays, and `Status` says
        so. A mesh that arrives is in the document already.

        Raises:
            VolfrepError: one sentence; the object turns Invalid and its last mesh stays.
        """
        if is_spoiled(obj):
            ensure_properties(obj)
        job = self.job
        if job.state is State.ARRIVING:
            return
        window = screen() if is_asked_by_user() else None
        try:
            if self._error is not None:
                raise self._error
            if job.is_under_way and not (window and job.follows and self.differs(obj, job)):
                obj.Status = job.said
                return
            obj.Status = FAILED  # what stays if something fails that is not the input's fault
            self.job = self._job_of(obj, forced=False)
            if self.job.is_under_way and window is not None:
                self.job.follows, obj.Status = True, self.job.said
                window.update(obj, self.job)
            elif self.job.is_under_way:
                self._take(obj, self._made())
                self.job.go(State.IDLE)
        except Exception as error:
            self._end(obj, error)

    def update(self, obj: App.DocumentObject) -> bool:
        """Compute now, AutoUpdate or not; returns whether the mesh fits the properties then.

        What is being made in background is not wanted any more.
        """
        if self.begin(obj) is None:
            return bool(obj.isValid())
        try:
            come = self._made()
        except Exception as error:
            return self.arrive(obj, None, error)
        return self.arrive(obj, come, None)

    def begin(self, obj: App.DocumentObject) -> MeshJob | None:
        """Ask for the mesh of the present values, AutoUpdate or not, without waiting for it.

        Whoever asks has it made and lets it `arrive`; until then a recompute leaves the infill as
        it is. Returns None where there is nothing to make: the mesh fits the values, or they make
        no sense, and the object is invalid.
        """
        self.job = Job()
        sources = obj.OutListRecursive
        if any("Touched" in source.State for source in sources):
            obj.Document.recompute(sources)
        try:
            follow_expressions(obj)
            job = self._job_of(obj, forced=True)
        except Exception as error:
            self._fail(obj, error)
            return None
        is_base_wrong = any("Invalid" in source.State for source in sources)
        self.job = Job() if is_base_wrong else job
        if is_base_wrong or not obj.isValid():
            obj.touch()  # FreeCAD is to see that the values are good, or that the base is not
            obj.Document.recompute()
        else:
            obj.purgeTouched()
        if not self.job.is_under_way:
            return None
        obj.Status = job.said
        return job

    def arrive(
        self, obj: App.DocumentObject, come: Come | None, error: BaseException | None
    ) -> bool:
        """Install what `begin` has asked for, or say why there is none.

        Where values have changed meanwhile the object stays touched. Returns whether the mesh is
        there.

        Args:
            obj: the infill.
            come: what has come, and FreeCAD's mesh of it (`infill_results.loaded`).
            error: why nothing has.
        """
        job = self.job
        try:
            if error is not None:
                raise error
            assert come is not None
            self._take(obj, come)
        except Exception as failure:
            self._fail(obj, failure)
            return False
        if job.state is State.ARRIVING:
            obj.touch()  # it is valid again, and what depends on it follows
            obj.Document.recompute()
        job.go(State.IDLE)
        if self.differs(obj, job):
            obj.Status = CHANGED
            obj.touch()
        return bool(obj.isValid()) and come[1] is not None

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
        require_engine()
        spec, solid = self.read(obj)
        if not is_of(obj.Fingerprint, obj, spec, solid):
            raise VolfrepError(f"'{obj.Label}' is out of date: update it first.")
        spec = with_radius(spec, json.loads(obj.Report).get("target"))
        return self.checked(solid, obj.Base.Label), spec, self._cache

    def wanted(self, obj: App.DocumentObject) -> tuple[TriangleMesh, LatticeSpec, StageCache]:
        """As `inputs`, of the present properties: whether or not the mesh was made of them.

        Raises:
            VolfrepError: a property makes no sense, or there is no solid.
        """
        require_engine()
        spec, solid = self.read(obj)
        return self.checked(solid, obj.Base.Label), spec, self._cache

    def checked(self, mesh: TriangleMesh, name: str) -> Solid:
        """As `volfrep.io.solid.check_solid`, once for the same mesh; on any thread."""
        from volfrep.io.solid import check_solid
        from volfrep.util.content import digest_of

        key, known = digest_of(mesh.vertices, mesh.triangles, name), self._checked
        if known is None or known[0] != key:
            known = self._checked = key, check_solid(mesh, name)
        return known[1]

    @property
    def cache(self) -> StageCache:
        """The stages' results, once the solid was read."""
        return self._cache

    def take_reader(self, reader: SolidReader) -> None:
        """Read the base by what has read it already."""
        self._reader = reader

    def onDocumentRestored(self, obj: App.DocumentObject) -> None:  # noqa: N802
        """Bring an object of an older file up to the present table of properties.

        A file that was written without windows has no view: it gets one where there are windows.
        What cannot be computed says so at once.
        """
        ensure_properties(obj)
        try:
            refuse_spoiled(obj)
        except VolfrepError as error:
            obj.Status = str(error)
            App.Console.PrintWarning(report_line(obj.Label, str(error)))
        attach_view(obj)

    def dumps(self) -> None:
        """Nothing to save beside the properties."""

    def loads(self, state: Any) -> None:
        """Start with empty hands after a file was opened."""
        self._forget()

    __getstate__ = dumps  # FreeCAD 0.20
    __setstate__ = loads

    def _forget(self) -> None:
        self.job = Job()
        self._reader: Any = None
        self._cache: Any = None
        self._error = self._checked = None
        self.made: Any = None

    def _made(self) -> Come:
        """What the job comes to, waited for."""
        job = self.job
        job.go(State.RUNNING)
        forecast, filled = run_call(job.title, job.call)
        return forecast, filled, None if filled is None else loaded(filled)

    def _take(self, obj: App.DocumentObject, come: Come) -> None:
        """Take what has come into the document."""
        forecast, filled, mesh = come
        obj.Expected = str(forecast)
        if filled is not None:
            self.job.go(State.ARRIVING)
            install(obj, self.job, filled, mesh)
            obj.Status = UP_TO_DATE
        elif not obj.AutoUpdate:
            obj.Status = OUT_OF_DATE
        else:
            obj.Status = LARGE
            App.Console.PrintMessage(f"VOLFREP, {obj.Label}: {LARGE}; {forecast}\n")

    def _fail(self, obj: App.DocumentObject, error: Exception) -> None:
        """Say why there is no mesh; a recompute tells FreeCAD of what is no cancel."""
        if isinstance(error, Cancelled):
            self._end(obj, error)
            return
        if self.job.is_under_way:
            self.job.go(State.FAILED)
        self._error = error
        obj.touch()
        obj.Document.recompute()
        self._error = None

    def _end(self, obj: App.DocumentObject, error: Exception) -> None:
        """Say in `Status` why there is no mesh.

        Raises:
            VolfrepError: it was not cancelled.
        """
        is_cancelled = isinstance(error, Cancelled)
        if self.job.is_under_way:
            self.job.go(State.CANCELLED if is_cancelled else State.FAILED)
        if is_cancelled:
            obj.Status = CANCELLED if obj.Mesh.CountFacets else CANCELLED_FIRST
            App.Console.PrintMessage(report_line(obj.Label, obj.Status))
            return
        if isinstance(error, VolfrepError):
            message = str(error)
        elif isinstance(error, MemoryError):
            message = "Not enough memory: choose larger cells or a coarser deviation."
        else:  # whatever it is, the user gets a sentence and keeps the mesh
            text = "".join(traceback.format_exception(None, error, error.__traceback__))
            App.Console.PrintLog(f"VOLFREP, {obj.Label}:\n{text}\n")
            message = (
                f"The engine failed with a {type(error).__name__} ({error}), which is a defect of "
                "VOLFREP: please report it with the traceback in the report view's log messages."
            )
        obj.Status = message
        App.Console.PrintError(report_line(obj.Label, message))
        raise VolfrepError(message) from error

    def _job_of(self, obj: App.DocumentObject, forced: bool) -> Job:
        """The job of the mesh of the present values; an idle one where it is there."""
        require_engine()
        from volfrep.jobs.pipeline import forecast_and_fill
        from volfrep.process.worker import Call

        spec, solid = self.read(obj)
        fingerprint = fingerprint_of(obj, spec, solid)
        tell_driven(obj, "Density", spec.density)
        if is_of(obj.Fingerprint, obj, spec, solid) and obj.Mesh.CountFacets == obj.Triangles:
            obj.Fingerprint = fingerprint  # which was an earlier release's
            set_value(obj, "Mass", obj.Volume.Value * spec.density / 1000.0)
            obj.Status = UP_TO_DATE
            return Job()
        most = None if forced else largest_automatic() if obj.AutoUpdate else 0
        options = {"cache": self._cache, "show": triangles_drawn(), "most": most}
        call = Call(forecast_and_fill, (solid, obj.Base.Label, spec), options)
        said = BEING_MADE if forced or obj.AutoUpdate else OUT_OF_DATE
        return MeshJob(job_title("Filling {label}", obj.Base), call, spec, fingerprint, said)

    def differs(self, obj: App.DocumentObject, job: MeshJob) -> bool:
        """Whether the present values are others than those that a job makes a mesh of."""
        try:
            spec, solid = self.read(obj)
        except VolfrepError:
            return True
        now = fingerprint_of(obj, spec, solid)
        return bool(spec.density != job.spec.density or now != job.fingerprint)

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

        refuse_spoiled(obj)
        spec = specification_of(obj)
        if obj.Base is None:
            raise VolfrepError("There is no solid to fill: choose one as Base.")
        self._reader = self._reader or SolidReader()
        self._cache = self._cache or StageCache()
        return spec, self._reader.read(obj.Base, parent_placement(obj))


# Saved files find the class under this name, wherever the file it is written in moves to.
LatticeInfill.__module__ = saved_module("features")


def is_infill(obj: App.DocumentObject) -> bool:
    """Whether an object is a lattice infill."""
    return isinstance(getattr(obj, "Proxy", None), LatticeInfill)


def check_infill(obj: App.DocumentObject) -> None:
    """Refuse what is no lattice infill.

    Raises:
        VolfrepError: it is none.
    """
    if not is_infill(obj):
        raise VolfrepError(f"'{obj.Label}' is not a lattice infill: choose one.")


def say_revived(obj: App.DocumentObject) -> None:
    """Say that an infill has its proxy again, or what of its values is spoiled."""
    obj.Status = REVIVED
    try:
        refuse_spoiled(obj)
    except VolfrepError as error:
        obj.Status = str(error)
