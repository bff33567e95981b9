"""Particle swarm optimisation as thesis B uses it (Dzeladini 2013, equations 2.45 and 2.46), plain and with stages.

    v(t+1) = ω v(t) + c₁ r₁ (x_pb − x(t)) + c₂ r₂ (x_gb − x(t)),   x(t+1) = x(t) + v(t+1)

x_pb is the best place of the particle so far, x_gb that of the whole swarm; c₁ = c₂ = 2.05, ω = 0.729, and no component
of v exceeds 0.3 of its range. `r₁`, `r₂` are uniform in [0, 1], drawn anew for each particle and coordinate.

The thesis calls ω the constriction factor. Constriction (Clerc & Kennedy 2002, 10.1109/4235.985692) is another equation
with the same numbers: there χ = 0.729 multiplies all three terms. `constricts` says which one is meant.

Stage PSO (2.2.1.2) is the same with scores that have stages: a best place of a higher stage replaces one of a lower
stage whatever the values are. A particle enters every stage whose conditions it meets at once, where the thesis lets it
climb by one stage in an iteration.

What the thesis leaves open: the first particle begins at the document's own values, the others anywhere; velocities
begin anywhere within their limit; a particle that would leave the bounds stops at them, without the component of its
velocity that led there; without a best place there is no pull towards it.
"""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.random import Generator
from pydantic import Field

from neuromech.study.algorithms.base import Floats, Generational, Settings, State
from neuromech.study.score import Score
from neuromech.units import DIMENSIONLESS, Dimensionless, Quantity, quantity


class PsoSettings(Settings):
    """Settings of `pso`; the defaults are those of thesis B 2.2.1 and its table of experiments (60 particles)."""

    kind: Literal["pso"] = "pso"
    population: Annotated[int, Field(ge=1, strict=True, description="particles")] = 60
    inertia: Dimensionless = quantity("0.729")
    cognitive: Annotated[Quantity, DIMENSIONLESS.non_negative] = quantity("2.05")
    social: Annotated[Quantity, DIMENSIONLESS.non_negative] = quantity("2.05")
    maximum_velocity: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0).positive] = quantity("0.3")
    constricts: Literal["velocity", "all"] = "velocity"


class Pso(Generational):
    """A swarm with one best place for all, moved by equations 2.45 and 2.46."""

    settings_type: ClassVar[type[Settings]] = PsoSettings
    settings: PsoSettings

    def first(self, random: Generator) -> Floats:
        """Return the particles where they begin."""
        shape = (self.settings.population, self.dimension)
        points = random.random(shape)
        if self.start is not None:
            points[0] = self.start
        self._velocities = self.settings.maximum_velocity * (2.0 * random.random(shape) - 1.0)
        self._best_points = points.copy()
        self._best_scores: list[Score | None] = [None] * len(points)
        return points

    def advance(self, points: Floats, scores: tuple[Score | None, ...], random: Generator) -> Floats:
        """Remember the best places and move every particle."""
        self._keep_best(points, scores)
        pulls = self.settings.cognitive * random.random(points.shape) * self._to_own_best(points)
        pulls = pulls + self.settings.social * random.random(points.shape) * self._to_swarm_best(points)
        return self._move(points, pulls)

    def centers(self) -> Floats:
        """Return the best place of the swarm; none before there is one."""
        best = self._swarm_best()
        return np.empty((0, self.dimension)) if best is None else self._best_points[[best]]

    def memory(self) -> State:
        """Return velocities and best places."""
        scores = [None if score is None else [score.stage, score.value] for score in self._best_scores]
        return {
            "velocities": self._velocities.tolist(),
            "best_points": self._best_points.tolist(),
            "best_scores": scores,
        }

    def remember(self, memory: Mapping[str, Any]) -> None:
        """Take velocities and best places."""
        self._velocities = np.array(memory["velocities"], dtype=np.float64)
        self._best_points = np.array(memory["best_points"], dtype=np.float64)
        self._best_scores = [None if score is None else Score(*score) for score in memory["best_scores"]]

    def _keep_best(self, points: Floats, scores: tuple[Score | None, ...]) -> None:
        for index, (score, best) in enumerate(zip(scores, self._best_scores, strict=True)):
            if score is not None and (best is None or score > best):
                self._best_scores[index] = score
                self._best_points[index] = points[index]

    def _to_own_best(self, points: Floats) -> Floats:
        known = np.array([score is not None for score in self._best_scores])
        return np.where(known[:, None], self._best_points - points, 0.0)

    def _to_swarm_best(self, points: Floats) -> Floats:
        best = self._swarm_best()
        return np.zeros_like(points) if best is None else self._best_points[best] - points

    def _swarm_best(self) -> int | None:
        """Return the particle that has found the best place, the first of equals."""
        found = [(score, -index) for index, score in enumerate(self._best_scores) if score is not None]
        return -max(found)[1] if found else None

    def _move(self, points: Floats, pulls: Floats) -> Floats:
        omega, limit = float(self.settings.inertia), float(self.settings.maximum_velocity)
        pulled = omega * pulls if self.settings.constricts == "all" else pulls
        velocities = np.clip(omega * self._velocities + pulled, -limit, limit)
        moved = points + velocities
        inside = np.clip(moved, 0.0, 1.0)
        self._velocities = np.where(inside == moved, velocities, 0.0)
        return inside
