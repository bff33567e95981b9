"""Memory for samples: lent again only when nobody looks at it, and not without limit."""

import gc

import numpy as np
import pytest

from neuromech.simulate import sample_memory
from neuromech.simulate.recording import GroupData, Outcome, Provenance, Recording
from neuromech.simulate.sample_memory import borrowed


@pytest.fixture(autouse=True)
def _nothing_unused(monkeypatch):
    monkeypatch.setattr(sample_memory, "_unused", {})


def place(array):
    return array.__array_interface__["data"][0]


def test_memory_is_lent_again_once_nobody_looks_at_it():
    first = borrowed(1000)
    where = place(first)
    del first
    assert place(borrowed(1000)) == where


def test_a_view_of_a_view_keeps_memory_from_being_lent_again():
    first = borrowed(1000)
    view = first[:900].reshape(90, 10)[:, 3:5]
    view[:] = 7.0
    del first
    second = borrowed(1000)
    second[:] = 1.0
    assert (view == 7.0).all()


def test_memory_of_another_size_is_not_used():
    first = borrowed(1000)
    where = place(first)
    keep = np.array(first)
    del first
    assert place(borrowed(999)) != where
    assert len(keep) == len(borrowed(1000)) == 1000


def test_unused_memory_does_not_grow_without_limit(monkeypatch):
    monkeypatch.setattr(sample_memory, "LARGEST_UNUSED", 8 * 3000)
    for count in range(1000, 1100):
        del_me = borrowed(count)
        del del_me
        kept = sum(size * len(some) for size, some in sample_memory._unused.items())
        assert 0 < kept <= 3000
    too_large = borrowed(4000)
    del too_large
    assert 4000 not in sample_memory._unused


def test_no_numbers_need_no_memory():
    assert borrowed(0).shape == (0,)


def test_memory_of_a_recording_comes_back_at_once_and_not_when_cycles_are_collected():
    memory = borrowed(1000)
    where = place(memory)
    group = GroupData(np.arange(100.0), ("A.force", "B.force"), memory[:200].reshape(100, 2), ("N", "N"))
    origin = Provenance("x", "", "0", {}, "none", "", 0, {}, Outcome("finished", 1.0), 1.0, 1.0)
    recording = Recording.from_groups({"all": group}, origin)
    gc.disable()
    try:
        assert recording.unit("B.force") == "N"
        del memory, group, recording
        assert place(borrowed(1000)) == where
    finally:
        gc.enable()
