"""The words of cycloidal reducers, lanterns and pins in English and Ukrainian."""

from __future__ import annotations

PIN_WORDS: dict[str, tuple[str, str]] = {
    "transmission_of_involutes": (
        "no transmission error: it is computed for pairs of involute gears only",
        "кінематичної похибки немає: її обчислюють лише для пар евольвентних коліс",
    ),
    "pin_circle_diameter": ("pin circle diameter, mm", "діаметр кола цівок, мм"),
    "pitch_diameter": ("pitch diameter d_w, mm", "початковий діаметр d_w, мм"),
    "inner_diameter": ("inner diameter, mm", "внутрішній діаметр, мм"),
    "number_of_pins": ("number of pins N", "число цівок N"),
    "pin_diameter": ("pin diameter, mm", "діаметр цівки, мм"),
    "diameter": ("diameter, mm", "діаметр, мм"),
    "eccentricity": ("eccentricity e, mm", "ексцентриситет e, мм"),
    "reduction": ("reduction, ring held", "передавальне число при нерухомому вінці"),
    "shortening_coefficient": ("shortening coefficient e N / R", "коефіцієнт укорочення e N / R"),
    "least_path_radius": ("least radius of the pins' path, mm", "найменший радіус траєкторії цівки, мм"),
    "least_convex_curvature_radius": ("least convex radius of the lobes, mm", "найменший радіус кривини зубів, мм"),
    "pointed_tip_diameter": ("diameter at which the tip is pointed, mm", "діаметр загострення, мм"),
    "flank_start_diameter": ("diameter at which the flank begins, mm", "діаметр початку профілю, мм"),
    "lantern_contact_ratio": ("contact ratio", "коефіцієнт перекриття"),
    "mate_cycloidal_pair": (
        "{second} in {first}: reduction {reduction:.6g}, e = {eccentricity:.6g} mm, {pins_in_contact} pins touch, "
        "lost motion {lost_motion_deg:.4g} deg",
        "{second} у {first}: передавальне число {reduction:.6g}, e = {eccentricity:.6g} мм, цівок у контакті "
        "{pins_in_contact}, мертвий хід {lost_motion_deg:.4g} град",
    ),
    "mate_eccentric_bearing": (
        "{second} on {first}: e = {eccentricity:.6g} mm, bearing play {bearing_play:.4g} mm",
        "{second} на {first}: e = {eccentricity:.6g} мм, зазор у підшипнику {bearing_play:.4g} мм",
    ),
    "mate_output_pins": (
        "{second} in the holes of {first}: {output_pins} pins of {pin_diameter:.6g} mm in holes of "
        "{hole_diameter:.6g} mm",
        "{second} в отворах {first}: пальців {output_pins}, діаметри {pin_diameter:.6g} мм і {hole_diameter:.6g} мм",
    ),
    "mate_coaxial": ("{first} - {second}: on one axis", "{first} - {second}: на одній осі"),
    "mate_pin_seat": ("seated in {first}: {second}", "у гніздах {first}: {second}"),
    "mate_lantern_pair": (
        "lantern pair {first} - {second}: a_w = {working_centre_distance:.5f} mm, ratio {gear_ratio:.6g}, "
        "contact ratio {lantern_contact_ratio:.4f}",
        "цівкова пара {first} - {second}: a_w = {working_centre_distance:.5f} мм, передавальне число "
        "{gear_ratio:.6g}, коефіцієнт перекриття {lantern_contact_ratio:.4f}",
    ),
}

PIN_FINDINGS: dict[str, tuple[str, str]] = {
    "flat_pins": (
        "the pins of one piece are not in a flat outline, which has holes in their place; STL, 3MF and STEP have them",
        "суцільні пальці (цівки) не входять у плоский контур: на їхньому місці отвори; вони є в STL, 3MF і STEP",
    ),
    "cycloidal_near_cusp": (
        "the lobes are nearly sharp: least radius {value:.4f} mm is below a tenth of the pin's, {limit:.4f} mm; "
        "a smaller eccentricity or thinner pins round them",
        "зуби майже загострені: найменший радіус {value:.4f} мм менший за десяту частину радіуса цівки, "
        "{limit:.4f} мм; менший ексцентриситет або тонші цівки їх заокруглять",
    ),
    "lobes_reach_ring": (
        "the lobes reach the inside of the ring: inner_diameter is {value:.6g} mm, at least {limit:.6g} mm clears them",
        "зуби зачіпають вінець зсередини: inner_diameter {value:.6g} мм, потрібно щонайменше {limit:.6g} мм",
    ),
    "output_holes_small": (
        "the output pins jam in holes of {value:.6g} mm: pin + 2 e is {limit:.6g} mm; set the table's pin_diameter",
        "пальці заклинюють в отворах {value:.6g} мм: палець + 2 e = {limit:.6g} мм; задайте pin_diameter таблиці",
    ),
    "cycloidal_thin_wall": (
        "thin wall: {value:.3f} mm between holes and valleys, less than half of a pin's radius ({limit:.3f} mm)",
        "тонка стінка: {value:.3f} мм між отворами і западинами, менше за половину радіуса цівки ({limit:.3f} мм)",
    ),
}
