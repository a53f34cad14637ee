"""The proof of a mechanism's problem: its task, the lines that are marked, and the text that a person
reads.
"""

from dataclasses import dataclass

POINTS = 4
_TEXT = """\
**The energy.** With $E = \\tfrac12\\dot q^{\\mathsf T}M\\dot q + P(q)$ the product rule gives \
$\\dot E = \\tfrac12\\ddot q^{\\mathsf T}M\\dot q + \\tfrac12\\dot q^{\\mathsf T}\\dot M\\dot q + \
\\tfrac12\\dot q^{\\mathsf T}M\\ddot q + \\dot q^{\\mathsf T}\\frac{\\partial P}{\\partial q}$. \
The first and the third term are equal, since $M$ is symmetric, and $\\partial P/\\partial q = \
g(q)$.

**The motion.** Put in $M\\ddot q = FORCES - C\\dot q - g$: what remains is $\\dot E = \\dot \
q^{\\mathsf T}(FORCES) + \\tfrac12\\dot q^{\\mathsf T}(\\dot M - 2C)\\dot q$. Only $C\\dot q$ has \
been used, so this holds for every matrix $C$ whose $C\\dot q$ is right.

**The skew-symmetry.** The Christoffel symbols $h_{ijk} = \\tfrac12\\left(\\frac{\\partial \
M_{ij}}{\\partial q_k} + \\frac{\\partial M_{ik}}{\\partial q_j} - \\frac{\\partial \
M_{jk}}{\\partial q_i}\\right)$ give $C_{ij} = \\sum_k h_{ijk}\\dot q_k$. By the chain rule $\\dot \
M_{ij} = \\sum_k \\frac{\\partial M_{ij}}{\\partial q_k}\\dot q_k$. In $\\dot M_{ij} - 2C_{ij}$ \
the first derivative cancels, and $\\sum_k\\left(\\frac{\\partial M_{jk}}{\\partial q_i} - \
\\frac{\\partial M_{ik}}{\\partial q_j}\\right)\\dot q_k$ is left. If $i$ and $j$ change places it \
changes its sign. So $\\dot M - 2C$ is skew-symmetric.

**What follows.** A skew-symmetric matrix gives zero between any vector and itself, so that $\\dot \
E = \\dot q^{\\mathsf T}(FORCES)$. ENDS"""
_ENDS = {
    False: "The energy stays the same as long as the input does no work.",
    True: "Without input the friction alone does work, and the energy falls in every motion that it "
    "resists.",
}
# What does work: the input alone, or less the friction.
_FORCES = {False: "u", True: "u - f(\\dot q)"}
_MOTION = {False: "u - C qd - g", True: "u - C qd - g - f"}


@dataclass(frozen=True)
class Lines:
    """Lines that are marked. id: of their derivation. function: which gives them. doc: from where to
    where they lead. model: the right ones, each a formula and its reasons.
    """

    id: str
    function: str
    doc: str
    model: tuple[tuple[str, ...], ...]

    @property
    def answer(self) -> str:
        """The answer's cell in nbgrader's source form."""
        shown = (f"        ({', '.join(map(_quoted, line))})," for line in self.model)
        return "\n".join(
            [
                f"def {self.function}():",
                f'    """{self.doc}: lines of ("formula", "reason"), or with two reasons."""',
                "    ### BEGIN SOLUTION",
                "    return [",
                *shown,
                "    ]",
                "    ### END SOLUTION",
            ]
        )

    @property
    def call(self) -> str:
        """The cell that has the lines marked."""
        said = "# Marks each line, and says what is still to be shown."
        return f'{said}\nderivation("{self.id}", {self.function})'


def lines_of(name: str, friction: bool) -> tuple[Lines, Lines]:
    """Of the energy, with friction or without, and of the skew-symmetry, for this mechanism."""
    power = "qd' (u - f)" if friction else "qd' u"
    energy = (
        ("Edot = d/dt (K + P)", "definition of E"),
        ("= d/dt(1/2 qd' M qd) + Pdot", "kinetic energy"),
        ("= 1/2 qdd' M qd + 1/2 qd' Mdot qd + 1/2 qd' M qdd + Pdot", "product rule"),
        ("= qd' M qdd + 1/2 qd' Mdot qd + Pdot", "symmetry of M"),
        ("= qd' M qdd + 1/2 qd' Mdot qd + qd' g", "chain rule", "gradient of P"),
        (f"= qd' ({_MOTION[friction]}) + 1/2 qd' Mdot qd + qd' g", "equation of motion"),
        (f"= {power} + 1/2 qd' (Mdot - 2 C) qd", "algebra"),
        (f"= {power}", "skew-symmetry"),
    )
    skew = (
        ("(Mdot - 2C) + (Mdot - 2C)' = (W' - W) + (W' - W)'", "Christoffel symbols"),
        ("= 0", "algebra"),
    )
    whose = "u - f" if friction else "the motors"
    return (
        Lines(
            f"{name}-E-friction" if friction else f"{name}-E",
            "energy_lines",
            f"From Edot to the power of {whose}",
            energy,
        ),
        Lines(f"{name}-skew", "skew_lines", "From (Mdot - 2 C) + (Mdot - 2 C)' to 0", skew),
    )


def text_of(friction: bool) -> str:
    """The model answer that a person reads, for the equation of motion with friction or without."""
    forces = _FORCES[friction]
    power = f"({forces})" if friction else forces
    text = _TEXT.replace("(FORCES)", power).replace("FORCES", forces)
    return text.replace("ENDS", _ENDS[friction])


def task(letter: str, friction: bool) -> str:
    """What is asked, and the table of points; its rows 1 to 3 are those that the lines earn."""
    return f"""\
## {letter}. By hand ({POINTS} points, read by a person)

Show how the energy $E = K + P$ of this mechanism changes, and that $\\dot M - 2C$ is \
skew-symmetric for the Christoffel form of $C$. Write it up in the last cell of this part, line by \
line, with a reason for each line.

| points | for |
|---|---|
| 1 | $\\dot E$ of $E = \\tfrac12\\dot q^{{\\mathsf T}}M\\dot q + P(q)$, each term with its \
reason, and where you use the symmetry of $M$ |
| 1 | the equation of motion put in, so that the power of ${_FORCES[friction]}$ and a term with one \
matrix remain, and for **which** matrices $C$ this holds |
| 1 | a proof that $\\dot M - 2C$ is skew-symmetric for the Christoffel form of $C$ |
| 1 | where the skew-symmetry enters $\\dot E$, and when the energy of this mechanism stays the \
same |"""


def lines_task(lines: tuple[Lines, ...]) -> str:
    """What is said above the cells with the lines."""
    first = lines[0].id
    return (
        "**Line by line.** Before you write the text, let the computer check the heart of it: first "
        "the rate of the energy, then the skew-symmetry. Each line is a formula with one or two "
        "reasons from a list, and must follow from the line before it. "
        f'`derivation("{first}")` without lines says where to start, and shows the names and the '
        "reasons. Run the cell as often as you like: it marks each line, and says what is still to "
        f'be shown. If you are stuck, run `hint("{first}")`. The rows of the table that your lines '
        "earn are suggested to the person who reads your text. That person decides."
    )


def _quoted(text: str) -> str:
    return f'"{text}"'
