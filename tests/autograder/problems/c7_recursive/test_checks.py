"""What only c7-recursive asks: chains in space, libraries that are robots, and exact counts."""

import inspect

import numpy as np
import pytest

from armdyn import Link, SerialChain
from autograder.judging.check import VISIBLE_CASES
from autograder.problems import CHECKS
from autograder.problems.c7_recursive import counting, libraries
from autograder.problems.c7_recursive.checks import ASKED, MAKERS
from autograder.problems.c7_recursive.library_mistakes import parts
from autograder.problems.c7_recursive.mistakes import EXAMPLE
from autograder.problems.c7_recursive.sign_mistakes import gravity_sign
from autograder.problems.c7_recursive.sweeps import Sweeps
from autograder.protocol import real
from tests.autograder.course_problems import problem
from tests.autograder.problems.c7_recursive.right import RIGHT
from tests.autograder.problems.c7_recursive.table import AT_JOINT, CROSS_C, CROSS_R, late
from tests.autograder.problems.c7_recursive.table import rnea as body_with
from tests.autograder.verdicts import judged, judged_in, namespace_of, sentences
from tests.submissions.answers import cell_of

PROBLEM = problem("c7-recursive")
STEP = 1e-5


def of_the_library(chain) -> SerialChain:
    links = [
        Link(
            "revolute",
            chain.m[k],
            com=tuple(chain.com[k]),
            inertia=tuple(map(tuple, chain.I[k])),
            axis=tuple(chain.axis[k]),
            translation=tuple(chain.offset[k]),
        )
        for k in range(len(chain.m))
    ]
    return SerialChain(links, gravity=tuple(chain.gravity), viscous=tuple(chain.viscous))


@pytest.mark.parametrize("seed", range(3))
def test_the_sweeps_agree_with_M_C_g_and_f_of_the_library(seed):
    """Not with its recursive algorithm, which could share a mistake; and bodies like these exist."""
    lengths = set()
    for call in CHECKS["c7-rnea"].calls(np.random.default_rng(seed), 24):
        q, qd, qdd, chain = call.args
        model = of_the_library(chain)
        u = model.M(q) @ qdd + model.C(q, qd) @ qd + model.g_vec(q) + model.f_vec(qd)
        np.testing.assert_allclose(Sweeps()(*call.args), u, rtol=1e-10, atol=1e-10)
        lengths.add(len(q))
    assert lengths == {2, 3, 4}


def test_many_chains_at_once_give_what_each_gives_alone():
    """Of different lengths, for the right sweeps and for every mistake."""
    calls = CHECKS["c7-rnea"].calls(np.random.default_rng(2), 12)[3::4]
    assert [len(call.args[0]) for call in calls] == [2, 3, 4]
    for mistake in CHECKS["c7-rnea"].mistakes:
        for call, u in zip(calls, mistake.wrong.for_calls(calls), strict=True):
            alone = mistake.wrong(*call.args)
            np.testing.assert_allclose(u, alone, rtol=1e-12, atol=1e-12, err_msg=mistake.name)


# Each is near a mistake, and is not it.
NEIGHBOURS = {
    "centripetal acceleration of the plane": body_with(CROSS_C, "-w**2 * c", CROSS_R, "-w**2 * r"),
    "turning of the axis with two kinds of axes": body_with("cross(w, z", "2 * cross(w, z"),
    "next joint from the centre": body_with("F.append(m * ac)", "a = ac / 2\n    F.append(m * ac)"),
    "centre as the arm of the whole force": body_with(
        "cross(chain.com[k], F", "cross(2 * chain.com[k], F"
    ),
    "joint carried by its own rates": late(f"a = R[k].T @ a + R[k] @ ({AT_JOINT})"),
    "length of the moment": body_with("chain.axis[k] @ t", "np.sum(np.abs(t))"),
}


@pytest.mark.parametrize("name", NEIGHBOURS)
def test_what_is_only_near_a_mistake_is_not_called_so(name):
    found = judged("c7-rnea", NEIGHBOURS[name]).diagnosis
    (sentence,) = sentences("c7-rnea", name)
    assert not [said for said in found if sentence in said]


def test_each_part_is_asked_for_by_itself():
    for place, call in enumerate(CHECKS["c7-rnea"].calls(np.random.default_rng(1), 12)):
        _, qd, qdd, chain = call.args
        asked = tuple(bool(np.any(x)) for x in (chain.gravity, qdd, qd))
        assert asked == ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1))[place % 4]


def christoffel_torque(M, q, qd):
    """C q̇ by derivatives of M alone, (n,)."""
    slopes = np.array(
        [(M(q + STEP * e) - M(q - STEP * e)) / (2 * STEP) for e in np.eye(len(q))]
    )  # ∂M/∂q_k
    return np.einsum("kij,j,k->i", slopes, qd, qd) - np.einsum("ijk,j,k->i", slopes, qd, qd) / 2


@pytest.mark.parametrize("make", MAKERS, ids=lambda make: make.__name__)
def test_each_library_is_a_robot(make):
    """M is positive definite, C q̇ follows from it, g is a gradient, friction takes energy."""
    for seed in range(20):
        rng = np.random.default_rng(seed)
        library = real(make(rng))
        n = 3 if make is libraries.with_wheel else 2
        q, qd = rng.uniform(-2, 2, (2, n))
        of = parts(library, q, qd)
        np.testing.assert_allclose(of.M, of.M.T, atol=1e-12)
        assert np.linalg.eigvalsh(of.M)[0] > 0

        def M(q, library=library, qd=qd):
            return parts(library, q, qd).M

        np.testing.assert_allclose(of.c, christoffel_torque(M, q, qd), rtol=0.02, atol=1e-2)
        slope = np.array(
            [
                parts(library, q + STEP * e, qd).g - parts(library, q - STEP * e, qd).g
                for e in np.eye(n)
            ]
        )
        np.testing.assert_allclose(slope, slope.T, atol=1e-9)
        assert qd @ of.f > 0


def test_gravity_that_pulls_down_is_held_upwards():
    for seed in range(20):
        for gravity, load in ASKED:
            library = real(libraries.column(np.random.default_rng(seed), gravity, load))
            assert gravity_sign(library) == gravity
            held = library(np.zeros(2), np.zeros(2), np.zeros(2))[1]
            assert np.sign(held) == (-gravity if load else gravity)


@pytest.mark.parametrize("constant", [-1, 0, 1])
def test_no_constant_is_a_sign(constant):
    namespace = {"gravity_sign": lambda library: constant}
    assert judged_in(namespace, "c7-gravity_sign", 0, VISIBLE_CASES).credit == 0


def test_a_number_that_is_no_sign_is_called_so():
    verdict = judged("c7-gravity_sign", "2 * np.sign(library(*np.zeros((3, 2)))[1])")
    assert verdict.credit == 0
    assert any("neither 1 nor" in sentence for sentence in verdict.diagnosis)


def test_the_notebook_counts_the_algorithms_that_the_check_counts(capsys):
    shown = cell_of(PROBLEM.source, "c7-two-ways").source
    for function in (counting.outwards, counting.direct, counting.sweeps):
        assert inspect.getsource(function).strip() in shown
    found = PROBLEM.namespace()
    printed = capsys.readouterr().out
    assert "Write" not in printed
    for n in (1, 2, 17):
        assert tuple(found["count"](n)) == counting.count(n)
    direct, sweeps = (
        line for line in printed.splitlines() if line.startswith(("direct:", "sweeps:"))
    )
    assert direct.partition(":")[2] == sweeps.partition(":")[2]
    assert "first program: -1" in printed
    assert "second program: -1" in printed


def test_the_notebooks_rotation_and_robot_are_those_of_a_chain_that_exists(capsys):
    found = PROBLEM.namespace()
    capsys.readouterr()
    model = of_the_library(EXAMPLE)
    q, qd, qdd = np.random.default_rng(5).normal(size=(3, 3))
    expected = model.inverse_dynamics(q, qd, qdd)
    np.testing.assert_allclose(found["rnea"](q, qd, qdd, found["robot"]), expected, rtol=1e-10)
    # On the floor joint 1 carries nothing; on the wall it does.
    assert abs(model.g_vec(q)[0]) < 1e-12


def test_the_counts_grow_as_the_card_says():
    direct, sweeps = np.transpose([counting.count(n) for n in (200, 400)])
    assert 3.9 < direct[1] / direct[0] < 4
    assert sweeps[1] == 2 * sweeps[0]
    assert counting.count(1)[0] < counting.count(1)[1]


def test_n_plus_3_calls_are_enough():
    """As the card says after a right answer."""
    for make, n in zip(MAKERS, (2, 2, 3), strict=True):
        library, asked = real(make(np.random.default_rng(1))), []

        def counted(*args, library=library, asked=asked):
            asked.append(args)
            return library(*args)

        body = namespace_of("c7-terms", RIGHT["c7-terms"][0])["terms"]
        body(counted, np.ones(n), np.ones(n))
        assert len(asked) == n + 3


def test_a_long_chain_stands_in_a_call_by_its_name():
    """Its inertias alone are 18 numbers."""
    verdict = judged("c7-rnea", body_with("return u", "return 2 * u"))
    assert verdict.witness.call == "rnea(q, qd, qdd, chain)"
    assert 'q, qd, qdd, chain = worst_case("c7-rnea")' in verdict.witness.given_by


def test_a_number_of_links_is_shown_as_a_whole_number():
    verdict = judged("c7-count", "0, 0")
    assert verdict.witness.call.removeprefix("count(").removesuffix(")").isdigit()
