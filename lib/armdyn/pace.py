"""Notices when an adaptive method makes no more progress in time, which SciPy's solvers do not say."""

WINDOW = 3000  # calls of ẋ, over which the pace is taken
# Calls of ẋ that an accepted step takes, if none is taken back. LSODA's vary.
CALLS_A_STEP = {"RK45": 6, "RK23": 3, "DOP853": 12}
MANY = 1e6  # calls: minutes, if there is another sign that something is wrong
FAR_TOO_MANY = 1e8  # hours, whatever the reason
SLOWER = 1000
ADVICE = (
    'where f jumps, as Coulomb friction does at rest, use method="rk4" with times so close that '
    "dt k / M_ii, k being the Coulomb torque, is a velocity that does not matter; where f is stiff "
    'without jumps, "LSODA"'
)


class Pace:
    """How fast an adaptive method gets on with ẋ from t to `end`.

    A jump that holds the state back, as Coulomb friction at rest does, makes steps fail and get ever
    shorter. That differs from a long run in that more than half of the steps are taken back, or that
    some step before was very much quicker.
    """

    def __init__(self, method: str, rate, t: float, end: float):
        self.method, self.rate, self.end = method, rate, end
        self.last = self.mark = t
        self.last_calls = self.mark_calls = rate.calls
        self.steps, self.best = 0, 0.0

    def step(self, t: float) -> None:
        """Note a step to t; FloatingPointError if the end is out of reach at this pace."""
        self.steps += 1
        self.best = max(self.best, (t - self.last) / max(self.rate.calls - self.last_calls, 1))
        self.last, self.last_calls = t, self.rate.calls
        calls, gained, left = self.rate.calls - self.mark_calls, t - self.mark, self.end - t
        if calls < WINDOW:
            return
        needed = calls * left / gained if gained > 0 else float("inf")
        failing = CALLS_A_STEP.get(self.method, calls) * self.steps < calls / 2
        slowed = gained / calls * SLOWER < self.best
        if left > 0 and needed > (MANY if failing or slowed else FAR_TOO_MANY):
            raise FloatingPointError(
                f"{self.method} makes no more progress at t = {t:.6g} s: the last {calls} calls of f "
                f"gained {gained:.1e} s, and {left:.3g} s are left; {ADVICE}"
            )
        self.mark, self.mark_calls, self.steps = t, self.rate.calls, 0
