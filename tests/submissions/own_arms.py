"""Right answers for a member of the family of planar arms, as its student would type them."""

from autograder.problems.material.conventions import Convention
from autograder.problems.material.given import code
from tests.submissions import p1_inertia, p2_energy_skew, p4_gravity, p5_state_space
from tests.submissions.answers import answered

HEIGHTS = """
def potential_energy(q, arm):
    phi = np.array({turns}) @ q + np.array({zeros}) - {tilt}
    h1 = arm.lc1 * np.sin(phi[0])
    h2 = arm.l1 * np.sin(phi[0]) + arm.lc2 * np.sin(phi[1])
    return arm.g * (arm.m1 * h1 + arm.m2 * h2)
"""
M_DOT = """
def M_dot(q, qd, arm):
    C = christoffel_of_arm(q, qd, arm)
    return C + C.T
"""
C_OTHER = """
def C_other(q, qd, arm):
    return christoffel_of_arm(q, qd, arm) + np.array([[-qd[1], qd[0]], [0.0, 0.0]])
"""
DRIFT = """
def energy_drift(x, arm):
    E = np.array([r[2:] @ M(r[:2], arm) @ r[2:] / 2 + potential_energy(r[:2], arm) for r in x])
    return E - E[0]
"""


def _functions(own: Convention) -> dict[str, str]:
    M, C, g_vec = code(own, "p5").split("\n\n")
    P = HEIGHTS.format(
        turns=own.turns.tolist(), zeros=own.zeros.tolist(), tilt=own.pull + 1.5707963267948966
    )
    equilibria = f"def equilibria(arm):\n    return {own.equilibria().tolist()}"
    folded = own.angles_at([0.3, 0.3 + 3.141592653589793]).tolist()
    massless = "dict(l1=1, l2=1, lc1=0, lc2=0.5, m1=1, m2=1, I1=0, I2=0, g=9.81)"
    singular = f"def singular_arm():\n    return {massless}, {folded}"
    of_arm = C.replace("def C(", "def christoffel_of_arm(")
    return {
        **{"M": M, "C": C, "g_vec": g_vec, "potential_energy": P, "equilibria": equilibria},
        **{"M_dot": of_arm + M_DOT, "C_other": of_arm + C_OTHER, "energy_drift": P + DRIFT},
        "singular_arm": singular,
    }


PROBLEMS = {
    "p1-inertia": p1_inertia,
    "p2-energy-skew": p2_energy_skew,
    "p4-gravity": p4_gravity,
    "p5-state-space": p5_state_space,
}


def right(release, problem: str, own: Convention):
    """The released notebook of a problem with everything right for this arm."""
    known = PROBLEMS[problem].RIGHT
    functions = _functions(own)
    return answered(release, **{name: functions.get(name, text) for name, text in known.items()})
