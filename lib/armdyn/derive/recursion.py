"""The recursions of a serial chain from link to link, in terms."""

from functools import cached_property

from armdyn.derive.frames import Frames
from armdyn.derive.terms import Term, Terms
from armdyn.derive.vectors import UPPER, MovingLink, cross, dot, plus


class Recursion:
    """The equation of motion of a chain in its new frames, as terms.

    A wrench is (moment, force), the moment about the origin of the link it is given in. `momenta`,
    `outward_masses` and the like are computed once and shared by what is asked for.
    """

    def __init__(self, terms: Terms, basis: list[Term], found: Frames, q, qd):
        self.terms, self.basis, self.found = terms, basis, found
        joints = zip(found.joints, q, qd, strict=True)
        self.links = [MovingLink(terms, basis, joint, x, v) for joint, x, v in joints]
        self.n = len(self.links)
        self.zero = terms(0.0)

    @cached_property
    def outward_masses(self):
        """(second, first, mass) of the links from each joint outwards, about its frame's origin."""
        found: list = [None] * self.n
        second, first, mass = dict.fromkeys(UPPER, self.zero), [self.zero] * 3, self.zero
        for k in reversed(range(self.n)):
            link = self.links[k]
            second = {at: second[at] + link.second[at] for at in UPPER}
            first = plus(first, link.first)
            mass = mass + link.mass
            found[k] = second, first, mass
            p, h = link.position, link.inwards(first)
            # Σ + p hᵀ + h pᵀ + m p pᵀ
            half = [a + 0.5 * mass * x for a, x in zip(h, p, strict=True)]
            turned = link.second_inwards(second)
            second = {
                (i, j): self.terms.sum(
                    (turned[i, j], 2 * p[i] * half[i])
                    if i == j
                    else (turned[i, j], p[i] * half[j], p[j] * half[i])
                )
                for i, j in UPPER
            }
            first = [a + mass * x for a, x in zip(h, p, strict=True)]
        return found

    @cached_property
    def momenta(self):
        """For each joint j and each i ≤ j, (moment, force) in link i's frame of what keeps the links
        from j outwards accelerating at q̈_j = 1."""
        found = {}
        for j, link in enumerate(self.links):
            second, first, mass = self.outward_masses[j]
            x, y, _ = first
            if link.revolute:
                moment = [-second[0, 2], -second[1, 2], second[0, 0] + second[1, 1]]
                force = [-y, x, self.zero]
            else:
                moment, force = [y, -x, self.zero], [self.zero, self.zero, mass]
            found[j, j] = moment, force
            for i in reversed(range(j)):
                moment, force = self._wrench_inwards(i + 1, moment, force)
                found[i, j] = moment, force
        return found

    def inertia(self) -> list[list[Term]]:
        """M."""
        M = [[self.zero] * self.n for _ in range(self.n)]
        for (i, j), wrench in self.momenta.items():
            M[i][j] = M[j][i] = self.links[i].axis_part(*wrench)
        return M

    def gravity_vector(self) -> list[Term]:
        """g: the torque of the weight of the links from each joint outwards."""
        found = []
        for link, (_, (x, y, _), mass), g in zip(
            self.links, self.outward_masses, self._pulls, strict=True
        ):
            found.append(y * g[0] - x * g[1] if link.revolute else -(mass * g[2]))
        return found

    def potential_energy(self) -> Term:
        """P."""
        link, (_, first, mass) = self.links[0], self.outward_masses[0]
        carried = dot(self.terms, first, self._pulls[0])
        offset = dot(self.terms, link.position, [self.terms(g) for g in self.found.gravity])
        still = dot(self.terms, self.found.still, self.basis)
        return self.terms.sum((still, -carried, -(mass * offset)))

    @cached_property
    def _pulls(self):
        """The gravitational acceleration in each link's frame."""
        pull, found = [self.terms(g) for g in self.found.gravity], []
        for link in self.links:
            pull = link.outwards(pull)
            found.append(pull)
        return found

    @cached_property
    def spins(self):
        """ω of each link."""
        spin, found = [self.zero] * 3, []
        for link in self.links:
            spin = link.outwards(spin)
            if link.revolute:
                spin = [*spin[:2], spin[2] + link.qd]
            found.append(spin)
        return found

    def bias(self) -> list[Term]:
        """C q̇ + g, by forces outwards from a base that accelerates upwards, and back."""
        rate = [self.zero] * 3  # ω̇
        push = [-self.terms(g) for g in self.found.gravity]
        before, wrenches = None, []
        for link, spin in zip(self.links, self.spins, strict=True):
            if before is not None:
                push = plus(push, [dot(self.terms, row, link.position) for row in before])
            push, rate = link.outwards(push), link.outwards(rate)
            # ω × z q̇, which the axis adds.
            sideways = [spin[1] * link.qd, -(spin[0] * link.qd)]
            if link.revolute:
                rate = [rate[0] + sideways[0], rate[1] + sideways[1], rate[2]]
            else:
                push = [push[0] + 2 * sideways[0], push[1] + 2 * sideways[1], push[2]]
            before = U = _pull_of_turning(spin, rate)
            wrenches.append(self._wrench(link, spin, U, push))
        return self._axis_parts(wrenches)

    def _wrench(self, link, spin, U, push):
        """(moment, force) of ∫ x × ẍ dm and ∫ ẍ dm with ẍ = push + U x over the link's own masses."""
        S, h = link.second, link.first
        x, y, z = (w * w for w in spin)
        add = self.terms.sum
        force = [
            add((link.mass * a, dot(self.terms, row, h))) for a, row in zip(push, U, strict=True)
        ]
        moment = [
            add(
                (
                    U[2][0] * S[0, 1],
                    U[2][1] * S[1, 1],
                    -(U[1][0] * S[0, 2]),
                    -(U[1][2] * S[2, 2]),
                    (z - y) * S[1, 2],
                )
            ),
            add(
                (
                    U[0][1] * S[1, 2],
                    U[0][2] * S[2, 2],
                    -(U[2][0] * S[0, 0]),
                    -(U[2][1] * S[0, 1]),
                    (x - z) * S[0, 2],
                )
            ),
            add(
                (
                    U[1][0] * S[0, 0],
                    U[1][2] * S[0, 2],
                    -(U[0][1] * S[1, 1]),
                    -(U[0][2] * S[1, 2]),
                    (y - x) * S[0, 1],
                )
            ),
        ]
        return plus(moment, cross(h, push)), force

    def _axis_parts(self, wrenches):
        found: list = [None] * self.n
        moment, force = [self.zero] * 3, [self.zero] * 3
        for k in reversed(range(self.n)):
            moment, force = plus(moment, wrenches[k][0]), plus(force, wrenches[k][1])
            found[k] = self.links[k].axis_part(moment, force)
            moment, force = self._wrench_inwards(k, moment, force)
        return found

    def _wrench_inwards(self, k, moment, force):
        """A moment about link k's origin, and a force, as those about the origin before."""
        link = self.links[k]
        force = link.inwards(force)
        return plus(link.inwards(moment), cross(link.position, force)), force

    def coriolis(self) -> list[list[Term]]:
        """C: for the axes i ≤ j as twists S, C_ij = S_iᵀ(I Ṡ_j + B S_j) and
        C_ji = Ṡ_iᵀ I S_j + S_iᵀ Bᵀ S_j, with I and B of the links from j outwards and
        B S = ∫ [x×; 1] (S_ω × ẋ) dm."""
        C = [[self.zero] * self.n for _ in range(self.n)]
        velocities = self._velocities
        for j, link in enumerate(self.links):
            Q, p = self._outward_momenta[j]
            spin, velocity = self.spins[j], velocities[j]
            if link.revolute:
                turning = [spin[1], -spin[0]], [velocity[1], -velocity[0]]
                trace = Q[0][0] + Q[1][1]
                right = [-Q[2][0], -Q[2][1], trace], [-p[1], p[0], self.zero]
                couple = [-Q[0][2], -Q[1][2], trace]
            else:
                turning = [self.zero] * 2, [spin[1], -spin[0]]
                right = [self.zero] * 3, [self.zero] * 3
                couple = [p[1], -p[0], self.zero]
            moment, force = self._momentum(j, *turning)
            moment, force = plus(moment, right[0]), plus(force, right[1])
            C[j][j] = link.axis_part(moment, force)
            for i in reversed(range(j)):
                moment, force = self._wrench_inwards(i + 1, moment, force)
                couple = self.links[i + 1].inwards(couple)
                C[i][j] = self.links[i].axis_part(moment, force)
                C[j][i] = self._left(i, self.momenta[i, j], couple)
        return C

    def _left(self, i, wrench, couple):
        """Ṡ_iᵀ(moment, force) + S_iᵀ(couple, 0)."""
        (a, b, _), (x, y, _) = wrench
        (p, q, _), (v, w, _) = self.spins[i], self._velocities[i]
        if self.links[i].revolute:
            return self.terms.sum((q * a, -(p * b), w * x, -(v * y), couple[2]))
        return self.terms.sum((q * x, -(p * y)))

    def _momentum(self, j, angular, linear):
        """(moment, force) of the links from j outwards with these velocities across z."""
        S, h, m = self.outward_masses[j]
        (a, b), (v, w) = angular, linear
        add = self.terms.sum
        moment = [
            add(((S[1, 1] + S[2, 2]) * a, -(S[0, 1] * b), -(h[2] * w))),
            add(((S[0, 0] + S[2, 2]) * b, -(S[0, 1] * a), h[2] * v)),
            add((-(S[0, 2] * a), -(S[1, 2] * b), h[0] * w, -(h[1] * v))),
        ]
        force = [
            add((m * v, b * h[2])),
            add((m * w, -(a * h[2]))),
            add((a * h[1], -(b * h[0]))),
        ]
        return moment, force

    @cached_property
    def _velocities(self):
        """The velocity of each link's origin."""
        velocity, found, before = [self.zero] * 3, [], [self.zero] * 3
        for link, spin in zip(self.links, self.spins, strict=True):
            velocity = link.outwards(plus(velocity, cross(before, link.position)))
            if not link.revolute:
                velocity = [*velocity[:2], velocity[2] + link.qd]
            found.append(velocity)
            before = spin
        return found

    @cached_property
    def _outward_momenta(self):
        """(Q, p) of the links from each joint outwards: ∫ x ẋᵀ dm about its frame's origin, ∫ ẋ dm."""
        found: list = [None] * self.n
        Q = [[self.zero] * 3 for _ in range(3)]
        p = [self.zero] * 3
        for k in reversed(range(self.n)):
            link, spin, velocity = self.links[k], self.spins[k], self._velocities[k]
            h = link.first
            p = plus(p, [link.mass * v for v in velocity])
            p = plus(p, cross(spin, h))
            for i in range(3):
                row = [link.second[min(i, j), max(i, j)] for j in range(3)]
                own = plus([h[i] * v for v in velocity], cross(spin, row))
                Q[i] = plus(Q[i], own)
            found[k] = [list(row) for row in Q], p
            p = link.inwards(p)
            turned = [link.inwards(row) for row in Q]
            columns = [link.inwards([row[j] for row in turned]) for j in range(3)]
            Q = [[columns[j][i] + link.position[i] * p[j] for j in range(3)] for i in range(3)]
        return found


def _pull_of_turning(spin, rate):
    """U: the acceleration of a body's points is that of its origin plus U x; ω̇× + ω×ω×."""
    (x, y, z), (a, b, c) = spin, rate
    xx, yy, zz, xy, xz, yz = x * x, y * y, z * z, x * y, x * z, y * z
    return [
        [-(yy + zz), xy - c, xz + b],
        [xy + c, -(xx + zz), yz - a],
        [xz - b, yz + a, -(xx + yy)],
    ]
