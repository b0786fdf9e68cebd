"""Refusals in Ukrainian: a table of patterns over the English texts, piece by piece; what it lacks stays English.

A refusal is made of pieces with ``; `` between them: why, then what works. Keys, file names and numbers stay as typed.
"""

from __future__ import annotations

import re
import tomllib
from functools import cache
from pathlib import Path

from exporters.words_errors_more import MEANINGS, MORE, value_in_ukrainian
from parts.schema import SceneError

_DID_YOU_MEAN = re.compile(r" \(did you mean (.*?)\?\)")
# a key in front of a reason: another key is to blame than the one where it showed
_KEYED = re.compile(r"([a-z][a-z_]*(?:\.(?:item \d+|\w+))*): (.*)", re.DOTALL)
_WAY = {
    "at most": "щонайбільше", "at least": "щонайменше", "above": "більше за", "less than": "менше за",
    "more than": "більше за", "below": "менше за",
}  # fmt: skip
_UNITS = {"mm": "мм", "degrees": "град", "modules": "модулів", "g/cm^3": "г/см³", "rpm": "об/хв", "turns": "обертів"}
_OFFER = re.compile(
    r"(?:(at most|at least|above|below|less than|more than) )?([-\w.+]+|\"[^\"]*\"|\[.*\])(?: (mm|degrees|modules))?,? "
    r"(works|work|fits|does|do)"
)
_RANGE = re.compile(
    r"(?:(.*?): )?(?:(at least|above) (\S+?))?(?:, )?(?:(at most|below) (\S+?))?"
    r"(?: (mm|degrees|modules|g/cm\^3|rpm|turns))?"
)
_TYPES = {
    "a number": "числом", "a whole number": "цілим числом", "true or false": "true або false",
    "true, false or a table": "true, false або таблицею", "text in quotes": "текстом у лапках",
    "a number or a table": "числом або таблицею",
    "a list in brackets": "списком у дужках", "a table": "таблицею", "text or a table": "текстом або таблицею",
    "a table or a list of tables": "таблицею або списком таблиць",
}  # fmt: skip

# how scenes, calculations and files are written, in any of them; one pattern a line, {} stands for a value
_GENERAL = """
is missing|відсутнє
is missing: {}|відсутнє: {}
is missing: give {} and the same for the other gear|відсутнє: задайте {} і те саме для другого колеса
is missing: give {}|відсутнє: задайте {}
is missing: which part stands here? {}|відсутнє: яка деталь стоїть тут? {}
is missing: an oscillating follower needs it|відсутнє: потрібне коромисловому штовхачу
unknown key{}|невідомий ключ{}
unknown table{}|невідома таблиця{}
unknown kind{}|невідомий вид{}
unknown kind of mate{}|невідомий вид пари{}
unknown kind of pair{}|невідомий вид пари{}
unknown topic{}|невідома тема{}
unknown format|невідомий формат
no such part{}|такої деталі немає{}
no such gear{}|такого колеса немає{}
no such cam{}|такого кулачка немає{}
no such instance{}|такого екземпляра немає{}
no such file|такого файла немає
no such file or built-in scene{}|немає такого файла чи вбудованої сцени{}
no such file: it is a folder|такого файла немає: це тека
known keys: {}|відомі ключі: {}
known kinds: {}|відомі види: {}
known: {}|відомі: {}
kinds: {}|види: {}
topics: {}|теми: {}
formats: {}|формати: {}
parts: {}|деталі: {}
gears: {}|колеса: {}
cams: {}|кулачки: {}
instances: {}|екземпляри: {}
built-in: {}|вбудовані: {}
one of {}|одне з: {}
must be one of {}|має бути одним з: {}
must be a finite number|має бути скінченним числом
must be a finite number below 1e308|має бути скінченним числом, меншим за 1e308
must be a finite number above 0|має бути скінченним числом, більшим за 0
must be a finite number, at least 0|має бути скінченним числом, не меншим за 0
must be at least {}|має бути не менше за {}
must be above {}|має бути більше за {}
must be below {}|має бути менше за {}
must be above 0 and below 90 degrees|має бути більше за 0 і менше за 90 град
must be above 0 and at most {}, the addendum|має бути більше за 0 і не більше за {}, висоту головки
must be at least {} and at most {}|має бути від {} до {}
must be from {} to {}|має бути від {} до {}
must be from {} to {}, the number of mates|має бути від {} до {}, кількості пар
must be from {} to {}, the number of teeth|має бути від {} до {}, числа зубців
must be from {} to {}, the number of pairs of the scene|має бути від {} до {}, кількості пар сцени
must be positive|має бути додатним
write it as a table of keys|запишіть як таблицю ключів
write it as a table, {}|запишіть як таблицю, {}
write it as {}|запишіть як {}
write key=value, like {}|пишіть ключ=значення, наприклад {}
remove it|приберіть його
remove one of them|приберіть одне з них
remove one of both keys|приберіть один з двох ключів
rename it|перейменуйте
rename it, like {}|перейменуйте, наприклад {}
make it smaller|зменшіть
make it larger|збільште
change it|змініть
name another one|назвіть інше
name one of them|назвіть одне з них
add part=ID|додайте part=ID
add one|додайте
add one or remove it|додайте або приберіть його
give one of them another name|дайте одному з них інше ім'я
once is enough|одного разу досить
is listed twice|названо двічі
is given twice|задано двічі
is given already|задано вже
{} is given already|{} задано вже
one of them works|підходить одне з них
one scene is enough|досить однієї сцени
without it the pair works|без нього пара можлива
more works|підходить більше
give either {} or {}|задайте або {}, або {}
has {} gears: {}|має {} коліс: {}
has {} cams: {}|має {} кулачків: {}
needs {} too|потребує також {}
has no pair of gears|не має пари коліс
{} has a value already|{} вже має значення
only for {}, not {}|лише для {}, не для {}
only for {}|лише для {}
{} is for {}|{} призначено для {}
is a folder|це тека
give a scene file (.toml) or one of: {}|задайте файл сцени (.toml) або одну з: {}
is no scene|не є сценою
cannot be read: {}|не читається: {}
is not a path: {}|не є шляхом: {}
is not UTF-8 text (byte {})|не є текстом UTF-8 (байт {})
save it as UTF-8|збережіть як UTF-8
is not TOML: {}|не є TOML: {}
see {} for a start|для початку: {}
is larger than {} bytes|більше за {} байтів
not a scene file|не є файлом сцени
tables are nested too deeply|таблиці вкладено надто глибоко
a scene needs three levels|сцені досить трьох рівнів
a scene needs at least one part, like {}|сцені потрібна хоча б одна деталь, наприклад {}
the scene asks for no file|сцена не просить жодного файла
nothing to check|нема що перевіряти
add {}|додайте {}
add [[exports]] with format = {} (or {}), or use --format|додайте [[exports]] з format = {} (або {}) чи задайте --format
the file's name names the folder of the results|ім'я файла дає ім'я теці результатів
a part's name is made of letters, digits, _ and - (A to Z, at most 64)|\
ім'я деталі: латинські літери, цифри, _ і - (до 64)
an instance's name is made of letters, digits, _ and - (at most 64)|\
ім'я екземпляра: латинські літери, цифри, _ і - (до 64)
is a name that Windows keeps for a device|це ім'я Windows тримає для пристрою
differs from {} only in case: one file for both|відрізняється від {} лише великими літерами: один файл на двох
writes the same file as {}|пише той самий файл, що {}
an offset of half the kerf is the same|зсув на половину ширини різу - те саме
a print has no kerf|друк не має ширини різу
offset = {} moves every outline by as much|offset = {} зсуває контури на стільки ж
{} shows the part, not the cut|{} показує деталь, а не різ
{} has true splines|{} має справжні сплайни
{} is not for R12|{} не буває у R12
a sheet shows the exact profile|аркуш показує точний профіль
a picture of meshing shows a pair|картина зачеплення показує пару
use mate = {}|задайте mate = {}
shows pairs of involute gears only|показує лише пари евольвентних коліс
the roots reach the axis|западини сягають осі
too slender to compute|надто видовжений, щоб обчислити
is held, but other mates join it to {}, which turns in it|\
нерухомий, але інші пари з'єднують його з {}, що обертається в ньому
remove the one that does|приберіть ту, що з'єднує
turns the ring {}, which is held|обертає нерухомий вінець {}
drive {} or its eccentric, or remove this drive|приводьте {} або його ексцентрик, або приберіть цей привід
the mate closes where it has a whole number of lobes|друге колесо замикається, коли має ціле число виступів
a rounder centrode has one|округліша центроїда має таке
is not of the first gear's pair|не належить до пари першого колеса
the centrodes differ in shape (axis_ratio or eccentricity)|центроїди різної форми (axis_ratio або eccentricity)
is for pins = "solid"|лише для pins = "solid"
shows external gears|показує зовнішні колеса
is itself a part|сама є деталлю
name that one, or give the instance another id|назвіть її або дайте екземпляру інше ім'я
{} and {} stand in one place|{} і {} стоять на одному місці
turns nothing|нічого не обертає
1.0 is one turn|1.0 - один оберт
the part stands as {}|деталь стоїть як {}
the drive of {} turns it already|привід {} уже обертає його
is not placed yet|ще не поставлено
put this mate after {}, which places it|поставте цю пару після {}, яка його ставить
needs the CAD kernel to be read: {}|щоб прочитати, потрібне ядро САПР: {}
not named in {}|не названо у {}
it knows: {}|там відомі: {}
name the files in it|назвіть файли в ній
hold no file of a single part to measure|не містить файла окремої деталі для виміру
{}, too thin for the digits of a mesh file|{}, надто тонко для цифр файла сітки
make the wall thicker, or write STEP|зробіть стінку товщою або пишіть STEP
cannot be met: {}|недосяжний: {}
no mesh lies within {}|жодна сітка не лежить у межах {}
{} turns it into mesh|{} вводить його в зачеплення
remove it, or give `at` too: then the mate only checks|приберіть його або задайте й `at`: тоді пара лише перевіряє
is not placed, but {} is|не поставлено, а {} поставлено
swap first and second (direction_deg = {}), or give {}|поміняйте first і second (direction_deg = {}) або задайте {}
is not placed|не поставлено
begin its train at {}, which is, or give {}|почніть його ланцюг з {} або задайте {}
{} is itself a part|{} сама є деталлю
needs the CAD kernel: {}|потрібне ядро САПР: {}
is damaged ({})|пошкоджено ({})
build the scene again|побудуйте сцену знову
no {} beside it|поруч немає {}
build the scene again to get one|побудуйте сцену знову, щоб він був
write it with format = {}|запишіть з format = {}
names a part of a scene{}|називає деталь сцени{}
is chosen for external pairs only|вибирається лише для зовнішніх пар
would need {} edges|потребувало б {} відрізків
a mesh file stores 7 digits, at this size at least {} mm works|файл сітки має 7 цифр, за такого розміру від {} мм
"""


@cache
def _patterns() -> list[tuple[list[str], str]]:
    """The words between the values of every English pattern, with its Ukrainian text; those with most words first."""
    from exporters.words_errors_cams import OFFERS, PARTS
    from exporters.words_errors_linkage import LINKAGES
    from exporters.words_errors_parts import CAMS, GEARS

    lines = [
        line for text in (_GENERAL, GEARS, CAMS, LINKAGES, OFFERS, PARTS, MORE) for line in text.strip().splitlines()
    ]
    pairs = [line.split("|", 1) for line in lines]
    pairs.sort(key=lambda pair: -len(pair[0].replace("{}", "")))
    return [(en.split("{}"), uk) for en, uk in pairs]


def _values(words: list[str], text: str) -> list[str] | None:
    """What stands between words of a text that begins with the first and ends with the last of them.

    In one pass, each at its first place: a regular expression of as many gaps takes for ever on a long list of names.
    """
    first, *inner = words
    if not inner:
        return [] if text == first else None
    *inner, last = inner
    if not text.startswith(first) or not text.endswith(last) or len(text) < len(first) + len(last):
        return None
    found, at, end = [], len(first), len(text) - len(last)
    for word in inner:
        place = text.find(word, at, end)
        if place < 0:
            return None
        found.append(text[at:place])
        at = place + len(word)
    return [*found, text[at:end]]


def piece_in_ukrainian(piece: str) -> str | None:
    """One piece of a refusal; None where the table lacks it."""
    if piece in MEANINGS.values():
        return piece
    keyed = _KEYED.fullmatch(piece)
    if keyed and keyed[1] not in _UNITS and (rest := piece_in_ukrainian(keyed[2])) is not None:
        return f"{keyed[1]}: {rest}"
    for words, text in _patterns():
        if (values := _values(words, piece)) is not None:
            return text.format(*map(_inner, values))
    if offer := _OFFER.fullmatch(piece):
        way, value, unit, _ = offer.groups()
        words = ["підходить", _WAY[way] if way else "", value, _UNITS[unit] if unit else ""]
        return " ".join(filter(None, words))
    if together := re.fullmatch(r"with (.*) it works", piece):
        told = re.sub(r"(^|, )no ", r"\1без ", together[1])
        return f"підходить так: {told}"
    if kind := re.fullmatch(r"must be (.*)", piece):
        return f"має бути {_TYPES[kind[1]]}" if kind[1] in _TYPES else None
    if (found := _range_in_ukrainian(piece)) is not None:
        return found
    if works := re.fullmatch(r"(.*) works?", piece):
        return f"підходить {value_in_ukrainian(works[1])}"
    # a closed hole or a lost wall, and the part it belongs to
    if (whose := re.fullmatch(r"(.*) of ([\w-]+)", piece)) and (rest := piece_in_ukrainian(whose[1])) is not None:
        return f"{rest} ({whose[2]})"
    return _choices_in_ukrainian(piece.split(" or "))


def _choices_in_ukrainian(choices: list[str]) -> str | None:
    """Several kinds of value that a key takes; None where one of them is not known."""
    if len(choices) < 2:
        return None
    made = ["таблиця" if one == "table" else piece_in_ukrainian(one) for one in choices]
    known = [one for one in made if one is not None]
    return " або ".join(known) if len(known) == len(made) else None


def _inner(value: str) -> str:
    """What stands in the place of a value: a sentence of its own, or names and words."""
    sentence = piece_in_ukrainian(value) if re.search("[a-z]{2} [a-z0-9]", value) else None
    return value_in_ukrainian(value) if sentence is None else sentence


def _range_in_ukrainian(piece: str) -> str | None:
    """The range of a key; what the key means is left out: the key itself says it."""
    found = _RANGE.fullmatch(piece)
    if found is None or not (found[2] or found[4]):
        return None
    _, low, least, high, most, unit = found.groups()
    words = [f"{_WAY[low]} {least}" if low else "", f"{_WAY[high]} {most}" if high else ""]
    return ", ".join(filter(None, words)) + (f" {_UNITS.get(unit, unit)}" if unit else "")


def in_ukrainian(remedy: str) -> str:
    """The reason and remedy of a refusal, each piece that the table knows in Ukrainian."""
    if ": " in remedy or any(text in remedy for text in MEANINGS):
        from exporters.words_keys import without_meanings

        remedy = without_meanings(remedy)
    pieces = _DID_YOU_MEAN.sub(r" (можливо, \1?)", remedy).split("; ")
    made = [piece_in_ukrainian(piece) for piece in pieces]
    if None in made:
        from exporters.words_keys import without_meaning

        told = [without_meaning(p) if m is None else m for p, m in zip(pieces, made, strict=True)]
        made = [p if t is None else t for p, t in zip(pieces, told, strict=True)]
    return "; ".join(filter(None, made))


def refusal_line(error: SceneError, language: str) -> str:
    """A refusal as one line in a language ("en" or "uk")."""
    if language != "uk":
        return str(error)
    return str(SceneError(error.source, error.key, error.value, in_ukrainian(error.remedy)))


def language_of(address: str) -> str:
    """The language that a scene asks for, as far as it can be read; "en" where it cannot."""
    from parts.scene import built_in_scenes

    path = Path(address)
    try:
        path = built_in_scenes().get(address, path) if not path.is_file() else path
        raw = path.read_bytes()[:4_000_000]
    except (OSError, ValueError):
        return "en"
    try:
        asked = tomllib.loads(raw.decode("utf-8-sig")).get("scene", {}).get("language")
    except (ValueError, AttributeError, RecursionError):
        # what is no TOML may still say it
        asked = "uk" if re.search(rb"""(?m)^\s*language\s*=\s*["']uk["']""", raw) else "en"
    return "uk" if asked == "uk" else "en"
