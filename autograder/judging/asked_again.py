"""What an answer that no mistake explains gives when it is called once more, or with other arguments."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from autograder.judging import dependence, error_of, findings, scaling
from autograder.judging.criterion import Criterion, errors_of
from autograder.judging.given import Given, NoNumbersError
from autograder.judging.loops import Loop
from autograder.judging.quantities import Numbers
from autograder.protocol import Call, Reply


@dataclass(frozen=True)
class AskedAgain:
    """An answer, its quantities for some calls, and the right ones.

    ask: gives the replies to calls; None where the answer is not to be called again. read: what is
    judged in replies. right: the right quantities of calls; None where these need all calls together.
    """

    ask: Callable[[list[Call]], list[Reply]] | None
    signature: str
    criteria: Sequence[Criterion]
    calls: list[Call]
    expected: Numbers
    given: Numbers
    read: Callable[[list[Call], list[Reply]], Given]
    right: Callable[[list[Call]], Numbers] | None
    # Calls are made once, and only where something is left to explain.
    _known: dict = field(default_factory=dict)

    def unsteady(self, k: int) -> str:
        """What to say of criterion k where the same calls give other numbers; "" where they do not."""
        if (again := self._once("again", self._repeated)) is None or again.spoilt[k]:
            return ""
        first, second = ([case[k] for case in numbers] for numbers in (self.given, again.numbers))
        return findings.of_repeats(self.criteria[k], first, second)

    def elsewhere(self, k: int) -> str:
        """On what criterion k depends unlike the right one; or else whether its units come out, and on
        what alone its error depends. "" for nothing.
        """
        criterion = self.criteria[k]
        if not criterion.unit or criterion.is_property:
            return ""
        errors = errors_of(self.criteria, self.expected, self.given)[k]
        worst = int(np.argmax(errors))
        # The calls of which this criterion judges anything.
        *others, last = (i for i, case in enumerate(self.expected) if np.size(case[k]))
        parts = []
        if found := self._tried(last):
            best = min(others, key=errors.__getitem__, default=last)
            within = found.within(k)
            if said := dependence.sentence(
                criterion.text, k, within, lambda: self._within(k, best)
            ):
                return said
            tried = [one for one in (self._tried(worst), found) if one]
            # What is not tried may change the error too.
            if all(len(one.within(k).probes) == len(one.probes) for one in tried):
                parts.append(error_of.sentence(criterion.text, k, tried))
        elif self._probes(last):  # which gave no numbers
            return ""
        if of_units := self._once(("units", worst), lambda: self._in_other_units(worst)):
            parts.insert(0, scaling.sentence(criterion.text, k, of_units))
        return " ".join(filter(None, parts))

    def _once(self, name, found: Callable):
        if name not in self._known:
            self._known[name] = found()
        return self._known[name]

    def _repeated(self) -> Given | None:
        """What the same calls give once more; None where that is no answer, or would cost whole runs."""
        if self.ask is None or any(isinstance(call, Loop) for call in self.calls):
            return None
        return self._read(self.calls)

    def _tried(self, case: int) -> dependence.Tried | None:
        """The call with one number changed at a time, if numbers came for all."""

        def tried() -> dependence.Tried | None:
            calls = [self.calls[case], *(probe.call for probe in self._probes(case))]
            both = self._both(calls) if len(calls) > 1 else None
            return dependence.Tried(self._probes(case), *both) if both else None

        return self._once(("tried", case), tried)

    def _within(self, k: int, case: int) -> dependence.Tried | None:
        tried = self._tried(case)
        return tried and tried.within(k)

    def _probes(self, case: int) -> list[dependence.Probe]:
        """None of arguments that are not plain numbers."""
        call = self.calls[case]
        return (
            [] if isinstance(call, Loop) else dependence.probes(self.signature, call, matrices=True)
        )

    def _in_other_units(self, case: int) -> scaling.InOtherUnits | None:
        call = self.calls[case]
        scaled = [] if isinstance(call, Loop) else scaling.scalings(self.signature, call)
        both = self._both([call, *(one.call for one in scaled)]) if scaled else None
        return scaling.InOtherUnits(scaled, *both) if both else None

    def _both(self, calls: list[Call]) -> tuple[Numbers, Numbers] | None:
        """The right quantities of some calls, and the answer's; None where these are not all there."""
        if self.ask is None or self.right is None or (theirs := self._read(calls)) is None:
            return None
        return None if any(theirs.spoilt) else (self.right(calls), theirs.numbers)

    def _read(self, calls: list[Call]) -> Given | None:
        assert self.ask is not None
        replies = self.ask(calls)
        try:
            return self.read(calls, replies) if len(replies) == len(calls) else None
        except NoNumbersError:
            return None
