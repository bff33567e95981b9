"""Random numbers of populations and projections: who sends to whom, and what differs between neurons or synapses.

Each population and each projection has a generator of its own, made from its seed and its qualified name. So the order
of a document changes nothing, and neither does the seed of a run.
"""

import hashlib
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from neuromech.compiler.numerics import Floats, Integers
from neuromech.spec.model import Projection, Uniform
from neuromech.units import quantity

Sources = NDArray[np.int32]

_MOST_AT_ONCE = 20_000_000


@dataclass(frozen=True)
class Wiring:
    """Senders of each receiver, receiver after receiver: how many (receivers,), and which (synapses,)."""

    counts: Integers
    senders: Sources


def generator(seed: int, name: str) -> np.random.Generator:
    """Return the generator that belongs to a seed and a name."""
    digest = hashlib.sha256(name.encode()).digest()
    return np.random.default_rng([seed, *np.frombuffer(digest, dtype=np.uint32)])


def varied(interval: Uniform, count: int, seed: int, name: str) -> Floats:
    """Return `count` values of a uniform distribution, SI units; `name` is that of what varies."""
    low, high = (quantity(str(end)) for end in interval.uniform)
    return low + (high - low) * generator(seed, name).random(count)


def wire(projection: Projection | None, senders: int, receivers: int, name: str) -> Wiring:
    """Return the wiring of a projection with a qualified name; from all to all where there is none."""
    if projection is not None and projection.in_degree is not None:
        chosen = fixed_in_degree(senders, receivers, projection.in_degree, generator(projection.seed, name))
        return Wiring(np.full(receivers, projection.in_degree), chosen)
    if projection is not None and projection.probability is not None:
        return by_probability(senders, receivers, float(projection.probability), generator(projection.seed, name))
    everybody = np.tile(np.arange(senders, dtype=np.int32), receivers)
    return Wiring(np.full(receivers, senders), everybody)


def fixed_in_degree(senders: int, receivers: int, count: int, random: np.random.Generator) -> Sources:
    """Return `count` different senders for each receiver, sorted, every set of them equally likely; flat."""
    if 2 * count > senders:
        return _by_smallest_keys(senders, receivers, count, random)
    chosen = np.sort(random.integers(senders, size=(receivers, count), dtype=np.int32), axis=1)
    rows = np.arange(receivers)
    while len(rows):
        some = chosen[rows]
        repeated = np.zeros(some.shape, dtype=bool)
        repeated[:, 1:] = some[:, 1:] == some[:, :-1]
        inside = repeated.any(axis=1)
        rows, some, repeated = rows[inside], some[inside], repeated[inside]
        # Drawing on until enough are different favours no sender.
        some[repeated] = random.integers(senders, size=np.count_nonzero(repeated), dtype=np.int32)
        chosen[rows] = np.sort(some, axis=1)
    return chosen.ravel()


def _by_smallest_keys(senders: int, receivers: int, count: int, random: np.random.Generator) -> Sources:
    chosen = np.empty((receivers, count), dtype=np.int32)
    at_once = max(1, _MOST_AT_ONCE // senders)
    for first in range(0, receivers, at_once):
        keys = random.random((min(at_once, receivers - first), senders))
        smallest = np.argpartition(keys, count - 1, axis=1)[:, :count]
        chosen[first : first + at_once] = np.sort(smallest, axis=1)
    return chosen.ravel()


def by_probability(senders: int, receivers: int, probability: float, random: np.random.Generator) -> Wiring:
    """Return each of all possible synapses with a probability; gaps between those that exist are geometric."""
    pairs = senders * receivers
    pieces = [np.zeros(0, dtype=np.int64)]
    last = -1
    while probability > 0.0 and last < pairs - 1:
        expected = (pairs - last) * probability
        gaps = random.geometric(probability, size=min(_MOST_AT_ONCE, int(expected + 5.0 * expected**0.5) + 10))
        pieces.append(last + np.cumsum(np.minimum(gaps, pairs + 1)))
        last = int(pieces[-1][-1])
    found = np.concatenate(pieces)
    found = found[found < pairs]
    counts = np.bincount(found // senders, minlength=receivers)
    return Wiring(counts, (found % senders).astype(np.int32))
