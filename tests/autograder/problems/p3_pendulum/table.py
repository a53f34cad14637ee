"""Wrong answers about the pendulum: the mistakes that each shows, and the credit left."""

MGL = "pend.m * pend.g * pend.lc"

KINETIC, POTENTIAL = "I * qd**2 / 2", "m * g * lc * (1 - sp.cos(q))"

TABLE = {
    "p3-M": [
        (
            "parallel axis added / the rotation of the body / m / I",
            "pend.I + pend.m * pend.lc**2",
            0,
        ),
        (
            "parallel axis taken off / the rotation of the body / m / I",
            "[[pend.I - pend.m * pend.lc**2]]",
            0,
        ),
        ("point mass / the rotation of the body / m / I", "pend.m * pend.lc**2", 0),
        ("inverse", "np.linalg.inv([[pend.I]])", 0),
        ("mass for inertia / the rotation of the body / m / I", "pend.m", 0),
    ],
    "p3-C": [
        ("gravity for C", f"[[{MGL} * np.sin(q[0])]]", 0),
        ("M", "pend.I", 0),
        ("point-mass centrifugal term", "pend.m * pend.lc * qd", 0),
        ("momentum for C", "pend.I * qd", 0),
    ],
    "p3-g_vec": [
        (
            "parameter inverted / the weight of the body / lc",
            "pend.m * pend.g * np.sin(q) / pend.lc",
            0,
        ),
        ("sign of the whole", f"-{MGL} * np.sin(q)", 0),
        ("cosine for sine / the weight of the body", f"{MGL} * np.cos(q)", 0),
        ("radians converted / the weight of the body", f"{MGL} * np.sin(np.radians(q))", 0),
        ("angle in degrees / the weight of the body", f"{MGL} * np.sin(np.degrees(q))", 0),
        (
            "gravity of Earth / the weight of the body / 9.81 / g",
            "pend.m * 9.81 * pend.lc * np.sin(q)",
            0,
        ),
        ("small angle / the weight of the body", f"{MGL} * q", 0),
        ("energy for its derivative", f"{MGL} * (1 - np.cos(q))", 0),
    ],
    "p3-lagrangian": [
        ("½ of K missing", f"I * qd**2 - {POTENTIAL}", 0.5),
        (
            "parallel axis added / the rotation of the body / m / I",
            f"(I + m * lc**2) * qd**2 / 2 - {POTENTIAL}",
            0.5,
        ),
        (
            "parallel axis taken off / the rotation of the body / m / I",
            f"(I - m * lc**2) * qd**2 / 2 - {POTENTIAL}",
            0.5,
        ),
        (
            "point mass / the rotation of the body / m / I",
            f"m * lc**2 * qd**2 / 2 - {POTENTIAL}",
            0.5,
        ),
        (
            "sine for cosine / the weight of the body / −",
            f"{KINETIC} - m * g * lc * sp.sin(q)",
            0.5,
        ),
        (
            "parameter left out / the weight of the body / lc",
            f"{KINETIC} - m * g * (1 - sp.cos(q))",
            0.5,
        ),
        (
            "radians converted / the weight of the body",
            f"{KINETIC} - m * g * lc * (1 - sp.cos(q * sp.pi / 180))",
            0.5,
        ),
        (
            ("½ of K missing", "energy for L"),
            f"I * qd**2 + {POTENTIAL}",
            0,
        ),
    ],
    "p3-inertia_about_pivot": [
        ("inertia about the centre of mass", "I_com", 0),
        ("parallel axis subtracted", "I_com - m * lc**2", 0),
        ("distance not squared", "I_com + m * lc", 0),
        ("point mass", "m * lc**2", 0),
        ("half the parallel-axis term", "I_com + m * lc**2 / 2", 0),
    ],
    "p3-small_angle_frequency": [
        ("point mass", "np.sqrt(pend.g / pend.lc)", 0),
        ("square root missing", f"{MGL} / pend.I", 0),
        ("period", f"2 * np.pi * np.sqrt(pend.I / ({MGL}))", 0),
        ("hertz", f"np.sqrt({MGL} / pend.I) / (2 * np.pi)", 0),
        ("upside down", f"np.sqrt(pend.I / ({MGL}))", 0),
        ("parallel axis applied again", f"np.sqrt({MGL} / (pend.I + pend.m * pend.lc**2))", 0),
    ],
}
