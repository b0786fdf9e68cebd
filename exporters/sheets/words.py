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


SHEET_WORDS |= {
    **{
        f"cam_{kind}_{how}": (
            f"Synthesis of a cam mechanism with {en_how} {en} follower",
            f"Синтез кулачкового механізму з {uk_how}{uk} штовхачем",
        )
        for kind, en, uk in (
            ("pointed", "pointed", "загостреним"),
            ("roller", "roller", "роликовим"),
            ("mushroom", "mushroom", "грибковим"),
            ("flat", "flat", "плоским"),
        )
        for how, en_how, uk_how in (("slide", "a", ""), ("swing", "an oscillating", "коромисловим "))
    },
    **{
        f"cam_{kind}_linkage": (
            f"Synthesis of a cam mechanism with a {en} follower on a connecting rod",
            f"Синтез кулачкового механізму з {uk} штовхачем на шатуні",
        )
        for kind, en, uk in (
            ("pointed", "pointed", "загостреним"),
            ("roller", "roller", "роликовим"),
            ("mushroom", "mushroom", "грибковим"),
            ("flat", "flat", "плоским"),
        )
    },
    "cam_positions": (
        "Positions: connecting rod, O_{2}, pressure angles, profile, mm",
        "Положення: шатун, точка O_{2}, кути тиску, профіль, мм",
    ),
    "no_joint": (
        "No joint diagram: with the follower in general plane motion the cam's centre is part of the linkage.",
        "Сумісної діаграми немає: за плоскопаралельного руху штовхача центр кулачка заданий разом з механізмом.",
    ),
    "follower": ("linkage and follower", "ланки механізму і штовхач"),
    "cam_profile": ("Profile of the cam by inversion", "Побудова профілю кулачка"),
    "cam_joint": ("Least radius by the joint diagram", "Визначення мінімального радіуса кулачка"),
    "cam": ("actual profile", "практичний профіль кулачка"),
    "pitch_curve": ("path of the follower's centre", "теоретичний профіль кулачка"),
    "graphical": ("graphical method", "графічний метод"),
    "return_tangent": ("tangent of the return, for form closure", "дотична наближення (геом. замикання)"),
    "phase_rise": ("rise", "від"),
    "phase_return_": ("ret", "наб"),
    "phase_far": ("far", "д.в."),
    "phase_near": ("near", "б.в."),
    "lift_unit_0": ("mm", "мм"),
    "lift_unit_1": ("mm/rad", "мм/рад"),
    "lift_unit_2": ("mm/rad²", "мм/рад²"),
    "swing_unit_0": ("°", "°"),
    "swing_unit_1": ("°/rad", "°/рад"),
    "swing_unit_2": ("°/rad²", "°/рад²"),
    "scales": ("Scales, (4.1) - (4.4), (5.1) - (5.4)", "Масштаби, (4.1) - (4.4), (5.1) - (5.4)"),
    "scale_phi": ("scale of the cam angle", "масштаб кута повороту кулачка"),
    "scale_phi_deg": ("the same in degrees", "те саме в градусах"),
    "scale_0": ("scale of the follower's way", "масштаб переміщення штовхача"),
    "scale_1": ("scale of the velocity's analogue", "масштаб аналога швидкості штовхача"),
    "scale_2": ("scale of the acceleration's analogue", "масштаб аналога прискорення штовхача"),
    "pole_1": ("pole distance of the second integration", "полюсна відстань другого інтегрування"),
    "pole_2": ("pole distance of the first integration", "полюсна відстань першого інтегрування"),
    "scale_time": ("scale of time", "масштаб часу"),
    "scale_velocity": ("scale of the velocity", "масштаб швидкості штовхача"),
    "scale_acceleration": ("scale of the acceleration", "масштаб прискорення штовхача"),
    "scale_joint": ("scale of the joint diagram", "масштаб сумісної діаграми"),
    "scale_profile": ("scale of the profile", "масштаб побудови профілю"),
}


def sheet_words(language: str, key: str) -> str:
    """A term in a language ("en" or "uk")."""
    return SHEET_WORDS[key][1 if language == "uk" else 0]
