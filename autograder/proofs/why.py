"""Why a step does not follow by its reasons: other reasons, or a false proof."""

import itertools
from dataclasses import replace

from autograder.proofs.derivation import ALGEBRA, Derivation, FalseStep, Misuse
from autograder.proofs.expression import Number, names_in, walk
from autograder.proofs.slips import slips
from autograder.proofs.steps import Step, Worlds
from autograder.proofs.subject import Reason

# Reasons, and names of properties that also hold.
_Known = tuple[tuple[Reason, ...], tuple[str, ...]]


class Why:
    """Says why the steps of one derivation do not follow."""

    def __init__(self, derivation: Derivation, worlds: Worlds):
        self._derivation = derivation
        self._subject = derivation.subject
        self._worlds = worlds

    def misused(self, step: Step, given: tuple[Reason, ...]) -> str:
        """What is said where one of the reasons is thought to give what it does not; else ""."""
        names = [reason.name for reason in given]
        for misuse in self._derivation.misused:
            if misuse.reason in names and self._is_misuse(step, given, misuse):
                return misuse.sentence
        return ""

    def said(self, step: Step, given: tuple[Reason, ...]) -> str:
        """Why a step does not follow by its reasons. TooMuchError if that takes too long to find."""
        if said := self._other_reasons(step, given):
            return said
        everything = (self._subject.everything,), self._subject.truth
        true = self._worlds.hold(step, *everything)
        if not true and (said := self._numbers(step)):
            return said
        if found := self._mistake(step, [((), ()), (given, ())]):
            return found.sentence
        if not true and (said := self._slip(step, given)):
            return said
        if found := self._mistake(step, self._more(given, true)):
            return found.sentence
        if true:
            return (
                f"This does follow from the line before, but not by {named(given)}, nor by one or two "
                "other reasons: put the steps between on lines of their own."
            )
        return f"This does not follow from the line before: {self._worlds.witness(step)}."

    def _is_misuse(self, step: Step, given: tuple[Reason, ...], misuse: Misuse) -> bool:
        if step.relation not in misuse.relations or self._worlds.hold(step, ()):
            return False
        return not misuse.gives or self._worlds.hold(replace(step, relation=misuse.gives), given)

    def _other_reasons(self, step: Step, given: tuple[Reason, ...]) -> str:
        derivation = self._derivation
        others = [reason for reason in self._subject.reasons if reason not in given]
        allowed = [reason for reason in others if reason.name not in derivation.to_prove]
        by = named(given)
        for other in allowed:
            if self._worlds.hold(step, (other,)):
                return f"The line is right, but not by {by}: it needs {other.kind}."
        for other in allowed:
            if given and self._worlds.hold(step, (*given, other)):
                are = "are" if len(given) > 1 else "is"
                return f"The line is right, but {by} {are} not enough: it also needs {other.kind}."
        for other in others:
            if other not in allowed and self._worlds.hold(step, (*given, other)):
                return "This step uses what is to be proved."
        for pair in itertools.combinations(allowed, 2):
            kinds = " and ".join(dict.fromkeys(reason.kind for reason in pair))
            if self._worlds.hold(step, pair):
                return f"The line is right, but not by {by}: it needs {kinds}."
            if given and self._worlds.hold(step, (*given, *pair)):
                are = "are" if len(given) > 1 else "is"
                return f"The line is right, but {by} {are} not enough: it also needs {kinds}."
        return ""

    def _numbers(self, step: Step) -> str:
        """What is said where numbers stand for names."""
        if not names_in(step.after, self._subject.rates) and not _is_zero(step):
            return (
                "Here a number stands for what differs from one mechanism to the next. One example "
                "proves nothing: write it in the names."
            )
        if any(isinstance(node, Number) and not (4 * node.value).is_integer()
               for node in walk(step.after)):  # fmt: skip
            return (
                "A measured number stands here. The line is about every mechanism: write its name."
            )
        return ""

    def _slip(self, step: Step, given: tuple[Reason, ...]) -> str:
        """A slip without which the step would follow, from its reasons or from all that is true."""
        everything = (self._subject.everything,), self._subject.truth
        for facts, properties in ((given, ()), everything):
            for mended, said in slips(step.after):
                if self._worlds.same(mended, Number(0.0)):
                    continue
                if self._worlds.hold(replace(step, after=mended), facts, properties):
                    return said
        return ""

    def _more(self, given: tuple[Reason, ...], true: bool) -> list[_Known]:
        """With one reason more each, or with all that is true, if the step itself is not."""
        subject = self._subject
        others = [reason for reason in subject.reasons if reason not in given]
        known: list[_Known] = [((*given, other), ()) for other in others]
        if not true:
            known.append(((subject.everything,), tuple(subject.truth)))
        return known

    def _mistake(self, step: Step, known: list[_Known]) -> FalseStep | None:
        """The first mistake with which the step would follow from one of these."""
        held = names_in(step.after, self._subject.rates)
        for facts, properties in known:
            for mistake in self._derivation.mistakes:
                if mistake.gone in held:
                    continue
                false = Reason(mistake.name, "", "", mistake.defines)
                more = (mistake.property,) if mistake.property else ()
                if self._worlds.hold(step, (*facts, false), (*properties, *more)):
                    return mistake
        return None


def _is_zero(step: Step) -> bool:
    return all(node.value == 0 for node in walk(step.after) if isinstance(node, Number))


def named(reasons: tuple[Reason, ...]) -> str:
    """The reasons in quotes."""
    return " and ".join(f'"{reason.name}"' for reason in reasons) or ALGEBRA
