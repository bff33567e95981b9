"""Storing beside a search: everything in order, much of it together, and nothing after a failure."""

import time
from types import SimpleNamespace

import pytest

from neuromech.errors import StudyError
from neuromech.study.writer import Writer


class Stored:
    """A study that keeps what it is told; it fails to store what is in `refuses`."""

    def __init__(self, refuses=()):
        self.told, self.refuses, self.moments = [], refuses, []

    def begin(self, jobs, _space):
        self.told.append(("begin", *jobs))

    def finish(self, evaluations):
        if set(evaluations) & set(self.refuses):
            raise StudyError("the disk is full")
        self.told.append(("finish", *evaluations))
        self.moments.append(time.monotonic())

    def set_boundary(self, boundary):
        self.told.append(("boundary", boundary))


def flat(told):
    return [(kind, one) for kind, *several in told for one in several]


def test_all_is_written_in_order_and_evaluations_that_follow_each_other_together():
    stored = Stored()
    with Writer(stored, SimpleNamespace()) as writer:
        for generation in range(3):
            numbers = range(10 * generation, 10 * generation + 10)
            writer.begin(numbers)
            for number in numbers:
                writer.finish(number)
            writer.set_boundary(generation)
    expected = [
        one
        for generation in range(3)
        for one in (
            *(("begin", 10 * generation + k) for k in range(10)),
            *(("finish", 10 * generation + k) for k in range(10)),
            ("boundary", generation),
        )
    ]
    assert flat(stored.told) == expected
    assert sum(kind == "finish" for kind, *_ in stored.told) < 10


def test_an_evaluation_that_comes_alone_is_written_at_once():
    stored = Stored()
    with Writer(stored, SimpleNamespace()) as writer:
        asked = time.monotonic()
        writer.finish(0)
        while not stored.moments:
            assert time.monotonic() < asked + 10.0
            time.sleep(1e-3)
        time.sleep(0.3)
        writer.finish(1)
        time.sleep(0.2)
        assert stored.told == [("finish", 0), ("finish", 1)]


def test_the_end_does_not_wait_for_more_to_come():
    stored = Stored()
    with Writer(stored, SimpleNamespace()) as writer:
        writer.finish(0)
        while not stored.moments:
            time.sleep(1e-3)
        writer.finish(1)
        before = time.monotonic()
    assert stored.told == [("finish", 0), ("finish", 1)]
    assert time.monotonic() - before < 0.2


def test_nothing_is_written_after_a_failure_which_is_raised():
    stored = Stored(refuses=[1])
    with pytest.raises(StudyError, match="the disk is full"), Writer(stored, SimpleNamespace()) as writer:
        writer.finish(0)
        while not stored.moments:
            time.sleep(1e-3)
        writer.finish(1)
        writer.set_boundary(0)
        writer.finish(2)
    assert stored.told == [("finish", 0)]
