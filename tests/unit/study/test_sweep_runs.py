"""What runs of a sweep give: the same as runs of the changed document, and words where they give nothing."""

import pytest
from searches import Inline
from sweep_documents import MEASURES, results_of, settled, task_in

from neuromech.errors import DocumentError, StudyError
from neuromech.pipeline import run
from neuromech.study.executors import Done, ProcessExecutor
from neuromech.study.sweeps.carry_out import carry_out
from neuromech.study.sweeps.journal import Journal, SweepHeader

GRID = """
vary: {first_bias: {values: [0.3, 0.6]}, second_bias: {range: [0.4, 0.8], count: 3}}
seeds: 2
"""


def by_position(results):
    return {(*result.point.position, result.point.repetition): result for result in results}


def test_a_point_is_a_run_of_the_document_with_its_values_and_seed(tmp_path):
    task = task_in(
        tmp_path,
        "vary: {first_bias: {values: [0.3, 0.6]}}\nseeds: 2\nduration: 20 ms\nset: {parameters.second_bias.value: 0.7}",
    )
    found = by_position(results_of(task, tmp_path))
    for (index, repetition), result in found.items():
        changes = [f"parameters.first_bias.value={[0.3, 0.6][index]}", "parameters.second_bias.value=0.7"]
        recording = run(tmp_path / "cells.yaml", changes, seed=repetition, duration=0.02)
        assert result.measures["first"] == recording.signal("first.activity")[1][-1]
        assert result.measures["second"] == recording.signal("second.activity")[1][-1]
        assert (result.seed, result.outcome, result.end) == (repetition, "finished", pytest.approx(0.02))
    assert found[0, 0].measures["first"] != found[0, 1].measures["first"], "seeds change nothing"


def test_what_is_not_varied_keeps_its_own_value(tmp_path):
    sweep = "vary: {first_bias: {values: [0.2, 0.9]}, second_bias: {values: [0.3, 0.6]}}\ndesign: one_at_a_time"
    for result in results_of(task_in(tmp_path, sweep), tmp_path):
        biases = [[0.2, 0.9], [0.3, 0.6]]
        expected = [0.5, 0.5]
        expected[result.point.block] = biases[result.point.block][result.point.position[0]]
        assert result.measures["first"] == pytest.approx(settled(expected[0]), abs=1e-9)
        assert result.measures["second"] == pytest.approx(settled(expected[1]), abs=1e-9)


def test_results_do_not_depend_on_workers_or_processes(tmp_path):
    task = task_in(tmp_path, GRID)
    alone = results_of(task, tmp_path)
    header = SweepHeader.of(task.document, task.name)
    with Journal(tmp_path / "other", header) as journal, ProcessExecutor(2) as executor:
        assert carry_out(task, journal, executor, lambda: False, lambda standing: None) == alone
    assert results_of(task, tmp_path / "several", workers=5) == alone


def test_within_one_run_every_point_settles_to_what_a_run_of_its_own_gives(tmp_path):
    held = "within_one_run: {every: 120 ms, settle: 80 ms, lead_in: 30 ms}"
    sweep = f"vary: {{first_bias: {{values: [0.3, 0.6]}}, second_bias: {{range: [0.4, 0.8], count: 3}}}}\n{held}"
    measures = (
        "\n    measures: {first: {kind: mean, signal: first.activity}, second: {kind: mean, signal: second.activity}}"
    )
    results = results_of(task_in(tmp_path, sweep, measures), tmp_path)
    assert [result.end for result in results] == pytest.approx([0.15 + 0.12 * index for index in range(6)])
    for result in results:
        first, second = result.point.position
        assert result.measures["first"] == pytest.approx(settled([0.3, 0.6][first]), abs=1e-6)
        assert result.measures["second"] == pytest.approx(settled([0.4, 0.6, 0.8][second]), abs=1e-6)


def test_a_measure_that_begins_too_early_sees_the_point_before(tmp_path):
    sweep = "vary: {first_bias: {values: [0.2, 0.8]}}\nwithin_one_run: {every: 120 ms, settle: 0 ms}"
    results = results_of(
        task_in(tmp_path, sweep, "\n    measures: {least: {kind: mean, signal: first.activity}}"), tmp_path
    )
    assert results[1].measures["least"] < settled(0.8) - 0.01


def test_a_run_that_diverges_is_recorded_with_its_words(tmp_path):
    sweep = "vary: {time_constant: {values: [5 ms, 0.1 ms]}}"
    good, bad = results_of(task_in(tmp_path, sweep), tmp_path)
    assert (good.outcome, good.message, good.measures["period"]) == ("finished", "", "no rhythm")
    assert (bad.outcome, bad.message) == ("diverged", "state first.rate is not a finite number any more")
    assert bad.measures["first"] == f"the run diverged at {bad.end:g} s"


def test_after_a_run_ended_early_another_one_begins_at_the_next_point(tmp_path):
    sweep = "vary: {time_constant: {values: [5 ms, 0.1 ms, 8 ms]}}\nwithin_one_run: {every: 250 ms, settle: 200 ms}"
    measures = "\n    measures: {first: {kind: mean, signal: first.activity}}"
    one, two, three = results_of(task_in(tmp_path, sweep, measures), tmp_path)
    assert [result.outcome for result in (one, two, three)] == ["finished", "diverged", "finished"]
    assert 0.25 < two.end < 0.5
    assert str(two.measures["first"]).startswith("the run diverged at")
    assert three.end == pytest.approx(0.25)
    assert three.measures["first"] == pytest.approx(0.5, abs=1e-6)


def test_values_that_break_the_document_are_recorded_as_refused(tmp_path):
    sweep = "vary: {delay: {values: [0.1 ms, 3 ms]}}"
    refused, good = results_of(task_in(tmp_path, sweep), tmp_path)
    assert refused.outcome == "refused"
    assert refused.message.startswith(
        "network.synapses.excitatory.second.third.delay must be zero or at least the solver's step"
    )
    assert set(refused.measures.values()) == {"refused"}
    assert good.outcome == "finished"


class Crashing(Inline):
    """Loses the run of the second job."""

    def run(self, task, jobs, stop):
        for done in super().run(task, jobs, stop):
            yield Done(done.job, None, "ended abruptly", 0.0) if done.job.number == 1 else done


def test_a_crash_is_recorded_and_the_others_go_on(tmp_path):
    task = task_in(tmp_path, GRID)
    with Journal(tmp_path / "j", SweepHeader.of(task.document, "sweep")) as journal, Crashing() as executor:
        results = carry_out(task, journal, executor, lambda: False, lambda standing: None)
    assert [result.outcome for result in results] == ["finished", "crashed", *["finished"] * 10]
    assert (results[1].message, results[1].measures["first"]) == ("ended abruptly", "crashed")


def test_standing_counts_what_is_done(tmp_path):
    seen = []
    results_of(task_in(tmp_path, GRID), tmp_path, report=seen.append)
    assert [standing.done for standing in seen] == list(range(13))
    assert seen[-1].outcomes == {"finished": 12}
    assert {standing.total for standing in seen} == {12}


@pytest.mark.parametrize("keep", [None, -1, -20])
def test_an_interrupted_sweep_goes_on_where_it_was(tmp_path, keep):
    task = task_in(tmp_path, GRID)
    whole = results_of(task, tmp_path / "whole")
    done = []
    part = results_of(task, tmp_path, stop=lambda: len(done) >= 5, report=done.append)
    assert 0 < len(part) < 12
    journal = tmp_path / "unfinished.jsonl"
    text = journal.read_bytes()
    journal.write_bytes(text[:keep])
    kept = len(part) - (keep is not None)
    seen = []
    assert results_of(task, tmp_path, report=seen.append) == whole
    assert seen[0].done == kept
    assert journal.read_bytes().startswith(text[: text.rindex(b"\n", 0, -1)])


def test_an_unfinished_sweep_of_a_changed_document_is_refused_with_the_changes(tmp_path):
    results_of(task_in(tmp_path, GRID), tmp_path)
    changed = task_in(tmp_path, GRID.replace("0.6]", "0.7]"))
    with pytest.raises(StudyError) as caught:
        results_of(changed, tmp_path)
    assert str(caught.value) == (
        f"the sweep in {tmp_path / 'unfinished.jsonl'} was begun with another document:\n"
        "  sweeps.sweep.vary.first_bias.values.1: 0.6 → 0.7\n"
        "Hint: undo the changes to go on, choose another folder with '--out', or begin anew with '--restart'"
    )


def test_words_and_other_sections_are_free_to_change(tmp_path):
    task = task_in(tmp_path, GRID)
    whole = results_of(task, tmp_path)
    file = tmp_path / "cells.yaml"
    file.write_text(
        file.read_text()
        + "  other: {vary: {delay: {values: [3 ms]}}, measures: {a: {kind: final, signal: first.activity}}}\n"
    )
    again = type(task)(file, "sweep", ["description=new words"])
    assert results_of(again, tmp_path) == whole


@pytest.mark.parametrize("content", [b"hello\n", b'{"format": "other"}\n', b"[]\n"])
def test_a_file_that_is_no_journal_is_refused(tmp_path, content):
    (tmp_path / "unfinished.jsonl").write_bytes(content)
    with pytest.raises(StudyError, match="is no journal of a sweep"):
        results_of(task_in(tmp_path, GRID), tmp_path)


@pytest.mark.parametrize(
    ("sweep", "measures", "said"),
    [
        (
            "vary: {delay: {values: [2 ms, 3 ms]}}\nwithin_one_run: {every: 120 ms, settle: 80 ms}",
            "\n    measures: {first: {kind: final, signal: first.activity}}",
            "sweeps.sweep.vary.delay  cannot change during a run, because it sets "
            "network.synapses.excitatory.second.third.delay. "
            "Hint: remove 'within_one_run', which gives each value a run of its own",
        ),
        (
            "vary: {first_bias: {values: [0.1, 0.2]}}",
            "\n    measures: {first: {kind: finl, signal: first.activity}}",
            "sweeps.sweep.measures.first  'finl' is not a measure. Hint: did you mean 'final'?",
        ),
        (
            "vary: {first_bias: {values: [0.1, 0.2]}}\nduration: 100 ms",
            "\n    measures: {first: {kind: mean, signal: first.activity, after: 200 ms}}",
            "sweeps.sweep.measures.first.after  begins when a run is over, at 0.1 s (got 0.2 s).",
        ),
        (
            "vary: {first_bias: {values: [0.1, 0.2]}}\nset: {network.neurons.first.bais: 1}",
            MEASURES,
            "sweeps.sweep.set.network.neurons.first.bais  is not known here. Hint: did you mean 'bias'?",
        ),
    ],
)
def test_what_no_run_could_give_is_refused_before_any_run(tmp_path, monkeypatch, sweep, measures, said):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(DocumentError) as caught:
        task_in(tmp_path, sweep, measures)
    assert [str(problem).partition("  ")[2] for problem in caught.value.problems] == [said]


def test_a_sweep_that_does_not_exist_is_refused(tmp_path):
    task = task_in(tmp_path, GRID)
    with pytest.raises(DocumentError, match=r"there is no sweep 'sweeep'\. Hint: did you mean 'sweep'\?"):
        type(task)(tmp_path / "cells.yaml", "sweeep")
