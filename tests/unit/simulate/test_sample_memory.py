"""Memory for samples: lent again only when nobody looks at it, and not without limit."""

import numpy as np
import pytest

from neuromech.simulate import sample_memory
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
