"""Generated C++, Java, MATLAB and Wolfram source: it runs, and it says what the derivation says."""

import re
from functools import cache

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from sympy.parsing.mathematica import parse_mathematica

from armdyn import ports
from armdyn.codegen.cpp import cpp
from armdyn.codegen.java import java
from armdyn.codegen.matlab import matlab
from armdyn.codegen.wolfram import wolfram
from armdyn.derive import Derivation, from_energies, planar_chain
from armdyn.ports.toolchain import TOOLCHAINS, build
from tests.armdyn.arms import a_few, between, inertias, lengths, masses, offsets, vectors

UNDERFLOW = 1e-300
PARAMETERS = {"l": lengths, "lc": offsets, "ly": offsets, "m": masses, "M": masses}
PARAMETERS |= {"I": inertias, "g": between(0, 20), "k": between(0, 20)}


def cart_pole():
    """In names that something has taken: the functions and their arguments, Wolfram's I."""
    x, q, u, qd = sp.symbols("x q u qd", real=True)
    M, I, m, lc, g, k = sp.symbols("M I m lc g k_1")
    K = (M + m) * u**2 / 2 + m * lc * sp.cos(q) * u * qd + (I + m * lc**2) * qd**2 / 2
    return from_energies(K, m * g * lc * sp.cos(q) + k * x**2 / 2, [x, q], [u, qd])


def pendulum():
    """One coordinate: M is a matrix with one entry, not a number and not a vector."""
    q, qd, m, lc, I, g = sp.symbols("q qd m lc I g", real=True)
    return from_energies(I * qd**2 / 2, m * g * lc * (1 - sp.cos(q)), [q], [qd])


def ten():
    """Not physical: indices of two digits, M1x10 beside M1x1."""
    n = 10
    q, v = sp.symbols(f"q1:{n + 1}", real=True), sp.symbols(f"qd1:{n + 1}", real=True)
    g, k = sp.symbols("g k", positive=True)
    M = sp.ImmutableMatrix(n, n, lambda i, j: sp.cos(q[i] - q[j]) + 2 * n * (i == j))
    C = sp.ImmutableMatrix(n, n, lambda i, j: v[j] * sp.sin(q[i] - q[j]))
    g_vec = sp.ImmutableMatrix(n, 1, [g * sp.sin(x) * (i + 1) for i, x in enumerate(q)])
    P = -g * sum((i + 1) * sp.cos(x) for i, x in enumerate(q))
    f = sp.ImmutableMatrix(n, 1, [k * x / (i + 1) for i, x in enumerate(v)])
    return Derivation(q, v, (g, k), M, C, g_vec, P, f)


def functions():
    """Not physical: one of each function that a potential or an inertia may bring."""
    q, v = sp.symbols("q1 q2", real=True), sp.symbols("qd1 qd2", real=True)
    a, b = q
    l, k = sp.symbols("l k", positive=True)
    wall = sp.Piecewise((a, a > 1), (sp.Rational(1, 3), True))
    P = sp.sqrt(a**2 + l**2) + k * sp.tanh(b) + sp.atan2(a, l) + sp.exp(-(b**2)) + sp.Abs(a) + wall
    g1 = sp.sign(a) + sp.Max(0, b) + sp.Min(a, 1) + sp.atan(b) / l + sp.log(1 + a**2) * 1e-7
    M11 = 2 + sp.tan(a / 20) ** 2 + sp.Float(0.1) * sp.pi + sp.floor(b) ** 2
    M = sp.ImmutableMatrix([[M11, 1], [1, 2 + sp.cosh(a / 20)]])
    C = sp.ImmutableMatrix([[a * v[1], 0], [-1, 0]])
    return Derivation(q, v, (l, k), M, C, sp.ImmutableMatrix([[g1], [0]]), P)


MODELS = {
    "Planar2R": planar_chain(2),
    "Planar3R": planar_chain(3, offsets=True),
    "CartPole": cart_pole(),
    "Pendulum": pendulum(),
    "Ten": ten(),
    "Functions": functions(),
}
WRITERS = {"cpp": cpp, "java": java, "matlab": matlab, "wolfram": wolfram}
PACKAGES = {
    "cpp": ("g++", "libeigen3-dev"),
    "java": ("default-jdk-headless", "libejml-java"),
    "matlab": ("octave",),
}


def symbols_of(derivation):
    return (*derivation.parameters, *derivation.q, *derivation.qd)


def parts(derivation):
    d = derivation
    return [d.M, d.C, d.g_vec, d.f_vec, sp.Matrix([d.P])]


def sizes(expression):
    """The sum of the sizes of the terms, with 1 for each function: what rounding is relative to."""
    terms = sp.Add.make_args(sp.expand(expression.doit()))
    return sum(sp.Abs(t.replace(lambda e: e.is_Function, lambda e: sp.S.One)) for t in terms)


@cache
def exact_and_sizes(name):
    """The parts of a model in many digits, and the sizes of their entries, as functions."""
    d = MODELS[name]
    symbols = symbols_of(d)
    return [
        (
            sp.lambdify(symbols, part, "mpmath"),
            sp.lambdify(symbols, part.applyfunc(sizes).tolist(), "numpy"),
        )
        for part in parts(d)
    ]


@st.composite
def arms_states_inputs(draw, derivation):
    values = [draw(PARAMETERS[s.name.rstrip("_123")]) for s in derivation.parameters]
    return values, *(draw(vectors(derivation.n)) for _ in range(3))


@pytest.fixture(scope="module", params=PACKAGES)
def language(request, needs):
    for package in PACKAGES[request.param]:
        needs(package)
    return request.param


# Compiling takes seconds; tests/ports builds the 2R arm as well.
BUILT = [
    pytest.param(name, marks=pytest.mark.long if name == "Planar2R" else ()) for name in MODELS
]


@pytest.fixture(scope="module", params=BUILT)
def model(request, language):
    """(name, its program): what is generated, built without a warning."""
    derivation = MODELS[request.param]
    said = ports.built(language, derivation) / "compiler.txt"
    assert said.read_text(encoding="utf-8") == ""
    with ports.start(language, derivation) as program:
        yield request.param, program


@a_few
@given(data=st.data())
def test_source_computes_the_derivation(model, data):
    name, program = model
    n, functions = MODELS[name].n, exact_and_sizes(name)
    values, q, qd, u = data.draw(arms_states_inputs(MODELS[name]))
    answer = program.terms(values, [*q, *qd], u)
    found = [
        answer.M.ravel(),
        answer.C.ravel(),
        answer.g_vec,
        answer.f_vec,
        [answer.potential_energy],
        answer.qdd,
    ]
    with mpmath.workdps(340):
        exact = [part(*map(mpmath.mpf, (*values, *q, *qd))) for part, _ in functions]
        size = [np.array(part(*values, *q, *qd), float).ravel() for _, part in functions]
        for got, right, largest in zip(found, exact, size, strict=False):
            error = np.abs(np.array([float(a - b) for a, b in zip(got, right, strict=True)]))
            assert np.all(error <= 1e-12 * largest + UNDERFLOW)

        # M q̈ + C q̇ + g + f = u, to the size of the terms in it.
        M, C, g, f = exact[:4]
        qdd = mpmath.matrix(found[5])
        residual = M * qdd + C * mpmath.matrix(qd) + g + f - mpmath.matrix(u)
    M, C, g, f = size[0].reshape(n, n), size[1].reshape(n, n), size[2], size[3]
    terms = M @ np.abs(found[5]) + C @ np.abs(qd) + g + f + np.abs(u)
    assert np.all(
        np.abs(np.array([float(r) for r in residual])) <= 1e-12 * np.max(terms) + UNDERFLOW
    )


@pytest.mark.parametrize(
    "names", [("CartPole", "Functions"), pytest.param(tuple(MODELS), marks=pytest.mark.long)]
)
def test_the_header_is_cpp_11(needs, tmp_path, names):
    for package in PACKAGES["cpp"]:
        needs(package)
    files = {f"{name}.hpp": cpp(MODELS[name], name) for name in names}
    driver = "".join(f'#include "{name}"\n' for name in files)
    command = ["-std=c++11" if p == "-std=c++17" else p for p in TOOLCHAINS["cpp"]().compile]
    assert "-std=c++11" in command
    folder = build(files | {"driver.cpp": driver}, [*command, "-fsyntax-only"], tmp_path)
    assert (folder / "compiler.txt").read_text(encoding="utf-8") == ""


def wolfram_values(source):
    """What each definition of the source comes to, by SymPy's parser: name → (arguments, value)."""
    values = {}
    for block in source.split("\n\n")[1:]:
        head, body = parse_mathematica(block).args
        if body.func.__name__ == "Module":
            _, sequence = body.args
            local = {}
            for step in sequence.args[:-1]:
                name, term = step.args
                local[name] = sp.sympify(term).subs(local)
            body = sequence.args[-1]
        else:
            local = {}
        body = (sp.Matrix(body) if len(values) < 4 else sp.sympify(body)).subs(local)
        arguments = [[pattern.args[0] for pattern in vector] for vector in head.args[:2]]
        values[head.func.__name__] = arguments, body
        if len(values) == 5:
            return values
    raise AssertionError(f"five definitions in {source}")


@pytest.mark.parametrize("name", ["Planar2R", "Planar3R", "CartPole", "Pendulum"])
def test_wolfram_says_the_derivation_exactly(name):
    derivation = MODELS[name]
    values = wolfram_values(wolfram(derivation, "arm"))
    renamed = {"I": "ISym", "k_1": "k1"}
    own = {s: sp.Symbol(renamed.get(s.name, s.name)) for s in symbols_of(derivation)}
    q, qd = ([own[s] for s in symbols] for symbols in (derivation.q, derivation.qd))
    expected = {
        "armM": ([q], derivation.M),
        "armC": ([q, qd], derivation.C),
        "armGVec": ([q], derivation.g_vec),
        "armFVec": ([qd], derivation.f_vec),
        "armPotentialEnergy": ([q], sp.Matrix([derivation.P])),
    }
    assert list(values) == list(expected)
    for function, (arguments, right) in expected.items():
        assert values[function][0] == arguments
        found = sp.Matrix([values[function][1]]).reshape(*right.shape)
        difference = found - right.xreplace(own)
        assert all(entry.doit().rewrite(sp.exp).expand() == 0 for entry in difference)


def test_wolfram_solves_for_the_accelerations():
    definition = parse_mathematica(wolfram(MODELS["Planar2R"], "arm").split("\n\n")[-1])
    solve = definition.args[1]
    assert solve.func.__name__ == "LinearSolve"
    q, qd, u = sp.symbols("q qd u")
    M, C, gravity, friction, dot = sp.symbols("armM armC armGVec armFVec Dot", cls=sp.Function)
    assert solve.args == (M(q), u - dot(C(q, qd), qd) - gravity(q) - friction(qd))


@pytest.mark.parametrize(
    ("number", "text"),
    [(9.81, "9.81"), (1e-7, "1.*^-07"), (0.1 + 0.2, "0.30000000000000004`"), (-2e30, "-2.*^30")],
)
def test_wolfram_reads_numbers_as_doubles(number, text):
    q, qd = sp.symbols("q qd")
    one = sp.ones(1, 1)
    spring = Derivation((q,), (qd,), (), one, 0 * one, number * q * one, sp.Float(number) * q)
    text = text.replace("-07", "-7")
    assert f"{text}*q" in wolfram(spring)


def source(writer, *arguments):
    """The text of all the files that the writer gives."""
    written = writer(*arguments)
    return "".join(written.values()) if isinstance(written, dict) else written


@pytest.mark.parametrize("writer", WRITERS.values(), ids=WRITERS)
def test_source_says_what_it_is(writer):
    text = source(writer, MODELS["Planar2R"], "Elbow")
    assert "Elbow: the equation of motion M(q) qdd + C(q, qd) qd + g_vec(q) = u" in text
    assert "Generated by armdyn" in text
    assert re.search(r"\bl1\b.* length, m\n", text)
    assert re.search(r"\bI2\b.* inertia, kg m\^2\n", text)
    assert text.isascii()
    assert max(map(len, text.splitlines())) <= 100


@pytest.mark.parametrize(
    ("writer", "names"),
    [
        (cpp, {"M": "M_", "q": "q_", "qd": "qd_", "u": "u_"}),
        (java, {"M": "M_", "q": "q_", "qd": "qd_", "u": "u_"}),
        (matlab, {"M": "M_", "q": "q_", "qd": "qd_", "u": "u_"}),
        (wolfram, {"I": "ISym", "k_1": "k1"}),
    ],
)
def test_taken_names_are_told(writer, names):
    found = re.findall(r"(\w+) stands for (\w+), ", source(writer, MODELS["CartPole"], "cart"))
    assert {old: new for new, old in found} == names


@pytest.mark.parametrize("writer", WRITERS.values(), ids=WRITERS)
def test_source_says_whether_there_is_friction(writer):
    text = source(writer, MODELS["Ten"], "Dozen")
    assert "C(q, qd) qd + g_vec(q) + f_vec(qd) = u" in text
    assert "no friction" not in text
    assert "and no friction" in source(writer, MODELS["Planar2R"], "Elbow")


def test_wolfram_has_a_matrix_for_one_coordinate():
    text = wolfram(MODELS["Pendulum"])
    assert "armM[{q_}] :=\n  {{ISym}}" in text
    assert "armC[{q_}, {qd_}] :=\n  {{0}}" in text
    assert "armFVec[{qd_}] :=\n  {0}" in text


@pytest.mark.parametrize("writer", WRITERS.values(), ids=WRITERS)
def test_bad_input_is_named(writer):
    arm = MODELS["Planar2R"]
    for name in ("2R", "my arm", "", "Armé", None):
        with pytest.raises(ValueError, match=r"name = .*needs ASCII letters"):
            writer(arm, name)
    q, qd, other = sp.symbols("q1 qd1 other")
    one = sp.ones(1, 1)

    def model(P, *parameters):
        return Derivation((q,), (qd,), parameters, one, 0 * one, 0 * one, P)

    with pytest.raises(ValueError, match=r"P depends on other: needs q and parameters"):
        writer(model(q * other), "Arm")
    with pytest.raises(ValueError, match=r"P contains f\(q1\), which .*: needs functions whose"):
        writer(model(sp.Function("f")(q)), "Arm")
    with pytest.raises(ValueError, match=r"symbol .m'.: needs a name of ASCII letters"):
        writer(model(q, sp.Symbol("m'")), "Arm")
    with pytest.raises(ValueError, match=r"2 different symbols are called m"):
        writer(model(q, sp.Symbol("m"), sp.Symbol("m", positive=True)), "Arm")


@pytest.mark.parametrize(("writer", "name"), [(cpp, "double"), (java, "Math"), (matlab, "end")])
def test_a_model_is_not_called_as_the_language_is(writer, name):
    with pytest.raises(ValueError, match="needs a name that the language does not reserve"):
        writer(MODELS["Planar2R"], name)


def test_closed_form_of_the_2r_can_be_read():
    text = cpp(MODELS["Planar2R"])
    assert "t1 = l1*lc2*m2*std::cos(q2);" in text
    assert "M22 = I2 + std::pow(lc2, 2)*m2;" in text
    assert "M12 = M22 + t1;" in text
    assert "C12 = -t1*(qd1 + qd2);" in text


@pytest.mark.parametrize("writer", WRITERS.values(), ids=WRITERS)
def test_high_powers_are_left_as_they_are(writer):
    """Multiplied out, or taken for polynomials of that degree, they would fill the memory."""
    q, qd, a = sp.symbols("q qd a", real=True)
    P = (q + sp.cos(q)) ** 3_000_000_000 + (a + q) ** sp.Rational(10**7 + 1, 3 * 10**7)
    assert "3000000000" in source(writer, from_energies(qd**2 / 2, P, [q], [qd]))


def test_terms_of_a_long_chain_have_the_names_of_the_field():
    text = cpp(planar_chain(5))
    assert "s123 = std::sin(q123);" in text
    assert "q123 = q12 + q3;" in text
