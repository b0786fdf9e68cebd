"""Every refusal is data with a sentence: no English where a code stands, no code without words, no number forgotten."""

from __future__ import annotations

import ast
import re
import string
from collections import Counter

from parts.base.reasons import SUBJECTS, reason, sentences
from parts.base.texts import Message
from tests.sources import told
from tests.test_architecture import product_files

# for those who call us with a key that is none: no scene leads there
NOT_TOLD = {"no_such_place"}


def faults(place: str, source: str) -> list[str]:
    """Codes written out in a file that are English, have no sentence or do not give it its numbers."""
    found: list[str] = []
    for call, code in told(source).refusals:
        where = f"{place}:{call.lineno}"
        pieces = (
            [v.value for v in code.values if isinstance(v, ast.Constant)] if isinstance(code, ast.JoinedStr) else []
        )
        if any(" " in str(piece) for piece in pieces):
            found.append(f"{where}: a sentence in place of a code")
        if not isinstance(code, ast.Constant) or not isinstance(code.value, str) or code.value in NOT_TOLD:
            continue
        words = reason(code.value)
        text = words.msgid if isinstance(words, Message) else words
        if text == code.value:
            found.append(f"{where}: {code.value} has no sentence")
        given = {word.arg for word in call.keywords}
        asked = {name for _, name, _, _ in string.Formatter().parse(text) if name}
        if None not in given and asked - given:
            found.append(f"{where}: {code.value} lacks {', '.join(sorted(asked - given))}")
    return found


def test_every_code_has_its_sentence_with_its_numbers() -> None:
    assert [f for place, file in product_files().items() for f in faults(place, file.read_text("utf-8"))] == []


def test_no_code_has_two_sentences() -> None:
    codes = Counter(code for subject in SUBJECTS for code in sentences(subject))
    assert [code for code, times in codes.items() if times > 1] == []


def test_no_sentence_has_two_codes() -> None:
    """What says the same is one refusal; ``_nearly`` is put together from the code of what is touched."""
    first = {str(text): code for subject in SUBJECTS for code, text in sentences(subject).items()}
    codes = [code for subject in SUBJECTS for code in sentences(subject) if not code.endswith("_nearly")]
    assert sorted(set(codes) - set(first.values())) == []


def test_a_fault_is_noticed() -> None:
    wrong = (
        'SceneError(source, key, 1, "must be above 0; 3 works")',
        'SceneError(source, key, 1, f"at most {most} works")',
        'ParameterError("module", 1, "nobody_has_said_this")',
        'SceneError(source, key, 1, "not_one_of", None)',
        'ParameterError.beyond("module", 1.0, "nobody_has_said_this", 2.0)',
    )
    assert [len(faults("x.py", line)) for line in wrong] == [1, 1, 1, 1, 1]
    assert faults("x.py", 'SceneError(source, key, 1, "not_one_of", None, known=[2])') == []
    assert faults("x.py", 'SceneError(source, key, 1, "not_one_of", None, "", **numbers)') == []


# codes that are put together: a beginning or an end that others complete
COMPOSED = re.compile(
    r"chamfer_(higher_than|leaves_nothing_of)_|_nearly$|^(within|reaches|cutter|space|not_that_of|no_working_angle_with)_"
)


def test_every_sentence_has_its_code() -> None:
    written = {c for file in product_files().values() for c in re.findall(r'"(\w+)(?=")', file.read_text("utf-8"))}
    codes = [c for subject in SUBJECTS for c in sentences(subject)]
    assert [c for c in codes if c not in written and not COMPOSED.search(c)] == []


def test_a_reason_says_what_is_wrong_and_not_what_would_work() -> None:
    """What would work is data; its words are the same for every refusal."""
    for subject in SUBJECTS:
        for code, text in sentences(subject).items():
            one = text.msgid if isinstance(text, Message) else text
            assert not re.search(r"\bworks?$|; at (most|least) \{", one), code
            assert not one.endswith("."), code


def reading(source: str) -> list[str]:
    """Lines that search, cut or compare a sentence of ours: what is needed of it stands in its data."""
    pattern = re.compile(r"\.(remedy|allowed)\b|str\((error|refusal|refused)\)\.|\bin str\((error|refusal|refused)\)")
    return [line.strip() for line in source.splitlines() if pattern.search(line)]


def test_nobody_reads_a_sentence_of_ours() -> None:
    assert [f"{p}: {line}" for p, file in product_files().items() for line in reading(file.read_text("utf-8"))] == []
    assert reading('if "works" in refusal.allowed:')
    assert reading('reason = str(error).partition(";")[0]')
