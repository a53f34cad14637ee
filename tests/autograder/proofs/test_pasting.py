"""What lessons and problems show for the proofs can be pasted into a line, and means what it says."""

import numpy as np
import pytest

from autograder.proofs import DERIVATIONS
from autograder.proofs.energy import FREE, N
from autograder.proofs.evaluating import value_of
from autograder.proofs.notation import plain
from autograder.proofs.parsing import LineError, relation_and_sides
from autograder.proofs.subject import World
from autograder.protocol import handed_in

BY_K = r"\frac{\partial M_{ij}}{\partial q_k}"
BY_J = r"\frac{\partial M_{ik}}{\partial q_j}"
BY_I = r"\frac{\partial M_{jk}}{\partial q_i}"
SAME = {
    "p2-E": {
        r"\tfrac12\ddot q^{\mathsf T}M\dot q + \tfrac12\dot q^{\mathsf T}\dot M\dot q + \tfrac12\dot "
        r"q^{\mathsf T}M\ddot q + \dot q^{\mathsf T}\frac{\partial P}{\partial q} .":
            "1/2 qdd' M qd + 1/2 qd' Mdot qd + 1/2 qd' M qdd + qd' dPdq",
        r"\dot q^{\mathsf T}\bigl(\dot M(q,\dot q) - 2C(q,\dot q)\bigr)\dot q "
        r"\quad\text{for all } q, \dot q .": "qd' (Mdot - 2 C) qd",
        r"\tfrac12\dot q^{\mathsf T}M\dot q + P(q)": "1/2 qd' M qd + P",
        r"\partial P/\partial q": "dPdq",
        r"g(q)": "g",
        r"\boxed{\ C + C^{\mathsf T}\ }": "C + C'",
        r"&\dot q^{\mathsf T}(u - C\dot q - g) \\[2pt]": "qd' (u - C qd - g)",
        r"\frac{d}{dt}\left(\tfrac12 \dot q^T M \dot q\right) + \frac{dP}{dt}":
            "d/dt(1/2 qd' M qd) + Pdot",
        r"C_{ji}": "C'",
        r"N_{ij} + N_{ji}": "(Mdot - 2 C) + (Mdot - 2 C)'",
        r"\dot q^{\mathsf T}N\dot q": "qd' (Mdot - 2 C) qd",
        r"\tfrac12\sum_{j=1}^n\sum_{k=1}^n M_{jk}(q)\,\dot q_j\,\dot q_k": "1/2 qd' M qd",
        r"\sum_j M_{ij}\,\ddot q_j + \sum_k M_{ki}\dot q_k": "M qdd + M' qd",
        r"\sum_i \frac{\partial P}{\partial q_i}\dot q_i": "qd' dPdq",
        r"\sum_i \dot q_i\,\partial P/\partial q_i": "qd' dPdq",
        r"\sum_{k=1}^n h_{ijk}(q)\,\dot q_k": "1/2 (Mdot + W - W')",
        rf"\dot M_{{ij}} - \sum_k {BY_K}\dot q_k": "0 M",
        r"\sum_k h_{ijk}\,\dot q_k": "1/2 (Mdot + W - W')",
        rf"\sum_{{k=1}}^n \tfrac12\left({BY_K} + {BY_J} - {BY_I}\right)\dot q_k":
            "1/2 (Mdot + W - W')",
        rf"\sum_k\left({BY_I} - {BY_J}\right)\dot q_k": "W' - W",
        r"\sum_k (\partial M_{jk}/\partial q_i - \partial M_{ik}/\partial q_j)\dot q_k": "W' - W",
        rf"\sum_j\sum_k\left({BY_K} - \tfrac12{BY_I}\right)\dot q_j\,\dot q_k":
            "(Mdot - 1/2 W') qd",
        rf"\sum_i\sum_j\sum_k{BY_K}\,\dot q_i\dot q_j\dot q_k - \tfrac12\sum_i\sum_j\sum_k{BY_I}"
        r"\,\dot q_i\dot q_j\dot q_k": "qd' Mdot qd - 1/2 qd' W' qd",
    },
    "p3-L": {
        r"\frac{d}{dt}\frac{\partial L}{\partial \dot q} - \frac{\partial L}{\partial q}":
            "d/dt(d/dqd(L)) - d/dq(L)",
        r"\frac{\mathrm d}{\mathrm dt}\frac{\partial L}{\partial \dot q} ,": "d/dt(d/dqd(L))",
        r"\partial L/\partial\dot q": "d/dqd(L)",
        r"\tfrac12 I\dot q^2 - m g\ell_c(1-\cos q)": "1/2 I qd^2 - m g lc (1 - cos q)",
        r"-(-m g\ell_c \sin q)": "m g lc sin q",
        "I*Derivative(q(t), (t, 2)) + g*lc*m*sin(q(t))": "I qdd + m g lc sin q",
        "I*Derivative(q(t), t)**2/2": "1/2 I qd^2",
        "Derivative(L, q)": "d/dq(L)",
    },
    "p1-positive": {
        r"\sum_k J_k(q)^{\mathsf T}\,\mathcal I_k\,J_k(q)": "J1' I1 J1 + J2' I2 J2",
        r"\sum J_k^{\mathsf T}I_kJ_k": "J1' I1 J1 + J2' I2 J2",
        r"J_1^{\mathsf T}I_1J_1": "J1' I1 J1",
        r"\sum_k \tfrac12\,(J_k\dot q)^{\mathsf T}\,\mathcal I_k\,(J_k\dot q)":
            "1/2 (J1 qd)' I1 J1 qd + 1/2 (J2 qd)' I2 J2 qd",
        r"\tfrac12\,\dot q^{\mathsf T}\Bigl(\sum_k J_k^{\mathsf T}\,\mathcal I_k\,J_k\Bigr)\dot q":
            "1/2 qd' (J1' I1 J1 + J2' I2 J2) qd",
    },
    "p4-P": {
        r"-\sum_k m_k\,\vec g^{\,\mathsf T} p_k(q)": "-m1 g0' p1 - m2 g0' p2",
        r"-\sum m_k\,\vec g^{\,\mathsf T}p_k": "-m1 g0' p1 - m2 g0' p2",
        r"-\sum_i m_i J_{v,i}^T\,\vec g_0": "-m1 J1' g0 - m2 J2' g0",
        r"-\sum_{i=1}^{2} m_i\,\vec g_0^{\,T} \dot p_i": "-m1 g0' v1 - m2 g0' v2",
        r"\dot q^{\mathsf T}\frac{\partial P}{\partial q}": "qd' dPdq",
    },
}  # fmt: skip


@pytest.mark.parametrize(
    ("id", "pasted", "ours"),
    [(id, pasted, ours) for id, rows in SAME.items() for pasted, ours in rows.items()],
)
def test_a_formula_of_the_course_is_read(id, pasted, ours):
    subject = DERIVATIONS[id].subject
    world = World(subject, np.random.default_rng(0), ())
    _, _, right = relation_and_sides(pasted)
    read, expected = (world.value(subject.parser.read(text)).numbers for text in (right, ours))
    np.testing.assert_allclose(*np.broadcast_arrays(read, expected), atol=1e-12)


@pytest.mark.parametrize(
    "typed",
    [
        "\tfrac12 \\dot q^T M \\dot q",
        "\\left(\frac{1}{2}\right) \bigl(\\dot q^T M \\dot q\bigr)",
        "\frac{1}{2} \times \\dot q^\top M \\dot q",
        "\boxed{\tfrac12 \\dot q^{\text{T}} M \\dot q}",
    ],
)
def test_a_text_without_r_is_read_as_well(typed):
    """Where Python has made one sign of a backslash and the letter behind it."""
    ((line, _),) = handed_in([(typed, "algebra")]).lines
    _, _, right = relation_and_sides(line)
    world = World(FREE, np.random.default_rng(0), ())
    read, expected = (
        world.value(FREE.parser.read(text)).numbers for text in (right, "1/2 qd' M qd")
    )
    np.testing.assert_allclose(read, expected)


def test_a_vector_without_r():
    assert plain("\vec g_0").split() == ["g0"]


@pytest.mark.parametrize(
    ("pasted", "indices"),
    [
        (r"\sum_k h_{ijk}\,\dot q_k", "ijk,k->ij"),
        (r"\sum_k h_{kij}\,\dot q_k", "kij,k->ij"),
        (r"\sum_k h_{jik}\,\dot q_k", "jik,k->ij"),
        (r"\sum_j\sum_k h_{ijk}\,\dot q_j\,\dot q_k", "ijk,j,k->i"),
        (r"\sum_i\sum_j\sum_k h_{ijk}\,\dot q_i\dot q_j\,\dot q_k", "ijk,i,j,k->"),
    ],
)
def test_indices_mean_what_they_say(pasted, indices):
    """Against the sums themselves, of random slopes of a symmetric M."""
    rng = np.random.default_rng(2)
    slopes = rng.normal(size=(N, N, N))  # ∂M_ij/∂q_k: i, j, k
    slopes = slopes + np.swapaxes(slopes, 0, 1)
    qd = rng.normal(size=N)
    h = (slopes + np.swapaxes(slopes, 1, 2) - np.einsum("jki->ijk", slopes)) / 2
    numbers = {
        "qd": qd[None, :, None],
        "Mdot": np.einsum("ijk,k->ij", slopes, qd)[None],
        "W": np.einsum("ikj,k->ij", slopes, qd)[None],
    }
    tree = FREE.parser.read(pasted)
    tree = World(FREE, rng, ())._calculus.written_out(tree)
    read = value_of(tree, numbers, lambda x, by: x).numbers
    expected = np.einsum(indices, h, *[qd] * (indices.count(",")))
    np.testing.assert_allclose(read.reshape(expected.shape), expected)


@pytest.mark.parametrize(
    "text",
    [
        r"\sum",
        r"\sum_k",
        r"\sum_k h_{ijk",
        r"\sum" * 60 + "K",
        r"\sum_k h_{ijk}" * 26,
        "⟨ijk⟩",
        r"\sum_k \frac{\partial M_{ij}}{\partial q_k}\dot q_j",
        r"\sum_j \frac{\partial M_{ij}}{\partial q_k}\dot q_j",
        r"\frac{\partial M_{ij}}{\partial q_k}",
        r"\sum_k K",
        r"\sum_j M_{ij}\dot q_k",
        r"\sum_j M_{jj}\dot q_j",
        r"\sum_i \partial P/\partial q_j \dot q_i",
        r"\sum_j\sum_k h_{ijk}\dot q_k",
    ],
)
def test_a_broken_sum_is_refused(text):
    with pytest.raises(LineError):
        FREE.parser.read(text)
