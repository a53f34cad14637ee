"""Mistakes about the inertia matrix as the sum of what each link adds."""

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.problems.material import sentences
from autograder.problems.p1_inertia.mistakes import HALF


def _links(matrix):
    """A wrong model of Σ JᵀIJ from what it does to one link's J and I."""
    return lambda jacobians, inertias: sum(
        matrix(J, I) for J, I in zip(jacobians, inertias, strict=True)
    )


def _of(links):
    """The right model with some of the links only: none gives zeros."""
    return lambda jacobians, inertias: _right(jacobians[links], inertias[links])


def _right(jacobians, inertias):
    return np.einsum("lai,lab,lbj->ij", jacobians, inertias, jacobians)


def _without_coupling(I):
    apart = np.array(I)
    apart[:3, 3:] = apart[3:, :3] = 0
    return apart


HALVES_SWAPPED = [3, 4, 5, 0, 1, 2]

INERTIA_FROM_LINKS = (
    Mistake(
        "I not used",
        _links(lambda J, I: J.T @ J),
        "You do not use the spatial inertias: your matrix is right only where each of them is the "
        "identity. What stands between Jᵀ and J in the energy of one link?",
    ),
    Mistake(
        "only the diagonal of I",
        _links(lambda J, I: J.T @ np.diag(np.diag(I)) @ J),
        "You use only the diagonal of each spatial inertia. What do the other entries do when the "
        "centre of mass is not at the origin?",
    ),
    Mistake(
        "coupling of rotation and translation dropped",
        _links(lambda J, I: J.T @ _without_coupling(I) @ J),
        "You add the energy of rotation to the energy of translation, and nothing more. That is "
        "enough only about the centre of mass. Which blocks of I couple the two?",
    ),
    Mistake(
        "halves of J swapped",
        _links(lambda J, I: J[HALVES_SWAPPED].T @ I @ J[HALVES_SWAPPED]),
        "You swap the upper and the lower three rows of each Jacobian, but not those of its "
        "inertia. In what order do the rows come in both?",
    ),
    Mistake(
        "inverse of I",
        _links(lambda J, I: J.T @ np.linalg.inv(I) @ J),
        "You use the inverse of each spatial inertia. Which of the two, the inertia or its "
        "inverse, turns a velocity into a momentum?",
    ),
    Mistake("half", lambda jacobians, inertias: _right(jacobians, inertias) / 2, HALF),
    Mistake("last link only", _of(slice(-1, None)), sentences.LAST_LINK_ONLY),
    Mistake("first link only", _of(slice(0, 1)), sentences.FIRST_LINK_ONLY),
    Mistake("last link left out", _of(slice(None, -1)), sentences.LAST_LINK_LEFT_OUT),
    Mistake("first link left out", _of(slice(1, None)), sentences.FIRST_LINK_LEFT_OUT),
    Mistake(
        "mean for sum",
        lambda jacobians, inertias: _right(jacobians, inertias) / len(jacobians),
        "You divide by the number of links. Is the energy of the arm the mean of the links' "
        "energies, or their sum?",
    ),
    Mistake(
        "links added before they are multiplied",
        lambda jacobians, inertias: (
            np.sum(jacobians, 0).T @ np.sum(inertias, 0) @ np.sum(jacobians, 0)
        ),
        "You add up the Jacobians and the inertias first, and multiply afterwards. Each link has "
        "its own velocity. Which can you add: the velocities of different bodies, or their "
        "energies?",
    ),
    Mistake(
        "diagonal of the matrix alone",
        lambda jacobians, inertias: np.diag(np.diag(_right(jacobians, inertias))),
        "Your matrix is diagonal. Does no joint feel the acceleration of another?",
    ),
    Mistake(
        "upper triangle of the matrix alone",
        lambda jacobians, inertias: np.triu(_right(jacobians, inertias)),
        "Your matrix is 0 below its diagonal. Which property does an inertia matrix have?",
    ),
    Mistake(
        "inverse for matrix",
        lambda jacobians, inertias: np.linalg.inv(_right(jacobians, inertias)),
        "You return the inverse of the matrix. Which of the two, M or M⁻¹, stands in K = ½ q̇ᵀ M q̇?",
    ),
)
