"""The checks of lesson 07, the planar 2R arm."""

from math import hypot, radians

from autograder.lesson_checks.arm import ARM
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("07-hand", "p1-M", "p2-C", "p4-g_vec"),
    2: ("07-load", "07-push"),
    3: ("07-degrees",),
    4: ("07-reversed",),
}

# At q = (0, 90°), q̇ = (1, 2): link 1 lies along x, link 2 stands up and turns with q̇1 + q̇2.
HAND = Number(
    id="07-hand",
    text="the speed of the hand",
    unit="m/s",
    right=hypot(ARM.l1 * 1, ARM.l2 * (1 + 2)),
    wrong=(
        WrongNumber(
            "rate of joint 2 alone",
            hypot(ARM.l1 * 1, ARM.l2 * 2),
            "You let link 2 turn with the rate of joint 2 alone. How fast does its angle with the "
            "x axis change?",
        ),
        WrongNumber(
            "centre of mass",
            hypot(ARM.l1 * 1, ARM.lc2 * (1 + 2)),
            "This is the speed of link 2's centre of mass. Where is the hand?",
        ),
        WrongNumber(
            "speeds added",
            ARM.l1 * 1 + ARM.l2 * (1 + 2),
            "You added two speeds. The two velocities are vectors: which angle is between them "
            "here?",
        ),
        WrongNumber(
            "one rigid body",
            hypot(ARM.l1, ARM.l2),
            "You let the whole arm turn with the rate of joint 1, as if joint 2 were locked.",
        ),
        WrongNumber(
            "squared",
            hypot(ARM.l1 * 1, ARM.l2 * (1 + 2)) ** 2,
            "This is the square of the speed.",
        ),
        WrongNumber(
            "relative to the elbow",
            ARM.l2 * (1 + 2),
            "This is how fast the hand moves round the elbow. And the elbow itself?",
        ),
        WrongNumber(
            "speed of the elbow",
            ARM.l1 * 1,
            "This is the speed of the elbow. How does the hand move relative to it?",
        ),
    ),
    otherwise=(
        "Put the hand where the second centre of mass stands in the lines above: which length is "
        "another? Draw the two velocities that add up."
    ),
    further="Most mistakes in M of this arm are made here: link 2 turns with both joints.",
    hints=(
        "The hand is a point of link 2, like its centre of mass, but at another distance from the "
        "elbow.",
        "In this pose the elbow moves upwards, and the hand moves round the elbow to the left. How "
        "fast is each, and how do two velocities at a right angle add up?",
    ),
)

LOAD = 1.0  # kg, in the hand
OUT = ARM.l1**2 + ARM.l2**2  # the hand's distance from joint 1, squared, with the elbow at 90°
LOADED = Number(
    id="07-load",
    text="what the load adds to M11",
    unit="kg·m²",
    right=LOAD * OUT,
    wrong=(
        WrongNumber(
            "stretched",
            LOAD * (ARM.l1 + ARM.l2) ** 2,
            "This is what it adds while the arm is stretched out. How far from joint 1 is the hand "
            "when the elbow is bent?",
        ),
        WrongNumber(
            "about joint 2",
            LOAD * ARM.l2**2,
            "This is what M22 gains. About which joint does the arm turn in M11?",
        ),
        WrongNumber(
            "at the centre of mass",
            LOAD * (ARM.l1**2 + ARM.lc2**2),
            "You put the load at the centre of mass of link 2. Where is the hand?",
        ),
        WrongNumber(
            "distance not squared",
            LOAD * OUT**0.5,
            "You took the distance itself. How does a distance enter an inertia?",
        ),
        WrongNumber(
            "halved",
            LOAD * OUT / 2,
            "This is half of it. The ½ stands before M in the energy, and not in M.",
        ),
        WrongNumber(
            "all of M11",
            ARM.I1 + ARM.I2 + ARM.m1 * ARM.lc1**2 + ARM.m2 * (ARM.l1**2 + ARM.lc2**2) + LOAD * OUT,
            "This is all of M11, with the load. What does the load alone add?",
        ),
        WrongNumber(
            "at the elbow",
            LOAD * ARM.l1**2,
            "This load hangs at the elbow. How far from joint 1 is the hand?",
        ),
    ),
    otherwise=(
        "Lock joint 2: arm and load turn about joint 1 as one body. What is the inertia of a small "
        "body at that distance?"
    ),
    further="Each entry can be tested like this: add one mass, and see the one number that must change.",
    hints=(
        "M11 is the inertia of the whole arm as one rigid body. A point mass adds to it as to any "
        "body.",
        "The shoulder, the elbow and the hand make a triangle with a right angle at the elbow.",
    ),
)

PUSH = Choice(
    id="07-push",
    text="which way link 1 begins to turn, and why",
    options=(
        Option(
            "Clockwise both times: a motor always pushes back on the link that carries it.",
            "It does push back. But link 1 also has to carry link 2's mass along, and where that "
            "mass goes depends on the pose. Which curve of section 6 knows?",
        ),
        Option(
            "Clockwise with the straight arm, counter-clockwise with the folded one: an entry of "
            "$M$ changes its sign.",
        ),
        Option(
            "Counter-clockwise both times: link 2 drags link 1 along.",
            "Think of the straight arm as a boat, and of link 2 as somebody in it who begins to "
            "walk. Which way does the boat go?",
        ),
        Option(
            "Not at all: motor 1 is off, so joint 1 has no reason to move.",
            "Without a motor the torque of joint 1 is zero. Is its acceleration zero then, when "
            "joint 2 accelerates?",
        ),
    ),
    further="A motor moves every joint that its acceleration is coupled with, also those that are free.",
    hints=(
        "Write down the first of the two equations, at rest, without gravity, with nothing on its "
        "right side.",
        "Joint 2 accelerates counter-clockwise both times. Which entry of M decides what joint 1 "
        "does, and how does it look in the picture of section 6?",
    ),
)

M11 = ARM.I1 + ARM.I2 + ARM.m1 * ARM.lc1**2 + ARM.m2 * (ARM.l1**2 + ARM.lc2**2)  # at q2 = 90°
DEGREES = Number(
    id="07-degrees",
    text="the first entry of M where angles are in degrees",
    unit="J·s²/deg²",
    right=M11 * radians(1) ** 2,
    wrong=(
        WrongNumber(
            "once",
            M11 * radians(1),
            "You multiplied once. How often does the change of coordinates stand in the new matrix?",
        ),
        WrongNumber(
            "unchanged",
            M11,
            "You left it as it was. A joint that turns by one unit now turns much less: is the "
            "energy the same number?",
        ),
        WrongNumber(
            "the other way",
            M11 / radians(1) ** 2,
            "You turned the factor around. Is one degree per second more energy than one radian "
            "per second, or less?",
        ),
        WrongNumber(
            "once, the other way",
            M11 / radians(1),
            "You multiplied once, and with the factor turned around. Is one degree per second more "
            "than one radian per second?",
        ),
        WrongNumber(
            "halved",
            M11 * radians(1) ** 2 / 2,
            "This is the energy at one degree per second. Where does the ½ belong?",
        ),
        WrongNumber(
            "half a turn for a whole one",
            M11 * radians(2) ** 2,
            "Your factor is twice as large as it should be. How many degrees has half a turn?",
        ),
    ),
    otherwise=(
        "Write the old angles by the new ones: which number is T, for each joint? Then the energy "
        "must be the same in both."
    ),
    further="The same happens to the torques, once: a torque belongs to a rad, or to a degree.",
    hints=(
        "How many rad is one degree? That number is T here, the same for both joints.",
        "The arm turns at one degree per second. Compute its energy with the old matrix: the new "
        "one must give the same.",
    ),
)

REVERSED = Choice(
    id="07-reversed",
    text="which test finds a P that is turned over",
    options=(
        Option(
            "Let the arm go and follow its energy: with the wrong sign it grows.",
            "Think of an arm in a world where gravity pulls up. Does its energy grow?",
        ),
        Option(
            "Test $M$: with the wrong sign it is no longer positive definite.",
            "From which of the two energies does M come?",
        ),
        Option(
            "Hold the arm where it hangs: that must take no torque.",
            "What becomes of a torque of zero when its sign is turned around? Would you see it?",
        ),
        Option(
            "Hold the arm stretched out level: that must take positive torques.",
        ),
    ),
    further="Only where right and wrong differ does a test find a mistake. Choose the pose for that.",
    hints=(
        "For each of the four tests: what would the wrong program give?",
        "The wrong program is a right one for another planet. Which of the four tests tells the "
        "planets apart?",
    ),
)

CHECKS = (HAND, LOADED, PUSH, DEGREES, REVERSED)
