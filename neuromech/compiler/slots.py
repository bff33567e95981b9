"""Rows with few entries each, stored slot by slot instead of row by row, so that many rows are summed at a time.

Row by row, the sums of such rows are short loops of unpredictable length. Here the rows of a kind are put in order of
their number of entries, and the k-th entries of all rows stand together (jagged diagonals: Saad 1989,
doi:10.1137/0910073). Within a row the order of the sum stays the same.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from neuromech.compiler.numerics import Floats, Integers

MOST_ENTRIES = 8.0
"""Mean number of entries of a row up to which slots pay; measured with the networks of the benchmark."""


@dataclass(frozen=True)
class Slots:
    """All kinds' entries slot by slot.

    Args:
        tables: for each kind its table, one after the other: number of rows with entries, of slots, first entry, first
            row in `order`, then the number of rows of each slot.
        starts: where in `tables` each kind's table starts.
        order: rows with entries, kind by kind, those with most entries first.
        place: position of each given entry in the new order.
    """

    tables: Integers
    starts: tuple[int, ...]
    order: Integers
    place: Integers


def slotted(rows: Integers, ranges: Sequence[range]) -> Slots:
    """Put entries in slot order.

    Args:
        rows: (entries,) row of each entry; entries of one row in the order of their sum.
        ranges: rows of each kind.
    """
    place = np.empty(len(rows), dtype=np.int64)
    tables: list[Integers] = []
    orders: list[Integers] = []
    starts: list[int] = []
    entry = first_row = 0
    for some in ranges:
        own = np.flatnonzero((rows >= some.start) & (rows < some.stop))
        table, order, sequence = _one_kind(rows[own])
        place[own[sequence]] = entry + np.arange(len(own))
        starts.append(sum(len(each) for each in tables))
        tables.append(np.concatenate([[len(order), len(table), entry, first_row], table]))
        orders.append(order)
        entry, first_row = entry + len(own), first_row + len(order)
    return Slots(_joined(tables), tuple(starts), _joined(orders), place)


def _one_kind(rows: Integers) -> tuple[Integers, Integers, Integers]:
    """Return the number of rows of each slot, the rows in order, and the entries in order."""
    used, inverse, degree = np.unique(rows, return_inverse=True, return_counts=True)
    by_degree = np.argsort(-degree, kind="stable")
    rank = np.empty(len(used), dtype=np.int64)
    rank[by_degree] = np.arange(len(used))
    by_row = np.argsort(inverse, kind="stable")
    slot = np.empty(len(rows), dtype=np.int64)
    slot[by_row] = np.arange(len(rows)) - np.repeat(np.cumsum(degree) - degree, degree)
    return np.bincount(slot), used[by_degree], np.lexsort((rank[inverse], slot))


def _joined(parts: Sequence[Floats | Integers]) -> Integers:
    return np.concatenate([np.zeros(0, dtype=np.int64), *parts]).astype(np.int64)
