# SPDX-License-Identifier: LGPL-2.1-or-later
"""A beam of cells or of a network and two analyses of it: what scripts about loads begin with."""

import FreeCAD as App
import ObjectsFem
from driving import look_at_all

OLD = App.Version()[0] == "0" and App.Version()[1] == "20"
TITANIUM = {
    "Name": "Ti-6Al-4V",
    "YoungsModulus": "110 GPa",
    "PoissonRatio": "0.34",
    "Density": "4410 kg/m^3",
    "YieldStrength": "903 MPa",
}


def loaded(size=(40, 20, 20), cell=10, shell=0.0, **values):
    """A document with a lattice beam, held at one end, and two analyses of it.

    Args:
        size: of the beam, mm.
        cell: edge of its cells, mm; the struts' radius is 0.08 of it.
        shell: the skin, mm.
        values: of the infill's properties, in place of these.
    """
    from freecad_volfrep import make_lattice_infill

    doc = App.newDocument("Sizing")
    doc.UndoMode = 1
    box = doc.addObject("Part::Box", "Beam")
    box.Length, box.Width, box.Height = size
    doc.recompute()
    usual = {"CellType": "BCC", "CellSize": cell, "StrutRadius": 0.08 * cell, "Resolution": 13}
    obj = make_lattice_infill(doc, box, **{**usual, "ShellThickness": shell, **values})
    doc.recompute()
    faces = {face.CenterOfMass.x: k + 1 for k, face in enumerate(box.Shape.Faces)}
    edges = enumerate(box.Shape.Edges, 1)
    along_z = next(k for k, edge in edges if abs(edge.tangentAt(0).z) > 0.99)
    for name, force in (("bend", 200.0), ("light", 80.0)):
        analysis = ObjectsFem.makeAnalysis(doc, name)
        material = ObjectsFem.makeMaterialSolid(doc, "Material")
        material.Material = TITANIUM
        held = ObjectsFem.makeConstraintFixed(doc, "Fixed")
        held.References = [(box, f"Face{faces[0.0]}")]
        push = ObjectsFem.makeConstraintForce(doc, "Force")
        push.References = [(box, f"Face{faces[float(size[0])]}")]
        push.Force = force if OLD else f"{force} N"
        push.Direction = (box, [f"Edge{along_z}"])
        for member in (material, held, push):
            analysis.addObject(member)
        doc.recompute()
        push.Reversed = push.DirectionVector.z > 0
        doc.recompute()
    box.Visibility = False
    for member in doc.Objects:
        if member.isDerivedFrom("Fem::Constraint"):
            member.ViewObject.Visibility = False
    look_at_all()
    return doc, obj
