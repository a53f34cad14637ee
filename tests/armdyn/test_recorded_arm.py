"""Lesson 12's figures of a real arm: fitted to three runs, it predicts a fourth.

The record is that of a double pendulum with two motors, and the project may not contain it. It is
looked for in the folder that ARMDYN_RECORDED_ARM names: run1.csv, run2.csv, run3.csv and unseen.csv,
with q1 measured from hanging down.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from armdyn import Planar2R
from armdyn.base_parameters import base_parameters, on_link_axes
from armdyn.energy_regressor import energy_regressor
from armdyn.identify import identify
from armdyn.recording import Motion, Recording, motion
from armdyn.recording_file import read
from armdyn.regressor import friction_columns, parameters

# As published; the inertias are about the joints.
L1, LC1, LC2, M1, M2 = 0.2, 0.2, 0.25569, 0.52346, 0.62557
ARM = Planar2R(L1, 0.3, LC1, LC2, M1, M2, 0.031887 - M1 * LC1**2, 0.05087 - M2 * LC2**2)
FITTED = ("run1", "run2", "run3")


@pytest.fixture(scope="module")
def runs() -> dict[str, Recording]:
    folder = os.environ.get("ARMDYN_RECORDED_ARM")
    if not folder:
        pytest.skip(
            "set ARMDYN_RECORDED_ARM to the folder of a recorded arm, which is not part of the project"
        )
    files = {name: read(Path(folder, f"{name}.csv")) for name in (*FITTED, "unseen")}
    return {name: Recording(r.t, r.q - [np.pi / 2, 0], r.u) for name, r in files.items()}


def fitted(runs, cutoff, friction=True):
    """The fit of three runs, and R² of each joint's torque in the fourth."""
    parts = [motion(runs[name], cutoff) for name in FITTED]
    _, *samples = (np.concatenate(part) for part in zip(*parts, strict=True))
    found = identify(ARM, *samples, friction=friction, columns=on_link_axes(ARM))
    new = motion(runs["unseen"], cutoff)
    missed = new.u - found.torque(new.q, new.qd, new.qdd)
    return found, 1 - np.var(missed, axis=0) / np.var(new.u, axis=0)


def shares(found) -> np.ndarray:
    """The base parameters as shares of the published ones."""
    base = found.base
    return found.estimate[: base.rank] / (base.combination @ parameters(ARM))


def of_energies(moved: Motion, window=0.3):
    """Rows and right sides of the balance of energy over each window: no q̈ is in it."""
    base = base_parameters(ARM, on_link_axes(ARM))
    energies = energy_regressor(ARM, moved.q, moved.qd)[:, list(base.independent)]
    lost = np.einsum("tj,tjp->tp", moved.qd, friction_columns(moved.qd))
    step = moved.t[1] - moved.t[0]
    rows = np.hstack([energies, np.cumsum(lost, axis=0) * step])
    work = np.cumsum(np.vecdot(moved.u, moved.qd)) * step
    k = round(window / step)
    return rows[k:] - rows[:-k], work[k:] - work[:-k]


def test_with_friction_it_predicts_the_unseen_run(runs):
    found, explained = fitted(runs, cutoff=6.0)
    assert np.all(explained >= 0.9)
    assert found.consistent
    _, without = fitted(runs, cutoff=6.0, friction=False)
    assert np.all(without < 0.85)


@pytest.mark.parametrize(
    ("cutoff", "mean", "explained"),
    [
        (5, 0.86, (0.93, 0.94)),
        (6, 0.84, (0.92, 0.94)),
        (8, 0.78, (0.88, 0.93)),
        (15, 0.48, (0.67, 0.79)),
    ],
)
def test_the_common_factor_falls_as_the_cutoff_rises(runs, cutoff, mean, explained):
    found, r_squared = fitted(runs, cutoff)
    assert shares(found).mean() == pytest.approx(mean, abs=0.006)
    np.testing.assert_allclose(r_squared, explained, atol=0.006)
    if cutoff == 8:
        np.testing.assert_allclose(shares(found), [0.76, 0.79, 0.78, 0.78], atol=0.006)


def test_in_run_3_the_arm_swings_by_itself(runs):
    moved = motion(runs["run3"], 6.0)
    by_inertia = np.matvec(ARM.M(moved.q), moved.qdd)
    parts = [moved.u, by_inertia, ARM.g_vec(moved.q)]
    found = [part[:, 0].std() for part in parts]
    np.testing.assert_allclose(found, [0.02, 1.33, 1.15], atol=0.006)


def test_of_energies_it_hardly_depends_on_the_cutoff(runs):
    mean = []
    for cutoff in (6.0, 15.0):
        parts = [of_energies(motion(runs[name], cutoff)) for name in FITTED]
        rows, work = (np.concatenate(part) for part in zip(*parts, strict=True))
        estimate = np.linalg.lstsq(rows, work)[0]
        base = base_parameters(ARM, on_link_axes(ARM))
        mean.append((estimate[:4] / (base.combination @ parameters(ARM))).mean())
    assert abs(mean[0] - mean[1]) < 0.02
    assert abs(mean[0] - 0.88) < 0.02
