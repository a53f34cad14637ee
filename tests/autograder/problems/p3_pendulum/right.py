"""Right answers about the pendulum, each found in another way."""

MGL = "pend.m * pend.g * pend.lc"
RIGHT = {
    "p3-lagrangian": [
        "I * qd**2 / 2 - m * g * lc * (1 - sp.cos(q))",
        "I * qd**2 / 2 + m * g * lc * sp.cos(q)",
        "sp.Rational(1, 2) * I * qd**2 - 2 * m * g * lc * sp.sin(q / 2) ** 2",
        "0.5 * I * qd**2 - m * g * (5 - lc * sp.cos(q))",
        "0.5 * (I - m * lc**2) * qd**2 + 0.5 * m * ((lc * sp.cos(q) * qd) ** 2 "
        "+ (lc * sp.sin(q) * qd) ** 2) + m * g * lc * sp.cos(q)",
        "sp.Matrix([[I * qd**2 / 2 + m * g * lc * sp.cos(q)]])[0, 0]",
        "sp.expand(I * qd**2 / 2 - m * g * (lc - lc * sp.cos(q)))",
        "sp.integrate(I * qd, qd) - sp.integrate(m * g * lc * sp.sin(q), q)",
        "(sp.Matrix([qd]).T * sp.Matrix([[I]]) * sp.Matrix([qd]))[0] / 2 + m * g * lc * sp.cos(q)",
        "0.5 * I * qd**2 - m * g * lc * (1 - sp.sin(q + sp.pi / 2))",
    ],
    "p3-M": [
        "[[pend.I]]",
        "pend.I + 0 * q",
        "((pend.I - pend.m * pend.lc**2) + pend.m * pend.lc**2,)",
        "np.full((1, 1), pend.I)",
    ],
    "p3-C": [
        "[[0 * q[0] * qd[0]]]",
        "(0,)",
        "sp.zeros(1, 1)",
        "np.zeros_like(q)",
        "[[(pend.I - pend.I) / 1e-6 * qd[0]]]",
    ],
    "p3-g_vec": [
        f"{MGL} * np.sin(q)",
        f"np.float32({MGL} * np.sin(np.float32(q)))",
        f"{MGL} * sp.sin(q[0])",
        f"-{MGL} * np.cos(q + np.pi / 2)",
        f"2 * {MGL} * np.sin(q / 2) * np.cos(q / 2)",
        f"{MGL} * (np.cos(q - 1e-6) - np.cos(q + 1e-6)) / 2e-6",
        f"np.array([[{MGL} * np.sin(q[0])]])",
    ],
    "p3-inertia_about_pivot": [
        "[I_com + m * lc * lc]",
        "np.array([[I_com + m * np.square(lc)]])",
        "sp.Float(I_com) + m * sp.Float(lc) ** 2",
        "m * (I_com / m + lc**2)",
        "np.dot([I_com, m], [1, lc**2])",
    ],
    "p3-small_angle_frequency": [
        f"({MGL} / pend.I) ** 0.5",
        f"sp.sqrt({MGL} / pend.I)",
        f"2 * np.pi / (2 * np.pi * np.sqrt(pend.I / ({MGL})))",
        f"np.hypot(0, ({MGL} / pend.I) ** 0.5)",
        f"abs(np.roots([pend.I, 0, {MGL}])[0])",
        f"np.exp(0.5 * np.log({MGL} / pend.I))",
    ],
}
# Those that come nearest to a tolerance; of symbols any.
DELICATE = {
    "p3-lagrangian": [RIGHT["p3-lagrangian"][1]],
    "p3-g_vec": [RIGHT["p3-g_vec"][1]],
}
