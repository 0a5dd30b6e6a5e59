# SPDX-License-Identifier: LGPL-2.1-or-later
"""What every STEP file of ours has in common: ISO 10303-21 text, AP214, millimetres and radians."""

from __future__ import annotations

import datetime

import numpy as np
from numpy.typing import NDArray

#: A real number as STEP wants it: with a point, and a capital E where it has an exponent.
REAL = "%#.10G"
POINT = f"({REAL},{REAL},{REAL})"

#: The first number that is free after `opening`, and what it defines: the context that
#: representations refer to, and a placement that changes nothing.
FIRST_FREE = 30
CONTEXT = 10
PLACEMENT = 20
_PRODUCT_CONTEXT, _DEFINITION_CONTEXT = 3, 4

_OPENING = f"""ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('%s'),'2;1');
FILE_NAME('%s','%s',(''),(''),'VOLFREP','VOLFREP','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));
ENDSEC;
DATA;
#1=APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#2);
#2=APPLICATION_CONTEXT('core data for automotive mechanical design processes');
#{_PRODUCT_CONTEXT}=PRODUCT_CONTEXT('',#2,'mechanical');
#{_DEFINITION_CONTEXT}=PRODUCT_DEFINITION_CONTEXT('part definition',#2,'design');
#{CONTEXT}=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#14))\
GLOBAL_UNIT_ASSIGNED_CONTEXT((#11,#12,#13))REPRESENTATION_CONTEXT('',''));
#11=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));
#12=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));
#13=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());
#14=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#11,'distance_accuracy_value','');
#{PLACEMENT}=AXIS2_PLACEMENT_3D('',#21,#22,#23);
#21=CARTESIAN_POINT('',(0.,0.,0.));
#22=DIRECTION('',(0.,0.,1.));
#23=DIRECTION('',(1.,0.,0.));
"""
CLOSING = "ENDSEC;\nEND-ISO-10303-21;\n"


def opening(name: str, description: str) -> str:
    """The header and the entities below `FIRST_FREE`."""
    now = datetime.datetime.now().replace(microsecond=0).isoformat()
    return _OPENING % (quoted(description), quoted(name), now)


def product(first: int, name: str, representation: int) -> str:
    """Entities `first` to `first` + 4: a product of that name with that shape representation.

    `first` is its PRODUCT_DEFINITION, `first` + 1 its PRODUCT_DEFINITION_SHAPE.
    """
    name = quoted(name)
    return (
        f"#{first}=PRODUCT_DEFINITION('design','',#{first + 2},#{_DEFINITION_CONTEXT});\n"
        f"#{first + 1}=PRODUCT_DEFINITION_SHAPE('','',#{first});\n"
        f"#{first + 2}=PRODUCT_DEFINITION_FORMATION('','',#{first + 3});\n"
        f"#{first + 3}=PRODUCT('{name}','{name}','',(#{_PRODUCT_CONTEXT}));\n"
        f"#{first + 4}=SHAPE_DEFINITION_REPRESENTATION(#{first + 1},#{representation});\n"
    )


def quoted(text: str) -> str:
    """The text as the inside of a STEP string: apostrophes doubled, other alphabets encoded."""
    out = []
    for character in text:
        if " " <= character <= "~":
            out.append({"'": "''", "\\": "\\\\"}.get(character, character))
        else:
            out.append(f"\\X4\\{ord(character):08X}\\X0\\")
    return "".join(out)


def references(numbers: NDArray[np.int64]) -> str:
    """The entities of these numbers as a list without its brackets."""
    return ("#%d," * len(numbers))[:-1] % tuple(numbers.tolist())
