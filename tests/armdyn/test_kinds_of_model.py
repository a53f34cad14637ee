"""A model where a derivation is needed, or the other way round: the error says how to get one."""

import numpy as np
import pytest
import sympy as sp

from armdyn import Link, SerialChain, codegen, derive, ports, properties
from armdyn.equilibria import equilibria
from armdyn.linearisation import forward_dynamics_slopes, inverse_dynamics_slopes, linearise
from armdyn.simulate import energy_drift, simulate

CHAIN = SerialChain([Link("revolute", 1.0, com=(0.1, 0, 0), axis=(0, 1, 0))])
DERIVATION = CHAIN.derivation()

TAKE_A_DERIVATION = {
    "cpp": codegen.cpp,
    "java": codegen.java,
    "matlab": codegen.matlab,
    "wolfram": codegen.wolfram,
    "numpy_model": lambda given: codegen.numpy_model(given, {}),
    "c_model": lambda given: codegen.c_model(given, {}),
    "fastest_model": lambda given: codegen.fastest_model(given, {}),
    "ports.built": lambda given: ports.built("cpp", given),
    "ports.start": lambda given: ports.start("cpp", given),
}
TAKE_A_MODEL = {
    "equilibria": equilibria,
    "linearise": lambda given: linearise(given, [0, 0], [0]),
    "inverse_dynamics_slopes": lambda given: inverse_dynamics_slopes(given, [0], [0], [0]),
    "forward_dynamics_slopes": lambda given: forward_dynamics_slopes(given, [0], [0], [0]),
    "energy_drift": lambda given: energy_drift(given, [[0, 0]]),
    "symmetry": lambda given: properties.symmetry(given, [0]),
    "skew_symmetry": lambda given: properties.skew_symmetry(given, [0], [0]),
    "power_balance": lambda given: properties.power_balance(given, [0], [0], [0]),
}


@pytest.mark.parametrize("name", TAKE_A_DERIVATION)
def test_a_model_is_no_derivation(name):
    take = TAKE_A_DERIVATION[name]
    needs = "^derivation = .*: needs a Derivation"
    with pytest.raises(ValueError, match=f"{needs}; a SerialChain has one: chain.derivation"):
        take(CHAIN)
    with pytest.raises(ValueError, match=f"{needs}; a NumpyModel has one: model.derivation"):
        take(codegen.numpy_model(DERIVATION, {}))
    with pytest.raises(ValueError, match=r"^derivation = 2: needs a Derivation$"):
        take(2)


def test_elastic_joints_and_ports_say_where_a_chain_has_its_derivation():
    with pytest.raises(ValueError, match=r"^rigid = SerialChain.*: chain\.derivation\(\)"):
        derive.elastic_joints(CHAIN)
    with pytest.raises(ValueError, match=r"^model = SerialChain.*chain\.derivation\(\)"):
        ports.run("cpp", CHAIN, [0, 0])


@pytest.mark.parametrize("name", TAKE_A_MODEL)
@pytest.mark.parametrize("given", [3, None, DERIVATION], ids=["3", "None", "derivation"])
def test_what_is_no_model_is_named(name, given):
    with pytest.raises(ValueError, match=r"^model = .*: needs a model, such as"):
        TAKE_A_MODEL[name](given)


def test_what_is_no_function_is_named():
    with pytest.raises(ValueError, match=r"^f = 3: needs a function f\(x, u\), or the arm"):
        simulate(3, [0, 0], [0], [0, 1])


@pytest.mark.parametrize("jump", [sp.sign, sp.Heaviside])
def test_the_slope_of_a_jump_is_refused_with_its_cure(jump):
    q, qd = sp.symbols("q qd", real=True)
    with pytest.raises(ValueError, match=r"g contains DiracDelta.*with Abs or Piecewise"):
        codegen.numpy_model(derive.from_energies(qd**2 / 2, q * jump(q), [q], [qd]), {})
    P = sp.Abs(q) if jump is sp.sign else sp.Piecewise((q, q > 0), (0, True))
    cured = codegen.numpy_model(derive.from_energies(qd**2 / 2, P, [q], [qd]), {})
    left = -1 if jump is sp.sign else 0
    np.testing.assert_array_equal(cured.g_vec([[0.3], [-0.3]]), [[1], [left]])
