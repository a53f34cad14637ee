"""`autograder try`: what an instructor reads of a mechanism, of the kit or of one's own file."""

import textwrap

import pytest

from autograder.cli import main
from autograder.mechanisms import MECHANISMS
from autograder.mechanisms.file import mechanism_in
from autograder.mutation.answers import ANSWERS
from autograder.mutation.mistakes import mistakes_of
from autograder.mutation.trial import Line, Tried, nothing_to_ask, summary

OWN = """
    import sympy as sp
    from autograder.mechanisms import Coordinate, EnergyTerm, Mechanism, Parameter

    x = Coordinate("x", "m", "the spring loose")
    m = Parameter("m", "kg", "mass of the block", 0.5, 3.0)
    k = Parameter("k", "N/m", "stiffness of the spring", 5.0, 40.0)
    MECHANISM = Mechanism(
        "block",
        (x,),
        (m, k),
        (EnergyTerm("the motion of the block", m.symbol * x.velocity**2 / 2),),
        (EnergyTerm("the spring", k.symbol * x.symbol**2 / 2),),
        lambda q, arm: [(0.0, 0.0), (q[0], 0.0)],
    )
"""


def test_a_mechanism_of_ones_own(tmp_path, capsys):
    path = tmp_path / "block.py"
    path.write_text(textwrap.dedent(OWN), encoding="utf-8")
    assert main(["try", str(path), "--all"]) == 0
    shown = capsys.readouterr().out
    assert "block-M: the right answer is correct\n" in shown
    assert "In your g, the spring has the wrong sign" not in shown  # that is the sign of the whole
    assert "Your g is twice the right one. Is a ½ missing?" in shown


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x = 1", "needs MECHANISM = Mechanism(…), of autograder.mechanisms; it has none"),
        ("MECHANISM = 3", "it has 3"),
        ("import nothing_of_this_name", "ModuleNotFoundError: No module named"),
        (textwrap.dedent(OWN).replace('"m", "kg"', '"x", "kg"'), "two of its symbols are 'x'"),
    ],
)
def test_a_file_without_a_mechanism_says_so(tmp_path, capsys, text, said):
    path = tmp_path / "mine.py"
    path.write_text(text, encoding="utf-8")
    assert main(["try", str(path)]) == 2
    shown = capsys.readouterr().err
    assert "mine.py" in shown
    assert said in shown


def test_a_teachers_own_sentence_is_said(tmp_path, capsys):
    path = tmp_path / "block.py"
    own = """
        sentences={"M: dropped / *": "What moves when the spring moves?", "g_vec: nothing": "?"},
    )
"""
    text = textwrap.dedent(OWN)
    path.write_text(f"{text.rstrip()[:-1]}    {own.strip()}\n", encoding="utf-8")
    assert main(["try", str(path), "--asks", "M,g_vec", "--names"]) == 1
    shown = capsys.readouterr().out
    assert (
        "  What moves when the spring moves?\n      M: dropped / the motion of the block\n" in shown
    )
    assert "!   the sentence for 'g_vec: nothing' fits no mistake" in shown


def test_a_summary_stands_first_and_the_rest_in_a_file(tmp_path, capsys):
    """Few lines for hundreds of mistakes; the file has each."""
    path, to = tmp_path / "block.py", tmp_path / "all.txt"
    path.write_text(textwrap.dedent(OWN), encoding="utf-8")
    assert main(["try", str(path), "--asks", "M,g_vec,f", "--to", str(to)]) == 0
    shown = capsys.readouterr().out
    known = {a: mistakes_of(mechanism_in(path), a) for a in ("M", "g_vec", "f")}
    count = sum(map(len, known.values()))
    assert f"{count} mistakes in 3 answers; {count} are told apart and named" in shown
    assert "What is said most:\n" in shown
    assert f"All of it: {to}\n" in shown
    assert len(shown.splitlines()) < 45
    written = to.read_text(encoding="utf-8")
    for mistakes in known.values():
        for mistake in mistakes:
            assert f"  {mistake.sentence}\n" in written
    with pytest.raises(SystemExit) as refused:
        main(["try", str(path), "--asks", "M", "--to", str(tmp_path)])
    assert refused.value.code == 2
    assert "is no name of a file" in capsys.readouterr().err


def test_a_summary_tells_what_is_not_named():
    one = Tried("M", "dropped / the spring", "The spring is missing.", ("Something else.",))
    good = [Tried("M", f"no. {k}", "Said.", ("Said.",)) for k in range(4)]
    head, nameless, *rest = summary([one, *good])
    assert head == Line("5 mistakes in 1 answer; 4 are told apart and named by their own sentences")
    assert nameless == Line("  not named: M: dropped / the spring: Something else.", False)
    assert [line.text for line in rest][:2] == ["What is said most:", "     4 × Said."]
    many = [line for line in summary(25 * [one]) if not line.good]
    assert len(many) == 10
    assert Line("  and 15 more that are not named") in list(summary(25 * [one]))


def test_some_answers_alone(tmp_path, capsys):
    path = tmp_path / "block.py"
    path.write_text(textwrap.dedent(OWN), encoding="utf-8")
    assert main(["try", str(path), "--asks", "g_vec"]) == 0
    shown = capsys.readouterr().out
    assert "block-g_vec: the right answer is correct" in shown
    assert "block-M" not in shown
    assert "as SymPy's numbers: full points" in shown
    assert main(["try", str(path), "--asks", "g"]) == 2
    assert "there is no answer 'g'; known are M, C" in capsys.readouterr().err


def test_a_wrong_column_of_a_regressor_is_named():
    said = [m.sentence for m in mistakes_of(MECHANISMS["planar-2r-absolute"], "regressor")]
    assert not [sentence for sentence in said if "()" in sentence or " pi" in sentence]


@pytest.mark.parametrize("name", ["cart", "none.py"])
def test_a_name_of_nothing(capsys, name):
    assert main(["try", name]) == 2
    assert name in capsys.readouterr().err


@pytest.mark.parametrize(
    ("mechanism", "zero"),
    [
        ("pendulum", {"C", "M_dot"}),
        ("elastic-joint", {"C", "M_dot"}),
        ("cart-pole", set()),
        ("slider-crank", set()),
    ],
)
def test_what_is_0_for_every_motion_is_not_asked(mechanism, zero):
    why = {answer: nothing_to_ask(MECHANISMS[mechanism], answer) for answer in ANSWERS}
    assert {answer for answer in ANSWERS if why[answer]} == zero
    for answer in zero:
        assert f"of {mechanism} is 0 for every motion: ask for something else" in why[answer]
