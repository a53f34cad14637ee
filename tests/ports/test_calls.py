"""The public calls: what they refuse, and what reaches the programs."""

import numpy as np
import pytest

from armdyn import Planar2R, ports
from armdyn.derive import planar_chain
from armdyn.ports import calls, program
from armdyn.ports.toolchain import MissingToolError, Toolchain
from tests.ports.agreement import PLANAR_2R, RUBBING_2R

ARM = Planar2R(1, 0.8, 0.5, 0.3, 2, 1.5, 0.2, 0.1, g=9.0, viscous=(2, 1.5), coulomb=(0.3, 0.2))
FLAT = [1, 0.8, 0.5, 0.3, 2, 1.5, 0.2, 0.1, 9.0, 2, 1.5, 0.3, 0.2]
FREE = Planar2R(1, 0.8, 0.5, 0.3, 2, 1.5, 0.2, 0.1)
VALUES = dict(zip((s.name for s in planar_chain(2).parameters), range(1, 10), strict=True))


class Recorded:
    """A conversation that keeps the requests, and answers a number for each that is due."""

    def __init__(self):
        self.requests = []

    def ask(self, numbers, at_most):
        self.requests.append(np.array(numbers))
        return np.arange(at_most, dtype=float)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.closed = True


@pytest.fixture
def recorded(monkeypatch):
    conversation = Recorded()

    def start(language, derivation=None, *, seconds=60):
        conversation.started = language, derivation, seconds
        n, count = (2, 13) if derivation is None else (derivation.n, len(derivation.parameters))
        return program.Program(conversation, n, count)

    monkeypatch.setattr(calls, "start", start)
    return conversation


def test_a_request_is_rows_of_parameters_states_inputs(recorded):
    found = ports.run("cpp", ARM, np.arange(8.0).reshape(2, 4), [7, 8], seconds=3)
    (request,) = recorded.requests
    assert recorded.started == ("cpp", None, 3)
    assert recorded.closed
    assert request.tolist() == [0, *FLAT, 0, 1, 2, 3, 7, 8, *FLAT, 4, 5, 6, 7, 7, 8]
    # The answer: M, C by rows, g, f, P, q̈.
    assert found.M[1].tolist() == [[15, 16], [17, 18]]
    assert found.C[0].tolist() == [[4, 5], [6, 7]]
    assert found.g_vec[0].tolist() == [8, 9]
    assert found.f_vec[0].tolist() == [10, 11]
    assert found.potential_energy.tolist() == [12, 27]
    assert found.qdd[1].tolist() == [28, 29]


def test_without_inputs_there_are_none(recorded):
    ports.run("cpp", ARM, [1, 2, 3, 4])
    assert recorded.requests[0].tolist() == [0, *FLAT, 1, 2, 3, 4, 0, 0]


def test_a_derivation_takes_its_values_in_its_order(recorded):
    backwards = dict(reversed(VALUES.items()))
    ports.run("java", PLANAR_2R, np.zeros((2, 4)), values=[backwards, VALUES])
    (request,) = recorded.requests
    assert recorded.started == ("java", PLANAR_2R, 60)
    assert request[1:].reshape(2, -1)[:, :9].tolist() == [list(range(1, 10))] * 2


def test_generated_source_of_an_arm(recorded):
    ports.run("java", [FREE, FREE], np.zeros((2, 4)), generated=True)
    assert recorded.started[1] == PLANAR_2R
    assert recorded.requests[0][1:10].tolist() == [*FLAT[:8], 9.81]
    # One of them has friction: the program of the arm with friction speaks for both.
    ports.run("java", [FREE, ARM], np.zeros((2, 4)), generated=True)
    assert recorded.started[1] == RUBBING_2R
    assert recorded.requests[1][1:].reshape(2, -1)[:, :13].tolist() == [
        [*FLAT[:8], 9.81, 0, 0, 0, 0],
        FLAT,
    ]


def test_many_states_go_in_several_requests(recorded, monkeypatch):
    monkeypatch.setattr(program, "ROWS", 3)
    found = ports.run("cpp", ARM, np.arange(28.0).reshape(7, 4))
    rows = [r[1:].reshape(-1, 19)[:, 13:17] for r in recorded.requests]
    assert [len(r) for r in rows] == [3, 3, 1]
    assert np.concatenate(rows).ravel().tolist() == list(range(28))
    assert found.M[:, 0, 0].tolist() == [0, 15, 30, 0, 15, 30, 0]


def test_a_simulation_in_steps(recorded):
    t = np.linspace(2, 3, 5)
    found = ports.simulate("cpp", ARM, [1, 2, 3, 4], [5, 6], t, substeps=10, seconds=4)
    assert recorded.started == ("cpp", None, 4)
    assert recorded.requests[0].tolist() == [1, *FLAT, 1, 2, 3, 4, 5, 6, 0.025, 40, 10]
    assert found.tolist() == np.arange(20.0).reshape(5, 4).tolist()


def test_an_answer_of_another_size_is_an_error(recorded, monkeypatch):
    monkeypatch.setattr(recorded, "ask", lambda numbers, at_most: np.zeros(at_most - 1))
    with pytest.raises(ports.ProgramError, match="gave 14 numbers instead of 15"):
        ports.run("cpp", ARM, np.zeros(4))


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (("fortran", ARM, np.zeros(4)), {}, r"language = 'fortran': needs one of cpp, java, "),
        (("cpp", "arm", np.zeros(4)), {}, r"model = 'arm': needs a Planar2R, a sequence of them"),
        (("cpp", [], np.zeros(4)), {}, r"model = \[\]: needs a Planar2R"),
        (("cpp", [ARM, 1], np.zeros(4)), {}, r"model = \[.*: needs a Planar2R"),
        (("cpp", ARM, np.zeros(3)), {}, r"states: got shape \(3,\), needs .* \(\.\.\., 4\)"),
        (("cpp", ARM, [0, 0, 0, np.nan]), {}, r"states\[3\] = nan: needs finite"),
        (("cpp", ARM, np.zeros(4), [1, 2, 3]), {}, r"u: got shape \(3,\)"),
        (("cpp", [ARM] * 3, np.zeros((2, 4))), {}, r"\(3, 13\), \(2, 4\), \(2,\) need batch axes"),
        (("cpp", ARM, np.zeros(4)), {"values": VALUES}, "values: only a Derivation takes them"),
        (("cpp", PLANAR_2R, np.zeros(4)), {}, "values = None: needs a mapping of names"),
        (
            ("cpp", PLANAR_2R, np.zeros(4)),
            {"values": {"l1": 1}},
            "values: got l1; needs l1, l2, lc1, lc2, m1, m2, I1, I2, g",
        ),
        (
            ("cpp", PLANAR_2R, np.zeros(4)),
            {"values": VALUES | {"g": np.inf}},
            r"values\['g'\] = inf: needs one finite number",
        ),
    ],
)
def test_what_run_refuses(recorded, arguments, options, message):
    if arguments[0] == "fortran":
        with pytest.raises(ValueError, match=message):
            ports.missing("fortran")
        with pytest.raises(ValueError, match=message):
            ports.start("fortran")
        return
    with pytest.raises(ValueError, match=message):
        ports.run(*arguments, **options)
    assert recorded.requests == []


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"x0": np.zeros((2, 4))}, r"x0: got shape \(2, 4\), needs one arm's"),
        ({"x0": np.zeros(3)}, r"x0: got shape \(3,\)"),
        ({"u": np.zeros((2, 2))}, r"u: got shape \(2, 2\), needs one arm's"),
        ({"model": [ARM, ARM]}, r"parameters: got shape \(2, 13\), needs one arm's"),
        ({"t": 1.0}, r"t: got shape \(\), needs two or more increasing times"),
        ({"t": [1.0]}, r"t: got shape \(1,\)"),
        ({"t": [1.0, 1.0]}, r"t\[-1\] - t\[0\] = 0.0: must be greater than 0 s"),
        ({"t": [0.0, 1.0, 3.0]}, r"t\[1\] = 1.0: needs evenly spaced times, here 1.5"),
        ({"substeps": 0}, r"substeps = 0: needs a whole number, at least 1"),
        ({"substeps": 1.5}, r"substeps = 1.5: needs a whole number"),
        ({"substeps": True}, r"substeps = True: needs a whole number"),
    ],
)
def test_what_simulate_refuses(recorded, changed, message):
    arguments = {"model": ARM, "x0": np.zeros(4), "u": np.zeros(2), "t": [0.0, 1.0]} | changed
    with pytest.raises(ValueError, match=message):
        ports.simulate("cpp", **arguments)
    assert recorded.requests == []


def test_what_is_missing_is_told_in_one_line(monkeypatch):
    for variable in ("CXX", "ARMDYN_EIGEN", "ARMDYN_EJML"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setenv("PATH", "")
    for language in ("cpp", "java"):
        line = ports.missing(language)
        assert "apt install" in line
        with pytest.raises(MissingToolError) as error:
            ports.run(language, ARM, np.zeros(4))
        assert str(error.value) == line


def test_nothing_is_missing_where_all_is_found(monkeypatch):
    module = calls._MODULES["cpp"]
    monkeypatch.setattr(module, "toolchain", lambda: Toolchain((), ()))
    assert ports.missing("cpp") is None


def test_times_may_be_rounded():
    for start, end, count in ((0, 10, 10_001), (1e6, 1e6 + 1, 1001), (-5, -4, 7)):
        steps, spacing = program._even(np.linspace(start, end, count))
        assert steps == count - 1
        assert spacing == pytest.approx((end - start) / (count - 1), rel=1e-15)
    assert program._even(np.arange(0, 1, 1e-3))[0] == 999
