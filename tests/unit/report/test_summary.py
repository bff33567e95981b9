"""Tables say what happened, and show claims that are not met."""

from io import StringIO

from rich.console import Console

from neuromech.analyse.claims import Measured, Verdict
from neuromech.report.summary import claims_table, measured_text, run_table
from neuromech.simulate.recording import Outcome


def printed(table):
    console = Console(width=160, record=True, file=StringIO())
    console.print(table)
    return console.export_text()


def verdict(word, published=None):
    measured = Measured(0.45712, 0.4569, 0.4573, 20)
    return Verdict("cat [CPG]", "period", "the period", "Habu 2020", published, "0.457 s ± 1 %", measured, word)


def test_the_table_of_claims_counts_and_keeps_those_not_met():
    text = printed(claims_table([verdict("met", "0.46 s"), verdict("not met")]))
    assert "1 of 2 claims met" in text
    assert text.count("not met") == 1
    for word in (
        "cat [CPG]: period",
        "the period",
        "Habu 2020",
        "0.46 s",
        "0.457 s ± 1 %",
        "0.4571 (0.4569 … 0.4573), n = 20",
    ):
        assert word in text


def test_measured_values_in_short():
    assert measured_text(Measured(0.45712, 0.45712, 0.45712, 1)) == "0.4571"
    assert measured_text(Measured("trot", "trot", "trot", 20)) == "trot, n = 20"
    assert measured_text(Measured("trot", "pace", "trot", 20)) == "trot (pace … trot), n = 20"
    assert measured_text(Measured("no rhythm in 1 of 3", 0.4, 0.5, 3)) == "no rhythm in 1 of 3 (0.4 … 0.5), n = 3"


def test_the_table_of_a_run_names_what_ended_it(cat):
    text = printed(run_table(cat(seconds=1.0, outcome=Outcome("diverged", 0.9, "LF.[RG-F].potential is not finite"))))
    assert "diverged at 0.9 s: LF.[RG-F].potential is not finite" in text
    assert "pybullet" in text
    assert "suspended cat" in text
