"""The words of reports and pictures in English and Ukrainian, in the terms of ISO 1122-1 and of the seeds."""

from __future__ import annotations

from exporters.words_cams import BARREL_WORDS, CAM_FINDINGS, CAM_WORDS
from exporters.words_pins import PIN_FINDINGS, PIN_WORDS
from geometry.findings import Finding

WORDS: dict[str, tuple[str, str]] = {
    "tip_diameter": ("tip diameter d_a, mm", "діаметр вершин d_a, мм"),
    "reference_diameter": ("reference diameter d, mm", "ділильний діаметр d, мм"),
    "base_diameter": ("base diameter d_b, mm", "діаметр основного кола d_b, мм"),
    "root_form_diameter": ("root form diameter d_Ff, mm", "діаметр початку евольвенти d_Ff, мм"),
    "root_diameter": ("root diameter d_f, mm", "діаметр западин d_f, мм"),
    "pitch": ("pitch p, mm", "крок p, мм"),
    "tooth_thickness": ("tooth thickness s, mm", "товщина зуба S, мм"),
    "tip_tooth_thickness": ("tip tooth thickness s_a, mm", "товщина зуба на колі вершин S_a, мм"),
    "base_circle_diameter": ("base circle diameter 2 R_b, mm", "діаметр основного кола 2 R_min, мм"),
    "prime_circle_diameter": ("prime circle diameter 2 r_0, mm", "діаметр кола теоретичного профілю 2 r_0, мм"),
    "lift": ("lift H, mm", "хід штовхача H, мм"),
    "swing_deg": ("swing, deg", "розмах коромисла, град"),
    "start_angle_deg": ("lowest angle from the line of centres, deg", "найменший кут від лінії центрів, град"),
    "follower_radius": ("follower radius, mm", "радіус ролика, мм"),
    "yoke_breadth": ("breadth between faces or roller centres, mm", "відстань між гранями чи осями роликів, мм"),
    "yoke_breadth_error": (
        "greatest departure of S(phi) + S(phi + 180) from H, mm",
        "найбільше відхилення S(phi) + S(phi + 180) від H, мм",
    ),
    "travel": ("travel of the plate, mm", "хід плоского кулачка, мм"),
    "pressure_angle_deg": ("greatest pressure angle, deg", "найбільший кут тиску, град"),
    "roller_distance": ("distance of both rollers, mm", "відстань між роликами, мм"),
    "roller_angle_deg": ("angle between both arms, deg", "кут між плечима коромисла, град"),
    "outer_diameter": ("outer diameter, mm", "зовнішній діаметр, мм"),
    **BARREL_WORDS,
    "groove_width": ("groove width, mm", "ширина паза, мм"),
    "groove_depth": ("groove depth, mm", "глибина паза, мм"),
    "follower_offset": ("follower offset E, mm", "зміщення штовхача E, мм"),
    "pressure_angle_rise_deg": ("greatest pressure angle, rise, deg", "кут тиску, віддалення, град"),
    "pressure_angle_return_deg": ("greatest pressure angle, return, deg", "кут тиску, наближення, град"),
    "least_curvature_radius": ("least convex radius rho, mm", "найменший радіус кривини rho, мм"),
    "face_from": ("face contact from, mm", "контакт на тарілці від, мм"),
    "least_plate_diameter": ("least plate diameter, mm", "найменший діаметр тарілки, мм"),
    "face_to": ("face contact to, mm", "контакт на тарілці до, мм"),
    "length": ("length, mm", "довжина, мм"),
    "roller_diameter": ("roller diameter, mm", "діаметр ролика, мм"),
    "arm_length": ("arm length, mm", "довжина коромисла, мм"),
    "pivot_offset": ("pivot beside the cam's axis, mm", "зсув осі коромисла від осі кулачка, мм"),
    "start_height": ("height of the roller at 0 deg, mm", "висота осі ролика при 0 град, мм"),
    "largest_roller_diameter": ("largest roller (no undercut), mm", "найбільший ролик без підрізу, мм"),
    "inner_root_diameter": ("least root diameter, mm", "найменший діаметр западин, мм"),
    "outer_tip_diameter": ("greatest tip diameter, mm", "найбільший діаметр вершин, мм"),
    "module": ("module m, mm", "модуль m, мм"),
    "centre_distance_of_pair": ("centre distance a, mm", "міжосьова відстань a, мм"),
    "centrode_perimeter": ("perimeter of the centrode, mm", "довжина центроїди, мм"),
    "least_centrode_radius": ("least radius of the centrode, mm", "найменший радіус центроїди, мм"),
    "greatest_centrode_radius": ("greatest radius of the centrode, mm", "найбільший радіус центроїди, мм"),
    "least_curvature_radius_of_centrode": (
        "its least radius of curvature, mm",
        "її найменший радіус кривини, мм",
    ),
    "normal_pitch": ("normal pitch p_n, mm", "нормальний крок p_n, мм"),
    "lead": ("lead of the helix p_z, mm", "хід гвинтової лінії p_z, мм"),
    "cutter_number_of_teeth": ("teeth of the cutter z_0", "кількість зубів довбача z_0"),
    "cutter_addendum_coefficient": ("addendum of the cutter h_a0, modules", "висота головки довбача h_a0, модулів"),
    "cutter_tip_rounding_coefficient": ("tip rounding of the cutter, modules", "заокруглення довбача, модулів"),
    "file": ("file", "файл"),
    "error": ("max error, mm", "найбільша похибка, мм"),
    "tolerance": ("tolerance, mm", "допуск, мм"),
    "entities": ("entities", "об'єкти"),
    "size": ("kB", "кБ"),
    "check": ("read back", "перевірка"),
    "exact": ("exact", "точно"),
    "certified": ("certified", "доведено"),
    "sampled": ("sampled", "виміряно"),
    "good": ("ok", "гаразд"),
    "bad": ("FAILED", "ПОМИЛКА"),
    "skipped": ("not verified", "не перевірено"),
    "finding": ("note", "зауваження"),
    "preview": ("preview", "ескіз"),
    "clear": ("CLEAR", "ЗАЗОР"),
    "contact": ("CONTACT", "КОНТАКТ"),
    "overlap": ("OVERLAP", "ПЕРЕКРИТТЯ"),
    "undecided": ("UNDECIDED", "НЕ ВИЗНАЧЕНО"),
    "pair": (
        "pair {first} - {second}: a_w = {a_w:.5f} mm, alpha_w = {alpha_w:.4f} deg, contact ratio {ratio:.4f}",
        "пара {first} - {second}: a_w = {a_w:.5f} мм, alpha_w = {alpha_w:.4f} град, коефіцієнт перекриття {ratio:.4f}",
    ),
    "mate_cam_follower": (
        "{first} moves {second} by {travel:.6g} {unit}",
        "{first} рухає {second} на {travel:.6g} {unit}",
    ),
    "mate_conjugate_cams": (
        "{first} - {second}: conjugate cams, rollers {between_rollers:.9g} {unit} from each other",
        "{first} - {second}: спряжені кулачки, між роликами {between_rollers:.9g} {unit}",
    ),
    "mate_cam_yoke": (
        "{first} moves the yoke {second} by {lift:.6g} mm, breadth {yoke_breadth:.9g} mm",
        "{first} рухає рамку {second} на {lift:.6g} мм, відстань між гранями {yoke_breadth:.9g} мм",
    ),
    "mate_noncircular_gear_pair": (
        "pair {first} - {second}: a = {centre_distance:.5f} mm, ratio {least_ratio:.4f} to {greatest_ratio:.4f}, "
        "least contact ratio {least_contact_ratio:.4f}",
        "пара {first} - {second}: a = {centre_distance:.5f} мм, передаточне відношення від {least_ratio:.4f} до "
        "{greatest_ratio:.4f}, найменший коефіцієнт перекриття {least_contact_ratio:.4f}",
    ),
    "mate_fixed": ("{first} - {second}: fixed to each other", "{first} - {second}: нерухомо з'єднані"),
    "transmission_error": (
        "transmission error (peak to peak, first turns {sense}): {value:.3g} mm on the line of action, {motion}",
        "кінематична похибка (розмах, перше колесо обертається {sense}): {value:.3g} мм на лінії зачеплення, {motion}",
    ),
    "nothing_overlaps": ("no mates; no solids run into each other", "з'єднань немає; тіла не перетинаються"),
    "no_transmission": (
        "no transmission error: the teeth slip past each other",
        "кінематичної похибки немає: зуби прослизають повз одні одних",
    ),
    "counter_clockwise": ("counter-clockwise", "проти годинникової стрілки"),
    "clockwise": ("clockwise", "за годинниковою стрілкою"),
    "second_arcsec": ('{value:.3g}" of {second}', "{value:.3g}″ на {second}"),
    "second_travel": ("{value:.3g} mm of {second}", "{value:.3g} мм на {second}"),
    "total_ratio": (", total {total:.4f}", ", сумарний {total:.4f}"),
    "broken": ("BROKEN", "ПОРУШЕНО"),
    "height": (
        "{second} stands {value:.9g} mm above {first}, {required:.9g} mm is asked",
        "{second} стоїть на {value:.9g} мм вище за {first}, потрібно {required:.9g} мм",
    ),
    "centre_distance": (
        "the centres of {first} and {second} stand {value:.9g} mm apart, {required:.9g} mm is asked "
        "(within {tolerance:.2g} mm)",
        "відстань осей {first} і {second} дорівнює {value:.9g} мм, потрібно {required:.9g} мм "
        "(з точністю {tolerance:.2g} мм)",
    ),
    "rack_phase": (
        "{second} stands {value:.10g} mm along its way from where it meets {first} (within {tolerance:.2g} mm)",
        "{second} зсунуто на {value:.10g} мм від положення контакту з {first} (з точністю {tolerance:.2g} мм)",
    ),
    "phase": (
        "{second} stands turned by {value:.10g} deg, rotation_deg = {required:.10g} brings it into the spaces of "
        "{first} (within {tolerance:.2g} deg)",
        "{second} повернуто на {value:.10g} град, rotation_deg = {required:.10g} вводить його в западини {first} "
        "(з точністю {tolerance:.2g} град)",
    ),
    "common_face_width": (
        "{first} and {second} share {value:.6g} mm of their face width, more than {required:g} mm is asked",
        "спільна ширина вінців {first} і {second} дорівнює {value:.6g} мм, потрібно більше за {required:g} мм",
    ),
    "herringbone_height": (
        "the points of the herringbones of {second} stand {value:.6g} mm above those of {first} "
        "(within {tolerance:.2g} mm)",
        "вершини шевронів {second} стоять на {value:.6g} мм вище від вершин {first} (з точністю {tolerance:.2g} мм)",
    ),
    "train": (
        "the other mates turn {second} {value:.9g} times for one turn of {first}, this one {required:.9g} times: "
        "unlike numbers lock the train",
        "інші пари повертають {second} {value:.9g} разів за один оберт {first}, ця {required:.9g} разів: "
        "різні числа заклинюють передачу",
    ),
    "solids_undecided": (
        "{first} and {second}: a wall is too thin to tell whether the solids run into each other; thicken it",
        "{first} і {second}: стінка надто тонка, щоб визначити, чи перетинаються тіла; потовщіть її",
    ),
    "solids_overlap": (
        "{first} and {second} run into each other: {value:.4g} mm^3 in common as they stand",
        "{first} і {second} перетинаються: {value:.4g} мм^3 спільного об'єму",
    ),
    "interrupted": ("the teeth part on their way", "зуби розходяться на шляху"),
    "neighbours_close": (
        "{first} and {second} may touch: {value:.6g} mm apart, their tips reach {limit:.6g} mm, no mate joins them",
        "{first} і {second} можуть торкатися: між осями {value:.6g} мм, вершини сягають {limit:.6g} мм, "
        "пари між ними немає",
    ),
    "drive": ("drive {instance}: {train} turns", "привід {instance}: {train} обертів"),
    "gap": ("least gap {gap:.2g} mm", "найменший зазор {gap:.2g} мм"),
    "left_out": ("left out", "не зроблено"),
    **(PIN_WORDS | CAM_WORDS),
}

FINDINGS: dict[str, tuple[str, str]] = {
    "undercut": (
        "the tooth is undercut: profile shift {value:.4f} is below x_min = {limit:.4f}",
        "зуб підрізаний: зміщення {value:.4f} менше за x_min = {limit:.4f}",
    ),
    "undercut_on_centrode": (
        "teeth are undercut where the centrode's radius of curvature, {value:.4f} mm at least, is below {limit:.4f} mm",
        "зуби підрізані там, де радіус кривини центроїди (найменший {value:.4f} мм) менший за {limit:.4f} мм",
    ),
    "thin_tip": (
        "thin tip: s_a = {value:.3f} mm is below 0.3 m = {limit:.3f} mm",
        "загострення: S_a = {value:.3f} мм менше за 0,3 m = {limit:.3f} мм",
    ),
    "thin_rim": (
        "thin rim: {value:.3f} mm between bore and root circle, less than one module ({limit:.3f} mm)",
        "тонкий обід: {value:.3f} мм між отвором і колом западин, менше за модуль ({limit:.3f} мм)",
    ),
    "relief_not_reached": (
        "the tip circle ({value:.3f} mm) ends below the tip relief: no relief on this tooth",
        "коло вершин ({value:.3f} мм) нижче за фланк: фланкування не видно",
    ),
    "tip_lost": (
        "the offset makes the teeth pointed: {value:.4f} mm of the tip is lost",
        "після зсуву контуру зуби загострені: втрачено {value:.4f} мм висоти",
    ),
    "fillet_cusp_trimmed": (
        "the offset {value:.4f} mm is more than the fillet radius {limit:.4f} mm: its corner is trimmed",
        "зсув {value:.4f} мм більший за радіус перехідної кривої {limit:.4f} мм: кут обрізано",
    ),
    "space_shallowed": (
        "the offset flanks meet at radius {value:.4f} mm: the space ends above its root at {limit:.4f} mm",
        "зсунуті профілі сходяться на радіусі {value:.4f} мм: западина вища за свою основу {limit:.4f} мм",
    ),
    **{
        f"{code}_{who}": (en.format(en_who), uk.format(uk_who))
        for who, en_who, uk_who in (
            ("first", "first gear", "першого колеса"),
            ("second", "second gear", "другого колеса"),
        )
        for code, en, uk in (
            (
                "fillet_interference",
                "the mate's tip reaches the fillet of the {}: {{value:.4f}} mm, the involute begins at "
                "{{limit:.4f}} mm",
                "головка спряженого колеса впирається в галтель {}: {{value:.4f}} мм проти {{limit:.4f}} мм",
            ),
            (
                "active_flank_cut_away",
                "undercut has taken active flank of the {}: {{value:.4f}} mm is asked, {{limit:.4f}} mm is there",
                "підріз зняв робочу частину профілю {}: потрібно {{value:.4f}} мм, є {{limit:.4f}} мм",
            ),
            (
                "tip_clearance",
                "the tip of the {} strikes the mate's root: clearance {{value:.4f}} mm",
                "вершина {} торкається западини: зазор {{value:.4f}} мм",
            ),
        )
    },
    "contact_ratio": (
        "contact ratio {value:.4f} is below {limit:.1f}: the drive is interrupted",
        "коефіцієнт перекриття {value:.4f} менший за {limit:.1f}: зачеплення переривається",
    ),
    "transverse_contact_ratio": (
        "transverse contact ratio {value:.4f} is below 1: the drive runs on along the face, total contact ratio "
        "{limit:.4f}",
        "коефіцієнт торцевого перекриття {value:.4f} менший за 1: зачеплення триває завдяки осьовому перекриттю, "
        "сумарний коефіцієнт {limit:.4f}",
    ),
    "total_contact_ratio": (
        "total contact ratio {value:.4f} is below {limit:.1f}: the drive is interrupted",
        "сумарний коефіцієнт перекриття {value:.4f} менший за {limit:.1f}: зачеплення переривається",
    ),
    "normal_backlash": (
        "the flanks overlap: normal backlash {value:.6f} mm",
        "профілі перекриваються: бічний зазор {value:.6f} мм",
    ),
    **{
        f"{code}_{who}": (en.format(en_who), uk.format(uk_who))
        for who, en_who, uk_who in (
            ("pinion", "pinion", "шестерні"),
            ("ring", "ring", "вінця"),
            ("gear", "gear", "колеса"),
            ("rack", "rack", "рейки"),
        )
        for code, en, uk in (
            (
                "fillet_interference",
                "the mate's tip reaches the fillet of the {}: {{value:.4f}} mm, the involute ends at {{limit:.4f}} mm",
                "вершина спряженої деталі впирається в галтель {}: {{value:.4f}} мм проти {{limit:.4f}} мм",
            ),
            (
                "tip_clearance",
                "the mate's tip strikes the root of the {}: clearance {{value:.4f}} mm",
                "вершина спряженої деталі торкається западини {}: зазор {{value:.4f}} мм",
            ),
        )
    },
    "involute_interference": (
        "involute interference: the ring's flank begins at {value:.4f} mm, the pinion's involute at {limit:.4f} mm",
        "інтерференція евольвент: профіль вінця починається на {value:.4f} мм, евольвента шестерні на {limit:.4f} мм",
    ),
    "trochoid_interference": (
        "the tips of pinion and ring strike each other on their way out: {value:.4f} mm of arc, {limit:.4f} mm needed",
        "вершини шестерні і вінця зачіпаються на виході: {value:.4f} мм дуги замість {limit:.4f} мм",
    ),
    "radial_assembly": (
        "the pinion goes into the ring only along its axis: room {value:.4f} mm, {limit:.4f} mm needed",
        "шестерню можна вставити у вінець лише вздовж осі: місця {value:.4f} мм замість {limit:.4f} мм",
    ),
    "thin_ring_rim": (
        "thin rim: {value:.3f} mm outside the root circle, less than one module ({limit:.3f} mm)",
        "тонкий обід: {value:.3f} мм зовні кола западин, менше за модуль ({limit:.3f} мм)",
    ),
    "cutter_makes_root": (
        "basic_rack gives the addendum alone ({value:.4g} m): the cutter makes the root, diameter {limit:.4f} mm, and "
        "the fillet",
        "basic_rack задає лише висоту головки ({value:.4g} m): западину діаметром {limit:.4f} мм і перехідну криву "
        "утворює довбач",
    ),
    "ring_tip_limited": (
        "the ring's tips are made shallower: addendum {value:.4f} m, {limit:.4f} m would lie below the base circle or "
        "be trimmed by every cutter; tip_diameter overrides",
        "вершини вінця вкорочено: висота головки {value:.4f} m, бо {limit:.4f} m лежить під основним колом або "
        "зрізається кожним довбачем; tip_diameter задає іншу",
    ),
    "short_rack": (
        "the rack has {value:.0f} teeth: fewer than {limit:.0f}; the check knows nothing of its ends",
        "рейка має {value:.0f} зубців: менше за {limit:.0f}; перевірка не знає її країв",
    ),
    "offset_in_mesh": (
        "the outlines are moved out by {value:.4g} mm: gears in mesh lose {limit:.4g} mm of backlash, unchecked",
        "контури зсунуто назовні на {value:.4g} мм: пара втрачає {limit:.4g} мм зазору, чого перевірка не знає",
    ),
    "flat_outline": (
        "web, hub and face chamfers are not in a flat outline; STL, 3MF and STEP have them",
        "диск, маточина і фаски не входять у плоский контур; вони є в STL, 3MF і STEP",
    ),
    "rigid_impact": (
        "rigid impact: velocity jumps by {value:.4g} per rad at cam angle {limit:.4g} deg",
        "жорсткий удар: аналог швидкості стрибає на {value:.4g} при куті {limit:.4g} град",
    ),
    "soft_impact": (
        "soft impact: acceleration jumps by {value:.4g} per rad^2 at cam angle {limit:.4g} deg",
        "м'який удар: аналог прискорення стрибає на {value:.4g} при куті {limit:.4g} град",
    ),
    "steep_pressure_angle": (
        "pressure angle {value:.2f} deg on the rise, usual is at most {limit:.0f} deg",
        "кут тиску {value:.2f} град при віддаленні, допустимо {limit:.0f} град",
    ),
    "steep_return_pressure_angle": (
        "pressure angle {value:.2f} deg on the return, which the cam drives too; usual is at most {limit:.0f} deg",
        "кут тиску {value:.2f} град при наближенні, яке теж веде кулачок; допустимо {limit:.0f} град",
    ),
    "roller_play": (
        "the roller's play in its groove is {value:.4g} mm; with none it jams, above {limit:.4g} mm it knocks",
        "зазор ролика в пазу {value:.4g} мм; без зазору ролик заклинює, понад {limit:.4g} мм - стукає",
    ),
    "engraved_groove": (
        "the groove is {value:.4g} mm deep of {limit:.4g} mm: its walls stand on layer ENGRAVE, not cut through; "
        "groove_piece gives plates to glue",
        "паз має глибину {value:.4g} мм із {limit:.4g} мм: його стінки на шарі ENGRAVE, наскрізь їх не ріжуть; "
        "groove_piece дає пластини для склеювання",
    ),
    "wedge_rigid_impact": (
        "rigid impact: S' jumps by {value:.4g} at {limit:.4g} mm of travel",
        "жорсткий удар: аналог швидкості стрибає на {value:.4g} на {limit:.4g} мм шляху",
    ),
    "wedge_soft_impact": (
        "soft impact: S'' jumps by {value:.4g} per mm^2 at {limit:.4g} mm of travel",
        "м'який удар: аналог прискорення стрибає на {value:.4g} на {limit:.4g} мм шляху",
    ),
    "large_roller": (
        "roller radius {value:.4g} mm is above 0.8 of the least radius of the pitch curve ({limit:.4g} mm)",
        "радіус ролика {value:.4g} мм більший за 0,8 найменшого радіуса теоретичного профілю ({limit:.4g} мм)",
    ),
    "steep_groove": (
        "pressure angle {value:.2f} deg at the groove's floor, usual is at most {limit:.0f} deg",
        "кут тиску {value:.2f} град біля дна паза, допустимо {limit:.0f} град",
    ),
    "large_groove_roller": (
        "half the groove's width {value:.4g} mm is above 0.8 of the one that undercuts ({limit:.4g} mm)",
        "половина ширини паза {value:.4g} мм більша за 0,8 межі підрізу ({limit:.4g} мм)",
    ),
    "development": (
        "flat outline: the outer cylinder of {limit:.9g} mm unrolled, seen from outside, {value:.9g} mm around",
        "плоский контур: розгортка зовнішнього циліндра {limit:.9g} мм, вид ззовні, довжина кола {value:.9g} мм",
    ),
    "outline_trimmed": (
        "the outline moved by {limit:.4g} mm crosses itself in {value:.0f} places: it is trimmed there",
        "зсунутий на {limit:.4g} мм контур перетинає себе у {value:.0f} місцях: там його обрізано",
    ),
    "transverse_section": (
        "helical teeth, {value:.6g} degrees: a flat outline is their transverse section; STL, 3MF and STEP have the "
        "screw surfaces",
        "косі зуби, {value:.6g} град: плоский контур є торцевим перерізом; гвинтові поверхні є в STL, 3MF і STEP",
    ),
    "rolled_jumps": (
        "rolled over this file the follower's acceleration S'' jumps by {value:.3g} at joints of arcs or lines, its "
        "peak is {limit:.3g}: a drawing DXF or STEP has splines; a smaller tolerance makes the jumps smaller",
        "на цьому контурі аналог прискорення S'' стрибає на {value:.3g} у стиках дуг чи відрізків при найбільшому "
        "{limit:.3g}: креслення DXF і STEP мають сплайни; менший допуск зменшує стрибки",
    ),
    "coarse_tolerance": (
        "tolerance {value:.4g} mm is more than 5 % of the module ({limit:.4g} mm): the teeth lose their shape",
        "допуск {value:.4g} мм більший за 5 % модуля ({limit:.4g} мм): зуби втрачають форму",
    ),
    "short_edges": (
        "{value:.0f} edges are shorter than {limit:.3g} mm; merging them would break the tolerance",
        "{value:.0f} відрізків коротші за {limit:.3g} мм; їх з'єднання порушило б допуск",
    ),
    **PIN_FINDINGS,
    **CAM_FINDINGS,
}


def words(language: str, key: str) -> str:
    """A term in a language ("en" or "uk")."""
    return WORDS[key][1 if language == "uk" else 0]


def finding_text(language: str, finding: Finding) -> str:
    """A finding as a sentence."""
    return FINDINGS[finding.code][1 if language == "uk" else 0].format(value=finding.value, limit=finding.limit)
