"""What an animation stores of torques and energies. How it shows them: tests/browser/."""

import numpy as np
import pytest

from armdyn import Pendulum, Planar2R, PlanarChain
from armdyn.plotting import TERMS, Animation
from armdyn.simulate import simulate
from tests.armdyn.test_animation import Cart, data_of, html_of, read

ALT = "An arm swings."
LINKS = (1.0, 0.8, 0.5, 0.4, 3.0, 2.0, 0.25, 0.11)
FREE = Planar2R(*LINKS)
RUBBING = Planar2R(*LINKS, viscous=(0.5, 0.3), coulomb=(0.4, 0.2))
ROD = Pendulum(m=1.0, lc=0.5, I=1 / 3, viscous=0.3)
CHAIN = PlanarChain((0.5, 0.4, 0.3), (0.25, 0.2, 0.15), (1.0, 0.8, 0.5), (0.02, 0.01, 0.01))
T = np.linspace(0, 10, 2001)


def motors(t, x=None):
    """Torques that change with time, (..., 2), N·m."""
    return np.stack([6 * np.sin(3 * t), 2 * np.cos(4 * t)], axis=-1)


class Shown:
    """An animation of a motion from x0, with the numbers of its page."""

    def __init__(self, model, x0, u=None, t=T):
        n = model.n
        self.model, self.t, self.u = model, t, u
        self.x = simulate(model.state_derivative, x0, u or np.zeros(n), t)
        self.q, self.qd = self.x[:, :n], self.x[:, n:]
        given = u and u(t)
        self.animation = Animation(model, t, self.q, ALT, qd=self.qd, u=given)
        self.data = data_of(self.animation)
        torques, frames = self.data["torques"], self.data["frames"]
        self.unit, self.joule = torques["unit"], torques["joule"]
        self.terms = np.array([read(term, frames, self.unit) for term in torques["values"][0]])
        names = [store["name"] for store in torques["stores"]]
        columns = read(torques["energies"][0], frames, self.joule)
        self.energies = dict(zip(names, columns, strict=True))
        self.times = self.data["start"] + self.data["step"] * np.arange(frames)

    def at_frames(self, values):
        """(T, ...) at the times of the frames, (..., frames)."""
        columns = np.reshape(values, (len(self.t), -1)).T
        found = np.array([np.interp(self.times, self.t, column) for column in columns])
        return found if np.ndim(values) > 1 else found[0]


@pytest.fixture(scope="module", params=["free", "driven", "rod", "chain"])
def shown(request):
    return {
        "free": lambda: Shown(FREE, [-0.35, 1.2, 0.0, 0.0]),
        "driven": lambda: Shown(RUBBING, [-0.35, 1.2, 0.0, 0.0], motors),
        "rod": lambda: Shown(ROD, [2.0, 0.0]),
        "chain": lambda: Shown(CHAIN, [0.3, 0.4, 0.5, 0.0, 0.0, 0.0]),
    }[request.param]()


def test_at_each_frame_and_joint_the_terms_sum_to_u(shown):
    inertia, velocity, gravity, friction, u = shown.terms
    assert np.abs(inertia).max() > 100 * shown.unit
    # Each of the five is rounded to a whole unit by itself.
    apart = inertia + velocity + gravity + friction - u
    assert np.abs(apart).max() <= 2.5 * shown.unit + 1e-9


def test_each_term_is_that_of_the_motion(shown):
    inertia, velocity, gravity, friction, u = shown.terms
    model, q, qd = shown.model, shown.q, shown.qd
    near = 0.5 * shown.unit + 0.01 * np.abs(inertia).max()  # between the times of the motion
    measured = np.gradient(qd, shown.t, axis=0)
    apart = np.abs(inertia - shown.at_frames(np.matvec(model.M(q), measured)))
    # Where Coulomb friction jumps, so does q̈, and a difference across the jump misses it.
    assert np.mean(apart > near) < 0.05
    for term, expected in (
        (velocity, np.matvec(model.C(q, qd), qd)),
        (gravity, model.g_vec(q)),
        (u, np.zeros_like(q) if shown.u is None else shown.u(shown.t)),
    ):
        assert term == pytest.approx(shown.at_frames(expected), abs=near)
    assert np.mean(np.abs(friction - shown.at_frames(model.f_vec(qd))) > near) < 0.05
    has_friction = isinstance(model, Pendulum) or shown.u is not None
    assert np.any(friction) == has_friction
    assert np.any(velocity) == (model.n > 1)


def test_the_energies_are_the_models_and_balance(shown):
    kinetic, potential, total = (
        shown.energies[name] for name in ("kinetic K", "potential P", "total E = K + P")
    )
    half = 0.5 * shown.joule + 1e-9
    fine = 0.01 * np.abs(kinetic).max()
    model, q, qd = shown.model, shown.q, shown.qd
    assert kinetic == pytest.approx(shown.at_frames(model.kinetic_energy(q, qd)), abs=half + fine)
    assert potential == pytest.approx(shown.at_frames(model.potential_energy(q)), abs=half + fine)
    assert np.abs(kinetic + potential - total).max() <= 3 * half
    taken = shown.energies.get("taken by friction", 0 * total)
    given = shown.energies.get("given by motors", 0 * total)
    assert np.abs(total - total[0] - given + taken).max() <= 4 * half + 0.01
    assert ("taken by friction" in shown.energies) == bool(np.any(shown.terms[3]))
    assert ("given by motors" in shown.energies) == (shown.u is not None)
    assert np.all(np.diff(taken) >= 0)
    if shown.u is None and np.all(taken == 0):
        assert np.ptp(total) <= 1.01 * shown.joule  # no flicker of a number that stays


def test_ten_seconds_are_under_50_kb(shown):
    assert len(html_of(shown.animation).encode()) < 50_000
    assert shown.data["step"] < 1 / 12


def test_the_longest_and_busiest_is_under_50_kb_too():
    chain = PlanarChain((0.3,) * 6, (0.15,) * 6, (1.0,) * 6, (0.02,) * 6, viscous=(0.1,) * 6)
    t = np.linspace(0, 2, 400)
    rates = np.random.default_rng(1).normal(0, 2, (5, 1, 6))
    q = 3 * np.sin(rates * t[:, np.newaxis] + rates)
    qd = 3 * rates * np.cos(rates * t[:, np.newaxis] + rates)
    u = 50 * np.sin(9 * q)
    animation = Animation(chain, t, q, ALT, speed=1.5, names="abcde", qd=qd, u=u)
    assert len(html_of(animation).encode()) < 50_000
    with pytest.raises(ValueError, match=r"^t: 2 s of watching do not fit .* show a part"):
        Animation(chain, t, q, ALT, names="abcde", qd=qd, u=u)


def test_a_number_that_stays_is_stored_once():
    free = Shown(FREE, [-0.35, 1.2, 0.0, 0.0], t=T[:41]).data["torques"]
    assert free["values"][0][3:] == [[[0], [0]], [[0], [0]]]
    held = Animation(FREE, [0, 1], [[0.0, 0.0]] * 2, ALT, qd=np.zeros((2, 2)), u=FREE.g_vec([0, 0]))
    torques = data_of(held)["torques"]
    inertia, _, gravity, _, u = torques["values"][0]
    assert inertia == [[0], [0]]
    assert gravity == u
    assert np.array(u)[:, 0] * torques["unit"] == pytest.approx([42.18, 7.848], abs=0.05)


def test_arcs_have_one_easy_unit_and_the_colours_of_the_bars(shown):
    torques = shown.data["torques"]
    assert [term["colour"] for term in torques["terms"]] == [colour for _, colour, _ in TERMS]
    dashes = [term["dash"] for term in torques["terms"]]
    assert len(set(dashes)) == len(dashes)
    peaks = np.abs(shown.terms).max(axis=(0, 1))
    turns = peaks / torques["quarter"]  # quarters of a turn
    assert np.mean(turns <= 2.5 + 1e-6) >= 0.89
    assert np.quantile(turns, 0.9) > 1.2
    assert float(f"{torques['quarter']:.2g}") == torques["quarter"]


def test_of_several_motions_each_has_its_own():
    starts = [[1.2, 0.3, 0, 0], [-1.2, -0.3, 0, 0]]
    t = T[:101]
    x = simulate(FREE.state_derivative, starts, [0, 0], t)
    both = data_of(Animation(FREE, t, x[..., :2], ALT, qd=x[..., 2:]))
    torques, frames = both["torques"], both["frames"]
    for k in range(2):
        alone = data_of(Animation(FREE, t, x[k, :, :2], ALT, qd=x[k, :, 2:]))
        one = alone["torques"]
        for of, all_of in zip(one["values"][0], torques["values"][k], strict=True):
            ends = read(of, alone["frames"], one["unit"])[:, [0, -1]]
            same = read(all_of, frames, torques["unit"])[:, [0, -1]]
            assert same == pytest.approx(ends, abs=0.51 * (one["unit"] + torques["unit"]))
    assert torques["values"][0] != torques["values"][1]


def test_at_rest_without_gravity_there_is_nothing_to_divide_by():
    flat = Planar2R(*LINKS, g=0.0)
    torques = data_of(Animation(flat, [0, 1], np.zeros((2, 2)), ALT, qd=np.zeros((2, 2))))[
        "torques"
    ]
    assert torques["quarter"] == 1
    assert np.all(np.array(torques["values"]) == 0)


def test_a_motion_without_velocities_brings_no_code_for_torques():
    plain = html_of(Animation(FREE, T, np.zeros((len(T), 2)), ALT))
    assert data_of(Animation(FREE, T, np.zeros((len(T), 2)), ALT))["torques"] is None
    assert "N·m" not in plain
    assert "@" not in plain.replace("@media", "")


def test_a_model_that_cannot_be_drawn_is_refused():
    with pytest.raises(TypeError, match="plotting draws a Pendulum, a Planar2R or a PlanarChain"):
        Animation(Cart(), [0, 1], [[0], [1]], ALT, qd=[[0], [1]])
