"""A search under noise with a memory goes on from a suspect that is known, where that is worth anything there."""

from dataclasses import dataclass, field

import pytest

from symid.discrepancy.name import error_model


@dataclass
class Known:
    suspects: tuple[str, ...] = ("gain",)
    fit: object = None
    base: object = None
    data: object = None


@dataclass
class Stub:
    """worthwhile : whether what is known explains enough beside the noise of this search."""

    worthwhile: bool
    base: object = None
    nothing: object = None
    clocks: tuple = ()
    known: list = field(default_factory=list)
    tried: list = field(default_factory=list)

    def worth(self, more, less) -> bool:
        return self.worthwhile


@pytest.mark.parametrize("worthwhile", [True, False])
def test_a_search_begins_anew_where_the_model_as_given_explains_as_much_beside_the_noise(monkeypatch, worthwhile):
    """A standing person with coloured sensors had an input that was 1.007 +- 0.011 times what was recorded: a finding
    that explained nothing, and was never weighed."""
    monkeypatch.setattr(error_model, "_refitted", lambda base, fit, data: base)
    first = Known()
    again = error_model._going_on(Stub(worthwhile), [first], None, lambda base, data: Stub(worthwhile))
    assert again.known == ([first] if worthwhile else [])
