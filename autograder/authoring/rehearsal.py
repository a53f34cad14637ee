"""Hands in a problem's own model answers, in ten styles, to the grader that grades the class."""

import copy
from collections.abc import Iterator, Mapping, Sequence

from nbformat import NotebookNode

from autograder.authoring.problem import notebook
from autograder.judging.verdict import State
from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.trial import nothing_to_ask
from autograder.notebook.beside import Beside
from autograder.notebook.grade import grade

# How students write the same right answer: code below it, which makes another function of it.
STYLES = {
    "as it is written": "",
    "as nested lists": "{name} = lambda *given: np.asarray(_right(*given)).tolist()",
    "as tuples": "def {name}(*given):\n"
    "    value = np.asarray(_right(*given)).tolist()\n"
    "    whole = lambda v: tuple(map(whole, v)) if isinstance(v, list) else v\n"
    "    return whole(value)",
    "in single precision": "def {name}(*given):\n    return np.float32(_right(*given))",
    "as an array of objects": "def {name}(*given):\n"
    "    return np.asarray(_right(*given), dtype=object)",
    "rounded in the last digits": "def {name}(*given):\n"
    "    return np.asarray(_right(*given)) * (1 + 1e-13)",
    "in an array that is used again": "_kept = {{}}\n\ndef {name}(*given):\n"
    "    value = np.asarray(_right(*given))\n"
    "    _kept.setdefault(value.shape, np.zeros(value.shape))[...] = value\n"
    "    return _kept[value.shape]",
    "column by column in memory": "def {name}(*given):\n"
    "    return np.asfortranarray(_right(*given))",
    "that cannot be written to": "def {name}(*given):\n"
    "    value = np.array(_right(*given))\n    value.setflags(write=False)\n    return value",
    "as SymPy's numbers": "import sympy\n\ndef {name}(*given):\n"
    "    return np.vectorize(sympy.Float, otypes=[object])(_right(*given))",
}


def rehearsed(
    mechanism: Mechanism, files: Mapping[str, str], asks: Sequence[str] = tuple(ANSWERS)
) -> Iterator[tuple[str, bool]]:
    """A line for each style: what it gets, and whether that is full credit.

    files: the mechanism's own file, name → text, as the grader finds it beside the source.
    """
    asked = [answer for answer in asks if not nothing_to_ask(mechanism, answer)]
    source = notebook(mechanism, asked)
    yield f"{mechanism.name}, its model answers handed in and graded:", True
    for style, code in STYLES.items():
        graded = grade(_handed_in(source, code), source, "rehearsal", Beside(mechanisms=files))
        lost = [str(v) for v in graded.verdicts.values() if v.state is not State.CORRECT]
        yield (
            "\n".join([f"  {style}: {'full points' if not lost else ''}", *lost]).rstrip(),
            not lost,
        )


def _handed_in(source: NotebookNode, code: str) -> NotebookNode:
    """The model answers as a student's, each function wrapped in the style's code."""
    answered = copy.deepcopy(source)
    for cell in answered.cells:
        grade_id = cell.metadata.get("nbgrader", {}).get("grade_id", "")
        if code and cell.cell_type == "code" and grade_id.startswith("answer-"):
            name = grade_id.removeprefix("answer-")
            asked = code.format(name=name).replace("_right", f"_right_{name}")
            cell.source += f"\n\n_right_{name} = {name}\n{asked.replace('_kept', f'_kept_{name}')}"
    return answered
