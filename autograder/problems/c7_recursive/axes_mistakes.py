"""Mistakes in the two sweeps about axes: in whose a vector is given, and into whose it is turned."""

from autograder.judging.diagnosis import Mistake
from autograder.problems.c7_recursive.sweeps import Sweeps

FRAMES = "into the frame of the next link, or of the link before"
SIGN_OF_ANGLE = (
    "You turn vectors the wrong way. Your rotation matrix takes a vector from one frame to another: "
    "from which, and to which?"
)
NOT_TURNED = (
    f"You hand vectors on without turning them {FRAMES}. In whose axes are the components of each "
    "vector given?"
)
HANDED_ON = (
    "You hand the {} on without turning it. In whose axes are its components given, and in whose do you "
    "use them?"
)
NOT_WITH_THE_LINK = (
    "A vector or matrix of the chain is given in the axes of its link, which have turned with it. You "
    "use one of them as if its axes were still those of the base. "
)
ONE_BACKWARD = (
    "You turn the {} the wrong way. Your rotation matrix takes a vector from one frame to another: "
    "from which, and to which?"
)
OWN_AXES = (
    "In a cross product you use offset[k] as if it were given in the axes of link k. In whose axes does "
    "the table give it?"
)
CARRIED_BY = (
    "You find the acceleration of joint k with ω and ω̇ of link k. On which link does offset[k] lie?"
)
VECTORS = (
    ("omega", "angular velocity"),
    ("alpha", "angular acceleration"),
    ("a", "acceleration of the joint"),
    ("f", "force"),
    ("t", "moment"),
)


def rows(*given) -> tuple[Mistake, ...]:
    return tuple(Mistake(name, wrong, sentence) for name, wrong, sentence in given)


AXES = rows(
    ("turned the wrong way outwards", Sweeps(out=-1), SIGN_OF_ANGLE),
    ("turned the wrong way inwards", Sweeps(back=-1), SIGN_OF_ANGLE),
    ("turned the wrong way", Sweeps(out=-1, back=-1), SIGN_OF_ANGLE),
    ("not turned outwards", Sweeps(out=0), NOT_TURNED),
    ("not turned inwards", Sweeps(back=0), NOT_TURNED),
    ("not turned", Sweeps(out=0, back=0), NOT_TURNED),
    *(
        (f"{vector} not turned", Sweeps(unturned=name), HANDED_ON.format(vector))
        for name, vector in VECTORS
    ),
    *(
        (f"{vector} turned the wrong way", Sweeps(backward=name), ONE_BACKWARD.format(vector))
        for name, vector in VECTORS
    ),
    (
        "inertia not turned",
        Sweeps(in_base="I"),
        f"{NOT_WITH_THE_LINK}It is a matrix: how is it turned?",
    ),
    (
        "centre of mass not turned",
        Sweeps(in_base="com"),
        f"{NOT_WITH_THE_LINK}It says where a link's mass is.",
    ),
    (
        "axis not turned",
        Sweeps(in_base="axis"),
        f"{NOT_WITH_THE_LINK}It says about which line a joint turns.",
    ),
    (
        "offset not turned",
        Sweeps(in_base="offset"),
        f"{NOT_WITH_THE_LINK}It says where a joint sits, and its link is the one before.",
    ),
    (
        "weight not turned",
        Sweeps(gravity=0.0, weight=1.0, unturned="down"),
        "You give each link its weight as if its axes were still those of the base. In whose axes is "
        "chain.gravity given?",
    ),
    ("offset in the axes of its own link outwards", Sweeps(own_axes_out=True), OWN_AXES),
    ("offset in the axes of its own link inwards", Sweeps(own_axes_in=True), OWN_AXES),
    (
        "offset in the axes of its own link",
        Sweeps(own_axes_out=True, own_axes_in=True),
        OWN_AXES,
    ),
    ("joint carried by its own rates", Sweeps(rates="own"), CARRIED_BY),
    (
        "joint carried by its own rates, offset as it is",
        Sweeps(rates="own", own_axes_out=True),
        CARRIED_BY,
    ),
    ("joint carried by its own rates, then turned", Sweeps(rates="axes"), CARRIED_BY),
    (
        "turning of the axis with two kinds of axes",
        Sweeps(twist_early=True),
        "For what the turning of a joint's axis adds to ω̇ you multiply two vectors in different axes. "
        "Which of them is still in those of the link before?",
    ),
    (
        "own angle inwards",
        Sweeps(back_by="own"),
        "You turn what link k + 1 hands down by the angle of joint k. Which joint lies between the two "
        "links?",
    ),
    (
        "own angle and offset inwards",
        Sweeps(back_by="own", arm_at="before"),
        "You turn what link k + 1 hands down by the angle of joint k, and give it the arm of joint k. "
        "Which joint lies between the two links?",
    ),
)
