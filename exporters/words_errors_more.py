"""Further refusals in Ukrainian, one pattern a line; and the words that stand in the place of a value."""

from __future__ import annotations

import re

# what patterns take for a value though it is English; all in the genitive, as their Ukrainian texts need it
_NOUNS = {
    "the root": "кола западин", "the bore": "отвору", "the holes": "отворів", "the hub": "маточини",
    "the rim": "обода", "the tooth outline": "контуру зубців", "the ring": "кільця цівок",
    "the eccentric": "ексцентрика", "the lantern": "цівкового колеса", "the seats": "гнізд", "table": "таблиця",
    "the pins": "цівок", "the bottom": "дна", "the floor": "дна", "all of its lift": "весь хід",
    "all of the profile": "весь профіль",
    "a STEP file": "файл STEP", "a sheet": "аркуш", "a drawing": "креслення",
    "outer": "зовнішня", "inner": "внутрішня",
    "and need not fit the scene": "і може не відповідати сцені", "of the same scene": "тієї самої сцени",
    "swinging": "коромисловий", "translating": "поступальний", "nested too deeply": "вкладено надто глибоко",
    # what the reader of TOML says
    "Invalid value": "хибне значення", "Invalid statement": "хибний рядок", "Unclosed array": "незакритий список",
    "Unterminated string": "незакритий текст", "Cannot overwrite a value": "значення вже задано",
    "Expected '=' after a key in a key/value pair": "після ключа має стояти '='",
    "Expected newline or end of document after a statement": "після запису має кінчатися рядок",
    "Expected ']' at the end of a table declaration": "назва таблиці має кінчатися на ]",
    "Expected ']]' at the end of an array declaration": "назва таблиці має кінчатися на ]]",
    "Invalid initial character for a key part": "ключ починається хибним знаком",
    "Unclosed inline table": "незакрита таблиця", "Invalid date or datetime": "хибна дата",
    'Expected "\'" after a literal string': "незакритий текст",
}  # fmt: skip
_PIECES = (
    (r"(.*) (mm|rad|degrees) of lift", r"\1 {\2} ходу"),
    (r"(.*) of lift", r"\1 ходу"),
    (r"at (most|least) (\S+)", r"{\1} \2"),
    (r"at (most|least) (\S+) (mm|degrees)", r"{\1} \2 {\3}"),
    (r"Cannot declare (.*) twice", r"\1 оголошено двічі"),
    (r"Cannot mutate immutable namespace (.*)", r"\1 задано вже"),
    (r"Illegal character (.*)", r"недозволений знак \1"),
)
_SHORT = {"mm": "мм", "rad": "рад", "degrees": "град", "most": "щонайбільше", "least": "щонайменше"}
_JOINING = re.compile(r'("[^"]*")| (and|or|with) ')
_JOINS = {"and": "і", "or": "або", "with": "з"}


def value_in_ukrainian(value: str) -> str:
    """What stands in the place of a value: names, words and numbers as they are, the English around them not."""
    if value in _NOUNS:
        return _NOUNS[value]
    for pattern, text in _PIECES:
        if found := re.fullmatch(pattern, value):
            made = found.expand(text)
            return re.sub(r"\{(\w+)\}", lambda m: _SHORT[m[1]], made)
    return _JOINING.sub(lambda m: m[1] or f" {_JOINS[m[2]]} ", value)


# of keys whose range is no number: a refusal has nothing else to say
MEANINGS = {
    "colour in pictures, like #c08040": "колір на малюнках: # і шість цифр, як #c08040",
    "part of the file's name where two exports share an ending; letters, digits, _, -": (
        "частина імені файла: латинські літери, цифри, _ і -"
    ),
    "tells files of one part apart; default: the purpose": "розрізняє файли однієї деталі: латинські літери, цифри",
}

MORE = """
is a {}, not a {}|це {}, а не {}
the scene has no part of kind = {}|у сцені немає деталі з kind = {}
must lie inside the prime circle|має лежати в колі теоретичного профілю
the cone's apex stands above the floor|вершина конуса стоїть вище за дно
is wider than the frame|ширше за рамку
cuts into the stem|зрізає стержень
leaves no bar at the window's corner|не лишає планки в куті вікна
leaves no bar|не лишає планки
meets a pin|зачіпає палець
meets the slot|зачіпає проріз
a larger base circle of the cam works|підходить більше основне коло кулачка
closes the pin holes|закриває отвори пальців
has follower = {}|має follower = {}
a conjugate pair needs a roller|спареному кулачку потрібен ролик
is no cam of constant breadth: S(phi) + S(phi + 180) departs from H by {} mm|\
не є кулачком сталої ширини: S(φ) + S(φ + 180) відходить від H на {} мм
is no cam of constant breadth: its {} is {}|не є кулачком сталої ширини: його {} дорівнює {}
phases rise a, dwell 180 - a, return_ a, dwell 180 - a degrees with one law for both works|\
підходять фази rise a, dwell 180 - a, return_ a, dwell 180 - a град з одним законом
a translating cam, flat, or roller with follower_offset = 0, works|\
підходить кулачок з поступальним штовхачем: flat або roller з follower_offset = 0
the cam is undercut and loses {}|кулачок підрізаний і втрачає {}
the cam is undercut|кулачок підрізаний
the groove's {} wall is undercut and loses {}|{} стінка паза підрізана і втрачає {}
a smaller follower_radius, longer phases or a law without impacts work|\
підходить менший follower_radius, довші фази або закон без ударів
a smaller follower_radius or longer phases work|підходить менший follower_radius або довші фази
a larger base_circle_radius works|підходить більший base_circle_radius
is missing: one of {}, or { diagram = [...] }|відсутнє: одне з {} або {{ diagram = [...] }}
one of {} or table|одне з: {} або таблиця
one of diagram, first_half with second_half, conditions, poles, name|\
одне з: diagram, first_half з second_half, conditions, poles, name
one of {} works|підходить одне з: {}
has no law|не має закону
has diagram and {}|має diagram і {}
has {} and name|має {} і name
belongs to {}, not to {}|належить до {}, а не до {}
the same segments as in first_half work|підходять ті самі ділянки, що в first_half
{} has none; {} have|{} його не має; мають {}
{} have|мають {}
{} has none|{} його не має
(0, 0, 0) and (1, 0, 1) must be among them|серед них мають бути (0, 0, 0) і (1, 0, 1)
the groove would have a corner that no roller follows|паз мав би кут, якого ролик не пройде
sine or polynomial_345 works|підходить sine або polynomial_345
a smaller swing works|підходить менший розмах
a shorter arm_length or longer phases work|підходить менший arm_length або довші фази
{} works with a small roller|{} підходить з малим роликом
0 works with a small roller|0 підходить з малим роликом
at most {} mm works with a smaller bore|щонайбільше {} мм підходить з меншим отвором
the follower runs along with the plate at {} mm of travel|при {} мм ходу штовхач рухається разом з кулачком
a law without such jumps, or pointed, works|підходить закон без таких стрибків або pointed
with this law none is small enough|з цим законом не досить малого
one without jumps of velocity, or pointed, works|підходить закон без стрибків швидкості або pointed
at least 3 rows below 360 degrees are needed|потрібно щонайменше 3 рядки до 360 град
a motion table has no acceleration diagram of phases|таблиця руху не має діаграми прискорення за фазами
the follower rests all the turn|штовхач стоїть увесь оберт
mid-ordinates of its diagram raise nothing|середні ординати її діаграми нічого не піднімають
more intervals work|підходить більше інтервалів
{} has a rigid impact: its acceleration diagram is infinite there|{} має жорсткий удар: прискорення там нескінченне
the rocker turns as fast as the cam|коромисло обертається так швидко, як кулачок
longer phases work|підходять довші фази
has no {}|не має {}
has more phases than the tables of one paper hold|має більше фаз, ніж вміщують таблиці одного аркуша
leave it out of parts|не називайте його в parts
its table fits no paper|його таблиця не вміщується на жодному аркуші
a positive number works|підходить додатне число
draws {} only|креслить лише {}
name a pair of gears|назвіть пару коліс
is a {} mate|це пара {}
purpose = "cam" draws the cams that are here|наявні кулачки креслить purpose = "cam"
shifts are chosen for external and internal pairs only|зміщення вибираються лише для зовнішніх і внутрішніх пар
write {}.number_of_teeth=…|пишіть {}.number_of_teeth=…
pictures end in {}|малюнки мають закінчення {}
there is no such folder|такої теки немає
a folder stands where a file should go|на місці файла стоїть тека
its last build failed ({})|остання побудова не вдалася ({})
what lies here is of an earlier build {}|тут лежить файл давнішої побудови {}
leaves no jacket|не лишає розгортки
closes the groove|закриває паз
leaves no groove|не лишає паза
leaves no wall inside the groove|не лишає стінки всередині паза
undercuts the walls|підрізає стінки
leaves no whole profile|не лишає цілого профілю
leaves no whole outline with the other sizes|не лишає цілого контуру з іншими розмірами
change them|змініть їх
leaves nothing of the roller|не лишає нічого від ролика
leaves no outline|не лишає контуру
leaves no rim to the roots|не лишає обода до западин
leaves no rim|не лишає обода
leaves no body|не лишає тіла
leaves no wall about the bore|не лишає стінки навколо отвору
leaves no wall between the holes|не лишає стінки між отворами
leaves no lobes or no rim|не лишає виступів або обода
leaves no lobes|не лишає виступів
leaves no pins|не лишає цівок
leaves no pin|не лишає цівки
leaves no disc|не лишає диска
closes the valleys|закриває западини
leaves nothing in the valleys|нічого не лишає в западинах
thinner pins work|підходять тонші цівки
reaches the output holes|сягає вихідних отворів
the pins undercut the lobes: the path's least radius {} mm is not above the pin's {} mm|\
цівки підрізають виступи: найменший радіус траєкторії {} мм не більший за {} мм цівки
holes of {} mm (pin + 2 e + clearance) do not fit between bore and valleys|\
отвори {} мм (палець + 2 e + зазор) не вміщуються між отвором і западинами
holes of {} mm (pin + 2 e + clearance) do not fit|отвори {} мм (палець + 2 e + зазор) не вміщуються
a disc without output_holes works|підходить диск без output_holes
at most {} mm with {} works|підходить щонайбільше {} мм з {}
{} mm with {} works|підходить {} мм з {}
{} pins need one lobe fewer|{} цівкам потрібно на один виступ менше
the disc needs a round bore for the eccentric|диску потрібен круглий отвір для ексцентрика
has no output_holes|не має output_holes
give the disc that table|задайте диску цю таблицю
the disc has other holes|у диска інші отвори
has its pins already|цівки вже має
give it seats or holes|задайте гнізда або отвори
the lantern has others|у цівкового колеса їх інше число
does not go between the plates|не проходить між дисками
at most {} mm works with pin_clearance = 0 and root_clearance = 0|\
щонайбільше {} мм підходить з pin_clearance = 0 і root_clearance = 0
the tooth is pointed at {} mm|зуб загострюється на {} мм
the flank begins at {} mm|профіль починається на {} мм
closes the ring between its pins|закриває кільце між цівками
closes the seats of the pins|закриває гнізда цівок
closes the ring|закриває кільце
the pins reach the edge|цівки сягають краю
the seats touch each other|гнізда торкаються одне одного
pins of one piece have no seats|суцільні цівки не мають гнізд
reaches the holes of the pins|сягає отворів цівок
the bore's axis leaves the disc|вісь отвору виходить за диск
must be that of {}|має бути таким, як у {}
{} teeth of a lobe are pointed|{} зубців виступу загострені
is concave somewhere: a rack cannot roll on it|десь увігнута: рейка по ній не котиться
the rack's rounding leaves no fillet|заокруглення рейки не лишає перехідної кривої
no flank is left below the tip|під вершиною не лишається профілю
the fillets of both sides meet inside a tooth|перехідні криві обох боків сходяться всередині зуба
undercut leaves no flank below the tip|підріз не лишає профілю під вершиною
undercut leaves no flank that its fillet reaches|підріз не лишає профілю, якого сягає перехідна крива
turns the elliptic fillets back|вивертає еліптичні перехідні криві
passes the base circle at the ring's tips|переходить основне коло біля вершин вінця
the tips that the pair shortens keep no involute|вершини, вкорочені парою, не мають евольвенти
other shifts of both gears work|підходять інші зміщення обох коліс
give either it or {}|задайте або його, або {}
is missing: give it, or {}|відсутнє: задайте його або {}
give it, or {}|задайте його або {}
give either {} or {}|задайте або {}, або {}
is for oval and focal_ellipse|лише для oval і focal_ellipse
an ellipse about its focus has one|еліпс навколо фокуса має один
"oval" takes more|"oval" має більше
the ratio is not positive all round|передаточне відношення не всюди додатне
the centrode is concave, and no rack rolls on it|центроїда увігнута, рейка по ній не котиться
the centrode is concave|центроїда увігнута
{} teeth of the same centrode work with mate_number_of_teeth = {}|\
на тій самій центроїді підходить {} зубців з mate_number_of_teeth = {}
{} teeth of the same centrode work|на тій самій центроїді підходить {} зубців
a rounder centrode works|підходить округліша центроїда
two gears of one role mesh only where a tooth on the long radius meets a space on the short one (as of {} teeth)|\
два колеса однієї ролі зчіплюються, лише де зуб довгого радіуса стає в западину короткого (як при {} зубцях)
two gears of one role mesh only where a tooth on the long radius meets a space on the short one|\
два колеса однієї ролі зчіплюються, лише де зуб довгого радіуса стає в западину короткого
must fit its mate|має узгоджуватися зі спряженим колесом
is not of the same pair: centrode, its shape, module and numbers of teeth must be the first one's, {}|\
не з тієї самої пари: центроїда, її форма, модуль і числа зубців мають бути, як у першого, {}
at most {} turns work|підходить щонайбільше {} обертів
is more than half of the shorter side|більше за половину коротшого боку
is where it starts|там, де й початок
a hole of that diameter works|підходить отвір такого діаметра
reaches the edge or another hole|сягає краю або іншого отвору
leaves no edge between two corners|не лишає краю між двома кутами
leaves nothing of an arc|не лишає нічого від дуги
leaves nothing of an edge|не лишає нічого від краю
a boundary crosses itself|межа перетинає себе
two boundaries cross|дві межі перетинаються
the corners' roundings meet|заокруглення кутів сходяться
closes a hole|закриває отвір
closes a slot|закриває проріз
{} joins {}|{} з'єднує {}
only {} works|підходить лише {}
is not TOML: {} (at line {}, column {})|не є TOML: {} (рядок {}, стовпець {})
is not TOML: {} (at end of document)|не є TOML: {} (кінець файла)
is not TOML: {}|не є TOML: {}
pushes the web out of the rim|виштовхує диск з обода
the holes touch the bore|отвори торкаються отвору вала
the holes touch a window|отвори торкаються вікна
the windows touch the bore|вікна торкаються отвору вала
the bore reaches {}|отвір сягає {}
the windows reach {}|вікна сягають {}
the outlines touch or cross at this tolerance|контури при цьому допуску торкаються або перетинаються
its chords cross a thin wall of {}|його хорди перетинають тонку стінку {}
choose another place|оберіть інше місце
add {} or remove it|додайте {} або приберіть його
closes the tooth spaces or is larger than the fillets|закриває западини або більше за перехідні криві
closes the keyway|закриває шпонковий паз
at least {} values|щонайменше {} значень
{} values|{} значень
"""
