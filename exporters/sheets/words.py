"""The words on sheets in English and Ukrainian, in the seeds' own terms."""

from __future__ import annotations

SHEET_WORDS: dict[str, tuple[str, str]] = {
    "external": ("Picture of external involute meshing", "Картина зовнішнього евольвентного зачеплення"),
    "internal": ("Picture of internal involute meshing", "Картина внутрішнього евольвентного зачеплення"),
    "rack": ("Picture of rack meshing", "Картина рейкового зачеплення"),
    "scale": ("scale", "масштаб"),
    "mate": ("{first} (1), {second} (2)", "{first} (1), {second} (2)"),
    "number_of_teeth": ("number of teeth", "число зубців"),
    "module": ("module", "модуль"),
    "shift": ("shift coefficient", "коефіцієнт зміщення"),
    "normal_module": ("normal module", "нормальний модуль"),
    "transverse_module": ("transverse module", "торцевий модуль"),
    "helix_angle": ("helix angle", "кут нахилу лінії зуба"),
    "normal_shift": ("normal shift coefficient", "нормальний коефіцієнт зміщення"),
    "face_width": ("common face width", "спільна ширина вінців"),
    "overlap": ("overlap ratio", "коефіцієнт осьового перекриття"),
    "transverse_section": ("transverse section", "торцевий переріз"),
    "centre_distance": ("centre distance", "міжосьова відстань"),
    "rack_distance": ("axis to datum line", "від осі до ділильної прямої"),
    "working_angle": ("working pressure angle", "кут зачеплення"),
    "line": ("line of action", "теоретична лінія зачеплення"),
    "active": ("active line of action", "практична лінія зачеплення"),
    "arc": ("arc of action", "дуга зачеплення"),
    "pitch": ("working pitch", "крок за початковим колом"),
    "ratio": ("contact ratio", "коефіцієнт перекриття"),
    "start": ("teeth at the start of contact", "зубці на початку зачеплення"),
    "end": ("teeth at the end of contact", "зубці в кінці зачеплення"),
    "flank": ("working flank", "робоча ділянка профілю"),
    "towards": ("to {name}", "до {name}"),
    "generating": (
        "Tooth profiles by the rack's successive positions, device TMM-42",
        "Утворення профілю зуба колеса за методом обкатки, прилад ТММ-42",
    ),
    "zero_wheel": ("zero wheel", "нульове колесо"),
    "shifted_wheel": ("shifted wheel", "колесо зі зміщенням"),
    "undercut": ("undercut", "підріз"),
    "off_sheet": ("base circle, off the sheet", "основне коло, поза аркушем"),
    "tip_line": ("tip line", "лінія вершин"),
    "working_line": ("working line", "початкова пряма"),
    "reference_line": ("datum line", "ділильна пряма"),
    "root_line": ("root line", "лінія западин"),
}


def sheet_words(language: str, key: str) -> str:
    """A term in a language ("en" or "uk")."""
    return SHEET_WORDS[key][1 if language == "uk" else 0]
