"""The vocabulary as a value: which class each (family, kind) of a document means."""

from collections.abc import Iterable, Mapping
from importlib.metadata import entry_points
from types import MappingProxyType
from typing import Self

from neuromech.components.base import Component, Family
from neuromech.components.body_sensors import (
    MuscleForceSensor,
    MuscleLengthSensor,
    OverextensionSensor,
    PostureSensor,
    RectifiedJointSensor,
    RectifiedPostureSensor,
)
from neuromech.components.muscle_tendon import MuscleTendonUnit
from neuromech.components.muscles import BrownMuscle
from neuromech.components.neurons import RateNeuron, RybakInterneuron, RybakNeuron, StaticNeuron
from neuromech.components.paths import ConstantMomentArms, LeverArms, StraightLines
from neuromech.components.reflexes import (
    GatedRelay,
    GatingSynapse,
    LatchUnit,
    LowPass,
    SampleAndHold,
    SaturatingNeuron,
    ThresholdUnit,
)
from neuromech.components.sensors import (
    ContactSensor,
    JointSensor,
    LegLoadSensor,
    LinkSensor,
    MuscleSpindle,
    StretchSensor,
)
from neuromech.components.synapses import (
    DescendingDrive,
    ExcitatorySynapse,
    FictiveLoad,
    InhibitorySynapse,
    InterlimbSynapse,
)

BUILT_IN: tuple[type[Component], ...] = (
    RybakNeuron,
    RybakInterneuron,
    RateNeuron,
    StaticNeuron,
    SaturatingNeuron,
    LowPass,
    GatedRelay,
    ThresholdUnit,
    LatchUnit,
    SampleAndHold,
    DescendingDrive,
    FictiveLoad,
    ExcitatorySynapse,
    InhibitorySynapse,
    InterlimbSynapse,
    GatingSynapse,
    BrownMuscle,
    MuscleTendonUnit,
    ConstantMomentArms,
    StraightLines,
    LeverArms,
    StretchSensor,
    MuscleSpindle,
    LegLoadSensor,
    JointSensor,
    LinkSensor,
    ContactSensor,
    MuscleForceSensor,
    MuscleLengthSensor,
    PostureSensor,
    RectifiedPostureSensor,
    RectifiedJointSensor,
    OverextensionSensor,
)


class Catalogue:
    """An immutable set of component classes, looked up by family and kind."""

    def __init__(self, classes: Iterable[type[Component]]) -> None:
        """Collect the classes.

        Raises:
            ValueError: two classes claim the same family and kind.
        """
        found: dict[tuple[Family, str], type[Component]] = {}
        for cls in classes:
            key = (cls.family, cls.kind_name())
            if key in found:
                raise ValueError(
                    f"two components claim the {key[0]} kind '{key[1]}': {found[key].__qualname__} "
                    f"and {cls.__qualname__}"
                )
            found[key] = cls
        self.classes: Mapping[tuple[Family, str], type[Component]] = MappingProxyType(found)
        self._kinds = {family: tuple(sorted(kind for one, kind in found if one == family)) for family, _ in found}

    @classmethod
    def built_in(cls) -> Self:
        """Return the vocabulary that comes with this package."""
        return cls(BUILT_IN)

    @classmethod
    def installed(cls) -> Self:
        """Return the built-in vocabulary joined with every class of the entry-point group `neuromech.components`."""
        plugins = [point.load() for point in entry_points(group="neuromech.components")]
        return cls((*BUILT_IN, *plugins))

    def kinds(self, family: Family) -> tuple[str, ...]:
        """Return the kinds of a family in alphabetical order."""
        return self._kinds.get(family, ())

    def find(self, family: Family, kind: str) -> type[Component] | None:
        """Return the class of a kind, or None where the family has no such kind."""
        return self.classes.get((family, kind))
