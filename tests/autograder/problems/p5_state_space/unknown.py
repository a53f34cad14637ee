"""Wrong answers about simulation that are no known mistake, and what is no answer."""

from tests.autograder.problems.p5_state_space.table import loop, rate

TRACED = {
    "p5-f": [
        (
            rate("0.5 * u - C @ qd - g - d * qd - k * np.sign(qd)"),
            "In your q̈, the input u is half of what it should be.",
        ),
        (
            rate("u - C @ qd - g - 3 * d * qd - k * np.sign(qd)"),
            "In your accelerations in ẋ, viscous friction is 3 times as large as it should be.",
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
