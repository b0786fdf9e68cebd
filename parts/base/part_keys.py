"""Keys that every part has: what it is made of, and how people call it, list it and buy it."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, Struct

Colour = Annotated[
    str, Meta(pattern=r"^#[0-9a-fA-F]{6}$", description="colour in pictures, like #c08040", examples=["#c08040"])
]
# in files of solids, of a part that has none of its own
USUAL_COLOUR = "#b8c4d0"
Material = Annotated[
    str,
    Meta(
        max_length=200,
        description="material; names and marks that `higherpair list` shows give the mass, any other needs density; "
        "its thickness is face_width, or that of a board",
        examples=["plywood 3 mm"],
    ),
]
Density = Annotated[
    float, Meta(gt=0, le=30, description="density for the mass", examples=[0.65], extra={"unit": "g/cm^3"})
]
Title = Annotated[
    str, Meta(pattern=r"\S", max_length=120, description="name for people, in any script", examples=["Pinion"])
]
# in one for all languages, or in each; msgspec 0.22 frees a pattern that stands beside a table twice: the process ends
# with a segmentation fault
Titles = (
    Annotated[
        str,
        Meta(min_length=1, max_length=120, description="name for people, in any script", examples=["Pinion"]),
    ]
    | Annotated[dict[str, Title], Meta(min_length=1)]
)
# of the parts list
Position = Annotated[int, Meta(ge=1, le=9999, description="number in the parts list", examples=[19])] | None
Designation = (
    Annotated[
        str, Meta(pattern=r"\S", max_length=60, description=("designation of its drawing"), examples=["ABC.01.00.19"])
    ]
    | None
)
Standard = (
    Annotated[
        str,
        Meta(
            pattern=r"\S",
            max_length=60,
            description="standard by which it is bought; boards and beds take it only where they name it",
            examples=["GOST 7805-70"],
        ),
    ]
    | None
)
LabelKey = (
    Annotated[
        bool,
        Meta(description="laser: its name, engraved in single strokes; default: on boards only", examples=[True]),
    ]
    | Annotated[str, Meta(pattern=r"\S", max_length=60, description="its words", examples=["z 21 m 4"])]
    | None
)


class MaterialKeys(Struct, forbid_unknown_fields=True, kw_only=True):
    """Keys of every part that is made of something; the chain goes on in ``parts/keys``."""

    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None
    title: Titles | None = None
    position: Position = None
    designation: Designation = None
    standard: Standard = None
    label: LabelKey = None
