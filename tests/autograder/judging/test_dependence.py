"""On what an answer depends unlike the right one: found by calling it again, and true of it."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.judging.check import Check, Criterion
from autograder.judging.dependence import probes
from autograder.judging.quantities import each
from autograder.protocol import Call, Fault, FaultKind, Function, Reply, Symbol, real

NAMES = ("q[0]", "q[1]", "arm.m", "arm.l", "arm.d[0]", "arm.d[1]")


def parts(q, arm) -> list[float]:
    return [q[0], q[1], arm.m, arm.l, *arm.d]


def product(used):
    """A function of some of the arguments' numbers."""
    return lambda q, arm: np.array(
        1.0 + np.prod([np.sin(x) + 2 for x, name in zip(parts(q, arm), NAMES, strict=True)
                       if name in used])
    )  # fmt: skip


def calls(rng, count):
    return [
        Call("torque", (rng.uniform(-2, 2, 2), SimpleNamespace(
            m=rng.uniform(1, 2), l=rng.uniform(1, 2), d=rng.uniform(1, 2, 2)
        )))
        for _ in range(count)
    ]  # fmt: skip


def check(used, **changes) -> Check:
    fields = {
        "id": "x-torque",
        "signature": "torque(q, arm)",
        "reference": product(used),
        "calls": calls,
        "criteria": (Criterion("torque", "N·m"),),
    }
    return Check(**fields | changes)


def said(judging: Check, theirs) -> tuple[str, ...]:
    def ask(calls):
        return [Reply(value=np.asarray(theirs(*map(real, call.args)), float)) for call in calls]

    return judging.run(ask, np.random.default_rng(3)).diagnosis


subsets = st.sets(st.sampled_from(NAMES), min_size=1)


@given(subsets, subsets)
def test_what_is_said_is_so(needed, used):
    """An answer of some other numbers than the right one: these and no others are named."""
    (found,) = said(check(needed), lambda q, arm: 0.3 + product(used)(q, arm) ** 2) or ("",)
    of_arm = {name for name in needed if "." in name}
    if of_arm and not any("." in name for name in used):
        assert "do not depend on arm at all" in found
        return
    more, less = used - needed, needed - used
    named = {name for name in NAMES if name in found}
    assert named == more | less
    assert bool(found) == bool(more | less)
    for name in more:
        assert name in found.partition(" do not depend")[0]


def test_a_sign_alone_is_noticed():
    """As in Coulomb friction: a change of size would not show it."""
    judging = check({"q[0]"}, reference=lambda q, arm: np.sign(q[0]) + 2.0)
    (found,) = said(judging, lambda q, arm: arm.m * 0 + 2.5)
    assert found == "In your torque, the values do not depend on q[0]; the right ones do."


@pytest.mark.parametrize("side", [1, -1])
def test_what_an_answer_ignores_in_one_call_it_may_use_in_another(side):
    """As where a student cuts off the range in which the answer is right; the call that is tried is in
    it, or out of it."""
    right = product({"q[0]", "arm.m"})
    found = said(check({"q[0]", "arm.m"}), lambda q, arm: right(q, arm) * (side * q[0] > 0))
    assert not any("depend" in sentence for sentence in found)


def test_a_call_that_fails_leaves_nothing_to_say():
    asked = []

    def ask(calls):
        asked.append(len(calls))
        if len(asked) == 1:
            return [Reply(value=np.array(7.0)) for _ in calls]
        return [Reply(fault=Fault(FaultKind.RAISED, "ValueError"))]

    verdict = check({"q[0]"}).run(ask, np.random.default_rng(3))
    assert len(asked) == 3  # the same calls again, and those with one number changed
    assert (verdict.credit, verdict.diagnosis) == (0, ())


@pytest.mark.parametrize(
    "changes",
    [
        {"criteria": (Criterion("count"),)},
        {"criteria": (Criterion("torque", "N·m", is_property=True),)},
        {"criteria": (Criterion("torque", "N·m", otherwise="Look at it."),)},
        {"quantities": lambda calls, values: [(np.reshape(v, ()),) for v in values]},
    ],
    ids=["a count", "a property", "a sentence of its own", "calls that are compared"],
)
def test_where_nothing_is_tried(changes):
    found = said(check({"q[0]"}, **changes), lambda q, arm: q[1] ** 2)
    assert not any("depend" in sentence for sentence in found)


@pytest.mark.parametrize(
    "args",
    [
        (np.eye(2),),
        (Symbol("q"),),
        (Function("x", "[x]"),),
        (np.zeros(31),),
        (SimpleNamespace(l=(1.0, 2.0)),),
    ],
)
def test_arguments_that_are_not_tried(args):
    assert probes("torque(q)", Call("torque", args)) == []


def of_matrices(used) -> Check:
    """Judges a number of two matrices and a vector, by the names of those that count."""

    def right(A, v, robot):
        held = {"A": np.sum(A**2), "v[0]": v[0], "robot.I": np.trace(robot.I)}
        return np.array(1.0 + np.prod([np.sin(held[name]) + 2 for name in used]))

    def calls(rng, count):
        return [
            Call("x", (rng.normal(size=(2, 3)), rng.normal(size=2),
                       SimpleNamespace(I=rng.normal(size=(2, 2)))))
            for _ in range(count)
        ]  # fmt: skip

    return check((), signature="x(A, v, robot)", reference=right, calls=calls)


OF_MATRICES = ("A", "v[0]", "robot.I")


@given(st.sets(st.sampled_from(OF_MATRICES)), st.sets(st.sampled_from(OF_MATRICES)))
def test_a_matrix_is_one_argument(needed, used):
    judging, other = of_matrices(sorted(needed)), of_matrices(sorted(used)).reference
    found = " ".join(said(judging, lambda *args: 0.3 + other(*args) ** 2))
    before, _, after = found.partition(" do not depend")
    if "robot.I" in needed and "robot.I" not in used:
        assert "do not depend on robot at all" in found
    elif needed != used:
        extra, missing = ({name for name in OF_MATRICES if f" {name}" in text.replace(",", "")}
                          for text in (before, after))  # fmt: skip
        assert (extra, missing) == (used - needed, needed - used)
    else:
        assert "depend" not in found


def test_a_criterion_of_some_calls_is_asked_of_these():
    """The last call is another one's, and says nothing of what this one depends on."""

    @each
    def by_sign(call, value):
        nothing = np.empty(0)
        return (value, nothing) if call.args[0] > 0 else (nothing, value)

    judging = check(
        (),
        signature="x(a, b)",
        reference=lambda a, b: np.array(a * b),
        calls=lambda rng, count: [Call("x", (float(s), rng.uniform(1, 2))) for s in (3, 2, -1, -2)],
        criteria=(Criterion("forth", "N", 0.5), Criterion("back", "N", 0.5)),
        quantities=by_sign,
    )
    (found,) = said(judging, lambda a, b: a * b if a < 0 else a**2 + 7.5)
    assert found == "In your forth, the values do not depend on b; the right ones do."


def test_a_number_that_leads_to_another_criterion_is_no_part_of_an_error():
    """The velocity is 0 in all that the first criterion judges: it does not change what is off there."""

    @each
    def by_rest(call, value):
        nothing = np.empty(0)
        return (value, nothing) if call.args[1] == 0 else (nothing, value)

    judging = check(
        (),
        signature="x(a, v)",
        reference=lambda a, v: np.array(a + v),
        calls=lambda rng, count: [
            Call("x", (rng.uniform(1, 2), v)) for v in (0.0, 0.0, 0.0, *rng.uniform(1, 2, 3))
        ],
        criteria=(Criterion("rest", "N", 0.5), Criterion("motion", "N", 0.5)),
        quantities=by_rest,
    )
    assert said(judging, lambda a, v: a + v + 7.0) == (
        "What is off in your motion is the same whatever the arguments are. Which of your terms is a "
        "mere number?",
    )
    assert not [text for text in said(judging, lambda a, v: a + v + a**3) if "rest changes" in text]


def test_a_symmetric_positive_matrix_stays_one():
    (A,) = (probe.call.args[0] for probe in probes("x(A)", Call("x", (np.eye(3),)), True))
    np.testing.assert_array_equal(A, A.T)
    assert np.linalg.eigvalsh(A)[0] > 0


def test_the_argument_itself_is_left_as_it_is():
    (call,) = calls(np.random.default_rng(0), 1)
    before = real(call.args[1])
    tried = probes("torque(q, arm)", call)
    assert {probe.of for probe in tried} == set(NAMES)
    np.testing.assert_equal(vars(call.args[1]), vars(before))


def test_quantities_of_one_call_each_say_so():
    assert isinstance(each(lambda call, value: (value,)), each)


def test_of_many_numbers_a_few_are_named():
    def state_calls(rng, count):
        return [Call("rate", (rng.uniform(1, 2, 8),)) for _ in range(count)]

    judging = check(
        (),
        signature="rate(x)",
        reference=lambda x: np.array(x[0]),
        calls=state_calls,
        criteria=(Criterion("rate", "m/s"),),
    )
    (sentence,) = said(judging, lambda x: np.exp(np.sin(x).sum()))
    assert sentence == (
        "In your rate, the values depend on x[1], x[2], x[3] and 4 other numbers; the right ones do not."
    )


@pytest.mark.parametrize("weak", [1e-3, 3e-5, 9e-6, 1e-6, 1e-8])
@pytest.mark.parametrize("swapped", [False, True])
def test_a_weak_dependence_is_said_neither_way_where_the_other_has_it_too(weak, swapped):
    """As on the friction of a joint that creeps: near the limit one moves enough, and the other not."""

    def small(q, arm):
        return np.array(1.0 + weak * arm.m * q[0])

    def large(q, arm):
        return 20 * (small(q, arm) - 1.0) + 100.0

    right, theirs = (large, small) if swapped else (small, large)
    judging = check({"q[0]"}, reference=right, criteria=(Criterion("torque", "N·m"),))
    assert not [sentence for sentence in said(judging, theirs) if "depend" in sentence]
