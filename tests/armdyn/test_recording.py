"""Recordings: what is refused, and what a filter and derivatives make of a motion that is known."""

import numpy as np
import pytest

from armdyn.recording import Recording, motion, resample

RATES = np.array([2.0, 3.1])


def swing(t):
    """q, q̇, q̈ of two sines."""
    angle = RATES * np.asarray(t)[..., np.newaxis]
    return np.sin(angle), RATES * np.cos(angle), -(RATES**2) * np.sin(angle)


def recorded(seconds=10.0, rate=200, uneven=0.0, noise=0.0, delay=0.0):
    """Angles of the swing, and as torque its acceleration, recorded later by `delay`."""
    rng = np.random.default_rng(12)
    t = np.arange(0, seconds, 1 / rate)
    t = t + rng.uniform(-uneven, uneven, t.shape) / rate
    q = swing(t)[0] + rng.normal(0, 1, (len(t), 2)) * noise
    return Recording(t, q, swing(t - delay)[2])


@pytest.mark.parametrize("uneven", [0.0, 0.3])
def test_derivatives_of_a_known_motion(uneven):
    got = motion(recorded(uneven=uneven), cutoff=20)
    for mine, right in zip(got[1:4], swing(got.t), strict=True):
        np.testing.assert_allclose(mine, right, atol=1e-2)
        np.testing.assert_allclose(mine[100:-100], right[100:-100], atol=2e-4)
    np.testing.assert_allclose(got.u, got.qdd, atol=1e-2)
    assert np.ptp(np.diff(got.t)) < 1e-9


def test_the_same_filter_shrinks_angles_and_torques_alike():
    # Far too low a cutoff: both are wrong, and still fit each other.
    got = motion(recorded(seconds=60), cutoff=0.45)
    shrunk = got.u.std(axis=0) / swing(got.t)[2].std(axis=0)
    assert np.all(shrunk < [0.95, 0.6])
    np.testing.assert_allclose(got.u, got.qdd, atol=0.02)


def test_noise_counts_less_below_a_cutoff():
    def error(cutoff):
        got = motion(recorded(noise=1e-3), cutoff)
        return (got.qdd - swing(got.t)[2]).std()

    # White noise in q̈ grows with the cutoff to the power 5/2: by 32 from 4 to 16 Hz.
    assert 15 < error(16) / error(4) < 60
    assert error(4) < 0.1


@pytest.mark.parametrize("delay", [0.02, -0.013])
def test_a_delay_is_taken_out(delay):
    late = recorded(delay=delay)
    assert np.max(np.abs(motion(late, 20).u - motion(late, 20).qdd)) > 0.1
    got = motion(late, 20, delay)
    np.testing.assert_allclose(got.u, got.qdd, atol=1e-2)
    assert resample(late, delay).t[-1] <= late.t[-1] + 1e-12


def test_resampling_keeps_what_is_even():
    given = recorded()
    again = resample(given)
    np.testing.assert_allclose(again.t, given.t, atol=1e-12)
    np.testing.assert_allclose(again.q, given.q, atol=1e-12)
    assert given.rate == pytest.approx(200)


def test_a_gap_is_not_filled():
    t = np.r_[np.arange(0, 1, 0.01), np.arange(1.5, 3, 0.01)]
    with pytest.raises(ValueError, match=r"gap of 0.51 s at 0.99 s, .*; cut the recording there"):
        motion(Recording(t, swing(t)[0], swing(t)[2]), 5)


@pytest.mark.parametrize(
    ("seconds", "cutoff", "says"),
    [
        (10, 0, "cutoff = 0: needs a number of Hz between 0 and 100"),
        (10, 101, "cutoff = 101: needs"),
        (10, float("nan"), "cutoff = nan: needs"),
        (0.5, 5, "lasts 0.495 s, too short for a cutoff of 5 Hz, which needs 1.8 s"),
        (0.015, 5, "3 samples in 0.01 s, with a delay of 0 s; too short"),
    ],
)
def test_what_cannot_be_filtered(seconds, cutoff, says):
    with pytest.raises(ValueError, match=says):
        motion(recorded(seconds), cutoff)


def test_a_delay_longer_than_the_recording():
    with pytest.raises(ValueError, match="with a delay of 11 s; too short"):
        motion(recorded(10), 5, delay=11)


@pytest.mark.parametrize(
    ("t", "q", "u", "says"),
    [
        ([0, 1], [[0], [1]], [[0, 0], [1, 1]], r"u: got shape \(2, 2\), needs that of q"),
        ([0, 1], [0, 1], [0, 1], r"q: got shape \(2,\), needs \(T, n\)"),
        ([0, 1], [[0]], [[0]], r"q: got shape \(1, 1\)"),
        ([[0, 1]], [[0]], [[0]], r"t: got shape \(1, 2\), needs \(T,\)"),
        (0.0, [[0]], [[0]], r"t: got shape \(\), needs \(T,\)"),
        ([0], [[0]], [[0]], "got 1 samples, needs at least 2"),
        ([0, 1], [[0], [np.nan]], [[0], [1]], "q: sample 1 is not finite"),
        ([0, 1, 1], [[0]] * 3, [[0]] * 3, "t: sample 2 is 1 s, after 1 s; needs increasing times"),
    ],
)
def test_what_is_no_recording(t, q, u, says):
    with pytest.raises(ValueError, match=says):
        Recording(t, q, u)
