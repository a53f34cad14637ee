"""Wrong answers about simulation that are no known mistake, and what is no answer."""

from tests.autograder.problems.p5_state_space.table import drift, loop, rate

TRACED = {
    "p5-f": [
        (
            rate("u - C @ qd - 1.1 * g - d * qd - k * np.sign(qd)"),
            "In your accelerations in ẋ, M⁻¹ g comes out 10 % too large.",
        ),
        (
            rate("0.5 * u - C @ qd - g - d * qd - k * np.sign(qd)"),
            "In your q̈, the input u is half of what it should be.",
        ),
        (
            rate("u - C @ qd - g - 3 * d * qd - k * np.sign(qd)"),
            "In your accelerations in ẋ, viscous friction is 3 times as large as it should be.",
        ),
    ],
    "p5-energy_drift": [
        (
            drift(K="0.6 * qd @ M(q) @ qd"),
            "In your change of the kinetic energy, every value is 20 % too large. Which factor belongs "
            "to all terms?",
            "In your drift where both change, the change of K comes out 20 % too large.",
        ),
    ],
}
UNEXPLAINED: dict = {}
NEARLY: dict = {}
ONE_ROW = "one row for each time and one column for each entry of the state"
UNFIT = {
    "p5-simulate": [
        (
            loop(returned="states[1:]"),
            "it must return one row for each time, and the state at t[0] is x0",
        ),
        (loop(returned="states[-1]"), ONE_ROW),
        (loop(returned="states[:, :1]"), ONE_ROW),
    ],
}
