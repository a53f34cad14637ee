"""Shares as a card, a report and a table write them: "28 %", and "0.3 %" below 1 %."""


def percent(share: float) -> str:
    """A share of 1 in per cent, without its sign: in whole ones from 1 % on, else in one digit."""
    hundredths = 100 * abs(share)
    return f"{hundredths:.0f} %" if hundredths >= 1 or not hundredths else f"{hundredths:.1g} %"
