"""Mistakes in the two sweeps: each is a sweep in which something counts wrongly, or not at all."""

from types import SimpleNamespace

import numpy as np

from autograder.problems.c7_recursive.axes_mistakes import AXES, rows
from autograder.problems.c7_recursive.sweeps import Sweeps
from autograder.problems.c7_recursive.wrong_sweeps import (
    AlwaysDown,
    FirstLeftOut,
    LastLeftOut,
    Reversed,
)

# The chain of the notebook's set-up cell.
EXAMPLE = SimpleNamespace(
    axis=np.array([[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [0.0, -0.8, 0.6]]),
    offset=np.array([[0.0, 0.0, 0.3], [0.05, 0.0, 0.25], [0.42, 0.02, 0.0]]),
    m=np.array([6.2, 4.1, 2.3]),
    com=np.array([[0.01, 0.02, 0.12], [0.2, 0.01, 0.03], [0.17, -0.02, 0.04]]),
    I=np.array(
        [np.diag([0.06, 0.05, 0.03]), np.diag([0.012, 0.09, 0.085]), np.diag([0.005, 0.03, 0.028])]
    ),
    viscous=np.array([0.8, 0.6, 0.3]),
    gravity=np.array([0.0, 0.0, -9.81]),
)

CENTRIPETAL = (
    "In your outward sweep a point of a turning link has no acceleration towards the axis. What "
    "acceleration has the end of a sling that turns evenly?"
)
OUTWARDS = (
    "In your outward sweep a point of a turning link is accelerated away from the axis. Which way does "
    "the string pull a stone that turns evenly on it?"
)
ORDER_OF_ALONG = (
    "What the angular acceleration adds to a point's acceleration has the wrong sign. In which order do "
    "the factors of this cross product stand?"
)
ORDER_OF_MOMENT = (
    "In your inward sweep a force has its moment with the wrong sign. In which order do force and lever "
    "arm stand in the cross product?"
)
HANDED_DOWN = (
    "Your inward sweep loses something on its way to the base. A joint carries all links beyond "
    "it: which two things does the next link hand down?"
)
FOR_A_VELOCITY = (
    "In your outward sweep the velocity of a point stands where its acceleration towards the axis "
    "belongs. How does this velocity change while the link turns evenly?"
)
OFFSETS = (
    "You take a wrong place for the next joint. Which entry of offset says where joint k + 1 sits on "
    "link k?"
)
CENTRE_FOR_JOINT = (
    "You carry on at the centre of mass of the link, as if the next joint sat there. Which of "
    "the chain's vectors leads to the next joint?"
)


SWEEPS = rows(
    (
        "gravity missing",
        Sweeps(gravity=0.0),
        "Your torques do not feel gravity. How does your outward sweep start: what does it take for "
        "the acceleration of the base?",
    ),
    (
        "sign of gravity",
        Sweeps(gravity=-1.0),
        "Your gravity pulls the wrong way. chain.gravity points down. A lift that starts presses you "
        "to its floor: which way must the base accelerate to load the links as gravity does?",
    ),
    (
        "gravity twice",
        Sweeps(weight=1.0),
        "Your links are twice as heavy as they should be. The base that accelerates and the weight of "
        "each link are two ways to say one thing.",
    ),
    (
        "9.81 downwards",
        AlwaysDown(),
        "Your gravity is always 9.81 m/s² along −z. The check also takes the chain to other places, and "
        "hangs it from walls: which entry of chain says where gravity points?",
    ),
    (
        "gyroscopic term missing",
        Sweeps(gyro=0.0),
        "In your Euler's equation the angular momentum changes only with the angular velocity. But it "
        "turns with the link: which part of its rate is left even at constant angular velocity?",
    ),
    (
        "sign of the gyroscopic term",
        Sweeps(gyro=-1.0),
        "In your Euler's equation one of two parts has the wrong sign. In which order do the factors "
        "of a cross product stand?",
    ),
    ("no centripetal acceleration of the joint", Sweeps(joint_centre=0.0), CENTRIPETAL),
    ("no centripetal acceleration of the centre", Sweeps(centre=0.0), CENTRIPETAL),
    ("no centripetal acceleration", Sweeps(joint_centre=0.0, centre=0.0), CENTRIPETAL),
    ("centripetal acceleration of the joint outwards", Sweeps(joint_centre=-1.0), OUTWARDS),
    ("centripetal acceleration of the centre outwards", Sweeps(centre=-1.0), OUTWARDS),
    ("centripetal acceleration outwards", Sweeps(joint_centre=-1.0, centre=-1.0), OUTWARDS),
    ("velocity of the joint for its acceleration", Sweeps(joint_inwards="once"), FOR_A_VELOCITY),
    ("velocity of the centre for its acceleration", Sweeps(inwards="once"), FOR_A_VELOCITY),
    (
        "velocities for accelerations",
        Sweeps(joint_inwards="once", inwards="once"),
        FOR_A_VELOCITY,
    ),
    (
        "centripetal acceleration of the plane",
        Sweeps(joint_inwards="plane", inwards="plane"),
        "Your acceleration towards the axis is that of the plane, where r is at right angles to ω. In "
        "space r also has a part along ω: how is a point accelerated that lies on the axis?",
    ),
    (
        "next joint from the centre",
        Sweeps(from_centre=True),
        "In your outward sweep the acceleration of the next joint starts from that of the centre of "
        "mass. From which point of the link does offset lead to the next joint?",
    ),
    ("sign of the angular acceleration at the joint", Sweeps(joint_along=-1.0), ORDER_OF_ALONG),
    ("sign of the angular acceleration at the centre", Sweeps(along=-1.0), ORDER_OF_ALONG),
    ("sign of the angular acceleration", Sweeps(joint_along=-1.0, along=-1.0), ORDER_OF_ALONG),
    (
        "no angular acceleration at the joint",
        Sweeps(joint_along=0.0),
        "The next joint does not feel how the link speeds up its turning. Two parts of its "
        "acceleration come from the turning: which of them have you written?",
    ),
    (
        "no angular acceleration at the centre",
        Sweeps(along=0.0),
        "The centre of mass does not feel how the link speeds up its turning. Two parts of its "
        "acceleration come from the turning: which of them have you written?",
    ),
    (
        "moment arm of the link's own force missing",
        Sweeps(lever=0.0),
        "Your moment of each link is the one about its centre of mass. About which point does the "
        "motor turn the link, and where does the link's force act?",
    ),
    (
        "moment arm of the next link's force missing",
        Sweeps(arm=0.0),
        "The next link pulls at the far end of this link, and in your inward sweep this force has no "
        "moment about the joint. What is its lever arm?",
    ),
    ("sign of the moment of the link's own force", Sweeps(lever=-1.0), ORDER_OF_MOMENT),
    ("sign of the moment of the next link's force", Sweeps(arm=-1.0), ORDER_OF_MOMENT),
    ("sign of both moments", Sweeps(lever=-1.0, arm=-1.0), ORDER_OF_MOMENT),
    (
        "centre as the arm of the whole force",
        Sweeps(lever_of_all=True),
        "You give the force that the next link hands down a second moment, as if it also pulled at "
        "the centre of mass. Where does this force act, and where does the link's own?",
    ),
    (
        "about the joint before",
        Sweeps(about_before=True),
        "The moment of which you take the motor's part is the one about the joint before. About which "
        "point does motor k turn its links?",
    ),
    ("force not handed down", Sweeps(force=0.0), HANDED_DOWN),
    ("torque not handed down", Sweeps(torque=0.0), HANDED_DOWN),
    ("nothing handed down", Sweeps(torque=0.0, arm=0.0), HANDED_DOWN),
    (
        "inertia about the joint",
        Sweeps(parallel=1.0),
        "You carry the inertia over to the joint, and also give the link's force a moment about the "
        "joint. One of them is enough: about which point do you write Euler's equation?",
    ),
    (
        "inertia about the joint, without the force",
        Sweeps(parallel=1.0, lever=0.0),
        "You carry the inertia over to the joint, and leave out the moment of the link's force. That "
        "would do if the joint were at rest. Is it?",
    ),
    (
        "angular acceleration of the link before missing",
        Sweeps(turn=0.0),
        "Each of your links has only its own joint's angular acceleration. What else turns it faster?",
    ),
    (
        "angular velocity of the link before missing",
        Sweeps(spin=0.0),
        "Each of your links has only its own joint's angular velocity. Who carries the joint?",
    ),
    (
        "turning of the axis missing",
        Sweeps(twist=0.0),
        "You add up the accelerations of the joints. But the axis of a joint turns with the link "
        "before: how does that change the angular velocity, even if all rates are constant?",
    ),
    (
        "turning of the axis with the wrong sign",
        Sweeps(twist=-1.0),
        "A joint's axis turns with the link before, and you take this with the wrong sign. In which "
        "order do the factors of the cross product stand?",
    ),
    (
        "acceleration of the joint missing",
        Sweeps(own_turn=0.0),
        "Your torques do not feel the joints' accelerations. Where does your outward sweep use qdd?",
    ),
    ("centre for the next joint outwards", Sweeps(joint_at="com"), CENTRE_FOR_JOINT),
    ("centre for the next joint inwards", Sweeps(arm_at="com"), CENTRE_FOR_JOINT),
    ("centre for the next joint", Sweeps(joint_at="com", arm_at="com"), CENTRE_FOR_JOINT),
    ("own offset outwards", Sweeps(joint_at="before"), OFFSETS),
    ("own offset inwards", Sweeps(arm_at="before"), OFFSETS),
    ("own offset", Sweeps(joint_at="before", arm_at="before"), OFFSETS),
    (
        "third component",
        Sweeps(part="third"),
        "You take the third component of the moment at each joint. This is the motor's part only if "
        "the joint turns about its z axis. About which line does joint k turn?",
    ),
    (
        "length of the moment",
        Sweeps(part="length"),
        "You take the length of the moment at each joint. Which part of it does the motor give, and "
        "which the bearing?",
    ),
    (
        "no part with the angular acceleration",
        Sweeps(euler=0.0),
        "Your Euler's equation has only the part that is left at constant angular velocity. What must "
        "turn a link faster?",
    ),
    (
        "no rotational inertia",
        Sweeps(euler=0.0, gyro=0.0),
        "Your links are point masses: their own inertia does nothing. Which of chain's entries have "
        "you not used yet?",
    ),
    (
        "friction missing",
        Sweeps(friction=0.0),
        "Your joints turn without friction. Which term of the equation of motion is neither weight nor "
        "inertia?",
    ),
    (
        "sign of friction",
        Sweeps(friction=-1.0),
        "Your friction helps the motor. On which side of the equation of motion does f(q̇) stand?",
    ),
    (
        "first joint left out",
        FirstLeftOut(),
        "The torque of the first joint is 0 in your result. At which link does your inward loop end?",
    ),
    (
        "last link left out",
        LastLeftOut(),
        "The last link loads no joint in your result. At which link does your inward loop begin?",
    ),
    (
        "order of the joints",
        Reversed(),
        "Your torques are right, but come in reverse order. Your inward sweep finds the last joint's "
        "torque first: where in the result does it belong?",
    ),
)
RNEA = (*SWEEPS, *AXES)
