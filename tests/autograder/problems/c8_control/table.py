"""Wrong answers about controllers: the mistakes that each shows, and the credit left."""

EXAMPLE = """
from types import SimpleNamespace
arm = SimpleNamespace(l1=0.6, l2=0.5, lc1=0.28, lc2=0.22, m1=3.0, m2=2.0, I1=0.09, I2=0.05, g=9.81,
                      kp=np.array([40.0, 12.0]), kd=np.array([12.0, 3.0]))
"""
MATRICES = """
def M(q):
    c = arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1])
    b = arm.I2 + arm.m2 * arm.lc2**2
    return np.array([[arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2 + b + 2 * c, b + c], [b + c, b]])
def M_dot(q, qd):
    h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])
    return h * qd[1] * np.array([[2.0, 1.0], [1.0, 0.0]])
def g_vec(q):
    g2 = arm.m2 * arm.lc2 * arm.g * np.cos(q[0] + q[1])
    return np.array([(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.cos(q[0]) + g2, g2])
"""


def hold(gravity="g_vec(q)", spring="arm.kp * (q_star - q)", damper="- arm.kd * qd", first=""):
    """The body of gravity_compensation, with one of its terms replaced."""
    return f"{first}{MATRICES}\nreturn {gravity} + {spring} {damper}"


TOP = "l1 * c2 * (2 * a1 + a2) - l1 * s2 * products + g * c12"
LOW = "l1 * c2 * a1 + l1 * s2 * v1 * r1 + g * c12"
LINES = {
    "products": "v2 * r1 + (v1 + v2) * r2",
    "mc1": "g * c1",
    "m2": "l1**2 * a1 + l1 * g * c1",
    "top": TOP,
    "low": LOW,
    "J1": "a1",
    "J2": "a1 + a2",
}


def Y(first="", **lines):
    """The body of regressor_r, with one of its lines replaced."""
    cosines = {name: lines[name] for name in ("c1", "c12") if name in lines}
    assert lines.keys() <= LINES.keys() | cosines.keys()
    defined = "\n".join(f"{name} = {text}" for name, text in (cosines | LINES | lines).items())
    return f"""{first}
l1, g = arm.l1, arm.g
(q1, q2), (v1, v2), (r1, r2), (a1, a2) = q, qd, qd_r, qdd_r
c1, c2, s2, c12 = np.cos(q1), np.cos(q2), np.sin(q2), np.cos(q1 + q2)
{defined}
return np.array([[0, mc1, J1, m2, top, J2], [0, 0, 0, 0, low, J2]])
"""


def defined(body):
    """Y_of(q, qd, qd_r, qdd_r), with this body."""
    lines = [f"    {line}" for line in body.strip().splitlines()]
    return "def Y_of(q, qd, qd_r, qdd_r, arm=arm):\n" + "\n".join(lines)


REGRESSOR = defined(Y())
STEPS = {
    "e": "q - ref.q",
    "ed": "qd - ref.qd",
    "qd_r": "ref.qd - gains.Lam @ e",
    "qdd_r": "ref.qdd - gains.Lam @ ed",
    "s": "qd - qd_r",
    "Y": "Y_of(q, qd, qd_r, qdd_r)",
    "u": "Y @ pi_hat - gains.KD @ s",
    "rate": "-gains.Gamma @ Y.T @ s",
    "both": "np.concatenate([u, rate])",
}


def law(first="", regressor=REGRESSOR, **steps):
    """The body of slotine_li, with some of its lines or its regressor replaced."""
    assert steps.keys() <= STEPS.keys()
    lines = "\n".join(f"{name} = {text}" for name, text in (STEPS | steps).items())
    return f"{first}\n{regressor}\n{lines}\nreturn both"


def rate(returned, first=""):
    """The body of V_dot; D, R and F: the damping, ½ sᵀ Ṁ s and sᵀ C s."""
    return f"""{first}{MATRICES}
K, N = gains.KD, M_dot(q, qd)
D, R, F = s @ K @ s, s @ N @ s / 2, s @ C_used @ s
return {returned}
"""


TABLE = {
    "c8-gravity_compensation": [
        ("gravity at the goal", hold("g_vec(q_star)"), 0.2),
        ("no gravity", hold("0"), 0),
        ("sign of gravity", hold("-g_vec(q)"), 0),
        ("sign of the error", hold(spring="arm.kp * (q - q_star)"), 0.2),
        ("no spring", hold(spring="0"), 0.2),
        ("spring to zero", hold(spring="- arm.kp * q"), 0),
        ("sum for the error", hold(spring="arm.kp * (q_star + q)"), 0),
        ("spring without its gain", hold(spring="(q_star - q)"), 0.2),
        ("damping without its gain", hold(damper="- qd"), 0.5),
        ("damper on the angle", hold(damper="- arm.kd * q"), 0),
        ("no damping", hold(damper=""), 0.5),
        ("sign of the damping", hold(damper="+ arm.kd * qd"), 0.5),
        (
            "gains exchanged",
            hold(spring="arm.kd * (q_star - q)", damper="- arm.kp * qd"),
            0.2,
        ),
        (
            "spring and gravity multiplied by M",
            hold(spring="M(q) @ (arm.kp * (q_star - q) - arm.kd * qd)", damper=""),
            0.2,
        ),
        ("error in degrees", hold(spring="arm.kp * np.rad2deg(q_star - q)"), 0.2),
        ("gravity in degrees", hold("g_vec(q * 180 / np.pi)"), 0),
        ("wrong angle of link 2", hold("g_vec([q[0], q[1] - q[0]])"), 0),
        ("9.81", hold(first="arm.g = 9.81\n"), 0),
        ("example arm", hold(first=EXAMPLE), 0),
    ],
    "c8-regressor_r": [
        ("qd for qd_r", Y("qd_r = qd"), 0.3),
        ("qd_r twice", Y("qd = qd_r"), 0.3),
        ("all of h on the second entry", Y(products="(2 * v1 + v2) * r2"), 0.6),
        ("2 q̇2 on the first entry", Y(products="v2 * (2 * r1 + r2)"), 0.6),
        ("2 q̇1 q̇r2 and q̇r2²", Y(products="2 * v1 * r2 + r2**2"), 0.6),
        ("q̇2² left", Y(products="v2 * r1 + v1 * r2 + v2**2"), 0.6),
        ("square of qd at joint 2", Y(low="l1 * c2 * a1 + l1 * s2 * v1**2 + g * c12"), 0.7),
        ("product once", Y(products="(v1 + v2) * r2"), 0.6),
        (
            "sign of the velocity products",
            Y("qd = -qd"),
            0.3,
        ),
        ("velocity products left out", Y("qd_r = 0 * qd_r"), 0.3),
        ("no acceleration", Y("qdd_r = 0 * qdd_r"), 0.1),
        ("no gravity", Y("arm.g = 0"), 0.1),
        ("sign of gravity", Y("arm.g = -arm.g"), 0.1),
        ("sine for cosine in gravity", Y(c1="np.sin(q1)", c12="np.sin(q1 + q2)"), 0.1),
        ("wrong angle of link 2 in gravity", Y(c12="c2"), 0.3),
        (
            "sine for cosine in the coupling",
            Y(top=TOP.replace("c2 *", "s2 *"), low=LOW.replace("c2 *", "s2 *")),
            0.3,
        ),
        (
            "coupling without the factor 2",
            Y(top="l1 * c2 * (a1 + a2) - l1 * s2 * products + g * c12"),
            0.6,
        ),
        ("absolute acceleration of link 2", Y(J2="a2"), 0.9),
        ("9.81", Y("arm.g = 9.81"), 0.1),
        ("example arm", Y(EXAMPLE), 0.1),
    ],
    "c8-slotine_li": [
        (
            "sign of Λ in q̇r",
            law(qd_r="ref.qd + gains.Lam @ e", qdd_r="ref.qdd + gains.Lam @ ed"),
            0,
        ),
        ("sign of Λ in q̇r alone", law(qd_r="ref.qd + gains.Lam @ e"), 0),
        ("Λ left out", law(qd_r="ref.qd", qdd_r="ref.qdd"), 0),
        ("Λ taken to be 1", law(qd_r="ref.qd - e", qdd_r="ref.qdd - ed"), 0),
        ("wanted acceleration for q̈r", law(qdd_r="ref.qdd"), 0),
        ("sign of Λ in q̈r", law(qdd_r="ref.qdd + gains.Lam @ ed"), 0),
        ("wanted velocity left out", law(qd_r="-gains.Lam @ e"), 0),
        ("wanted acceleration left out", law(qdd_r="-gains.Lam @ ed"), 0),
        ("q̇r and q̈r exchanged", law(Y="Y_of(q, qd, qdd_r, qd_r)"), 0),
        ("q̇ for q̇r in Y_r", law(Y="Y_of(q, qd, qd, qdd_r)"), 0.35),
        ("q̇r for q̇ in Y_r", law(Y="Y_of(q, qd_r, qd_r, qdd_r)"), 0.35),
        ("q̇r and q̇ exchanged in s", law(s="qd_r - qd"), 0),
        ("Y_r of the wanted motion", law(Y="Y_of(ref.q, ref.qd, ref.qd, ref.qdd)"), 0),
        ("Y_r at the wanted angles", law(Y="Y_of(ref.q, qd, qd_r, qdd_r)"), 0),
        ("error for s", law(s="q - ref.q"), 0),
        ("velocity error for s", law(s="ed"), 0),
        ("K_D on the velocity error", law(u="Y @ pi_hat - gains.KD @ ed"), 0.3),
        ("damping without K_D", law(u="Y @ pi_hat - s"), 0.3),
        ("sign of K_D", law(u="Y @ pi_hat + gains.KD @ s"), 0.3),
        ("K_D left out", law(u="Y @ pi_hat"), 0.3),
        ("Y_r π̂ left out", law(u="-gains.KD @ s"), 0.3),
        ("sign of the adaptation", law(rate="gains.Gamma @ Y.T @ s"), 0.35),
        ("no adaptation", law(rate="np.zeros(6)"), 0.35),
        ("Γ left out", law(rate="-Y.T @ s"), 0.35),
        ("Γ inverted", law(rate="-np.linalg.inv(gains.Gamma) @ Y.T @ s"), 0.35),
        ("Γ entry by entry", law(rate="-np.diag(gains.Gamma) * (s @ Y)"), 0.7),
        ("estimates for their rate", law(rate="pi_hat"), 0.35),
        (
            "estimates moved on by their rate",
            law(rate="pi_hat - gains.Gamma @ Y.T @ s"),
            0.35,
        ),
        ("rate from the error", law(rate="-gains.Gamma @ Y.T @ e"), 0.35),
        ("angles in degrees", law(e="np.degrees(q - ref.q)"), 0),
        ("example arm", law(EXAMPLE), 0),
        (
            ("K_D left out", "sign of the adaptation"),
            law(u="Y @ pi_hat", rate="gains.Gamma @ Y.T @ s"),
            0,
        ),
    ],
    "c8-V_dot": [
        ("skew-symmetry taken for granted", rate("-D"), 0.4),
        ("damping left out", rate("R - F"), 0),
        ("sign of the damping", rate("D + R - F"), 0),
        ("half of the damping", rate("-D / 2 + R - F"), 0),
        ("½ of V lost", rate("-D + s @ (N - 2 * C_used) @ s"), 0.4),
        ("½ of Ṁ lost", rate("-D + 2 * R - F"), 0),
        ("C once", rate("-D + s @ (N - C_used) @ s / 2"), 0),
        ("sign of Ṁ and C", rate("-D - R + F"), 0.4),
        ("sign of C", rate("-D + R + F"), 0),
        ("Ṁ left out", rate("-D - F"), 0),
        ("C left out", rate("-D + R"), 0),
        ("q̇ for s", rate("-qd @ K @ qd + qd @ (N / 2 - C_used) @ qd"), 0),
        ("q̇ for s in the damping", rate("-qd @ K @ qd + R - F"), 0),
        ("damping without K_D", rate("-s @ s + R - F"), 0),
        ("C times q̇", rate("-D + R - s @ C_used @ qd"), 0),
        ("Ṁ along s", rate("-D + s @ M_dot(q, s) @ s / 2 - F"), 0),
        ("M for Ṁ", rate("-D + s @ M(q) @ s / 2 - F"), 0),
        ("Ṁ from q̇1", rate("-D + s @ M_dot(q, qd[::-1]) @ s / 2 - F"), 0),
        ("example arm", rate("-D + R - F", EXAMPLE), 0),
    ],
}

# With these the arm in closed loop goes on as it should; with all others, it does not.
TRACKS = (
    "all of h on the second entry",
    "2 q̇2 on the first entry",
    "2 q̇1 q̇r2 and q̇r2²",
    "square of qd at joint 2",
)
TABLE["c8-slotine_li"] += [
    (
        f"law: {name}",
        law(regressor=defined(body)),
        0.35 if name in TRACKS else 0.15 if name == "q̇2² left" else 0,
    )
    for name, body, _ in TABLE["c8-regressor_r"]
    if name not in ("qd for qd_r", "qd_r twice", "example arm")
]
