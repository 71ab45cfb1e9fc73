"""Terms: one named physical law at one place, as something that can be added to a model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from types import SimpleNamespace

from symid import checked
from symid.errors import ModelError
from symid.model.model import Model
from symid.model.parts.quantities import Bounds, Parameter


@dataclass(frozen=True)
class LawParameter:
    """An unknown of a law.

    Parameters
    ----------
    key : name with its unit as suffix, as reports and answer files write it (``"delay_s"``).
    unit : the unit as text (``"s"``).
    bounds : physical range.
    null : value at which the law has no effect; None where no single value switches it off.
    starts : finite values from which a refit begins, for laws that a slope at zero cannot see.
    typical : a size that would be ordinary in this field, used for scaling.
    plausible : departure from `null` that surprises nobody, such as 0.002 for the gain of an encoder; a
        diagnosis believes in larger ones less (a Cauchy prior of this width). 0 where any size is as likely.
    clock : how the parameter follows a clock instead of the state: "frequency", "phase", "start", "duration"
        or "moment"; "turn" of how often something comes back in each turn; "range" of a position whose bounds and
        starts are parts of the recorded range, from -1 to 1 about its middle; "" for all others.

    Examples
    --------
    >>> LawParameter("torque_Nm", "N*m", bounds=(0, 5), plausible=0.1).unit
    'N*m'
    """

    key: str
    unit: str
    bounds: Bounds = (-inf, inf)
    null: float | None = 0.0
    starts: tuple[float, ...] = ()
    typical: float = 1.0
    plausible: float = 0.0
    clock: str = ""


@dataclass(frozen=True)
class Law:
    """A physical law that a model may lack, wherever it could act.

    Parameters
    ----------
    name : canonical name (``"coulomb_friction"``).
    acts_on : the role of the parts at which it can act (``"joint"``, ``"sensor"`` ...): the
        places are the `at` of all parts of a model with that role; of several roles, the
        places that have parts with each of them.
    parameters : its unknowns.
    build : ``build(model, place, p)`` changes `model` (a fresh copy) so that it contains the
        law at `place`; `p` has the symbols of the law's parameters by key.
    sentence : plain words with ``{place}`` and the parameter keys as blanks.
    source : author and year of the formula.
    place : name of its one place, for a law that acts on all parts with that role at once
        (``"global"``); "" for a law that acts at one part's place.
    applies : ``applies(model, place)`` says whether the law can act at a place that has such parts; at each if left
        out.

    Examples
    --------
    >>> def drag(model, place, p):
    ...     model.add_effort(place, -p.c_Nms_rad * model.rate)
    >>> law = Law("drag", "joint", (LawParameter("c_Nms_rad", "N*m*s/rad", (0, 1)),), drag, "Drag of {c_Nms_rad}")
    >>> str(law.at("shaft"))
    'drag@shaft'
    """

    name: str
    acts_on: str | tuple[str, ...]
    parameters: tuple[LawParameter, ...]
    build: Callable[[Model, str, SimpleNamespace], None]
    sentence: str = ""
    source: str = ""
    place: str = ""
    applies: Callable[[Model, str], bool] | None = None

    def places(self, model: Model) -> list[str]:
        """Where in `model` this law could act, each place once, in order of declaration."""
        first, *others = (self.acts_on,) if isinstance(self.acts_on, str) else self.acts_on
        everywhere = dict.fromkeys(c.at for c in model.find(role=first))
        found = dict.fromkeys(self.place or at for at in everywhere if all(model.find(r, at) for r in others))
        return [at for at in found if self.applies is None or self.applies(model, at)]

    def at(self, place: str) -> Term:
        """This law at one place."""
        return Term(self, place)


@dataclass(frozen=True)
class Term:
    """A law at one place. `Model.with_term(term)` gives a new model that contains it.

    Raises
    ------
    ModelError : it is made of no Law, or its place has no name.

    Attributes
    ----------
    law : what acts. location : the place's name, "joint1" or "sensor:link2".

    Examples
    --------
    >>> str(si.mechanics.LIBRARY["viscous_friction"].at("joint1"))
    'viscous_friction@joint1'
    """

    law: Law
    location: str

    def __post_init__(self) -> None:
        checked.kind(self.law, Law, "the law of a Term", ModelError)
        checked.kind(self.location, str, "the place of a Term", ModelError)

    @property
    def name(self) -> str:
        """Name of its law."""
        return self.law.name

    def parameter_name(self, key: str) -> str:
        """Name of the law's parameter `key` in a model that has this term."""
        place = "".join(c if c.isalnum() else "_" for c in self.location)
        return f"{self.law.name}_{place}_{key}"

    def build(self, model: Model) -> None:
        """Declare the parameters and let the law change `model` in place (a fresh copy).

        Parameters
        ----------
        model : a copy that the law may change.

        Raises
        ------
        ModelError : the law cannot act at its place.
        """
        if self.location not in self.law.places(model):
            raise ModelError(
                f"{self.law.name} cannot act at '{self.location}' of model '{model.name}': it acts on "
                f"parts with role {self.law.acts_on!r}, which are at {self.law.places(model) or 'no place'} "
                "(symid.mechanics.with_places(model) names the places of a model that names none)"
            )
        p = SimpleNamespace()
        for q in self.law.parameters:
            setattr(
                model,
                self.parameter_name(q.key),
                Parameter(
                    unit=q.unit,
                    bounds=q.bounds,
                    role="term",
                    at=self.location,
                    meaning=f"{self.law.name} at {self.location}: {q.key}",
                ),
            )
            setattr(p, q.key, model[self.parameter_name(q.key)].symbol)
        self.law.build(model, self.location, p)

    def __str__(self) -> str:
        return f"{self.name}@{self.location}"
