"""Submissions to p1-inertia, made from the released notebook by editing it as a student would."""

from tests.submissions.answers import Answers, answered, cell_of

RIGHT = Answers(
    {
        "inertia_from_links": """
def inertia_from_links(jacobians, inertias):
    return sum(J.T @ I @ J for J, I in zip(jacobians, inertias))
""",
        "M": """
def M(q, arm):
    c2 = np.cos(q[1])
    M22 = arm.I2 + arm.m2 * arm.lc2**2
    M12 = M22 + arm.m2 * arm.l1 * arm.lc2 * c2
    M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.I2
    M11 += arm.m2 * (arm.l1**2 + arm.lc2**2 + 2 * arm.l1 * arm.lc2 * c2)
    return [[M11, M12], [M12, M22]]
""",
        "is_spd": """
def is_spd(A):
    if not np.allclose(A, A.T):
        return False
    values = np.linalg.eigvalsh(A)
    return values.min() > 1e-9 * values.max()
""",
        "singular_arm": """
def singular_arm():
    arm = dict(l1=1, l2=1, lc1=0, lc2=0.5, m1=1, m2=1, I1=0, I2=0, g=9.81)
    return arm, [0, np.pi]
""",
    }
)
POINTS = {
    "p1-inertia_from_links": 2.0,
    "p1-M": 4.0,
    "p1-is_spd": 3.0,
    "p1-singular_arm": 2.0,
}

function, right_but = RIGHT.function, RIGHT.right_but


def right(release):
    notebook = right_but(release)
    cell_of(notebook, "p1-proof").source = "2K is a sum of squares, ..."
    return notebook


def wrong(release):
    """Mistakes in every cell."""
    return answered(
        release,
        inertia_from_links=function("inertia_from_links", "return sum(J.T @ J for J in jacobians)"),
        M=function(
            "M",
            """
l2 = arm.l2  # for lc2
k = arm.m2 * arm.l1 * l2 * np.cos(q[1])
M22 = arm.I2 + arm.m2 * l2**2
M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2 + M22 + 2 * k
return [[M11, M22 + k], [M22 + k, M22]]""",
        ),
        is_spd=function("is_spd", "return True"),
        singular_arm=function(
            "singular_arm",
            """
arm = dict(l1=1, l2=1, lc1=0.5, lc2=0.5, m1=1, m2=1, I1=0, I2=0, g=9.81)
return arm, [0, 0]""",
        ),
    )


def partly_right(release):
    """One link only, I2 missing in M12, Cholesky alone, and a link without mass."""
    return answered(
        release,
        inertia_from_links=function(
            "inertia_from_links", "return jacobians[-1].T @ inertias[-1] @ jacobians[-1]"
        ),
        M=RIGHT["M"].replace("M12 = M22 +", "M12 = M22 - arm.I2 +"),
        is_spd=function(
            "is_spd",
            """
try:
    np.linalg.cholesky(A)
except np.linalg.LinAlgError:
    return False
return True""",
        ),
        singular_arm=function(
            "singular_arm",
            """
arm = dict(l1=1, l2=1, lc1=0.5, lc2=0.5, m1=1, m2=0, I1=1, I2=0, g=9.81)
return arm, [0, 0]""",
        ),
    )
