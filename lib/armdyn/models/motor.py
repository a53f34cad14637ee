"""The inertia of a motor behind a gear, as its joint feels it."""

import numpy as np
from numpy.typing import ArrayLike

from armdyn.parameters import all_finite, real_array


def reflected_inertia(rotor_inertia: ArrayLike, gear_ratio: ArrayLike) -> np.ndarray:
    """Gear ratio² × rotor inertia: the `armature` of a `SerialChain`, (...).

    rotor_inertia: (...), kg·m², of what turns with the motor's shaft, about that shaft. gear_ratio:
    (...), turns of the motor per turn of the joint, of either sign; for a prismatic joint the motor's
    angle per displacement, rad/m. The result is in kg·m² for a revolute joint, in kg for a prismatic
    one.

    The energy ½ J (r q̇)² of the rotor's spin in its housing is all that this counts. It leaves out
    that the link which carries the motor turns as well: its turning about the shaft adds to the
    rotor's, and a spinning rotor resists the turning of its shaft as a gyroscope does. Both effects
    are about r times smaller than what is counted.

    Raises ValueError, naming the argument, for a negative rotor inertia, for what is not finite real
    numbers, and for shapes that do not broadcast.

    Source: M. W. Spong (1987), Modeling and Control of Elastic Joint Robots, Journal of Dynamic
    Systems, Measurement, and Control 109(4), for the assumption.
    """
    rotor = all_finite("rotor_inertia", real_array("rotor_inertia", rotor_inertia))
    ratio = all_finite("gear_ratio", real_array("gear_ratio", gear_ratio))
    if np.any(rotor < 0):
        raise ValueError(f"rotor_inertia = {rotor_inertia!r}: must not be negative (kg·m²)")
    try:
        np.broadcast_shapes(rotor.shape, ratio.shape)
    except ValueError:
        raise ValueError(
            f"rotor_inertia {rotor.shape}, gear_ratio {ratio.shape}: needs shapes that broadcast, "
            "such as one number per joint in each"
        ) from None
    return ratio**2 * rotor
